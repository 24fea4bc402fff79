// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

namespace slipwave {

/// Makes numbers in one unit numbers in another: of speeds also from slowness, which is their inverse.
struct UnitConversion {
  double factor = 1, offset = 0;
  bool inverse = false;

  double operator()(double value) const {
    return inverse ? factor / value + offset : factor * value + offset;
  }
  bool changes() const { return factor != 1 || offset != 0 || inverse; }
};

/// From a unit into another, by the grammar and the names of udunits, which CF has: "km.s-1", "ft",
/// "us/ft". Angles convert into angles only, inverses into speeds only. Nothing where `unit` is unknown or
/// measures something else. Throws Error where udunits finds no database, or `unit` names the grain ("gr"),
/// by which most people mean the gram.
std::optional<UnitConversion> unit_conversion(const std::string& unit, const std::string& into);

/// Returns the conversion of what people write in tables and well logs, too: in capitals, "US/F", "K/M3",
/// "GM/CC".
std::optional<UnitConversion> spelt_unit_conversion(const std::string& unit, const std::string& into);

/// What a message says of a unit without conversion: "found the unit 'degrees', expected one of length, as m
/// or km".
std::string unit_refusal(const std::string& unit, const std::string& into);

}  // namespace slipwave
