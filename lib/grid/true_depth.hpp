// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <vector>

#include "grid/field.hpp"

namespace slipwave {

/// Depths of the faces above and below the cells of a column, from the top down, m: one more than cells. Of a
/// fitted grid in the middle of the column, the means of the corners there. The last entry of `at` is free.
template <int D>
std::vector<double> faces_of_column(const Grid<D>& grid, Index<D> at);

/// The row in which a depth lies between the faces of a column; -1 above the first and below the last. A
/// depth on a face is in the row below, the last face belongs to the last row.
std::int64_t row_between(const std::vector<double>& faces_m, double depth_m);

/// Depths that a grid fills, m: from its first face, of a fitted grid from the datum (depth 0) or what
/// stands above it, to its deepest one.
template <int D>
std::array<double, 2> depth_extent(const Grid<D>& grid);

/// The regular grid whose cells, as wide as those of a fitted one, fill its depths; columns are the same. A
/// regular grid is its own.
template <int D>
Grid<D> in_regular_depth(const Grid<D>& grid);

/// How a field is taken at the centres of regular cells.
enum class DepthTake {
  nearest,  // the value of the cell in which they lie: media
  linear    // between the centres of cells in the column: wave fields
};

/// A field on in_regular_depth() of its grid; 0, as in void, above and below the rows.
template <int D>
Field<D> in_regular_depth(const Field<D>& field, DepthTake take);

}  // namespace slipwave
