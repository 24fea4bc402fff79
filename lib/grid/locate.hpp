// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>

#include "grid/grid.hpp"

namespace slipwave {

/// How far two points are apart, m.
template <int D>
double distance_m(const Point<D>& one, const Point<D>& other) {
  double squares = 0;
  for (std::size_t axis = 0; axis < std::size_t(D); ++axis) squares += std::pow(one[axis] - other[axis], 2);
  return std::sqrt(squares);
}

/// The cell a point is in. A point on a face is in the cell behind it, the high faces of the grid belong to
/// the cells before them, and what lies outside counts to the nearest cell.
template <int D>
Index<D> cell_of(const Grid<D>& grid, const Point<D>& point_m) {
  Index<D> at;
  const Point<D> place = grid.row_coordinates(point_m);
  for (std::size_t axis = 0; axis < D; ++axis) {
    const auto cell = std::int64_t(std::floor((place[axis] - grid.origin_m[axis]) / grid.spacing_m));
    at[axis] = std::clamp<std::int64_t>(cell - grid.first[axis], 0, grid.shape[axis] - 1);
  }
  return at;
}

}  // namespace slipwave
