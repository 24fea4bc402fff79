// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <optional>
#include <string_view>

#include "grid/field.hpp"

namespace slipwave {

/// A plane through a volume, across an axis.
struct Slice {
  int axis = 1;     // 0: x, 1: y, 2: z
  double at_m = 0;  // on that axis
};

/// "y=500". Throws a usage Error.
Slice parse_slice(std::string_view text);

/// A layer of cells across an axis.
struct CellLayer {
  int axis = 1;
  std::int64_t number = 0;
  /// The depth of a plane across z of a fitted grid, m, which curvilinear rows run through. A column shows
  /// the cell that the plane is in; `number` says nothing.
  std::optional<double> depth_m = {};
};
/// The cells that a plane runs through. Throws a usage Error when it misses the grid.
CellLayer layer_on(const Grid<3>& grid, const Slice& slice);
/// The layer to show: the one a plane runs through, or of a grid one cell thick the only one. Throws a
/// usage Error for a volume without a plane.
CellLayer layer_to_show(const Grid<3>& grid, const std::optional<Slice>& slice);
/// Returns where a layer lies: its depth, or the centres of its cells.
Slice plane_of(const Grid<3>& grid, const CellLayer& layer);

/// The axes that a section across an axis has left: the one that runs across it and the one that runs down.
std::array<std::size_t, 2> axes_left(int axis);
/// Their names, z as "depth".
std::array<const char*, 2> section_axes(int axis);

/// This layer of a grid: one cell thick. Upright layers of fitted grids are fitted, level ones are regular.
Grid<3> layer_of(const Grid<3>& grid, const CellLayer& layer);
/// And what a field has there; NaN where a plane runs above or below the rows of a fitted grid.
Field<3> layer_of(const Field<3>& field, const CellLayer& layer);

/// These return this layer as a section: of the axes that are left, the first across and the second down.
/// Where a plane runs above or below the rows of a fitted grid, values are NaN, or 0 of whole numbers.
Grid<2> section_grid(const Grid<3>& grid, const CellLayer& layer);
template <class Value>
Field<2, Value> section_of(const Field<3, Value>& field, const CellLayer& layer);

}  // namespace slipwave
