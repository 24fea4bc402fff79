// SPDX-License-Identifier: BSD-3-Clause
#include "grid/grid.hpp"

#include "base/error.hpp"
#include "base/instantiate.hpp"

namespace slipwave {

template <int D>
std::string place_of(const Grid<D>& grid, std::int64_t flat_index) {
  const auto at = grid.index(flat_index);
  std::string text;
  for (int axis = 0; axis < D; ++axis) {
    if (axis) text += ' ';
    text += axis_names<D>()[axis];
    const bool depth = axis == D - 1;
    const double place = depth ? grid.depth(at) : grid.centre(axis, at[axis]);
    // Of rows that bend it has many digits.
    text += '=' + (depth && grid.rows ? shown(place, 6) : shown(place));
  }
  return text;
}

template <int D>
std::string shown(const Grid<D>& grid) {
  std::string text;
  for (int axis = 0; axis < D; ++axis) {
    if (axis) text += " x ";
    text += std::to_string(grid.shape[axis]);
  }
  return text + " cells of " + slipwave::shown(grid.spacing_m) + " m";
}

SLIPWAVE_INSTANTIATE_D(FUNCTION, place_of);
SLIPWAVE_INSTANTIATE_D(FUNCTION, shown);

}  // namespace slipwave
