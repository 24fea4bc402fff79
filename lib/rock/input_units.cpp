// SPDX-License-Identifier: BSD-3-Clause
#include "rock/input_units.hpp"

#include <algorithm>

#include "base/error.hpp"
#include "base/parse.hpp"
#include "io/units.hpp"

namespace slipwave {
namespace {

const std::string pascal = "Pa";

/// Nothing where numbers of this unit are no others multiplied.
std::optional<double> factor_of(const std::string& unit, const std::string& into) {
  const auto conversion = spelt_unit_conversion(unit, into);
  if (!conversion || conversion->inverse || conversion->offset != 0) return {};
  return conversion->factor;
}

/// Nothing for properties without a unit and for angles, which have none to choose.
std::optional<double> factor_of(const std::string& unit, Property property) {
  const auto& into = row_of(property).units;
  if (into == "1" || into == "degree") return {};
  return factor_of(unit, into);
}

}  // namespace

InputUnits InputUnits::parse(const std::string& list) {
  InputUnits units;
  for (const auto& name : split(list, ',')) {
    const auto properties = all_properties();
    if (!factor_of(name, pascal) &&
        std::none_of(properties.begin(), properties.end(),
                     [&](Property property) { return factor_of(name, property).has_value(); }))
      throw Error(
          "found '" + name +
              "', expected units of speed, density and stiffness: m/s, km/s, ft/s, kg/m3, g/cm3, Pa, GPa",
          ErrorKind::usage);
    units.names_.push_back(name);
  }
  return units;
}

std::optional<double> InputUnits::given(Property property) const {
  std::optional<double> factor;
  for (const auto& name : names_)
    if (const auto found = factor_of(name, property)) factor = found;
  return factor;
}

double InputUnits::of_stiffness() const {
  double factor = 1;
  for (const auto& name : names_) factor = factor_of(name, pascal).value_or(factor);
  return factor;
}

}  // namespace slipwave
