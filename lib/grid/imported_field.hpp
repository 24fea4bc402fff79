// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "grid/field.hpp"

namespace slipwave {

/// A property of a foreign file: a volume, or a section, which is one of a single cell along y. Depths count
/// from where the file counts them.
struct ImportedField {
  Field<3> values;
  bool is_section = true;
  bool placed = true;             // false: the file does not say where it begins
  std::vector<std::string> said;  // what was taken for what, where the file leaves a choice
};

/// The grid of a section or a volume, and its values, on it. D = 2 needs a section.
template <int D>
Grid<D> grid_of(const ImportedField& field);
template <int D>
Field<D> field_of(const ImportedField& field);

/// The inverse.
template <int D>
ImportedField imported_from(const Field<D>& field);

/// Moves a field: its low corner lies there.
void place_at(ImportedField& field, const Point<3>& origin_m);

}  // namespace slipwave
