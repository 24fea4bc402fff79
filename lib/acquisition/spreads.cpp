// SPDX-License-Identifier: BSD-3-Clause
#include "acquisition/spreads.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "base/error.hpp"
#include "base/instantiate.hpp"

namespace slipwave {
namespace {

/// Depths below ground or sea floor are rounded so that headers of traces hold them.
constexpr double header_step_m = 1e-3;

/// A place that has no depth: who stands there is not said yet.
class PlacingError : public Error {
 public:
  using Error::Error;
};

std::string place_text(double x, double y, bool with_y) {
  return "x=" + shown(x) + (with_y ? " y=" + shown(y) : "");
}

/// Returns a coordinate as people write places on maps: 6000000, not 6e+06.
std::string map_text(double value) {
  char text[64];
  const auto end = std::to_chars(text, text + sizeof text, value, std::chars_format::fixed);
  return {text, end.ptr};
}

}  // namespace

template <int D>
unsigned Spreads<D>::axes_from_source(const Place& place) const {
  unsigned axes = place.relative;
  for (std::size_t axis = 0; axis + 1 < D; ++axis)
    if ((place.relative_if_outside >> axis & 1U) && ground_.grid().origin_m[axis] >= 0) axes |= 1U << axis;
  return axes;
}

template <int D>
double Spreads<D>::depth_of(const Place& place, const Point<D>& at, double given_m) const {
  if (place.depth_from == DepthFrom::datum) {
    if (!(given_.rounding_m > 0)) return given_m;
    // What was rounded to lie above the surface lies on it.
    const auto surface = ground_.surface_m(at), floor = ground_.floor_m(at);
    const double half_step_m = header_step_m / 2;
    if (surface && *surface - given_m >= -half_step_m && *surface - given_m <= given_.rounding_m)
      return *surface;
    return floor && std::abs(*floor - given_m) <= half_step_m ? *floor : given_m;
  }
  const bool of_floor = place.depth_from == DepthFrom::floor;
  const auto level = of_floor ? ground_.floor_m(at) : ground_.surface_m(at);
  if (!level)
    throw PlacingError("has its depth from the " + std::string(of_floor ? "sea floor" : "surface") +
                       ", found " + (of_floor ? "no water above rock" : "only void") + " at " +
                       place_text(at[0], at[D - 2], D == 3));
  if (given_m == 0) return *level;
  return std::nearbyint((*level + given_m) / header_step_m) * header_step_m;
}

template <int D>
Point<D> Spreads<D>::point_of(const Place& place, const std::array<double, 3>& source_m) const {
  auto map = place.at_m;
  const unsigned from_source = axes_from_source(place);
  for (std::size_t axis = 0; axis < 3; ++axis)
    if (from_source >> axis & 1U) map[axis] += source_m[axis];
  const auto across = given_.frame.model_m(map[0], map[1]);
  Point<D> point{};
  for (std::size_t axis = 0; axis + 1 < D; ++axis) point[axis] = across[axis];
  point[D - 1] = depth_of(place, point, map[2]);
  return point;
}

template <int D>
Point<D> Spreads<D>::source_of(std::size_t shot, std::size_t which) const {
  const auto& of_shot = given_.shots[shot - 1];
  const auto& source = of_shot.sources[which];
  try {
    return point_of(source.place, {});
  } catch (const PlacingError& error) {
    throw Error(name_of_source(shot, which) + ' ' + error.what());
  }
}

/// The first source where receivers are counted from: on the map, its depth found.
template <int D>
std::array<double, 3> Spreads<D>::map_source_of(std::size_t shot) const {
  auto map = given_.shots[shot - 1].sources.front().place.at_m;
  map[2] = source_of(shot, 0)[D - 1];
  return map;
}

template <int D>
std::size_t Spreads<D>::count_of(std::size_t shot) const {
  std::size_t count = 0;
  for (const auto& run : given_.runs_of(shot - 1)) count += run.count;
  return count;
}

template <int D>
std::vector<Receiver<D>> Spreads<D>::receivers_of(std::size_t shot) const {
  std::vector<Receiver<D>> receivers;
  receivers.reserve(count_of(shot));
  const auto source = map_source_of(shot);
  for (const auto& run : given_.runs_of(shot - 1))
    for (std::uint32_t n = 0; n < run.count; ++n) {
      const auto& place = given_.places[run.first_place + n];
      auto& receiver = receivers.emplace_back();
      receiver.channel = run.channel + std::int64_t(n) * run.channel_step;
      if (run.first_bin >= 0) receiver.bin = given_.bins[std::size_t(run.first_bin) + n];
      try {
        receiver.point_m = point_of(place, source);
      } catch (const PlacingError& error) {
        throw Error("receiver " + std::to_string(receivers.size()) + ' ' + error.what());
      }
      receiver.map_m = place.at_m;
      const unsigned from_source = axes_from_source(place);
      for (std::size_t axis = 0; axis < 2; ++axis)
        if (from_source >> axis & 1U) receiver.map_m[axis] += source[axis];
      receiver.map_m[2] = receiver.point_m[D - 1];
    }
  return receivers;
}

template <int D>
void Spreads<D>::each_place(const std::function<void(const Point<D>&, std::size_t, std::size_t)>& see) const {
  std::vector<bool> seen(given_.places.size());
  for (std::size_t shot = 1; shot <= given_.shots.size(); ++shot) {
    std::size_t number = 0;
    std::optional<std::array<double, 3>> source;
    for (const auto& run : given_.runs_of(shot - 1))
      for (std::uint32_t n = 0; n < run.count; ++n) {
        ++number;
        const std::size_t at = run.first_place + n;
        if (seen[at]) continue;
        const auto& place = given_.places[at];
        seen[at] = stands(place);
        if (!source) source = map_source_of(shot);
        try {
          see(point_of(place, *source), shot, number);
        } catch (const PlacingError& error) {
          throw Error("shot " +
                      std::to_string(given_.numbered ? given_.shots[shot - 1].number : std::int64_t(shot)) +
                      ": receiver " + std::to_string(number) + ' ' + error.what());
        }
      }
  }
}

template <int D>
std::string Spreads<D>::name_of_source(std::size_t shot, std::size_t which) const {
  const auto& from = given_.shots[shot - 1].sources[which].from;
  return from.empty() ? "source " + std::to_string(shot) : from + ": the source";
}

template <int D>
std::string Spreads<D>::remedy() const {
  if (!given_.from_map) return "";
  const auto fitting = fitting_frame(given_, D);
  std::string doubt = given_.doubt.empty() ? "" : "; or " + given_.doubt;
  if (fitting.origin_m == given_.frame.origin_m && fitting.azimuth_deg == given_.frame.azimuth_deg)
    return doubt;
  return "; the survey would begin at the model's origin with --origin " + map_text(fitting.origin_m[0]) +
         "," + map_text(fitting.origin_m[1]) +
         (fitting.azimuth_deg == 90 ? "" : " --azimuth " + shown(fitting.azimuth_deg)) + doubt;
}

template <int D>
double Spreads<D>::moved_m() const {
  if (D == 3) return 0;
  double most = 0;
  const auto see = [&](const Place& place) {
    most = std::max(most, std::abs(given_.frame.model_m(place.at_m[0], place.at_m[1])[1]));
  };
  for (const auto& shot : given_.shots)
    for (const auto& source : shot.sources) see(source.place);
  for (const auto& place : given_.places)
    if (axes_from_source(place) == 0) see(place);
  return most;
}

template <int D>
double Spreads<D>::offset_change_m() const {
  if (D == 3) return 0;
  double most = 0;
  for (const auto& shot : given_.shots) {
    const auto& source = shot.sources.front().place.at_m;
    for (std::size_t n = shot.first_run; n < shot.last_run; ++n)
      for (std::uint32_t k = 0; k < given_.runs[n].count; ++k) {
        const auto& place = given_.places[given_.runs[n].first_place + k];
        if (axes_from_source(place) != 0) continue;
        const double x = place.at_m[0] - source[0], y = place.at_m[1] - source[1];
        const auto to = given_.frame.model_m(place.at_m[0], place.at_m[1]);
        const auto from = given_.frame.model_m(source[0], source[1]);
        most = std::max(most, std::abs(std::hypot(x, y) - std::abs(to[0] - from[0])));
      }
  }
  return most;
}

SLIPWAVE_INSTANTIATE_D(TYPE, class Spreads);

}  // namespace slipwave
