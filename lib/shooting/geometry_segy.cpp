// SPDX-License-Identifier: BSD-3-Clause
#include "shooting/geometry_segy.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <tuple>
#include <utility>

#include "base/error.hpp"
#include "segy/geometry.hpp"
#include "segy/reader.hpp"

namespace slipwave {
namespace {

using Space = std::array<double, 3>;

/// What a trace header says of the geometry, SI.
struct TraceGeometry {
  Space source_m{}, receiver_m{};
  double offset_m = 0;
  std::int64_t shot = 0, channel = 0;
  std::int32_t bin = 0;
  std::int16_t component = 0;
};

/// What the traces of a file have in common.
struct Known {
  bool source = false, receiver = false, depth = false, midpoint = false, bin = false;
  bool places_midpoints = false;     // midpoints say where ends without coordinates are
  bool receiver_fits_offset = true;  // where receivers without coordinates would stand at 0,0
  bool source_fits_offset = true;
  double least_offset_m = 0, largest_offset_m = 0;
};

double across(const Space& a, const Space& b) { return std::hypot(a[0] - b[0], a[1] - b[1]); }

class GeometryReader {
 public:
  GeometryReader(const std::string& path, std::vector<std::uint8_t> already_read)
      : reader_(path, {}, std::move(already_read)) {}

  GivenSurvey read() {
    while (reader_.next(trace_)) in_place(place(reader_.delivered()), [&] { take(); });
    if (traces_.empty()) throw Error(reader_.name() + ": found no trace, expected those of a survey");
    in_place(reader_.name(), [&] { complete(); });
    group();
    return collect();
  }

 private:
  std::string place(std::int64_t trace) const { return reader_.name() + ": trace " + std::to_string(trace); }
  void check_words() const;
  void take();
  void complete();
  void group();
  void refuse_again(const TraceGeometry& trace, std::size_t n, std::size_t first) const;
  void check_spread(const std::vector<std::size_t>& traces) const;
  std::string hint_of_revision() const;
  GivenSurvey collect();
  void add_shot(GivenSurvey& survey, ReceiverCollector& collector, const std::vector<std::size_t>& traces);

  segy::Reader reader_;
  segy::RawTrace trace_;
  std::vector<TraceGeometry> traces_;
  std::vector<Space> midpoints_m_;  // where nothing else is known
  std::vector<std::vector<std::size_t>> shots_;
  Known known_;
  double rounding_m_ = 0;
  std::int64_t multiplied_ = 0;  // the largest scalar of coordinates
};

void GeometryReader::check_words() const {
  for (const auto& [name, byte, word] : {std::tuple("scalel", 69, trace_.words.get("scalel")),
                                         std::tuple("scalco", 71, trace_.words.get("scalco"))})
    if (!segy::is_length_scalar(word))
      throw Error("found scalar " + std::string(name) + " (byte " + std::to_string(byte) + ") " +
                  std::to_string(word) + ", expected 1, 10, 100, 1000 or 10000, or one of them negative");
  if (trace_.words.get("counit") > 1)
    throw Error("found coordinates in arc (counit, byte 89, is " +
                std::to_string(trace_.words.get("counit")) +
                "), expected lengths; convert them to metres first");
}

void GeometryReader::take() {
  check_words();
  const auto& words = trace_.words;
  const auto header = reader_.si_header(trace_);
  const double length = reader_.header().feet ? 0.3048 : 1;
  TraceGeometry found{header.source_m,
                      header.receiver_m,
                      length * double(words.get("offset")),
                      header.shot,
                      header.channel,
                      std::int32_t(words.get("cdp")),
                      std::int16_t(words.get("trid"))};
  for (const auto& point : {found.source_m, found.receiver_m})
    for (const double value : point)
      if (!std::isfinite(value)) throw Error("found a coordinate of " + shown(value) + ", expected a number");
  const Space zero{};
  const bool source = across(found.source_m, zero) > 0, receiver = across(found.receiver_m, zero) > 0;
  known_.source |= source;
  known_.receiver |= receiver;
  const auto midpoint = segy::place_words(words, reader_.header()).midpoint_m;
  known_.places_midpoints |= midpoint[0] != 0 || midpoint[1] != 0;
  known_.depth |= found.source_m[2] != 0 || found.receiver_m[2] != 0;
  known_.bin |= found.bin != 0;
  const double distance = across(found.source_m, found.receiver_m);
  const bool fits = std::abs(std::abs(found.offset_m) - distance) <= length;
  known_.receiver_fits_offset &= fits;
  known_.source_fits_offset &= fits;
  if (traces_.empty()) known_.least_offset_m = known_.largest_offset_m = found.offset_m;
  known_.least_offset_m = std::min(known_.least_offset_m, found.offset_m);
  known_.largest_offset_m = std::max(known_.largest_offset_m, found.offset_m);
  multiplied_ = std::max(multiplied_, words.get("scalco"));
  const auto scalar = words.get("scalel");
  rounding_m_ = std::max(rounding_m_, 0.5 * length * segy::scaled(1, scalar));
  if (!known_.source && !known_.receiver) {
    midpoints_m_.resize(traces_.size() + 1);
    for (const std::size_t axis : {0, 1})
      midpoints_m_.back()[axis] =
          length * segy::scaled(axis == 0 ? words.get("cdpx") : words.get("cdpy"), words.get("scalco"));
    known_.midpoint |= across(midpoints_m_.back(), zero) > 0;
  }
  traces_.push_back(found);
}

/// Puts coordinates that are missing in their place by offsets and midpoints.
void GeometryReader::complete() {
  const bool any_offset = known_.least_offset_m != 0 || known_.largest_offset_m != 0;
  const auto& given = reader_.positions();
  if (!given.source && !given.receiver && !known_.places_midpoints && any_offset &&
      known_.least_offset_m == known_.largest_offset_m && traces_.size() > 1)
    throw Error("found no coordinates of sources (bytes 73, 77) and receivers (81, 85), and one offset, " +
                shown(known_.least_offset_m) + " m, for all traces; expected coordinates" +
                hint_of_revision());
  if (known_.source && !known_.receiver && !known_.receiver_fits_offset)
    for (auto& trace : traces_)
      trace.receiver_m = {trace.source_m[0] + trace.offset_m, trace.source_m[1], trace.receiver_m[2]};
  if (!known_.source && known_.receiver && any_offset && !known_.source_fits_offset)
    for (auto& trace : traces_)
      trace.source_m = {trace.receiver_m[0] - trace.offset_m, trace.receiver_m[1], trace.source_m[2]};
  if (known_.source || known_.receiver) return;
  const bool differ = known_.least_offset_m != known_.largest_offset_m;
  if (known_.midpoint && (!any_offset || differ)) {
    for (std::size_t n = 0; n < traces_.size(); ++n) {
      for (const std::size_t axis : {0, 1})
        traces_[n].source_m[axis] = traces_[n].receiver_m[axis] = midpoints_m_[n][axis];
      traces_[n].source_m[0] -= traces_[n].offset_m / 2;
      traces_[n].receiver_m[0] += traces_[n].offset_m / 2;
    }
    return;
  }
  if (differ) {
    for (auto& trace : traces_) trace.receiver_m[0] = trace.offset_m;
    return;
  }
  if (known_.depth && !any_offset) return;
  throw Error(
      "found no geometry: coordinates of sources (bytes 73, 77), receivers (81, 85) and midpoints "
      "(181, 185) are 0, and the offset (37) is " +
      shown(known_.least_offset_m) + " m in every trace");
}

/// A shot for each field record and source, in the order of their first traces.
void GeometryReader::group() {
  std::map<std::tuple<std::int64_t, double, double, double>, std::size_t> numbers;
  for (std::size_t n = 0; n < traces_.size(); ++n) {
    const auto& trace = traces_[n];
    const auto& before = traces_[n == 0 ? 0 : n - 1];
    if (n > 0 && trace.shot == before.shot && trace.source_m == before.source_m) {
      const auto key = std::tuple(trace.shot, trace.source_m[0], trace.source_m[1], trace.source_m[2]);
      shots_[numbers.at(key)].push_back(n);
      continue;
    }
    const auto [at, is_new] = numbers.try_emplace(
        std::tuple(trace.shot, trace.source_m[0], trace.source_m[1], trace.source_m[2]), shots_.size());
    if (is_new) shots_.emplace_back();
    shots_[at->second].push_back(n);
  }
}

/// A receiver without a channel where another of the same record and component is.
void GeometryReader::refuse_again(const TraceGeometry& trace, std::size_t n, std::size_t first) const {
  throw Error(
      place(std::int64_t(n) + 1) + ": found channel 0 of field record " + std::to_string(trace.shot) +
      " again at x = " + shown(trace.receiver_m[0]) + " m (first: trace " + std::to_string(first + 1) +
      "), expected gathers, with records (byte 9) and channels (byte 13) or a place of its own for each "
      "trace (bytes 73 to 88)" +
      hint_of_revision());
}

std::string GeometryReader::hint_of_revision() const {
  return reader_.header().major < 1 && !reader_.header().su
             ? "; midpoints in bytes 181 to 188 count from revision 1 on"
             : "";
}

/// Receivers that only offsets place, all of them at one.
void GeometryReader::check_spread(const std::vector<std::size_t>& traces) const {
  const auto& first = traces_[traces.front()];
  if (reader_.positions().receiver || traces.size() < 2) return;
  for (const auto n : traces)
    if (traces_[n].receiver_m != first.receiver_m || traces_[n].component != first.component) return;
  throw Error(place(std::int64_t(traces.front()) + 1) + ": found all " + std::to_string(traces.size()) +
              " receivers of field record " + std::to_string(first.shot) + " at one offset (byte 37), " +
              shown(first.offset_m) + " m, and no coordinates of them, expected some (bytes 81, 85)" +
              hint_of_revision());
}

void GeometryReader::add_shot(GivenSurvey& survey, ReceiverCollector& collector,
                              const std::vector<std::size_t>& traces) {
  check_spread(traces);
  auto& shot = survey.shots.emplace_back();
  const auto& first = traces_[traces.front()];
  shot.number = first.shot;
  GivenSource source;
  source.place.at_m = first.source_m;
  source.from = place(std::int64_t(traces.front()) + 1);
  shot.sources.push_back(std::move(source));
  collector.begin(survey.shots.size() - 1);
  std::map<std::pair<std::int64_t, std::int16_t>, std::size_t> channels;  // of each component: trace
  // The first component at each of them, and its trace.
  std::map<std::pair<std::int64_t, Space>, std::pair<std::int16_t, std::size_t>> receivers;
  for (const auto n : traces) {
    const auto& trace = traces_[n];
    if (trace.channel != 0) {
      const auto [same, is_new] = channels.try_emplace({trace.channel, trace.component}, n);
      if (!is_new)
        throw Error(place(std::int64_t(n) + 1) + ": found channel " + std::to_string(trace.channel) +
                    " of field record " + std::to_string(trace.shot) + " again (first: trace " +
                    std::to_string(same->second + 1) + "), expected it once");
    }
    const auto [receiver, is_new] =
        receivers.try_emplace({trace.channel, trace.receiver_m}, std::pair(trace.component, n));
    if (!is_new && receiver->second.first != trace.component) continue;
    if (!is_new) refuse_again(trace, n, receiver->second.second);
    Place place;
    place.at_m = trace.receiver_m;
    collector.add(place, trace.channel, known_.bin ? std::optional<std::int64_t>(trace.bin) : std::nullopt);
  }
  collector.end();
}

GivenSurvey GeometryReader::collect() {
  GivenSurvey survey;
  survey.told_apart = true;
  survey.rounding_m = rounding_m_;
  ReceiverCollector collector(survey);
  for (const auto& traces : shots_) add_shot(survey, collector, traces);
  settle_numbers(survey);
  survey.numbered = true;
  if (multiplied_ > 1)
    survey.doubt = "the scalar scalco (byte 71) " + std::to_string(multiplied_) +
                   " is reversed: it multiplies, -" + std::to_string(multiplied_) + " divides";
  return survey;
}

}  // namespace

GivenSurvey read_trace_geometry(const std::string& path, std::vector<std::uint8_t> already_read) {
  return GeometryReader(path, std::move(already_read)).read();
}

}  // namespace slipwave
