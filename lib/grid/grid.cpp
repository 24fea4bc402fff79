// SPDX-License-Identifier: BSD-3-Clause
#include "grid/grid.hpp"

#include "base/error.hpp"

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

template std::string place_of<2>(const Grid<2>&, std::int64_t);
template std::string place_of<3>(const Grid<3>&, std::int64_t);
template std::string shown<2>(const Grid<2>&);
template std::string shown<3>(const Grid<3>&);

}  // namespace slipwave
