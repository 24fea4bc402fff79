// SPDX-License-Identifier: BSD-3-Clause
#include "traces/cube_numbers.hpp"

#include "base/error.hpp"
#include "segy/geometry.hpp"

namespace slipwave {

std::string CubeNumbers::shown(const Place& place) {
  return "channel " + std::to_string(place.channel) + ", " +
         name_of(segy::component_of_code(place.component));
}

void CubeNumbers::refuse(const std::string& what) {
  throw Error(what + "; a cube needs the same traces of every shot, sorted by sw-sort --key fldr,tracf,trid");
}

void CubeNumbers::number(segy::TraceWords& words) {
  const std::int64_t shot = words.get("fldr");
  const Place place{words.get("tracf"), words.get("trid")};
  const std::string found =
      "trace " + std::to_string(++traces_) + ": found shot " + std::to_string(shot) + ", " + shown(place);
  if (traces_ == 1) first_shot_ = shot_ = shot;
  if (shot == first_shot_) {
    if (!of_first_shot_.empty() && (shot_ != shot || !(of_first_shot_.back() < place)))
      refuse(found + " behind shot " + std::to_string(shot_) + ", " + shown(of_first_shot_.back()));
    of_first_shot_.push_back(place);
    next_ = of_first_shot_.size();
  } else {
    const bool begins = next_ == of_first_shot_.size();
    if (begins && shot <= shot_) refuse(found + " behind shot " + std::to_string(shot_));
    if (begins) shot_ = shot, next_ = 0;
    if (shot != shot_ || !(place == of_first_shot_[next_]))
      refuse(found + ", expected shot " + std::to_string(shot_) + ", " + shown(of_first_shot_[next_]));
    ++next_;
  }
  words.set("iline", shot);
  words.set("xline", place.channel);
  words.set("offset", place.component);
}

void CubeNumbers::finish() const {
  if (next_ != of_first_shot_.size())
    refuse("shot " + std::to_string(shot_) + " ends before " + shown(of_first_shot_[next_]));
}

void AreaNumbers::refuse(const std::string& what) {
  throw Error(what +
              "; an area needs the same records of every receiver, sorted by sw-sort --key gy,gx,fldr,trid");
}

std::string AreaNumbers::shown(const Record& record) {
  return "shot " + std::to_string(record.shot) + ", " + name_of(segy::component_of_code(record.component));
}

void AreaNumbers::begin_receiver(std::int64_t y, std::int64_t x, const std::string& found) {
  if (next_ != records_.size())
    refuse(found + ", expected " + shown(records_[next_]) + " of the receiver before");
  next_ = 0;
  if (y == y_ && x > x_) {
    ++column_;
    if (line_ == 0) x_of_line_.push_back(x);
  } else if (y > y_ && column_ + 1 == x_of_line_.size()) {
    ++line_;
    column_ = 0;
  } else {
    refuse(found + " behind one at y=" + std::to_string(y_) + " x=" + std::to_string(x_));
  }
  if (column_ >= x_of_line_.size() || x != x_of_line_[column_])
    refuse(found + ", where the first line has no receiver at that x");
  y_ = y;
  x_ = x;
}

void AreaNumbers::number(segy::TraceWords& words) {
  const std::int64_t x = words.get("gx"), y = words.get("gy");
  const Record record{words.get("fldr"), words.get("trid")};
  const std::string found = "trace " + std::to_string(++traces_) +
                            ": found a receiver at y=" + std::to_string(y) + " x=" + std::to_string(x) +
                            " (bytes 85 and 81)";
  const bool first = traces_ == 1 || (line_ == 0 && column_ == 0 && x == x_ && y == y_);
  if (traces_ == 1) {
    x_ = x;
    y_ = y;
    x_of_line_ = {x};
  }
  if (first) {
    records_.push_back(record);
    next_ = records_.size() - 1;
  } else {
    if (x != x_ || y != y_) begin_receiver(y, x, found);
    if (next_ == records_.size() || !(record == records_[next_]))
      refuse(found + " with " + shown(record) + ", expected " +
             (next_ == records_.size() ? "no more" : shown(records_[next_])));
  }
  words.set("iline", static_cast<std::int64_t>(line_) + 1);
  words.set("xline", static_cast<std::int64_t>(column_) + 1);
  words.set("offset", static_cast<std::int64_t>(++next_));
}

void AreaNumbers::finish() const {
  if (next_ != records_.size()) refuse("the last receiver ends before " + shown(records_[next_]));
  if (traces_ > 0 && column_ + 1 != x_of_line_.size()) refuse("the last line ends before its last receiver");
}

}  // namespace slipwave
