// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "cube_shot.hpp"
#include "usual_rock.hpp"

namespace slipwave::solver {

inline constexpr Rock water{1500, 0, 1000}, soft{2500, 1200, 2000};

/// Water over two rocks.
inline Rock reef_at(std::int64_t along, std::int64_t count, std::int64_t depth) {
  if (depth < 12 + std::abs(2 * along + 1 - count) / 20) return water;
  return depth > 38 ? soft : rock;
}

/// A scene in 2-D, which stretches along one axis of a scene in 3-D one cell thick between mirrors.
struct Extruded {
  Scene<2> flat;
  Scene<3> deep;
  std::array<int, 2> axes;  // of 3-D that x and z of 2-D are

  Index<3> deep_cell(std::int64_t i, std::int64_t k) const {
    Index<3> cell{};
    cell[std::size_t(axes[0])] = i;
    cell[std::size_t(axes[1])] = k;
    return cell;
  }
};

/// `axes`: those of 3-D that x and z of 2-D become.
inline Extruded extruded(const std::array<int, 2>& axes, const EdgeLaws<2>& edges, const char* mechanism,
                         const char* mechanism_3d, const std::vector<Component>& components,
                         const std::vector<Component>& components_3d, const Index<2>& size = {64, 52}) {
  const auto [nx, nz] = size;
  constexpr double h = 5;
  Extruded both{{}, {}, axes};
  both.flat.model.medium = uniform_medium(nx, nz, h, rock);
  Index<3> shape = {1, 1, 1};
  shape[std::size_t(axes[0])] = nx;
  shape[std::size_t(axes[1])] = nz;
  auto medium = uniform_cube(shape, h, rock);
  const auto point = [&](const Point<2>& flat) {
    Point<3> deep = {h / 2, h / 2, h / 2};
    for (std::size_t n = 0; n < 2; ++n) deep[std::size_t(axes[n])] = flat[n];
    return deep;
  };
  for (std::int64_t k = 0; k < nz; ++k)
    for (std::int64_t i = 0; i < nx; ++i) {
      put(both.flat.model.medium, {i, k}, reef_at(i, nx, k));
      put(medium, both.deep_cell(i, k), reef_at(i, nx, k));
    }
  both.flat.edges = edges;
  EdgeLaws<3> deep_edges = edges_all_3d(EdgeLaw::mirror);
  for (int n = 0; n < 2; ++n) deep_edges[axes[std::size_t(n)]] = edges[n];
  const Point<2> source = {221, 131};
  both.flat.survey.sources = {{source, parse_mechanism<2>(mechanism), parse_wavelet("ricker:25"), 1e9}};
  both.flat.survey.receivers_m = {{101, 33}, {302.5, 201.3}, {280, 60}, {201, 243}};
  both.flat.recording = {components, 0.2, 0.001};
  both.flat.numerics.double_precision = true;
  both.deep =
      scene_of(medium, deep_edges, point(source), mechanism_3d, "ricker:25", {}, components_3d, 0.2, 0.001);
  // A point source in a slice one cell thick is a line source of as much per metre.
  both.deep.survey.sources[0].amplitude *= h;
  for (const auto& receiver : both.flat.survey.receivers_m)
    both.deep.survey.receivers_m.push_back(point(receiver));
  both.deep.numerics.double_precision = true;
  return both;
}

/// A box of planes with this normal in the rock, some of its columns intact.
inline void fracture(Extruded& both, const Point<2>& normal, double friction, double cohesion_pa) {
  auto& flat = both.flat.model;
  auto& deep = both.deep.model;
  flat.fracture = Field<2, std::uint8_t>(flat.grid());
  deep.fracture = Field<3, std::uint8_t>(deep.grid());
  for (std::int64_t k = 26; k < 37; ++k)
    for (std::int64_t i = 22; i < 53; ++i)
      if (i % 9 != 0) flat.fracture({i, k}) = deep.fracture(both.deep_cell(i, k)) = 1;
  Point<3> normal_in_3d{};
  for (std::size_t n = 0; n < 2; ++n) normal_in_3d[std::size_t(both.axes[n])] = normal[n];
  flat.fracture_sets = {{"cracks", {{normal, friction, 500, cohesion_pa}}}};
  deep.fracture_sets = {{"cracks", {{normal_in_3d, friction, 500, cohesion_pa}}}};
}

/// In 2-D the half sweeps along x of two steps are one, but for lines with fractures close to an end
/// (Patches): with such a column of planes that never slip through all lines a step has the sweeps of one in
/// 3-D whose y is this x.
inline void keep_half_sweeps(Extruded& both) {
  auto& model = both.flat.model;
  if (model.fracture.size() == 0) model.fracture = Field<2, std::uint8_t>(model.grid());
  model.fracture_sets.push_back({"welded", {{{0, 1}, 0, 500, 1e12}}});
  for (std::int64_t k = 0; k < model.grid().shape[1]; ++k)
    model.fracture({10, k}) = std::uint8_t(model.fracture_sets.size());
}

inline double largest_error(const Extruded& both) {
  const auto flat = shoot(both.flat, 1), deep = shoot(both.deep, 1);
  double largest = 0;
  for (std::size_t n = 0; n < flat.traces.size(); ++n)
    largest = std::max(largest, relative_error(deep.traces[n].samples, flat.traces[n].samples));
  return largest;
}

/// Order in the step of what the traces differ by, all of them together, from two lengths of it.
inline double order_of_difference(Extruded both, double cfl) {
  double difference[2];
  for (int n = 0; n < 2; ++n) {
    both.flat.numerics.cfl = both.deep.numerics.cfl = n == 0 ? cfl : cfl / 2;
    difference[n] = relative_error(samples_of(shoot(both.deep, 1)), samples_of(shoot(both.flat, 1)));
  }
  return observed_order(difference[0], difference[1]);
}

inline EdgeLaws<2> edges_of(EdgeLaw top, EdgeLaw sides, EdgeLaw bottom) {
  EdgeLaws<2> edges;
  edges[0] = {sides, sides};
  edges[1] = {top, bottom};
  return edges;
}

}  // namespace slipwave::solver
