// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "grid/imported_field.hpp"
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

/// A section from a netCDF variable of two dimensions, a volume from one of three. `name` "" takes the
/// variable called as the row, else the only one of two dimensions, else the only one of three. Depth is the
/// vertical dimension (is_vertical()), in a section without one that which is not called x, else the first
/// one. Coordinates give the step (or must agree with `spacing_m`), in any unit of length; they may run up or
/// down and be stored either way (depths_of()). Values are in any unit that converts to that of the row;
/// where they name none, `unnamed` in SI. Throws Error naming file and variable.
ImportedField field_from_netcdf(const NetcdfFile& file, const PropertyRow& row, const std::string& name,
                                std::optional<double> spacing_m, double unnamed = 1);

/// The medium of imported fields. Without vs: Castagna's line, fluid where vp is at most `fluid_vp`; without
/// rho: Gardner's relation (rock/relations.hpp). Throws Error when the grids differ.
template <int D>
Medium<D> medium_of(Field<D> vp, std::optional<Field<D>> vs, std::optional<Field<D>> rho, double fluid_vp);

/// Adds an optional property, or replaces it. Throws Error when the grids differ.
template <int D>
void add_property(Medium<D>& medium, Property property, Field<D> field);

/// Returns the medium in 3-D, the same all along y and `length_m` long there, in cells of its size. Throws a
/// usage Error when that is no whole number of cells.
Medium<3> extruded(const Medium<2>& medium, double length_m);

}  // namespace slipwave
