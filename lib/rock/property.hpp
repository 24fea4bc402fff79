// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace slipwave {

/// How one value stands for the parts of a cell; only parts of the kind of its centre count.
enum class Mean {
  elastic,     // together with the other elastic properties: MaterialMean (theory.md M1, M2)
  arithmetic,  // sum V a / sum V, V volume
  harmonic,    // sum V / sum (V/a)
};

/// All there is to know of a material property, one value a cell. Model files, import, resampling,
/// subdomains, the identity of checkpoints, reports, pictures and export walk the table of these rows.
struct PropertyRow {
  std::string name;                      // in files and on command lines
  std::string long_name;                 // in files
  std::string help;                      // of the option of sw-import
  std::string units;                     // in files; foreign ones may have any that converts to it
  std::string shown_unit;                // in reports
  double least = 0, largest = infinite;  // of what check() lets through; infinite: any finite number
  Mean mean = Mean::arithmetic;
  std::optional<double> if_absent = {};  // stands for it where a model lacks it; none: every model has it
  bool computed = false;                 // what builders of models find out, not what users give them

  static constexpr double infinite = std::numeric_limits<double>::infinity();
};

/// A row of the table by its place. Those that formulas ask for by name; others are found by
/// find_property() or met in a walk.
enum class Property : std::size_t {
  vp,
  vs,
  rho,
  qp,
  qs,
  epsilon,
  delta,
  gamma,
  epsilon1,
  delta1,
  delta3,
  gamma2,
  tilt,
  azimuth,
  rotation,
  cut_epsilon,
  cut_delta,
  cut_dip,
  // Elastic constants: the upper triangle of Voigt's matrix, row by row.
  c11,
  c22 = c11 + 6,
  c33 = c11 + 11,
  c66 = c11 + 20
};

/// Rows that every model has. They are the first of the table; those after them say what stands for them
/// where they are absent.
inline constexpr std::size_t required_properties = 3;

/// The rows of all properties that are known, in the order of the variables in a file. A new property is a
/// row here.
std::vector<PropertyRow> property_rows();

/// The table that is walked: property_rows(), made once. Its definition stands in a source file of its own,
/// so that tests/property links the tools with a table that has one row more.
std::span<const PropertyRow> material_properties();

const PropertyRow& row_of(Property property);
/// Whether it is an angle of the axes of rock, which may be given beside stiffnesses along them.
constexpr bool turns_axes(Property property) {
  return property == Property::tilt || property == Property::azimuth || property == Property::rotation;
}
constexpr bool is_elastic_constant(Property property) {
  return property >= Property::c11 && property <= Property::c66;
}
/// Whether it says how rock differs from isotropic rock; cells that interfaces cut have others.
constexpr bool tells_anisotropy(Property property) {
  return (property >= Property::epsilon && property <= Property::rotation) || is_elastic_constant(property);
}
/// Nothing where no row has this name.
std::optional<Property> find_property(const std::string& name);
/// In the order of the table.
std::vector<Property> all_properties();
std::vector<std::string> property_names();

}  // namespace slipwave
