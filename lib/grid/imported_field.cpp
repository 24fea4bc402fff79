// SPDX-License-Identifier: BSD-3-Clause
#include "grid/imported_field.hpp"

#include <algorithm>
#include <utility>

#include "base/instantiate.hpp"

namespace slipwave {

template <int D>
Grid<D> grid_of(const ImportedField& field) {
  const auto& from = field.values.grid();
  Grid<D> grid;
  grid.spacing_m = from.spacing_m;
  for (std::size_t axis = 0; axis < D; ++axis) {
    const std::size_t of = axis + 1 == D ? 2 : axis;
    grid.shape[axis] = from.shape[of];
    grid.origin_m[axis] = from.origin_m[of];
  }
  return grid;
}

template <int D>
Field<D> field_of(const ImportedField& field) {
  Field<D> values(grid_of<D>(field));
  std::copy(field.values.begin(), field.values.end(), values.begin());
  return values;
}

template <int D>
ImportedField imported_from(const Field<D>& field) {
  const auto& from = field.grid();
  Grid<3> grid;
  grid.spacing_m = from.spacing_m;
  grid.shape = {from.shape[0], D == 3 ? from.shape[1] : 1, from.shape[D - 1]};
  grid.origin_m = {from.origin_m[0], D == 3 ? from.origin_m[1] : 0, from.origin_m[D - 1]};
  ImportedField imported;
  imported.is_section = D == 2;
  imported.values = Field<3>(grid);
  std::copy(field.begin(), field.end(), imported.values.begin());
  return imported;
}

void place_at(ImportedField& field, const Point<3>& origin_m) {
  auto grid = field.values.grid();
  if (grid.origin_m == origin_m) return;
  grid.origin_m = origin_m;
  Field<3> moved(grid);
  std::copy(field.values.begin(), field.values.end(), moved.begin());
  field.values = std::move(moved);
}

SLIPWAVE_INSTANTIATE_D(FUNCTION, imported_from);
SLIPWAVE_INSTANTIATE_D(FUNCTION, grid_of);
SLIPWAVE_INSTANTIATE_D(FUNCTION, field_of);

}  // namespace slipwave
