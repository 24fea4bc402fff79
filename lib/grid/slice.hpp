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

/// The cells that a plane runs through, counted along its axis. Throws a usage Error when it misses the grid.
std::int64_t cells_on(const Grid<3>& grid, const Slice& slice);

/// A layer of cells across an axis.
struct CellLayer {
  int axis = 1;
  std::int64_t number = 0;
};
/// The layer to show: the one a plane runs through, or of a grid one cell thick the only one. Throws a
/// usage Error for a volume without a plane.
CellLayer layer_to_show(const Grid<3>& grid, const std::optional<Slice>& slice);

/// The axes that a section across an axis has left: the one that runs across it and the one that runs down.
std::array<std::size_t, 2> axes_left(int axis);
/// Their names, z as "depth".
std::array<const char*, 2> section_axes(int axis);

/// The layer of a grid with this number across an axis: one cell thick.
Grid<3> layer_of(const Grid<3>& grid, int axis, std::int64_t number);
/// And what a field has there.
Field<3> layer_of(const Field<3>& field, int axis, std::int64_t number);

/// The same as a section: of the axes that are left, the first across and the second down.
Grid<2> section_grid(const Grid<3>& grid, int axis);
template <class Value>
Field<2, Value> section_of(const Field<3, Value>& field, int axis, std::int64_t number);

}  // namespace slipwave
