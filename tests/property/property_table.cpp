// SPDX-License-Identifier: BSD-3-Clause
#include "rock/property.hpp"

namespace slipwave {

// In place of lib/rock/property_table.cpp: one row more.
std::span<const PropertyRow> material_properties() {
  static const auto rows = [] {
    auto more = property_rows();
    more.push_back({.name = "temperature",
                    .long_name = "temperature",
                    .help = "temperature, K",
                    .units = "K",
                    .shown_unit = "K",
                    .largest = 5000,
                    .if_absent = 288});
    return more;
  }();
  return rows;
}

}  // namespace slipwave
