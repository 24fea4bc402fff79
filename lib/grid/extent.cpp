// SPDX-License-Identifier: BSD-3-Clause
#include "grid/extent.hpp"

#include <algorithm>

#include "base/error.hpp"
#include "base/instantiate.hpp"

namespace slipwave {

template <int D>
Box<D> box_of_grid(const Grid<D>& grid) {
  Box<D> box;
  for (std::size_t axis = 0; axis < D; ++axis) {
    box.low_m[axis] = grid.origin_m[axis] + double(grid.first[axis]) * grid.spacing_m;
    box.high_m[axis] = grid.end(int(axis));
  }
  if (!grid.rows) return box;
  const auto corners = grid.rows->corners_m();
  const auto [top, bottom] = std::minmax_element(corners.begin(), corners.end());
  box.low_m[D - 1] = *top, box.high_m[D - 1] = *bottom;
  return box;
}

template <int D>
std::string shown_box(const Box<D>& box) {
  // Depths of corners of a fitted grid have many digits.
  constexpr int digits = 7;
  std::string text;
  for (std::size_t axis = 0; axis < D; ++axis)
    text += std::string(axis == 0 ? "" : " ") + axis_names<D>()[axis] + "=" + shown(box.low_m[axis], digits) +
            ".." + shown(box.high_m[axis], digits);
  return text;
}

SLIPWAVE_INSTANTIATE_D(FUNCTION, box_of_grid);
SLIPWAVE_INSTANTIATE_D(FUNCTION, shown_box);

}  // namespace slipwave
