// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "model/model.hpp"

namespace slipwave {

class NetcdfFile;

/// Which axis of a raw file runs fastest.
enum class FastAxis { z, x };

/// Value number `at` of a raw file.
float raw_value(const std::vector<char>& bytes, std::int64_t at);

/// A field from raw little-endian float32 values, `grid` saying how many; z-fast: columns of depth one after
/// the other, y before x in 3-D; x-fast: rows, top first. Throws Error when the number of bytes is another.
template <int D>
Field<D> field_from_raw(const std::vector<char>& bytes, const Grid<D>& grid, FastAxis fast);

/// A section from columns of equal length (the traces of a SEG-Y model, left to right, each from the top
/// down).
Field<2> field_from_columns(const std::vector<std::vector<double>>& columns, double spacing_m);

/// A section from a netCDF variable of two dimensions. `name` "" takes the variable called as the row, else
/// the only one of two dimensions. Depth is the dimension named z or depth or whose coordinate has axis "Z"
/// or a `positive` attribute, else the first one. Coordinates give the step (or must agree with `spacing_m`),
/// in m or km; values in the units of the row (speeds in m/s or km/s, densities in kg/m3 or g/cm3), where
/// they name none `unnamed` in SI; ascending depth may run up or down. Throws Error naming file and variable.
Field<2> field_from_netcdf(const NetcdfFile& file, const PropertyRow& row, const std::string& name,
                           std::optional<double> spacing_m, double unnamed = 1);

/// The medium of imported fields. Without vs: Castagna's line, fluid where vp is at most `fluid_vp`; without
/// rho: Gardner's relation (model/relations.hpp). Throws Error when the grids differ.
template <int D>
Medium<D> medium_of(Field<D> vp, std::optional<Field<D>> vs, std::optional<Field<D>> rho, double fluid_vp);

/// Adds an optional property, or replaces it. Throws Error when the grids differ.
template <int D>
void add_property(Medium<D>& medium, Property property, Field<D> field);

/// The same all along y, `length_m` long in cells of the medium's. Throws a usage Error when that is no whole
/// number of cells.
Medium<3> extruded(const Medium<2>& medium, double length_m);

}  // namespace slipwave
