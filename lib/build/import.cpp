// SPDX-License-Identifier: BSD-3-Clause
#include "build/import.hpp"

#include <algorithm>
#include <bit>
#include <cstring>
#include <memory>

#include "base/error.hpp"
#include "base/instantiate.hpp"
#include "geology/layers.hpp"
#include "rock/anisotropy.hpp"
#include "rock/relations.hpp"

namespace slipwave {
namespace {

template <int D>
void check_grid(const Field<D>& field, const std::string& name, const Grid<D>& grid) {
  if (field.grid() == grid) return;
  throw Error(name + ": found " + shown(field.grid()) + ", expected " + shown(grid) + " as of vp");
}

/// Rows of a section all along y.
void fit_extruded(const Grid<2>& flat, Grid<3>& grid) {
  grid.shape[2] = flat.shape[1];
  std::vector<double> corners;
  for (std::int64_t row = 0; row <= grid.shape[2]; ++row)
    for (std::int64_t line = 0; line <= grid.shape[1]; ++line) {
      const auto of_row = flat.rows->row(row);
      corners.insert(corners.end(), of_row.begin(), of_row.end());
    }
  grid.rows = std::make_shared<const RowDepths<3>>(grid.shape, std::move(corners), flat.rows->horizons());
}

}  // namespace

float raw_value(const std::vector<char>& bytes, std::int64_t at) {
  const char* from = bytes.data() + at * 4;
  std::uint32_t bits = 0;
  for (int i = 3; i >= 0; --i) bits = bits << 8 | std::uint32_t(static_cast<unsigned char>(from[i]));
  return std::bit_cast<float>(bits);
}

template <int D>
Field<D> field_from_raw(const std::vector<char>& bytes, const Grid<D>& grid, FastAxis fast) {
  const std::size_t expected = std::size_t(grid.size()) * 4;
  if (bytes.size() != expected) {
    throw Error("found " + std::to_string(bytes.size()) + " bytes, expected " + std::to_string(expected) +
                " for " + shown(grid) + ", 4 bytes each");
  }
  Field<D> field(grid);
  for (std::int64_t n = 0; n < grid.size(); ++n) {
    std::int64_t from = n;
    if (fast == FastAxis::z) {
      const auto at = grid.index(n);
      from = 0;
      for (std::size_t axis = 0; axis < D; ++axis) from = from * grid.shape[axis] + at[axis];
    }
    field[std::size_t(n)] = raw_value(bytes, from);
  }
  return field;
}

template <int D>
Medium<D> medium_of(Field<D> vp, std::optional<Field<D>> vs, std::optional<Field<D>> rho, double fluid_vp) {
  if (vs) check_grid(*vs, "vs", vp.grid());
  if (rho) check_grid(*rho, "rho", vp.grid());
  Medium<D> medium;
  medium.vs = vs ? std::move(*vs) : vs_by_castagna(vp, fluid_vp);
  medium.rho = rho ? std::move(*rho) : rho_by_gardner(vp, medium.vs);
  medium.vp = std::move(vp);
  return medium;
}

template <int D>
void add_property(Medium<D>& medium, Property property, Field<D> field) {
  check_grid(field, row_of(property).name, medium.grid());
  medium[property] = std::move(field);
  complete_anisotropy(medium);
}

SLIPWAVE_INSTANTIATE_D(FUNCTION, field_from_raw);

Medium<3> extruded(const Medium<2>& medium, double length_m) {
  const auto& flat = medium.grid();
  auto grid = grid_of_size<3>({flat.end(0) - flat.origin_m[0], length_m, flat.end(1)}, flat.spacing_m);
  grid.origin_m = {flat.origin_m[0], 0, flat.origin_m[1]};
  if (flat.rows) fit_extruded(flat, grid);
  Medium<3> deep(grid, medium);
  for (const Property property : medium.properties()) {
    for (std::int64_t line = 0; line < grid.shape[1] * grid.shape[2]; ++line) {
      const auto row = medium[property].line(line / grid.shape[1]);
      std::copy(row.begin(), row.end(), deep[property].line(line).begin());
    }
  }
  complete_anisotropy(deep);
  return deep;
}

SLIPWAVE_INSTANTIATE_D(FUNCTION, add_property);
template Medium<2> medium_of(Field<2>, std::optional<Field<2>>, std::optional<Field<2>>, double);
template Medium<3> medium_of(Field<3>, std::optional<Field<3>>, std::optional<Field<3>>, double);

}  // namespace slipwave
