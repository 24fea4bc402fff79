// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>

#include "grid/grid.hpp"

namespace slipwave {

/// The longest side of a cell, m: in rows that are stretched its height.
template <int D>
double longest_side_m(const Grid<D>& grid, std::int64_t cell) {
  return grid.rows ? std::max(grid.spacing_m, grid.height(grid.index(cell))) : grid.spacing_m;
}

}  // namespace slipwave
