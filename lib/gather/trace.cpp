#include "gather/trace.hpp"

#include <cmath>
#include <iterator>

#include "base/error.hpp"

namespace slipwave {
namespace {

struct ComponentRow {
  Component component;
  const char* name;
  const char* unit;
};

constexpr ComponentRow components[] = {
    {Component::vx, "vx", "m/s"},  {Component::vy, "vy", "m/s"},    {Component::vz, "vz", "m/s"},
    {Component::p, "p", "Pa"},     {Component::sxx, "sxx", "Pa"},   {Component::syy, "syy", "Pa"},
    {Component::szz, "szz", "Pa"}, {Component::sxy, "sxy", "Pa"},   {Component::sxz, "sxz", "Pa"},
    {Component::syz, "syz", "Pa"}, {Component::other, "other", ""},
};

const ComponentRow& row_of(Component component) {
  for (const ComponentRow& row : components)
    if (row.component == component) return row;
  return *(std::end(components) - 1);
}

}  // namespace

const char* name_of(Component component) { return row_of(component).name; }

const char* unit_of(Component component) { return row_of(component).unit; }

Component component_named(const std::string& name) {
  std::string known;
  for (const ComponentRow& row : components) {
    if (name == row.name) return row.component;
    known += (known.empty() ? "" : ", ") + std::string(row.name);
  }
  throw Error("component \"" + name + "\", expected one of " + known, ErrorKind::usage);
}

void check_finite(std::span<const double> samples) {
  for (std::size_t n = 0; n < samples.size(); ++n)
    if (!std::isfinite(samples[n]))
      throw Error("sample " + std::to_string(n + 1) + ": " + shown(samples[n]) +
                  ", expected a finite number");
}

}  // namespace slipwave
