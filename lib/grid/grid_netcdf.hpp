#pragma once

#include <string>
#include <vector>

#include "grid/grid.hpp"

namespace slipwave {

class NetcdfFile;

/// The grid whose cell centres are the coordinate variables x, [y,] z of `file`. Throws Error when they are
/// absent, not evenly spaced, or of different steps, or z does not begin half a step below the surface,
/// unless the grid may be a layer of a model (`whole` false).
template <int D>
Grid<D> read_grid(const NetcdfFile& file, bool whole = true);
/// Defines the dimensions and coordinate variables of `grid`, x fastest, with their CF attributes.
template <int D>
void define_grid(NetcdfFile& file, const Grid<D>& grid);
/// Writes the values of the coordinate variables.
template <int D>
void put_grid(NetcdfFile& file, const Grid<D>& grid);
/// "z", ["y",] "x": the dimensions of a field, as netCDF orders them.
template <int D>
std::vector<std::string> field_dimensions();

}  // namespace slipwave
