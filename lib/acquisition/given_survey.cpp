// SPDX-License-Identifier: BSD-3-Clause
#include "acquisition/given_survey.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <numbers>
#include <unordered_set>

#include "base/error.hpp"

namespace slipwave {

std::array<double, 2> MapFrame::model_m(double map_x, double map_y) const {
  if (is_identity()) return {map_x, map_y};
  // Multiples of 90 degrees turn exactly.
  const auto sine = [](double degrees) {
    const double turned = std::remainder(degrees, 360.);
    if (std::fmod(turned, 180.) == 0) return 0.;
    return turned == 90 ? 1. : turned == -90 ? -1. : std::sin(turned * std::numbers::pi / 180);
  };
  const double east = sine(azimuth_deg), north = sine(azimuth_deg + 90);
  const double x = map_x - origin_m[0], y = map_y - origin_m[1];
  return {x * east + y * north, y * east - x * north};
}

MapFrame fitting_frame(const GivenSurvey& survey, int dimension) {
  std::vector<std::array<double, 2>> points;
  const auto add = [&](const Place& place) { points.push_back({place.at_m[0], place.at_m[1]}); };
  for (const auto& shot : survey.shots) add(shot.sources.front().place);
  for (const auto& place : survey.places) add(place);
  MapFrame frame;
  if (points.empty()) return frame;
  frame.origin_m = points.front();
  if (dimension == 3) {
    for (const auto& point : points)
      for (const std::size_t axis : {0, 1})
        frame.origin_m[axis] = std::min(frame.origin_m[axis], point[axis]);
    return frame;
  }
  std::array<double, 2> mean{};
  for (const auto& point : points)
    for (const std::size_t axis : {0, 1}) mean[axis] += point[axis] / double(points.size());
  double xx = 0, xy = 0, yy = 0;
  for (const auto& [x, y] : points) {
    xx += (x - mean[0]) * (x - mean[0]);
    xy += (x - mean[0]) * (y - mean[1]);
    yy += (y - mean[1]) * (y - mean[1]);
  }
  // The angle of the axis of least squares, towards where the survey goes.
  double angle = std::atan2(2 * xy, xx - yy) / 2;
  const auto along = [&](const std::array<double, 2>& point) {
    return (point[0] - mean[0]) * std::cos(angle) + (point[1] - mean[1]) * std::sin(angle);
  };
  if (along(points.back()) < along(points.front())) angle += std::numbers::pi;
  frame.azimuth_deg = std::round(std::remainder(90 - angle * 180 / std::numbers::pi, 360) * 100) / 100;
  double least = 0;
  for (const auto& point : points) least = std::min(least, along(point));
  // Rounded, it still lies before the first place.
  frame.origin_m = {std::round(mean[0] + (least - 1) * std::cos(angle)) + 0.0,
                    std::round(mean[1] + (least - 1) * std::sin(angle)) + 0.0};
  return frame;
}

std::size_t ReceiverCollector::Hash::operator()(const Place& place) const {
  std::uint64_t sum = 0x9e3779b97f4a7c15U + std::uint64_t(place.depth_from);
  for (const double value : place.at_m) {
    sum ^= std::bit_cast<std::uint64_t>(value + 0.0);
    sum *= 0xff51afd7ed558ccdU;
    sum ^= sum >> 32U;
  }
  return std::size_t(sum);
}

void ReceiverCollector::begin(std::size_t shot) {
  shot_ = shot;
  survey_.shots[shot].first_run = survey_.shots[shot].last_run = survey_.runs.size();
}

std::uint32_t ReceiverCollector::place_of(const Place& place) {
  if (survey_.places.size() >= std::numeric_limits<std::uint32_t>::max())
    throw Error("found more than 4294967295 places of receivers, expected fewer");
  const auto [at, is_new] = numbers_.try_emplace(place, std::uint32_t(survey_.places.size()));
  if (is_new) survey_.places.push_back(place);
  return at->second;
}

bool ReceiverCollector::continues(std::uint32_t place, std::int64_t channel, bool with_bin) const {
  if (survey_.runs.size() == survey_.shots[shot_].first_run) return false;
  const auto& run = survey_.runs.back();
  const bool next_bin =
      with_bin ? run.first_bin + run.count == std::int64_t(survey_.bins.size()) - 1 : run.first_bin < 0;
  const bool next_channel =
      run.count == 1 || channel == run.channel + std::int64_t(run.count) * run.channel_step;
  return place == run.first_place + run.count && next_channel && (run.first_bin >= 0) == with_bin && next_bin;
}

void ReceiverCollector::add(const Place& place, std::int64_t channel, std::optional<std::int64_t> bin) {
  // What follows the last place most likely is the next one.
  std::uint32_t number = 0;
  const bool any = survey_.runs.size() > survey_.shots[shot_].first_run;
  const std::size_t next = any ? survey_.runs.back().first_place + std::size_t(survey_.runs.back().count) : 0;
  if (any && next < survey_.places.size() && survey_.places[next] == place)
    number = std::uint32_t(next);
  else
    number = place_of(place);
  if (bin) survey_.bins.push_back(std::int32_t(*bin));
  if (continues(number, channel, bin.has_value())) {
    auto& run = survey_.runs.back();
    if (run.count == 1) run.channel_step = std::int32_t(channel - run.channel);
    ++run.count;
    return;
  }
  survey_.runs.push_back(
      {number, 1, std::int32_t(channel), 1, bin ? std::int64_t(survey_.bins.size()) - 1 : std::int64_t(-1)});
}

void ReceiverCollector::add(const ReceiverRun& run) { survey_.runs.push_back(run); }

void ReceiverCollector::end() {
  auto& shot = survey_.shots[shot_];
  shot.last_run = survey_.runs.size();
  if (shot_ == 0) return;
  // A spread that stays is held once.
  const auto& before = survey_.shots[shot_ - 1];
  const auto same = [](const ReceiverRun& one, const ReceiverRun& other) {
    return one.first_place == other.first_place && one.count == other.count && one.channel == other.channel &&
           (one.count == 1 || one.channel_step == other.channel_step) && one.first_bin < 0 &&
           other.first_bin < 0;
  };
  const auto first = survey_.runs.begin() + std::ptrdiff_t(shot.first_run);
  if (!std::equal(first, survey_.runs.end(), survey_.runs.begin() + std::ptrdiff_t(before.first_run),
                  survey_.runs.begin() + std::ptrdiff_t(before.last_run), same))
    return;
  survey_.runs.resize(shot.first_run);
  shot.first_run = before.first_run;
  shot.last_run = before.last_run;
}

void settle_numbers(GivenSurvey& survey) {
  std::unordered_set<std::int64_t> numbers;
  survey.numbered = false;
  for (const auto& shot : survey.shots) {
    survey.numbered = survey.numbered || shot.number != 0;
    numbers.insert(shot.number);
  }
  survey.distinct = numbers.size() == survey.shots.size();
}

}  // namespace slipwave
