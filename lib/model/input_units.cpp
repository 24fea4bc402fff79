// SPDX-License-Identifier: BSD-3-Clause
#include "model/input_units.hpp"

#include <algorithm>

#include "base/error.hpp"
#include "base/parse.hpp"

namespace slipwave {
namespace {

constexpr double foot_m = 0.3048;
const std::string gigapascal = "GPa", pascal = "Pa";

bool holds(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// 0 where the property has no such unit. Those without units have none to choose.
double factor_of(const PropertyRow& row, const std::string& unit) {
  if (row.thousand.empty()) return 0;
  if (holds(row.si, unit)) return 1;
  if (holds(row.thousand, unit)) return 1000;
  return unit == "ft/s" && holds(row.si, "m/s") ? foot_m : 0;
}

}  // namespace

InputUnits InputUnits::parse(const std::string& list) {
  InputUnits units;
  for (const auto& name : split(list, ',')) {
    const auto properties = all_properties();
    if (name != gigapascal && name != pascal &&
        std::none_of(properties.begin(), properties.end(),
                     [&](Property property) { return factor_of(row_of(property), name) != 0; }))
      throw Error(
          "found '" + name +
              "', expected units of speed, density and stiffness: m/s, km/s, ft/s, kg/m3, g/cm3, Pa, GPa",
          ErrorKind::usage);
    units.names_.push_back(name);
  }
  return units;
}

double InputUnits::factor(Property property) const {
  double factor = 1;
  for (const auto& name : names_) {
    const double found = factor_of(row_of(property), name);
    if (found != 0) factor = found;
  }
  return factor;
}

double InputUnits::of_stiffness() const { return holds(names_, gigapascal) ? 1e9 : 1; }

}  // namespace slipwave
