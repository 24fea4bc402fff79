// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <cmath>

#include "base/error.hpp"
#include "base/parse.hpp"
#include "base/words.hpp"
#include "build/import.hpp"
#include "io/netcdf_file.hpp"
#include "io/netcdf_units.hpp"

namespace slipwave {
namespace {

using Variable = NetcdfFile::Variable;

[[noreturn]] void refuse(const NetcdfFile& file, const std::string& name, const std::string& sentence) {
  throw Error(file.shown_name() + ": " + name + ": " + sentence);
}

Variable chosen_variable(const NetcdfFile& file, const std::string& property, const std::string& name) {
  if (!name.empty() && !file.has_variable(name))
    throw Error(file.shown_name() + ": found no variable '" + excerpt(name) + "'", ErrorKind::usage);
  if (!name.empty()) return file.variable(name);
  if (file.has_variable(property)) return file.variable(property);
  std::vector<Variable> fields;
  for (const std::size_t dimensions : {2, 3}) {
    for (const auto& variable : file.variables())
      if (variable.shape.size() == dimensions) fields.push_back(variable);
    if (!fields.empty()) break;
  }
  if (fields.size() == 1) return fields.front();
  std::string list;
  for (const auto& field : fields) list += (list.empty() ? "" : ", ") + field.name;
  throw Error(file.shown_name() + ": found " + (list.empty() ? "no variable" : list) +
              " with two or three dimensions, expected " + property +
              " or one alone; FILE:VARIABLE names one");
}

/// Which dimension of a variable runs along x, y and z.
struct Order {
  std::array<std::size_t, 3> of{};
  bool guessed_depth = false;
};

/// The vertical dimension, of a section also the one that is not called x; of several that may be, or of none
/// in a volume, Error.
std::size_t depth_dimension(const NetcdfFile& file, const Variable& variable, bool& guessed) {
  std::vector<std::size_t> vertical;
  for (std::size_t n = 0; n < variable.dimensions.size(); ++n)
    if (is_vertical(file, variable.dimensions[n])) vertical.push_back(n);
  if (vertical.size() == 1) return vertical.front();
  const std::string names = joined(variable.dimensions);
  if (vertical.size() > 1)
    refuse(file, variable.name, "found more than one vertical dimension among (" + names + "), expected one");
  const auto other_than_depth = [&](std::size_t n) {
    const auto& name = variable.dimensions[n];
    return is_horizontal(file, name, 'y') || name == "time" || name == "t" || name == "twt";
  };
  for (std::size_t n = 0; n < variable.dimensions.size(); ++n)
    if (variable.dimensions.size() == 3 || other_than_depth(n))
      refuse(file, variable.name,
             "found no vertical dimension among (" + names +
                 "), expected one called z or depth, or whose coordinate has axis = \"Z\"");
  for (std::size_t n : {0, 1})
    if (is_horizontal(file, variable.dimensions[1 - n], 'x')) return n;
  guessed = true;
  return 0;
}

/// Whether a dimension is one of times, or of runs of a model: no place.
bool is_no_place(const NetcdfFile& file, const std::string& dimension) {
  const auto name = lower(dimension);
  for (const char* other : {"t", "time", "twt", "ensemble", "member", "realization", "realisation"})
    if (name == other) return true;
  if (!file.has_variable(dimension)) return false;
  const auto units = file.text_attribute(dimension, "units").value_or("");
  return file.text_attribute(dimension, "axis").value_or("") == "T" ||
         units.find(" since ") != std::string::npos || (!units.empty() && unit_conversion(units, "s"));
}

Order order_of(const NetcdfFile& file, const Variable& variable) {
  Order order;
  order.of[2] = depth_dimension(file, variable, order.guessed_depth);
  std::vector<std::size_t> level;
  for (std::size_t n = 0; n < variable.dimensions.size(); ++n)
    if (n != order.of[2]) level.push_back(n);
  for (const auto n : level)
    if (const auto& name = variable.dimensions[n]; variable.dimensions.size() == 3 && is_no_place(file, name))
      refuse(file, variable.name,
             "found the dimension " + name + ", expected places alone: take one out, as with ncwa -a " +
                 name + " -d " + name + ",0 FILE OUT");
  // As CF recommends, x comes last.
  std::reverse(level.begin(), level.end());
  if (level.size() == 2 && (is_horizontal(file, variable.dimensions[level[0]], 'y') ||
                            is_horizontal(file, variable.dimensions[level[1]], 'x')))
    std::swap(level[0], level[1]);
  order.of[0] = level[0];
  order.of[1] = level.size() == 2 ? level[1] : order.of[2];
  return order;
}

struct Axis {
  double first_m = 0, step_m = 0;  // step 0: no coordinates
  std::size_t count = 1;
  double lowest_m() const { return std::min(first_m, first_m + double(count - 1) * step_m); }
};

Axis axis_of(const NetcdfFile& file, const std::string& dimension, std::size_t length, bool depth) {
  Axis axis{0, 0, length};
  if (!file.has_variable(dimension)) {
    if (depth && names_height(dimension))
      refuse(file, dimension, "found no coordinates of heights, expected a variable of that name");
    return axis;
  }
  if (file.variable(dimension).dimensions != std::vector{dimension})
    refuse(file, dimension, "expected a coordinate variable " + dimension + "(" + dimension + ")");
  const auto values = depth ? depths_of(file, dimension) : values_in(file, dimension, "m");
  if (length < 2) return axis;
  const double step = (values.back() - values.front()) / double(values.size() - 1);
  for (std::size_t i = 0; i < values.size(); ++i)
    if (!(std::abs(values[i] - values.front() - double(i) * step) <= 1e-4 * std::abs(step)))
      refuse(file, dimension, "found uneven steps, expected a constant one");
  if (step == 0) refuse(file, dimension, "found equal coordinates, expected a constant step");
  return {values.front(), step, length};
}

/// Nearby decimal number: coordinates kept as float make 20 m steps 19.999998 m.
double tidy(double step) {
  const double rounded = std::round(step * 1000) / 1000;
  return std::abs(rounded - step) < 1e-4 * step ? rounded : step;
}

double common_step(const NetcdfFile& file, const Variable& variable, const std::array<Axis, 3>& axes,
                   std::optional<double> spacing_m) {
  double step = spacing_m.value_or(0);
  for (const Axis& axis : axes) {
    if (axis.step_m == 0) continue;
    const double found = tidy(std::abs(axis.step_m));
    if (step == 0) step = found;
    if (std::abs(found - step) > 1e-4 * step)
      refuse(file, variable.name,
             "found a step of " + shown(found) + " m, expected " + shown(step) + " m along " +
                 (variable.shape.size() == 2 ? "both" : "all") + " axes");
  }
  if (step == 0) refuse(file, variable.name, "found no coordinates, expected --step");
  return step;
}

void check_variable(const NetcdfFile& file, const Variable& variable) {
  const auto dimensions = variable.shape.size();
  if ((dimensions != 2 && dimensions != 3) || variable.size() == 0)
    refuse(file, variable.name,
           "found " + std::to_string(dimensions) + " dimensions, expected two or three that are not empty");
  if (file.text_attribute(variable.name, "coordinates") == "depth" && file.has_variable("depth_bounds"))
    refuse(file, variable.name,
           "found rows that follow horizons (depth_bounds), expected a regular grid; build the model "
           "with --fit none");
}

/// Copies values in the order of a file to that of fields, the lowest coordinates first.
void put_values(ImportedField& field, const std::vector<float>& values, const Variable& variable,
                const Order& order, const std::array<Axis, 3>& axes, const UnitConversion& conversion) {
  std::array<std::size_t, 3> stride{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    stride[axis] = 1;
    for (std::size_t n = order.of[axis] + 1; n < variable.shape.size(); ++n)
      stride[axis] *= variable.shape[n];
  }
  if (field.is_section) stride[1] = 0;
  const auto& grid = field.values.grid();
  const bool changes = conversion.changes();
  for (std::int64_t n = 0; n < grid.size(); ++n) {
    const auto at = grid.index(n);
    std::size_t from = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto i = std::size_t(at[axis]);
      from += stride[axis] * (axes[axis].step_m < 0 ? axes[axis].count - 1 - i : i);
    }
    field.values[std::size_t(n)] = changes ? float(conversion(double(values[from]))) : values[from];
  }
}

}  // namespace

ImportedField field_from_netcdf(const NetcdfFile& file, const PropertyRow& row, const std::string& name,
                                std::optional<double> spacing_m, double unnamed) {
  const auto variable = chosen_variable(file, row.name, name);
  check_variable(file, variable);
  const auto order = order_of(file, variable);
  ImportedField field;
  field.is_section = variable.shape.size() == 2;
  std::array<Axis, 3> axes;
  for (const std::size_t axis : {0, 1, 2})
    if (axis != 1 || !field.is_section)
      axes[axis] =
          axis_of(file, variable.dimensions[order.of[axis]], variable.shape[order.of[axis]], axis == 2);
  if (order.guessed_depth)
    field.said.push_back(variable.name + ": depth is taken along " + variable.dimensions[order.of[2]] +
                         ", the first dimension");
  Grid<3> grid;
  grid.spacing_m = common_step(file, variable, axes, spacing_m);
  field.placed = false;
  for (const std::size_t axis : {0, 1, 2}) {
    grid.shape[axis] = std::int64_t(axes[axis].count);
    if (axes[axis].step_m == 0) continue;
    field.placed = true;
    grid.origin_m[axis] = axes[axis].lowest_m() - grid.spacing_m / 2;
    if (std::abs(grid.origin_m[axis]) < 1e-4 * grid.spacing_m) grid.origin_m[axis] = 0;
  }
  const auto units = file.text_attribute(variable.name, "units").value_or("");
  const bool names_unit = !units.empty();
  if (names_unit && unnamed != 1)
    field.said.push_back(variable.name + " is in " + excerpt(units) +
                         ", as the file says; --units is of numbers that name no unit");
  const auto conversion =
      names_unit ? conversion_of(file, variable.name, row.units) : UnitConversion{unnamed, 0, false};
  field.values = Field<3>(grid);
  put_values(field, file.get_physical(variable.name), variable, order, axes, conversion);
  return field;
}

}  // namespace slipwave
