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

}  // namespace slipwave
