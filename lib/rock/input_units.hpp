// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "rock/property.hpp"

namespace slipwave {

/// What numbers that name no unit are in: typed ones, raw files, SEG-Y. SI unless said.
class InputUnits {
 public:
  InputUnits() = default;
  /// "km/s", "g/cm3", "km/s,g/cm3", "ft/s": a unit for all properties that can have it, as people spell it
  /// (spelt_unit_conversion()). Throws a usage Error on one that no property has.
  static InputUnits parse(const std::string& list);
  /// What one of it is in SI; nothing where the list names no unit of the property's.
  std::optional<double> given(Property property) const;
  double factor(Property property) const { return given(property).value_or(1); }
  /// Returns what the unit of stiffnesses, Pa or GPa, is in SI; 1 where the list names neither.
  double of_stiffness() const;

 private:
  std::vector<std::string> names_;
};

}  // namespace slipwave
