// SPDX-License-Identifier: BSD-3-Clause
#include "accuracy/straight_way.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "grid/locate.hpp"

namespace slipwave {

Speeds speeds_at(const Medium<2>& medium, const Point<2>& point) {
  const auto cell = std::size_t(medium.grid().flat(cell_of(medium.grid(), point)));
  return {medium.vp[cell], medium.vs[cell]};
}

WayOfWave straight_way(const Medium<2>& medium, const Point<2>& from, const Point<2>& to, WaveKind kind) {
  const double length = std::hypot(to[0] - from[0], to[1] - from[1]);
  const auto parts = std::int64_t(std::ceil(length / medium.grid().spacing_m)) + 1;
  WayOfWave way;
  for (std::int64_t n = 0; n < parts; ++n) {
    const double at = (double(n) + 0.5) / double(parts);
    const auto [vp, vs] =
        speeds_at(medium, {from[0] + at * (to[0] - from[0]), from[1] + at * (to[1] - from[1])});
    const double speed = kind == WaveKind::p ? vp : vs;
    if (!(speed > 0)) return {};
    way.add(vp, vs, length / double(parts) / speed);
  }
  return way;
}

double way_in_model_m(const Grid<2>& grid, const Point<2>& to, const Point<2>& direction) {
  double length = std::numeric_limits<double>::infinity();
  for (std::size_t axis = 0; axis < 2; ++axis) {
    double low = grid.origin_m[axis], high = low + double(grid.shape[axis]) * grid.spacing_m;
    if (axis == 1 && grid.rows) {
      const auto depths = grid.depths_at(to);
      low = depths[0];
      high = depths[1];
    }
    if (std::abs(direction[axis]) < 1e-9) continue;
    const double edge = direction[axis] > 0 ? to[axis] - low : high - to[axis];
    length = std::min(length, edge / std::abs(direction[axis]));
  }
  return length;
}

WayOfWave way_in_of_plane_wave(const Scene<2>& scene, const Source<2>& source, const PlaneWave<2>& wave,
                               const Point<2>& to) {
  const auto& grid = scene.model.grid();
  const double length = way_in_model_m(grid, to, wave.direction);
  const Point<2> entry = {to[0] - length * wave.direction[0], to[1] - length * wave.direction[1]};
  auto way = straight_way(scene.model.medium, entry, to, wave.shear ? WaveKind::s : WaveKind::p);
  const auto [vp, vs] = speeds_at(scene.model.medium, entry);
  if (const double c = wave.speed(vp, vs); c > 0)
    way.add(vp, vs, zone_cells(scene, source) * grid.spacing_m / c);
  return way;
}

}  // namespace slipwave
