// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "grid/grid.hpp"

namespace slipwave {

class NetcdfFile;

/// The grid whose cell centres are the coordinate variables x, [y,] z of `file`. Throws Error when they are
/// absent, not evenly spaced, or of different steps, or z does not begin half a step below the surface,
/// unless the grid may be a layer of a model (`whole` false). Where the file has `depth_bounds` the grid is
/// fitted to horizons (Grid::rows), and z, which may begin anywhere, is the row coordinate. Throws Error
/// naming the variable and place when depths do not deepen, are not finite or do not belong together.
template <int D>
Grid<D> read_grid(const NetcdfFile& file, bool whole = true);
/// Defines the dimensions and coordinate variables of `grid`, x fastest, with their CF attributes; of a
/// fitted grid also the depths of cells and corners and the horizons.
template <int D>
void define_grid(NetcdfFile& file, const Grid<D>& grid);
/// Writes the values of the coordinate variables.
template <int D>
void put_grid(NetcdfFile& file, const Grid<D>& grid);
/// The conventions that a file with this grid follows: CF, and SGRID where it is fitted.
template <int D>
std::string conventions_of(const Grid<D>& grid);
/// Writes the attributes that tie a field to a fitted grid: `coordinates`, the depth of cells, and of SGRID
/// `grid` and `location`. Nothing where the grid is regular.
template <int D>
void put_coordinates(NetcdfFile& file, const Grid<D>& grid, const std::string& variable);
/// "z", ["y",] "x": the dimensions of a field, as netCDF orders them.
template <int D>
std::vector<std::string> field_dimensions();

}  // namespace slipwave
