#include "grid/grid_netcdf.hpp"

#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "base/error.hpp"
#include "io/netcdf_file.hpp"

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
    if (!(std::abs(values[i] - expected) <= 1e-4 * spacing_m)) return false;
  }
  return true;
}

/// The step of evenly spaced centres: the shortest decimal number that reproduces the first and last of them,
/// so that 0.1 m comes back as 0.1 m. Throws when they are not even.
double spacing_of(const std::string& name, const std::vector<double>& values) {
  const double raw = (values.back() - values.front()) / double(values.size() - 1);
  if (!(raw > 0) || !std::isfinite(raw) || !is_even(values, raw)) {
    throw Error(name +
                ": found unevenly spaced or descending values, expected cell centres a constant step apart");
  }
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

}  // namespace

template <int D>
std::vector<std::string> field_dimensions() {
  std::vector<std::string> names;
  for (int axis = D - 1; axis >= 0; --axis) names.push_back(axis_name(axis_names<D>()[std::size_t(axis)]));
  return names;
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
    values[axis] = file.get<double>(name);
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
  if (begins_below && whole) {
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
    const bool down = axis == D - 1;
    if (down) file.put_attribute(name, "standard_name", "depth");
    file.put_attribute(name, "long_name", down ? "depth of cell centres" : name + " of cell centres");
    file.put_attribute(name, "units", "m");
    file.put_attribute(name, "axis", down ? "Z" : axis == 0 ? "X" : "Y");
    if (down) file.put_attribute(name, "positive", "down");
    const auto values = centres(grid.shape[axis], grid.origin_m[axis], grid.spacing_m);
    file.put_attribute(name, "actual_range", std::vector<double>{values.front(), values.back()});
  }
}

template <int D>
void put_grid(NetcdfFile& file, const Grid<D>& grid) {
  for (std::size_t axis = 0; axis < D; ++axis) {
    file.put(axis_name(axis_names<D>()[axis]),
             centres(grid.shape[axis], grid.origin_m[axis], grid.spacing_m).data());
  }
}

template std::vector<std::string> field_dimensions<2>();
template std::vector<std::string> field_dimensions<3>();
template Grid<2> read_grid<2>(const NetcdfFile&, bool);
template Grid<3> read_grid<3>(const NetcdfFile&, bool);
template void define_grid(NetcdfFile&, const Grid<2>&);
template void define_grid(NetcdfFile&, const Grid<3>&);
template void put_grid(NetcdfFile&, const Grid<2>&);
template void put_grid(NetcdfFile&, const Grid<3>&);

}  // namespace slipwave
