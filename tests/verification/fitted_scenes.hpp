// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstdint>

#include "cube_shot.hpp"
#include "fitted_medium.hpp"

namespace slipwave::solver {

inline const Below water_above{nullptr, 1500, 0, 1000};

inline Below below(std::function<double(double, double)> depth_m, const Rock& rock) {
  return {std::move(depth_m), rock.vp, rock.vs, rock.rho};
}

/// Slip in the cells whose depth is in a range, and whose column is.
template <int D>
void fracture_rows(Model<D>& model, double from_m, double to_m, std::int64_t first, std::int64_t last,
                   std::uint8_t set) {
  const auto& grid = model.grid();
  if (model.fracture.empty()) model.fracture = Field<D, std::uint8_t>(grid);
  for (std::int64_t n = 0; n < grid.size(); ++n) {
    const auto at = grid.index(n);
    const double depth = grid.depth(at);
    if (at[0] >= first && at[0] < last && depth >= from_m && depth < to_m &&
        model.medium.is_solid(std::size_t(n)))
      model.fracture[std::size_t(n)] = set;
  }
}

/// Water over two rocks with a rolling sea floor that dips; fractures in rows that bend, and some near an
/// end.
inline Scene<2> fitted_sea(std::int64_t nx = 220, std::int64_t nz = 90) {
  Scene<2> scene;
  const Grid<2> grid{{nx, nz}, 5, {0, 0}};
  const double length = double(nx) * 5;
  scene.model.medium = fitted_medium<2>(
      grid,
      {water_above,
       below([](double x, double) { return 121 + 0.08 * x + 8 * std::sin(x / 40); }, {4500, 2250, 2500}),
       below([=](double x, double) { return 312 - 0.03 * (x - length / 2); }, {2500, 1200, 2000})});
  fracture_rows(scene.model, 230, 290, 70, 100, 1);
  fracture_rows(scene.model, 150, 170, 0, 14, 2);
  const SlipSystem<2> level{{0, 1}, 0.5, 1000, 0}, upright{{1, 0}, 0.2, 2000, 5};
  scene.model.fracture_sets = {{"cracks", {level}}, {"block", {level, upright}}};
  scene.survey.sources = {{{430, 203}, parse_mechanism<2>("explosion"), parse_wavelet("ricker:40"), 1e9}};
  scene.survey.receivers_m = {{330, 130}, {462.5, 261.3}, {440, 333}, {40, 162}, {700, 301}, {505, 118}};
  scene.edges = edges_all(EdgeLaw::absorbing);
  scene.edges[1][0] = EdgeLaw::free;
  scene.recording = {{Component::vx, Component::vz, Component::p}, 0.07, 0.001};
  return scene;
}

/// Hills of rock below a free surface, soft rock in them.
inline Scene<2> fitted_hills(std::int64_t nx = 220, std::int64_t nz = 80) {
  auto scene = fitted_sea(nx, nz);
  scene.model.fracture = {};
  scene.model.medium =
      fitted_medium<2>(Grid<2>{{nx, nz}, 5, {0, 0}},
                       {below([](double x, double) { return 71 - 0.05 * (x - 550) + 9 * std::cos(x / 50); },
                              {2500, 1200, 2000}),
                        below(dipping(252, 0.05, 550), {4500, 2250, 2500})},
                       true);
  fracture_rows(scene.model, 100, 140, 100, 125, 1);
  fracture_rows(scene.model, 120, 140, 0, 14, 2);
  return scene;
}

/// The same in 3-D: the floor dips and rolls along both axes.
inline Scene<3> fitted_sea_3d(const Index<3>& shape = {40, 22, 44}) {
  const Grid<3> grid{shape, 5, {0, 0, 0}};
  const auto floor = [](double x, double y) {
    return 63 + 0.1 * x - 0.15 * y + 4 * std::sin(x / 25 + y / 30);
  };
  auto scene = scene_of(fitted_medium<3>(grid, {water_above, below(floor, {4500, 2250, 2500})}),
                        edges_all_3d(EdgeLaw::absorbing), {102, 52, 112}, "force:1,2,3", "ricker:60",
                        {{122.5, 72.5, 127.5}, {61, 33.4, 31}, {162, 40, 88}},
                        {Component::vx, Component::vy, Component::vz, Component::p}, 0.04, 0.001);
  scene.edges[2][0] = EdgeLaw::free;
  fracture_rows(scene.model, 80, 105, 14, 24, 1);
  scene.model.fracture_sets = {{"cracks", {{{0, 0.6, 0.8}, 0.4, 1000, 0}}}};
  scene.numerics.zone_cells = 6;
  return scene;
}

}  // namespace slipwave::solver
