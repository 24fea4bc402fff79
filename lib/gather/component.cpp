// SPDX-License-Identifier: BSD-3-Clause
#include "gather/component.hpp"

#include <algorithm>
#include <iterator>

#include "base/error.hpp"
#include "base/parse.hpp"

namespace slipwave {
namespace {

constexpr ComponentTerm velocity(int axis) { return {{WaveField::Quantity::velocity, axis, axis}, 1}; }
constexpr ComponentTerm stress(int axis, int other_axis, int sign = 1) {
  return {{WaveField::Quantity::stress, axis, other_axis}, sign};
}
/// The derivative of velocity along an axis.
constexpr ComponentTerm slope(int axis, int along, int sign = 1) {
  return {{WaveField::Quantity::velocity, axis, axis}, sign, along};
}
constexpr int x = 0, y = 1, z = 2;

constexpr bool both = true, only_3d = false;

/// A component that is one field, of both dimensions or of 3-D alone.
constexpr ComponentRow row(Component component, const char* name, const char* unit, const char* long_name,
                           int trace_code, bool in_2d, const ComponentTerm& term) {
  return {component, name, unit, long_name, trace_code, in_2d, true, {term}, 1};
}
/// One that is the mean of several.
template <std::size_t N>
constexpr ComponentRow mean(Component component, const char* name, const char* unit, const char* long_name,
                            int trace_code, bool in_2d, const ComponentTerm (&terms)[N]) {
  ComponentRow made = {component, name, unit, long_name, trace_code, in_2d, true, {}, int(N)};
  for (std::size_t n = 0; n < N; ++n) made.terms[n] = terms[n];
  return made;
}

/// One that is the sum of several, of the dimensions it is made for.
template <std::size_t N>
constexpr ComponentRow sum(Component component, const char* name, const char* unit, const char* long_name,
                           int trace_code, std::array<bool, 2> in, const ComponentTerm (&terms)[N]) {
  auto made = mean(component, name, unit, long_name, trace_code, in[0], terms);
  made.in_3d = in[1];
  made.is_sum = true;
  return made;
}
constexpr ComponentRow in_time(InTime what, ComponentRow row) {
  row.in_time = what;
  return row;
}
constexpr std::array<bool, 2> everywhere = {true, true}, in_2d_alone = {true, false},
                              in_3d_alone = {false, true};
constexpr InTime integral = InTime::integral, derivative = InTime::derivative;

// clang-format off
constexpr ComponentRow rows[] = {
    row(Component::vx, "vx", "m/s", "particle velocity along x", 14, both, velocity(x)),
    row(Component::vy, "vy", "m/s", "particle velocity along y", 13, only_3d, velocity(y)),
    row(Component::vz, "vz", "m/s", "particle velocity along z, positive down", 12, both, velocity(z)),
    mean(Component::p, "p", "Pa", "pressure", 11, both,
         {stress(x, x, -1), stress(y, y, -1), stress(z, z, -1)}),
    row(Component::sxx, "sxx", "Pa", "normal stress along x, tension positive", 257, both, stress(x, x)),
    row(Component::syy, "syy", "Pa", "normal stress along y, tension positive", 258, only_3d, stress(y, y)),
    row(Component::szz, "szz", "Pa", "normal stress along z, tension positive", 259, both, stress(z, z)),
    row(Component::sxy, "sxy", "Pa", "shear stress", 262, only_3d, stress(x, y)),
    row(Component::sxz, "sxz", "Pa", "shear stress", 261, both, stress(x, z)),
    row(Component::syz, "syz", "Pa", "shear stress", 260, only_3d, stress(y, z)),
    in_time(integral, row(Component::ux, "ux", "m", "displacement along x", 263, both, velocity(x))),
    in_time(integral, row(Component::uy, "uy", "m", "displacement along y", 264, only_3d, velocity(y))),
    in_time(integral, row(Component::uz, "uz", "m", "displacement along z, positive down", 265, both, velocity(z))),
    in_time(derivative, row(Component::ax, "ax", "m/s2", "acceleration along x", 266, both, velocity(x))),
    in_time(derivative, row(Component::ay, "ay", "m/s2", "acceleration along y", 267, only_3d, velocity(y))),
    in_time(derivative, row(Component::az, "az", "m/s2", "acceleration along z, positive down", 268, both, velocity(z))),
    row(Component::exx, "exx", "1/s", "strain rate along x, extension positive", 269, both, slope(x, x)),
    row(Component::eyy, "eyy", "1/s", "strain rate along y, extension positive", 270, only_3d, slope(y, y)),
    row(Component::ezz, "ezz", "1/s", "strain rate along z, extension positive", 271, both, slope(z, z)),
    mean(Component::exy, "exy", "1/s", "shear strain rate", 272, only_3d, {slope(x, y), slope(y, x)}),
    mean(Component::exz, "exz", "1/s", "shear strain rate", 273, both, {slope(x, z), slope(z, x)}),
    mean(Component::eyz, "eyz", "1/s", "shear strain rate", 274, only_3d, {slope(y, z), slope(z, y)}),
    sum(Component::div, "div", "1/s", "divergence of particle velocity", 275, everywhere,
        {slope(x, x), slope(y, y), slope(z, z)}),
    sum(Component::curl, "curl", "1/s", "curl of particle velocity, dvx/dz - dvz/dx", 276, in_2d_alone,
        {slope(x, z), slope(z, x, -1)}),
    sum(Component::curl_x, "curlx", "1/s", "curl of particle velocity along x, dvz/dy - dvy/dz", 277, in_3d_alone,
        {slope(z, y), slope(y, z, -1)}),
    sum(Component::curl_y, "curly", "1/s", "curl of particle velocity along y, dvx/dz - dvz/dx", 278, in_3d_alone,
        {slope(x, z), slope(z, x, -1)}),
    sum(Component::curl_z, "curlz", "1/s", "curl of particle velocity along z, dvy/dx - dvx/dy", 279, in_3d_alone,
        {slope(y, x), slope(x, y, -1)}),
    {Component::das, "das", "1/s", "strain rate along a fibre, mean over the gauge length", 280, true, true},
    {Component::other, "other", "", "", 1, false, false},
};
// clang-format on

constexpr bool in_order() {
  for (std::size_t n = 0; n < std::size(rows); ++n)
    if (rows[n].component != Component(n)) return false;
  return rows[std::size(rows) - 1].component == Component::other;
}
static_assert(in_order(), "a row for each Component, in their order");

std::string symbol_of(const ComponentTerm& term) {
  const std::string axes = "xyz";
  const auto& field = term.field;
  const auto axis = axes.substr(std::size_t(field.axis), 1);
  if (term.along >= 0) return "dv" + axis + "/d" + axes[std::size_t(term.along)];
  if (field.quantity == WaveField::Quantity::velocity) return "v" + axis;
  return "s" + axis + axes[std::size_t(field.other_axis)];
}

}  // namespace

std::span<const ComponentRow> component_rows() { return rows; }

const ComponentRow& row_of(Component component) {
  return rows[std::min(std::size_t(component), std::size_t(Component::other))];
}

std::vector<ComponentTerm> ComponentRow::terms_in(int dimension) const {
  std::vector<ComponentTerm> found(terms.begin(), terms.begin() + term_count);
  if (dimension == 2)
    std::erase_if(found, [](const ComponentTerm& term) {
      return term.field.axis == y || term.field.other_axis == y || term.along == y;
    });
  return found;
}

bool ComponentRow::is_field() const {
  return term_count > 0 && in_time == InTime::value &&
         std::all_of(terms.begin(), terms.begin() + term_count,
                     [](const ComponentTerm& term) { return term.along < 0; });
}

std::string ComponentRow::description(int dimension) const {
  if (term_count < 2 || is_sum) return long_name;
  const auto found = terms_in(dimension);
  const bool all_negative =
      std::all_of(found.begin(), found.end(), [](const ComponentTerm& term) { return term.sign < 0; });
  std::string sum;
  for (const auto& term : found) {
    const bool minus = term.sign < 0 && !all_negative;
    sum += (sum.empty() ? (minus ? "-" : "") : minus ? " - " : " + ") + symbol_of(term);
  }
  return std::string(long_name) + ", " + (all_negative ? "-" : "") + "(" + sum + ")/" +
         std::to_string(found.size());
}

const char* name_of(Component component) { return row_of(component).name; }

const char* unit_of(Component component) { return row_of(component).unit; }

Component component_named(const std::string& name, int dimension) {
  std::vector<std::string> known;
  for (const auto& one : rows) {
    if (name == one.name) return one.component;
    if (dimension == 0 || one.in(dimension)) known.emplace_back(one.name);
  }
  throw Error("component \"" + name + "\", expected one of " + joined(known), ErrorKind::usage);
}

std::string cf_unit(const std::string& unit) {
  const auto slash = unit.find('/');
  if (slash == std::string::npos) return unit;
  const auto above = unit.substr(0, slash), below = unit.substr(slash + 1);
  const bool squared = below.back() == '2';
  return (above == "1" ? "" : above + " ") +
         (squared ? below.substr(0, below.size() - 1) + "-2" : below + "-1");
}

std::vector<std::string> component_names(int dimension, int not_in, Listed listed) {
  std::vector<std::string> names;
  for (const auto& one : rows)
    if (one.in(dimension) && !(not_in > 0 && one.in(not_in)) && (listed == Listed::all || one.is_field()))
      names.emplace_back(one.name);
  return names;
}

}  // namespace slipwave
