// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "io/netcdf_file.hpp"
#include "model/import.hpp"
#include "model/units_netcdf.hpp"

namespace slipwave {
namespace {

std::string chosen_variable(const NetcdfFile& file, const std::string& property, const std::string& name) {
  if (!name.empty()) return name;
  if (file.has_variable(property)) return property;
  std::vector<std::string> sections;
  for (const auto& variable : file.variables()) {
    if (variable.shape.size() == 2) sections.push_back(variable.name);
  }
  if (sections.size() == 1) return sections.front();
  std::string list;
  for (const auto& section : sections) list += (list.empty() ? "" : ", ") + section;
  throw Error(file.shown_name() + ": found " + (list.empty() ? "no variable" : list) +
              " with two dimensions, expected " + property + " or one alone; FILE:VARIABLE names one");
}

bool is_depth(const NetcdfFile& file, const std::string& dimension) {
  if (dimension == "z" || dimension == "depth") return true;
  if (!file.has_variable(dimension)) return false;
  return file.text_attribute(dimension, "axis") == "Z" || file.text_attribute(dimension, "positive");
}

struct Axis {
  double first_m = 0, step_m = 0;  // step 0: no coordinates
};

Axis axis_of(const NetcdfFile& file, const std::string& dimension, std::size_t length) {
  if (!file.has_variable(dimension) || length < 2) return {};
  auto values = file.get<double>(dimension);
  const double factor = length_factor(file, dimension);
  const bool up = file.text_attribute(dimension, "positive") == "up";
  for (auto& value : values) value *= up ? -factor : factor;
  const double step = (values.back() - values.front()) / double(values.size() - 1);
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (std::abs(values[i] - values.front() - double(i) * step) <= 1e-4 * std::abs(step)) continue;
    throw Error(file.shown_name() + ": " + dimension + ": found uneven steps, expected a constant one");
  }
  return {values.front(), step};
}

/// Nearby decimal number: coordinates kept as float make 20 m steps 19.999998 m.
double tidy(double step) {
  const double rounded = std::round(step * 1000) / 1000;
  return std::abs(rounded - step) < 1e-4 * step ? rounded : step;
}

}  // namespace

Field<2> field_from_netcdf(const NetcdfFile& file, const PropertyRow& row, const std::string& name,
                           std::optional<double> spacing_m, double unnamed) {
  const auto variable = file.variable(chosen_variable(file, row.name, name));
  if (variable.shape.size() != 2 || variable.shape[0] == 0 || variable.shape[1] == 0) {
    throw Error(file.shown_name() + ": " + variable.name + ": found " +
                std::to_string(variable.shape.size()) + " dimensions, expected two that are not empty");
  }
  if (file.text_attribute(variable.name, "coordinates") == "depth" && file.has_variable("depth_bounds")) {
    throw Error(file.shown_name() + ": " + variable.name +
                ": found rows that follow horizons (depth_bounds), expected a regular grid; build the model "
                "with --fit none");
  }
  const std::size_t depth =
      is_depth(file, variable.dimensions[1]) && !is_depth(file, variable.dimensions[0]) ? 1 : 0;
  const std::size_t nz = variable.shape[depth], nx = variable.shape[1 - depth];
  const Axis z = axis_of(file, variable.dimensions[depth], nz);
  const Axis x = axis_of(file, variable.dimensions[1 - depth], nx);
  double step = spacing_m.value_or(0);
  for (const Axis& axis : {z, x}) {
    if (axis.step_m == 0) continue;
    const double found = tidy(std::abs(axis.step_m));
    if (step == 0) step = found;
    if (std::abs(found - step) > 1e-4 * step) {
      throw Error(file.shown_name() + ": " + variable.name + ": found a step of " + shown(found) +
                  " m, expected " + shown(step) + " m along both axes");
    }
  }
  if (step == 0)
    throw Error(file.shown_name() + ": " + variable.name + ": found no coordinates, expected --step");
  const bool names_unit = !file.text_attribute(variable.name, "units").value_or("").empty();
  const double factor = names_unit ? unit_factor(file, variable.name, row.si, row.thousand) : unnamed;
  const auto values = file.get_physical(variable.name);
  Grid<2> grid;
  grid.shape = {std::int64_t(nx), std::int64_t(nz)};
  grid.spacing_m = step;
  if (x.step_m != 0) grid.origin_m[0] = std::min(x.first_m, x.first_m + double(nx - 1) * x.step_m) - step / 2;
  if (std::abs(grid.origin_m[0]) < 1e-4 * step) grid.origin_m[0] = 0;
  Field<2> field(grid);
  for (std::size_t k = 0; k < nz; ++k) {
    for (std::size_t i = 0; i < nx; ++i) {
      const std::size_t from_k = z.step_m < 0 ? nz - 1 - k : k, from_i = x.step_m < 0 ? nx - 1 - i : i;
      const std::size_t from = depth == 0 ? from_k * nx + from_i : from_i * nz + from_k;
      const float value = values[from];
      field[k * nx + i] = factor == 1 ? value : float(double(value) * factor);
    }
  }
  return field;
}

}  // namespace slipwave
