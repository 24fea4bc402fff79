#include "model/property.hpp"

namespace slipwave {

// In place of lib/model/property_table.cpp: one row more.
std::span<const PropertyRow> material_properties() {
  static const auto rows = [] {
    auto more = property_rows();
    more.push_back(
        {"temperature", "temperature", "K", "K", {"K", "kelvin"}, {}, 0, 5000, Mean::arithmetic, 288});
    return more;
  }();
  return rows;
}

}  // namespace slipwave
