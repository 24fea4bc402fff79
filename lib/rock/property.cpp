// SPDX-License-Identifier: BSD-3-Clause
#include "rock/property.hpp"

namespace slipwave {
namespace {

/// Below it c11 or (c13 + c55)^2 is negative, whatever vp and vs are.
constexpr double least_thomsen = -0.5;

/// The most anisotropic mineral, graphite (c11 1060, c33 36.5, c44 4, c66 440 GPa), has an epsilon of 14 and
/// a gamma of 54; layers and cracks that waves still cross as one medium have less.
constexpr double largest_epsilon = 20, largest_gamma = 100;

PropertyRow thomsen(const std::string& name, const std::string& about) {
  return {.name = name,
          .long_name = "Thomsen's " + name.substr(name.find('_') + 1) + " about the " + about,
          .help = "Thomsen's " + name + " of layered rock, a file or a number",
          .units = "1",
          .shown_unit = "",
          .least = least_thomsen,
          .largest = name.find("gamma") == std::string::npos ? largest_epsilon : largest_gamma,
          .mean = Mean::elastic,
          .if_absent = 0};
}

/// Returns the row of a parameter of rock in 3-D; as 0 in files of models that lack it, complete_anisotropy()
/// says what it is then.
PropertyRow in_3d(const std::string& name, const std::string& long_name) {
  auto row = thomsen(name, "");
  row.long_name = long_name;
  row.help = long_name + ", in 3-D, a file or a number";
  return row;
}

PropertyRow dip(const std::string& name, const std::string& of, const std::string& help) {
  return {.name = name,
          .long_name = "dip of the " + of + ", deepening towards +x",
          .help = help,
          .units = "degree",
          .shown_unit = "degrees",
          .least = -90,
          .largest = 90,
          .mean = Mean::elastic,
          .if_absent = 0};
}

/// Returns the row of an angle of the axes of rock in 3-D, besides the tilt.
PropertyRow turn(const std::string& name, const std::string& long_name) {
  return {.name = name,
          .long_name = long_name,
          .help = long_name + ", degrees, in 3-D, a file or a number",
          .units = "degree",
          .shown_unit = "degrees",
          .least = -360,
          .largest = 360,
          .mean = Mean::elastic,
          .if_absent = 0};
}

PropertyRow tilt() {
  return dip("tilt", "beds of anisotropic rock, the tilt of its axis of symmetry",
             "dip of such layers, degrees: the tilt of their axis from the vertical, a file or a number");
}
PropertyRow azimuth() {
  return turn("azimuth", "direction in which the beds of anisotropic rock deepen, from +x towards +y");
}
PropertyRow rotation() {
  return turn("rotation", "turn of orthorhombic rock about the normal of its beds, from down dip");
}

/// Returns the row of a property that only cells have which interfaces of solids cut.
PropertyRow of_cut_cells(PropertyRow row) {
  row.computed = true;
  return row;
}

/// Returns the row of an elastic constant, by Voigt's numbers.
PropertyRow constant(int m, int n) {
  const auto name = "c" + std::to_string(m) + std::to_string(n);
  return {.name = name,
          .long_name = "elastic constant " + name + ", 0 where the other properties say what the rock is",
          .help = "",
          .units = "Pa",
          .shown_unit = "Pa",
          .least = -PropertyRow::infinite,
          .mean = Mean::elastic,
          .if_absent = 0,
          .computed = true};
}

std::vector<PropertyRow> rows_but_constants() {
  return {{.name = "vp",
           .long_name = "P-wave speed",
           .help = "P-wave speed: raw float32, SEG-Y or netCDF (FILE or FILE:VARIABLE), or a number",
           .units = "m s-1",
           .shown_unit = "m/s",
           .mean = Mean::elastic},
          {.name = "vs",
           .long_name = "S-wave speed, 0 = fluid",
           .help = "S-wave speed; 0 is fluid",
           .units = "m s-1",
           .shown_unit = "m/s",
           .mean = Mean::elastic},
          {.name = "rho",
           .long_name = "density, 0 = void",
           .help = "density; 0 is void (air)",
           .units = "kg m-3",
           .shown_unit = "kg/m3",
           .mean = Mean::elastic},
          {.name = "qp",
           .long_name = "quality factor of P waves, infinite = elastic",
           .help = "quality factor of P waves, a file or a number",
           .units = "1",
           .shown_unit = "",
           .least = 1,
           .mean = Mean::harmonic,
           .if_absent = PropertyRow::infinite},
          {.name = "qs",
           .long_name = "quality factor of S waves, infinite = elastic",
           .help = "quality factor of S waves, a file or a number; fluids have none",
           .units = "1",
           .shown_unit = "",
           .least = 1,
           .mean = Mean::harmonic,
           .if_absent = PropertyRow::infinite},
          thomsen("epsilon", "axis of symmetry, 0 = isotropic"),
          thomsen("delta", "axis of symmetry, 0 = isotropic"),
          in_3d("gamma", "Thomsen's gamma of layered rock"),
          in_3d("epsilon1", "Tsvankin's epsilon(1) of orthorhombic rock"),
          in_3d("delta1", "Tsvankin's delta(1) of orthorhombic rock"),
          in_3d("delta3", "Tsvankin's delta(3) of orthorhombic rock"),
          in_3d("gamma2", "Tsvankin's gamma(2) of orthorhombic rock"),
          tilt(),
          azimuth(),
          rotation(),
          of_cut_cells(thomsen("cut_epsilon", "normal of the interface that cuts the cell, 0 = none")),
          of_cut_cells(thomsen("cut_delta", "normal of the interface that cuts the cell, 0 = none")),
          of_cut_cells(dip("cut_dip", "interface that cuts the cell", ""))};
}

}  // namespace

std::vector<PropertyRow> property_rows() {
  auto rows = rows_but_constants();
  for (int m = 1; m <= 6; ++m)
    for (int n = m; n <= 6; ++n) rows.push_back(constant(m, n));
  return rows;
}

const PropertyRow& row_of(Property property) { return material_properties()[std::size_t(property)]; }

std::optional<Property> find_property(const std::string& name) {
  for (const Property property : all_properties())
    if (row_of(property).name == name) return property;
  return {};
}

std::vector<Property> all_properties() {
  std::vector<Property> all;
  for (std::size_t n = 0; n < material_properties().size(); ++n) all.push_back(Property(n));
  return all;
}

std::vector<std::string> property_names() {
  std::vector<std::string> names;
  for (const auto& row : material_properties()) names.push_back(row.name);
  return names;
}

}  // namespace slipwave
