// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "acquisition/given_survey.hpp"
#include "acquisition/ground.hpp"

namespace slipwave {

/// A receiver of a shot.
template <int D>
struct Receiver {
  Point<D> point_m{};
  std::int64_t channel = 1;
  std::int64_t bin = 0;           // midpoint bin (cdp), 0: not given
  std::array<double, 3> map_m{};  // as the survey gave it: x and y of the map, depth
};

/// Places of a survey in a model: what was given relative to a source, the ground or the map, worked out shot
/// by shot when it is asked for, so that large surveys take little memory. Shots count from 1.
template <int D>
class Spreads {
 public:
  Spreads() = default;
  explicit Spreads(GivenSurvey given) : given_(std::move(given)) {}

  const GivenSurvey& given() const { return given_; }
  /// The model it is in, before which nothing has a place.
  void put_on(Ground<D> ground) { ground_ = std::move(ground); }
  /// Throws Error naming the receiver where its depth cannot be found.
  std::vector<Receiver<D>> receivers_of(std::size_t shot) const;
  std::size_t count_of(std::size_t shot) const;
  /// Calls `see` with every place of a receiver, once where it stands, and a shot and number (from 1) of it.
  void each_place(const std::function<void(const Point<D>&, std::size_t, std::size_t)>& see) const;
  /// The source that was given as `which` (0: the first) of a shot; throws Error naming it.
  Point<D> source_of(std::size_t shot, std::size_t which) const;
  /// x and y of its first source on the map, and its depth.
  std::array<double, 3> map_source_of(std::size_t shot) const;
  /// Whether a receiver stands at one place in all shots that have it: then one look is enough.
  bool stands(const Place& place) const { return axes_from_source(place) == 0; }
  /// "shots.csv: line 3: the source" or "source 3".
  std::string name_of_source(std::size_t shot, std::size_t which) const;
  /// What to try where the survey misses the model; empty where it was not given on a map.
  std::string remedy() const;
  /// Returns by how much places were moved to come onto a section, in m at most.
  double moved_m() const;
  /// Returns by how much that changed distances of receivers from their sources, in m at most.
  double offset_change_m() const;

 private:
  unsigned axes_from_source(const Place& place) const;
  Point<D> point_of(const Place& place, const std::array<double, 3>& source_m) const;
  double depth_of(const Place& place, const Point<D>& at, double given_m) const;

  GivenSurvey given_;
  Ground<D> ground_;
};

extern template class Spreads<2>;
extern template class Spreads<3>;

}  // namespace slipwave
