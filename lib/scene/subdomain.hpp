// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "grid/grid.hpp"
#include "grid/locate.hpp"

namespace slipwave {

/// Rows of the model (in 3-D planes), counted along the last axis, that one of several processes owns.
/// Its model holds some more of them on both sides, where there are any. In bands of cells
/// (Numerics::bands) these are rows of one band and of its model.
struct Subdomain {
  std::int64_t rows = 0;             // of the whole model; 0: there is one process, and no bands
  std::int64_t first = 0, last = 0;  // first <= row < last
  /// Rows beside them that are refreshed by neighbours before each time tile.
  std::int64_t exchanged = 0;
  /// How many rows, at the begin of the whole model and at its end, are those of bands of other cells:
  /// nothing is read or added across the faces to them but by sweeps.
  std::array<std::int64_t, 2> other_cells{};
  /// Whether rows beyond such a face, before and behind those of the band, are as high as its own.
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
  bool in_bands() const { return other_cells[0] > 0 || other_cells[1] > 0; }
  /// Whether it owns no row of the band.
  bool is_empty() const { return !is_whole() && first == last; }
  /// Whether rows before the first or behind the last are with other processes, or of other cells. Its model
  /// may hold all of them: where a neighbour owns no more rows than are refreshed.
  bool cut(int side) const { return !is_whole() && (side ? last < rows : first > 0); }
  /// The row at which the band begins, or the one at which the next band does.
  std::int64_t face(int side) const { return side ? rows - other_cells[1] : other_cells[0]; }
  /// Whether the rows before the first or behind the last are of other cells.
  bool ends_at_band(int side) const {
    return other_cells[std::size_t(side)] > 0 && (side ? last : first) == face(side);
  }
  /// Whether they are with another process.
  bool continues(int side) const { return cut(side) && !ends_at_band(side); }
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
