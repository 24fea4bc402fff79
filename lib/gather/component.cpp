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
    {Component::other, "other", "", "", 1, false, false},
};
// clang-format on

constexpr bool in_order() {
  for (std::size_t n = 0; n < std::size(rows); ++n)
    if (rows[n].component != Component(n)) return false;
  return rows[std::size(rows) - 1].component == Component::other;
}
static_assert(in_order(), "a row for each Component, in their order");

std::string symbol_of(const WaveField& field) {
  const std::string axes = "xyz";
  const auto axis = axes.substr(std::size_t(field.axis), 1);
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
    std::erase_if(
        found, [](const ComponentTerm& term) { return term.field.axis == y || term.field.other_axis == y; });
  return found;
}

std::string ComponentRow::description(int dimension) const {
  if (term_count < 2) return long_name;
  const auto found = terms_in(dimension);
  const bool all_negative =
      std::all_of(found.begin(), found.end(), [](const ComponentTerm& term) { return term.sign < 0; });
  std::string sum;
  for (const auto& term : found) {
    const bool minus = term.sign < 0 && !all_negative;
    sum += (sum.empty() ? (minus ? "-" : "") : minus ? " - " : " + ") + symbol_of(term.field);
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
  const auto above = unit.substr(0, slash);
  return (above == "1" ? "" : above + " ") + unit.substr(slash + 1) + "-1";
}

std::vector<std::string> component_names(int dimension, int not_in) {
  std::vector<std::string> names;
  for (const auto& one : rows)
    if (one.in(dimension) && !(not_in > 0 && one.in(not_in))) names.emplace_back(one.name);
  return names;
}

}  // namespace slipwave
