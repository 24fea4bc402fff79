// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <optional>

#include "base/error.hpp"
#include "geology/depth_grid.hpp"
#include "io/netcdf_file.hpp"
#include "io/netcdf_units.hpp"

namespace slipwave {
namespace {

NetcdfFile::Variable depth_variable(const NetcdfFile& file) {
  std::vector<NetcdfFile::Variable> grids;
  for (auto& variable : file.variables()) {
    if (variable.shape.size() == 2) grids.push_back(variable);
  }
  for (const char* name : {"depth", "z"}) {
    for (const auto& grid : grids) {
      if (grid.name == name) return grid;
    }
  }
  if (grids.size() == 1) return grids.front();
  std::string list;
  for (const auto& grid : grids) list += (list.empty() ? "" : ", ") + grid.name;
  throw Error(file.shown_name() + ": found " + (list.empty() ? "no variable" : list) +
              " with two dimensions, expected depth, z or one alone");
}

/// Coordinates in m, ascending, and whether they stood the other way round.
struct DepthAxis {
  std::vector<double> at_m;
  bool turned = false;
};

DepthAxis axis_of(const NetcdfFile& file, const std::string& variable, const std::string& dimension,
                  std::size_t length) {
  const std::string place = file.shown_name() + ": ";
  if (!file.has_variable(dimension) || file.variable(dimension).dimensions != std::vector{dimension}) {
    throw Error(place + variable + ": found no coordinates along " + dimension + ", expected a variable " +
                dimension + "(" + dimension + ")");
  }
  DepthAxis axis{values_in(file, dimension, "m")};
  axis.turned = length > 1 && axis.at_m.front() > axis.at_m.back();
  if (axis.turned) std::reverse(axis.at_m.begin(), axis.at_m.end());
  for (std::size_t n = 0; n < length; ++n) {
    if (std::isfinite(axis.at_m[n]) && (n == 0 || axis.at_m[n] > axis.at_m[n - 1])) continue;
    throw Error(place + dimension + ": found " + shown(axis.at_m[n]) +
                (n == 0 ? "" : " beside " + shown(axis.at_m[n - 1])) + ", expected coordinates in order");
  }
  return axis;
}

}  // namespace

DepthGrid depth_grid_from_netcdf(const NetcdfFile& file) {
  const auto variable = depth_variable(file);
  const auto& names = variable.dimensions;
  const bool x_first = !is_horizontal(file, names[1], 'x') &&
                       (is_horizontal(file, names[0], 'x') || is_horizontal(file, names[1], 'y'));
  const std::size_t of_x = x_first ? 0 : 1, columns = variable.shape[of_x], rows = variable.shape[1 - of_x];
  auto x = axis_of(file, variable.name, names[of_x], columns);
  auto y = axis_of(file, variable.name, names[1 - of_x], rows);
  const auto in_metres = conversion_of(file, variable.name, "m");
  const double sign = vertical_sense(file, variable.name) == VerticalSense::up ? -1 : 1;
  const auto values = file.get_physical(variable.name);
  std::vector<double> depths;
  depths.reserve(values.size());
  for (std::size_t j = 0; j < rows; ++j) {
    for (std::size_t i = 0; i < columns; ++i) {
      const std::size_t from_i = x.turned ? columns - 1 - i : i, from_j = y.turned ? rows - 1 - j : j;
      depths.push_back(
          sign * in_metres(double(values[x_first ? from_i * rows + from_j : from_j * columns + from_i])));
    }
  }
  return in_place(file.shown_name() + ": " + variable.name,
                  [&] { return DepthGrid(std::move(x.at_m), std::move(y.at_m), std::move(depths)); });
}

}  // namespace slipwave
