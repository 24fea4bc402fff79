// SPDX-License-Identifier: BSD-3-Clause
#include "grid/grid_netcdf.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <utility>

#include "base/error.hpp"
#include "base/instantiate.hpp"
#include "io/netcdf_file.hpp"
#include "io/netcdf_units.hpp"

namespace slipwave {
namespace {

std::string axis_name(char axis) { return std::string(1, axis); }

std::vector<double> centres(std::int64_t count, double origin_m, double spacing_m) {
  std::vector<double> values(std::size_t(count), 0.0);
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = origin_m + (double(i) + 0.5) * spacing_m;
  return values;
}

bool is_even(const std::vector<double>& values, double spacing_m) {
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double expected = values[0] + double(i) * spacing_m;
    if (!(std::abs(values[i] - expected) <= 1e-4 * std::abs(spacing_m))) return false;
  }
  return true;
}

/// The step of evenly spaced centres: the shortest decimal number that reproduces the first and last of them,
/// so that 0.1 m comes back as 0.1 m. Throws when they are not even.
double spacing_of(const std::string& name, const std::vector<double>& values) {
  const double raw = (values.back() - values.front()) / double(values.size() - 1);
  if (!std::isfinite(raw) || !is_even(values, raw))
    throw Error(name + ": found unevenly spaced values, expected cell centres a constant step apart");
  if (!(raw > 0))
    throw Error(name + ": found cells from " + shown(values.front()) + " to " + shown(values.back()) + " m" +
                (name == "z" ? " deep" : "") + ", expected " +
                (name == "z" ? "them from the top down" : "ascending ones") + ": ncpdq -a -" + name +
                " FILE reverses them");
  const double last = values.back();
  for (int digits = 6; digits <= 17; ++digits) {
    char text[40];
    std::snprintf(text, sizeof text, "%.*e", digits - 1, raw);
    const double candidate = std::strtod(text, nullptr);
    const double reached = values.front() + double(values.size() - 1) * candidate;
    if (std::abs(reached - last) <= 4e-16 * (std::abs(last) + std::abs(values.front()))) return candidate;
  }
  return raw;
}

const std::string bounds_name = "depth_bounds", horizon_prefix = "horizon_", topology_name = "grid";

template <int D>
std::vector<std::string> corner_dimensions() {
  auto names = field_dimensions<D>();
  for (auto& name : names) name += "_face";
  return names;
}

/// "x", in 3-D "y", "x".
template <int D>
std::vector<std::string> column_dimensions() {
  auto names = field_dimensions<D>();
  names.erase(names.begin());
  return names;
}

/// Whether the depths of rows are those of this grid, not of a larger one that it is a part of.
template <int D>
bool is_fitted(const Grid<D>& grid) {
  return grid.rows && grid.rows->cells() == grid.shape && grid.first == Index<D>{};
}

std::string listed(const std::vector<std::string>& names) {
  std::string text;
  for (const auto& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

[[noreturn]] void refuse(const NetcdfFile& file, const std::string& sentence) {
  throw Error(file.shown_name() + ": " + sentence);
}

/// The horizons that rows of a file follow, from the top down.
std::vector<FittedHorizon> read_horizons(const NetcdfFile& file, std::int64_t rows) {
  std::vector<FittedHorizon> horizons;
  for (const auto& variable : file.variables()) {
    if (!variable.name.starts_with(horizon_prefix)) continue;
    const auto role = file.text_attribute(variable.name, "role");
    const auto row = file.number_attribute(variable.name, "row");
    if (!role || (*role != "surface" && *role != "floor" && *role != "layer")) {
      refuse(file,
             variable.name + ": found role '" + role.value_or("") + "', expected surface, floor or layer");
    }
    if (!row || row->size() != 1 || !(row->front() >= 0 && row->front() <= double(rows))) {
      refuse(file, variable.name + ": found no row from 0 to " + std::to_string(rows) +
                       " that follows it, expected the attribute row");
    }
    horizons.push_back({variable.name.substr(horizon_prefix.size()), *role, std::int64_t(row->front())});
  }
  std::stable_sort(horizons.begin(), horizons.end(),
                   [](const auto& a, const auto& b) { return a.row < b.row; });
  return horizons;
}

/// Depths of cells and of corners must belong together: who changes one must change the other.
template <int D>
void check_depths(const NetcdfFile& file, const Grid<D>& grid) {
  if (!file.has_variable("depth")) return;
  if (file.variable("depth").dimensions != field_dimensions<D>())
    refuse(file, "depth: expected it over (" + listed(field_dimensions<D>()) + ")");
  std::vector<std::size_t> start(D, 0), count;
  for (int axis = D - 1; axis >= 0; --axis) count.push_back(std::size_t(grid.shape[std::size_t(axis)]));
  count[0] = 1;
  const std::int64_t a_row = grid.size() / grid.shape[D - 1];
  const double sign = vertical_sense(file, "depth") == VerticalSense::up ? -1 : 1;
  for (std::int64_t row = 0; row < grid.shape[D - 1]; ++row) {
    start[0] = std::size_t(row);
    const auto depths = values_in(file, "depth", "m", start, count);
    for (std::int64_t n = 0; n < a_row; ++n) {
      const std::int64_t cell = row * a_row + n;
      const double expected = grid.depth(grid.index(cell));
      const double found = sign * depths[std::size_t(n)];
      if (std::abs(found - expected) <= 0.01 * grid.spacing_m) continue;
      refuse(file, "depth is " + shown(found) + " m in the cell at " + place_of(grid, cell) + ", but " +
                       bounds_name + " has its corners about " + shown(expected) + " m");
    }
  }
}

/// Depths of a horizon at the centres of columns, m.
template <int D>
std::vector<double> depths_of_horizon(const Grid<D>& grid, const FittedHorizon& horizon) {
  std::vector<double> depths;
  for (std::int64_t n = 0; n < grid.size() / grid.shape[D - 1]; ++n) {
    const auto at = grid.index(n);
    std::array<double, std::size_t(D)> position{};
    for (std::size_t axis = 0; axis + 1 < D; ++axis) position[axis] = double(at[axis]) + 0.5;
    position[D - 1] = double(horizon.row);
    depths.push_back(grid.rows->depth(position));
  }
  return depths;
}

/// A horizon must lie where its row of faces does.
template <int D>
void check_horizons(const NetcdfFile& file, const Grid<D>& grid) {
  for (const auto& horizon : grid.rows->horizons()) {
    const auto name = horizon_prefix + horizon.name;
    if (file.variable(name).dimensions != column_dimensions<D>())
      refuse(file, name + ": expected it over (" + listed(column_dimensions<D>()) + ")");
    const double sign = vertical_sense(file, name) == VerticalSense::up ? -1 : 1;
    const auto found = values_in(file, name, "m");
    const auto expected = depths_of_horizon(grid, horizon);
    for (std::size_t n = 0; n < found.size(); ++n) {
      if (std::abs(sign * found[n] - expected[n]) <= 0.01 * grid.spacing_m) continue;
      refuse(file, name + " is " + shown(sign * found[n]) +
                       " m deep at x=" + shown(grid.centre(0, std::int64_t(n) % grid.shape[0])) +
                       ", but row " + std::to_string(horizon.row) + ", which follows it, is " +
                       shown(expected[n], 6) + " m deep there");
    }
  }
}

template <int D>
RowDepths<D> read_rows(const NetcdfFile& file, const Grid<D>& grid) {
  const auto variable = file.variable(bounds_name);
  std::vector<std::size_t> shape;
  for (int axis = D - 1; axis >= 0; --axis) shape.push_back(std::size_t(grid.shape[std::size_t(axis)]) + 1);
  if (variable.shape != shape) {
    std::string found, expected;
    for (const auto length : variable.shape) found += (found.empty() ? "" : " x ") + std::to_string(length);
    for (const auto length : shape) expected += (expected.empty() ? "" : " x ") + std::to_string(length);
    refuse(file, bounds_name + ": found " + found + " corners, expected " + expected +
                     ", one more than cells along each axis");
  }
  auto corners = depths_of(file, bounds_name);
  auto horizons = read_horizons(file, grid.shape[D - 1]);
  return in_place(file.shown_name() + ": " + bounds_name,
                  [&] { return RowDepths<D>(grid.shape, std::move(corners), std::move(horizons)); });
}

/// What SGRID calls a cell.
template <int D>
std::string cell_name() {
  return D == 2 ? "face" : "volume";
}

/// Which corners are those of a cell, by the SGRID conventions: one more than cells along each axis.
template <int D>
void define_topology(NetcdfFile& file) {
  std::string nodes, cells, columns, node_columns;
  for (std::size_t axis = 0; axis < D; ++axis) {
    const std::string name = axis_name(axis_names<D>()[axis]), node = name + "_face";
    const std::string blank = axis == 0 ? "" : " ";
    nodes += blank + node;
    cells += blank + name + ": " + node + " (padding: none)";
    if (axis + 1 == D) continue;
    columns += name + " ";
    node_columns += node + " ";
    file.define_variable(node, NetcdfFile::Type::f64, {node});
    file.put_attribute(node, "long_name", name + " of cell corners");
    file.put_attribute(node, "units", "m");
    file.put_attribute(node, "axis", axis == 0 ? "X" : "Y");
  }
  file.define_variable(topology_name, NetcdfFile::Type::i32, {});
  const auto put = [&](const std::string& name, const std::string& text) {
    file.put_attribute(topology_name, name, text);
  };
  put("cf_role", "grid_topology");
  put("long_name", "cells and their corners");
  file.put_attribute(topology_name, "topology_dimension", std::vector<int>{D});
  put("node_dimensions", nodes);
  put("node_coordinates", node_columns + bounds_name);
  put(cell_name<D>() + "_dimensions", cells);
  put(cell_name<D>() + "_coordinates", columns + "depth");
}

/// Variables of a fitted grid beside its coordinates.
template <int D>
void define_depths(NetcdfFile& file, const Grid<D>& grid) {
  const auto corners = corner_dimensions<D>();
  for (std::size_t n = 0; n < D; ++n)
    file.define_dimension(corners[n], std::size_t(grid.shape[D - 1 - n]) + 1);
  const auto define = [&](const std::string& name, NetcdfFile::Type type,
                          const std::vector<std::string>& dimensions, const std::string& long_name) {
    file.define_variable(name, type, dimensions);
    file.put_attribute(name, "standard_name", "depth");
    file.put_attribute(name, "long_name", long_name);
    file.put_attribute(name, "units", "m");
    file.put_attribute(name, "positive", "down");
  };
  define("depth", NetcdfFile::Type::f32, field_dimensions<D>(), "depth of cell centres");
  define(bounds_name, NetcdfFile::Type::f64, corners, "depth of cell corners");
  for (const auto& horizon : grid.rows->horizons()) {
    const auto name = horizon_prefix + horizon.name;
    define(name, NetcdfFile::Type::f64, column_dimensions<D>(), "depth of a horizon that rows follow");
    file.put_attribute(name, "role", horizon.role);
    file.put_attribute(name, "row", std::vector<int>{int(horizon.row)});
  }
  define_topology<D>(file);
}

template <int D>
void put_depths(NetcdfFile& file, const Grid<D>& grid) {
  std::vector<float> depths(std::size_t(grid.size()), 0);
  for (std::int64_t cell = 0; cell < grid.size(); ++cell)
    depths[std::size_t(cell)] = float(grid.depth(grid.index(cell)));
  file.put("depth", depths.data());
  file.put(bounds_name, grid.rows->corners_m().data());
  for (std::size_t axis = 0; axis + 1 < D; ++axis)
    file.put(axis_name(axis_names<D>()[axis]) + "_face",
             centres(grid.shape[axis] + 1, grid.origin_m[axis] - grid.spacing_m / 2, grid.spacing_m).data());
  for (const auto& horizon : grid.rows->horizons())
    file.put(horizon_prefix + horizon.name, depths_of_horizon(grid, horizon).data());
}

}  // namespace

template <int D>
std::vector<std::string> field_dimensions() {
  std::vector<std::string> names;
  for (int axis = D - 1; axis >= 0; --axis) names.push_back(axis_name(axis_names<D>()[std::size_t(axis)]));
  return names;
}

template <int D>
void put_coordinates(NetcdfFile& file, const Grid<D>& grid, const std::string& variable) {
  if (!is_fitted(grid)) return;
  file.put_attribute(variable, "coordinates", "depth");
  file.put_attribute(variable, "grid", topology_name);
  file.put_attribute(variable, "location", cell_name<D>());
}

template <int D>
std::string conventions_of(const Grid<D>& grid) {
  return is_fitted(grid) ? "CF-1.10 SGRID-0.3" : "CF-1.10";
}

template <int D>
Grid<D> read_grid(const NetcdfFile& file, bool whole) {
  Grid<D> grid;
  std::array<std::vector<double>, D> values;
  for (std::size_t axis = 0; axis < D; ++axis) {
    const std::string name = axis_name(axis_names<D>()[axis]);
    if (!file.has_variable(name)) {
      throw Error(file.shown_name() + ": found no coordinate variable '" + name + "'; is it a " +
                  std::to_string(D) + "-D model?");
    }
    const auto variable = file.variable(name);
    if (variable.dimensions != std::vector<std::string>{name}) {
      throw Error(file.shown_name() + ": " + name + ": expected a coordinate variable " + name + "(" + name +
                  ")");
    }
    values[axis] = axis == D - 1 ? depths_of(file, name) : values_in(file, name, "m");
    if (values[axis].empty()) throw Error(file.shown_name() + ": " + name + ": found no values");
    grid.shape[axis] = std::int64_t(values[axis].size());
  }
  std::string first;
  for (std::size_t axis = 0; axis < D; ++axis) {
    const std::string name = axis_name(axis_names<D>()[axis]);
    if (values[axis].size() < 2) continue;
    const double spacing = in_place(file.shown_name(), [&] { return spacing_of(name, values[axis]); });
    if (first.empty()) {
      first = name;
      grid.spacing_m = spacing;
    } else if (std::abs(spacing - grid.spacing_m) > 1e-6 * grid.spacing_m) {
      throw Error(file.shown_name() + ": found a step of " + shown(grid.spacing_m) + " m along " + first +
                  " and of " + shown(spacing) + " m along " + name + ", expected equal steps");
    }
  }
  if (first.empty())
    throw Error(file.shown_name() + ": found a single cell, expected at least two along an axis");
  for (std::size_t axis = 0; axis < D; ++axis) {
    double origin = values[axis].front() - grid.spacing_m / 2;
    if (std::abs(origin) < 1e-9 * grid.spacing_m) origin = 0;
    grid.origin_m[axis] = origin;
  }
  double& top = grid.origin_m[D - 1];
  const bool begins_below = std::abs(top) > 1e-4 * grid.spacing_m;
  if (file.has_variable(bounds_name)) {
    grid.rows = std::make_shared<const RowDepths<D>>(read_rows(file, grid));
    check_depths(file, grid);
    check_horizons(file, grid);
  } else if (begins_below && whole) {
    throw Error(file.shown_name() + ": z begins at " + shown(values[D - 1].front()) + ", expected " +
                shown(grid.spacing_m / 2) + ", half a step below the surface");
  }
  if (!begins_below) top = 0;
  return grid;
}

template <int D>
void define_grid(NetcdfFile& file, const Grid<D>& grid) {
  for (const auto& name : field_dimensions<D>()) {
    const auto axis = std::size_t(name == "x" ? 0 : name == "z" ? D - 1 : 1);
    file.define_dimension(name, std::size_t(grid.shape[axis]));
  }
  for (std::size_t axis = 0; axis < D; ++axis) {
    const std::string name = axis_name(axis_names<D>()[axis]);
    file.define_variable(name, NetcdfFile::Type::f64, {name});
    const bool down = axis == D - 1, is_depth = down && !is_fitted(grid);
    if (is_depth) file.put_attribute(name, "standard_name", "depth");
    file.put_attribute(name, "long_name",
                       is_depth ? "depth of cell centres"
                       : down   ? "row coordinate of cell centres"
                                : name + " of cell centres");
    file.put_attribute(name, "units", "m");
    file.put_attribute(name, "axis", down ? "Z" : axis == 0 ? "X" : "Y");
    if (down) file.put_attribute(name, "positive", "down");
    const auto values = centres(grid.shape[axis], grid.origin_m[axis], grid.spacing_m);
    file.put_attribute(name, "actual_range", std::vector<double>{values.front(), values.back()});
  }
  if (is_fitted(grid)) define_depths(file, grid);
}

template <int D>
void put_grid(NetcdfFile& file, const Grid<D>& grid) {
  for (std::size_t axis = 0; axis < D; ++axis) {
    file.put(axis_name(axis_names<D>()[axis]),
             centres(grid.shape[axis], grid.origin_m[axis], grid.spacing_m).data());
  }
  if (is_fitted(grid)) put_depths(file, grid);
}

SLIPWAVE_INSTANTIATE_D(FUNCTION, field_dimensions);
SLIPWAVE_INSTANTIATE_D(FUNCTION, read_grid);
SLIPWAVE_INSTANTIATE_D(FUNCTION, define_grid);
SLIPWAVE_INSTANTIATE_D(FUNCTION, put_grid);
SLIPWAVE_INSTANTIATE_D(FUNCTION, put_coordinates);
SLIPWAVE_INSTANTIATE_D(FUNCTION, conventions_of);

}  // namespace slipwave
