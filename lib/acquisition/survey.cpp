// SPDX-License-Identifier: BSD-3-Clause
#include "acquisition/survey.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/error.hpp"
#include "base/instantiate.hpp"

namespace slipwave {

template <int D>
bool is_inside(const Point<D>& point, const Grid<D>& grid) {
  const Point<D> at = grid.row_coordinates(point);
  bool inside = true;
  for (int axis = 0; axis < D; ++axis)
    inside = inside && at[axis] >= grid.origin_m[axis] && at[axis] <= grid.end(axis);
  return inside;
}

template <int D>
void check_inside(const std::string& what, const Point<D>& point, const Grid<D>& grid,
                  const std::string& remedy) {
  if (is_inside<D>(point, grid)) return;
  // Rounding noise is no one's coordinate.
  constexpr int digits = 9, of_depths = 7;
  std::string place, extent;
  for (int axis = 0; axis < D; ++axis) {
    const std::string name(1, axis_names<D>()[axis]), separator = axis == 0 ? "" : " ";
    place += separator + name + "=" + shown(point[axis], digits);
    const bool curvilinear = axis == D - 1 && grid.rows;
    const auto depths = curvilinear ? grid.depths_at(point) : std::array{grid.origin_m[axis], grid.end(axis)};
    extent += separator + name + "=" + shown(depths[0], curvilinear ? of_depths : digits) + ".." +
              shown(depths[1], curvilinear ? of_depths : digits) + (curvilinear ? " there" : "");
  }
  bool beside = false;
  for (int axis = 0; axis < D - 1; ++axis)
    beside = beside || !(point[axis] >= grid.origin_m[axis] && point[axis] <= grid.end(axis));
  if (grid.rows && !beside && point[D - 1] < grid.depths_at(point)[0])
    throw Error(what + " at " + place +
                " lies above the model, expected rock or fluid: the surface there is at z=" +
                shown(grid.depths_at(point)[0], of_depths));
  throw Error(what + " at " + place + " lies outside the model, expected " + extent + (beside ? remedy : ""));
}

template <int D>
std::vector<Receiver<D>> Survey<D>::receivers_of(std::size_t shot) const {
  if (spreads) return spreads->receivers_of(shot);
  std::vector<Receiver<D>> receivers;
  receivers.reserve(receivers_m.size());
  for (const auto& point : receivers_m) {
    auto& receiver = receivers.emplace_back();
    receiver.point_m = point;
    receiver.channel = std::int64_t(receivers.size());
    receiver.map_m = {point[0], D == 3 ? point[D - 2] : 0, point[D - 1]};
  }
  return receivers;
}

template <int D>
bool Survey<D>::any_receiver() const {
  return spreads ? !spreads->given().places.empty() : !receivers_m.empty();
}

template <int D>
std::int64_t Survey<D>::number_of(std::size_t shot) const {
  return spreads && spreads->given().numbered ? spreads->given().shots[shot - 1].number : std::int64_t(shot);
}

template <int D>
std::int64_t Survey<D>::label_of(std::size_t shot) const {
  return spreads && spreads->given().distinct ? number_of(shot) : std::int64_t(shot);
}

template <int D>
std::string Survey<D>::name_of_source(std::size_t shot, std::size_t which) const {
  if (spreads) return spreads->name_of_source(shot, which);
  return "source " + std::to_string(shot) +
         (which == 0 ? "" : " (blended, " + std::to_string(which + 1) + ")");
}

template <int D>
std::vector<const Source<D>*> Survey<D>::sources_of(std::size_t shot) const {
  std::vector<const Source<D>*> all = {&sources[shot - 1]};
  if (!blended.empty())
    for (const auto& source : blended[shot - 1]) all.push_back(&source);
  return all;
}

template <int D>
void each_receiver(const Survey<D>& survey,
                   const std::function<void(const Point<D>&, std::size_t, std::size_t)>& see) {
  if (survey.spreads) return survey.spreads->each_place(see);
  for (std::size_t n = 0; n < survey.receivers_m.size(); ++n) see(survey.receivers_m[n], 1, n + 1);
}

template <int D>
std::string name_of_receiver(const Survey<D>& survey, std::size_t shot, std::size_t number) {
  std::string name = "receiver " + std::to_string(number);
  if (!survey.spreads) return name;
  const auto receiver = survey.spreads->receivers_of(shot)[number - 1];
  if (receiver.channel != std::int64_t(number)) name += " (channel " + std::to_string(receiver.channel) + ")";
  if (!survey.spreads->given().frame.is_identity())
    name += ", on the map at " + shown(receiver.map_m[0]) + "," + shown(receiver.map_m[1]) + ",";
  return "shot " + std::to_string(survey.label_of(shot)) + ": " + name;
}

template <int D>
bool needs_ground(const Survey<D>& survey) {
  if (!survey.spreads) return false;
  const auto& given = survey.spreads->given();
  const auto from_ground = [](const Place& place) { return place.depth_from != DepthFrom::datum; };
  return given.rounding_m > 0 || std::any_of(given.places.begin(), given.places.end(), from_ground) ||
         std::any_of(given.shots.begin(), given.shots.end(), [&](const GivenShot& shot) {
           return std::any_of(shot.sources.begin(), shot.sources.end(),
                              [&](const GivenSource& source) { return from_ground(source.place); });
         });
}

namespace {

template <int D>
void put_on_ground(Survey<D>& survey) {
  const auto* const spreads = &*survey.spreads;
  const auto* const given = &spreads->given();
  for (std::size_t shot = 1; shot <= survey.sources.size(); ++shot) {
    survey.sources[shot - 1].position_m = spreads->source_of(shot, 0);
    for (std::size_t n = 1; n < given->shots[shot - 1].sources.size(); ++n)
      survey.blended[shot - 1][n - 1].position_m = spreads->source_of(shot, n);
  }
  const bool of_options = std::all_of(given->shots.begin(), given->shots.end(), [](const GivenShot& shot) {
    return shot.sources.front().from.empty();
  });
  const bool alike = of_options && !given->numbered && !given->told_apart && given->frame.is_identity() &&
                     std::all_of(given->places.begin(), given->places.end(),
                                 [&](const Place& one) { return spreads->stands(one); });
  if (!alike) return;
  if (!survey.sources.empty())
    for (const auto& receiver : spreads->receivers_of(1)) survey.receivers_m.push_back(receiver.point_m);
  survey.spreads.reset();
}

}  // namespace

template <int D>
void place(Survey<D>& survey, Ground<D> ground) {
  if (!survey.spreads) return;
  survey.spreads->put_on(std::move(ground));
  placing(survey, [&] { put_on_ground(survey); });
}

template <int D>
void check(const Survey<D>& survey, const Grid<D>& grid) {
  const auto check_source = [&](const Source<D>& source, std::size_t shot, std::size_t which) {
    if (std::isfinite(source.amplitude) &&
        (std::holds_alternative<PlaneWave<D>>(source.mechanism) || is_inside<D>(source.position_m, grid)))
      return;
    const auto who = survey.name_of_source(shot, which);
    if (!std::isfinite(source.amplitude))
      throw Error(who + ": found an amplitude that is not finite, expected a number");
    check_inside<D>(who, source.position_m, grid, survey.spreads ? survey.spreads->remedy() : "");
  };
  placing(survey, [&] {
    for (std::size_t shot = 1; shot <= survey.sources.size(); ++shot) {
      const auto of_shot = survey.sources_of(shot);
      for (std::size_t n = 0; n < of_shot.size(); ++n) check_source(*of_shot[n], shot, n);
    }
    each_receiver<D>(survey, [&](const Point<D>& point, std::size_t shot, std::size_t number) {
      if (!is_inside<D>(point, grid))
        check_inside<D>(name_of_receiver(survey, shot, number), point, grid,
                        survey.spreads ? survey.spreads->remedy() : "");
    });
  });
}

SLIPWAVE_INSTANTIATE_D(FUNCTION, is_inside);
SLIPWAVE_INSTANTIATE_D(FUNCTION, check_inside);
SLIPWAVE_INSTANTIATE_D(TYPE, struct Survey);
SLIPWAVE_INSTANTIATE_D(FUNCTION, each_receiver);
SLIPWAVE_INSTANTIATE_D(FUNCTION, name_of_receiver);
SLIPWAVE_INSTANTIATE_D(FUNCTION, place);
SLIPWAVE_INSTANTIATE_D(FUNCTION, needs_ground);
SLIPWAVE_INSTANTIATE_D(FUNCTION, check);

}  // namespace slipwave
