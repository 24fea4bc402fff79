// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <functional>
#include <memory>
#include <utility>
#include <vector>

#include "grid/field.hpp"

namespace slipwave {

/// The same grid with rows whose corners lie at depth(x, y, zeta), m; y is 0 in 2-D.
template <int D>
Grid<D> bent(Grid<D> grid, const std::function<double(double, double, double)>& depth) {
  Grid<D> corners = grid;
  for (auto& count : corners.shape) ++count;
  std::vector<double> depths;
  for (std::int64_t n = 0; n < corners.size(); ++n) {
    const auto at = corners.index(n);
    Point<D> place{};
    for (std::size_t axis = 0; axis < D; ++axis)
      place[axis] = grid.origin_m[axis] + double(at[axis]) * grid.spacing_m;
    depths.push_back(depth(place[0], D == 3 ? place[1] : 0, place[D - 1]));
  }
  grid.rows = std::make_shared<const RowDepths<D>>(grid.shape, std::move(depths),
                                                   std::vector<FittedHorizon>{{"surface", "surface", 0}});
  return grid;
}

/// f(centre) in every cell, with true depths.
template <int D>
Field<D> at_centres(const Grid<D>& grid, const std::function<double(const Point<D>&)>& f) {
  Field<D> field(grid);
  for (std::int64_t cell = 0; cell < grid.size(); ++cell) {
    const auto at = grid.index(cell);
    Point<D> point{};
    for (int axis = 0; axis < D - 1; ++axis)
      point[std::size_t(axis)] = grid.centre(axis, at[std::size_t(axis)]);
    point[D - 1] = grid.depth(at);
    field[std::size_t(cell)] = float(f(point));
  }
  return field;
}

}  // namespace slipwave
