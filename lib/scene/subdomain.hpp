// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "grid/grid.hpp"
#include "grid/locate.hpp"

namespace slipwave {

/// Rows of the model (in 3-D planes), counted along the last axis, that one of several processes owns.
/// Its model holds some more of them on both sides, where there are any.
struct Subdomain {
  std::int64_t rows = 0;             // of the whole model; 0: there is one process
  std::int64_t first = 0, last = 0;  // first <= row < last
  /// Rows beside them that are refreshed by neighbours before each time tile.
  std::int64_t exchanged = 0;
  /// Whether neighbours are bands of other cells: nothing is read or added across the faces to them but by
  /// sweeps.
  bool other_cells = false;
  /// Whether rows beyond such a face, before and behind its rows, are as high as its own.
  std::array<bool, 2> own_heights{};
  bool slips = false;        // whether anything slips in any part
  bool shear = false;        // whether any part has shear stress: solid cells or curvilinear rows
  bool anisotropic = false;  // whether any part has anisotropic cells
  bool tilted =
      false;  // whether any part has rock whose axes are turned, in 3-D also any in curvilinear rows
  bool tilted_means = false;     // whether any part has cells that interfaces cut as tilted means
  bool has_void = false;         // whether any part has void cells
  bool corrects_inside = false;  // whether any part has surfaces inside that sweeps along all axes correct
  /// The askew_sets(); set with several processes only.
  std::vector<std::array<bool, 2>> askew{};
  /// The side_speeds() of the whole model; set in a fitted grid only.
  std::array<std::array<std::vector<double>, 2>, 2> side_speeds{};
  /// The fastest_speed() and fastest_across_cells() of the whole model, m/s; 0 where nobody has looked
  /// (note_speeds()).
  double fastest = 0, fastest_across_cells = 0;

  bool is_whole() const { return rows == 0; }
  /// Whether rows before the first or behind the last are with other processes. Its model may hold all of
  /// them: where a neighbour owns no more rows than are refreshed.
  bool cut(int side) const { return !is_whole() && (side ? last < rows : first > 0); }
  /// Whether it owns a row of the model it holds.
  template <int D>
  bool owns(const Grid<D>& held, std::int64_t row) const {
    row += held.first[D - 1];
    return is_whole() || (row >= first && row < last);
  }
  /// Whether it owns the cell of a point of the whole model.
  template <int D>
  bool owns(const Grid<D>& held, const Point<D>& point_m) const {
    const auto all = whole(held);
    return owns(all, cell_of(all, point_m)[D - 1]);
  }
  /// The grid of the whole model.
  template <int D>
  Grid<D> whole(Grid<D> held) const {
    if (is_whole()) return held;
    held.first[D - 1] = 0;
    held.shape[D - 1] = rows;
    return held;
  }
};

}  // namespace slipwave
