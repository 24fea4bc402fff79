// SPDX-License-Identifier: BSD-3-Clause
#include "rock/property.hpp"

namespace slipwave {

// Nothing else may stand in this file: tests link another definition in its place.
std::span<const PropertyRow> material_properties() {
  static const auto rows = property_rows();
  return rows;
}

}  // namespace slipwave
