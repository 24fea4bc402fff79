// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

namespace slipwave {

/// What a trace recorded; `other`: something that is not known. In the order of the rows of the table.
// clang-format off
enum class Component {
  vx, vy, vz, p, sxx, syy, szz, sxy, sxz, syz,
  ux, uy, uz, ax, ay, az,
  exx, eyy, ezz, exy, exz, eyz,
  div, curl, curl_x, curl_y, curl_z,
  das,
  other
};
// clang-format on

/// A field of the wave equation: particle velocity along an axis, or a component of the stress tensor. Axes
/// x, y, z are 0, 1, 2; none in 2-D has a y.
struct WaveField {
  enum class Quantity { velocity, stress };
  Quantity quantity = Quantity::velocity;
  int axis = 0;
  int other_axis = 0;  // of stress
};

/// A field, or its derivative along an axis, and the sign with which a component is made of it.
struct ComponentTerm {
  WaveField field;
  int sign = 1;
  int along = -1;  // axis of the derivative; -1: the field itself
};

/// What is recorded of the sum of the terms: its values, their integral in time from t = 0, or derivative.
enum class InTime { value, integral, derivative };

/// All that the house knows of a component: with a row of its own it is known to options, headers of SEG-Y,
/// snapshots, pictures and checks, and the solver records it.
struct ComponentRow {
  Component component;
  const char* name;  // as it is typed
  const char* unit;  // "m/s"; cf_unit() for netCDF
  const char* long_name;
  int trace_code;     // SEG-Y: trace identification code
  bool in_2d, in_3d;  // whether it is recorded there
  /// The component is the mean of its terms, each with its sign, or their sum; 2-D drops those with a y. None
  /// for strain rate along a fibre, which has a direction.
  std::array<ComponentTerm, 3> terms = {};
  int term_count = 0;
  bool is_sum = false;
  InTime in_time = InTime::value;

  /// Whether it is made of fields at an instant alone, so that whole grids of it can be had.
  bool is_field() const;
  bool in(int dimension) const { return dimension == 2 ? in_2d : in_3d; }
  std::vector<ComponentTerm> terms_in(int dimension) const;
  /// "pressure, -(sxx + szz)/2": the long name, for a mean with its formula.
  std::string description(int dimension) const;
};

/// All rows, in the order of Component; the last is `other`.
std::span<const ComponentRow> component_rows();
const ComponentRow& row_of(Component component);

/// "vx" .. "syz", "other".
const char* name_of(Component component);
/// The component of that name; throws Error listing the names otherwise. With a dimension it lists
/// only those that are recorded there.
Component component_named(const std::string& name, int dimension = 0);
/// "m/s", "Pa", "1/s" .. or "" (other).
const char* unit_of(Component component);
/// Returns a unit as CF conventions write it: "m s-1" for "m/s", "m s-2" for "m/s2".
std::string cf_unit(const std::string& unit);

/// Which rows are listed: all, or those that snapshots can have (ComponentRow::is_field()).
enum class Listed { all, fields };
/// Names of all components that are recorded in that dimension, in order; `not_in`: less those of another.
std::vector<std::string> component_names(int dimension, int not_in = 0, Listed listed = Listed::all);

}  // namespace slipwave
