// SPDX-License-Identifier: BSD-3-Clause
#include "plot/derived_property.hpp"

#include <limits>

namespace slipwave::plot {
namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

double ratio(const ElasticCell& cell) { return cell.vs > 0 ? cell.vp / cell.vs : none; }

double poisson(const ElasticCell& cell) {
  const double p = cell.vp * cell.vp, s = cell.vs * cell.vs;
  return p > s ? (p - 2 * s) / (2 * (p - s)) : none;
}

constexpr DerivedProperty rows[] = {
    {"vp/vs", "vp/vs", "", true, true, false, ratio},
    {"poisson", "Poisson's ratio", "", true, true, false, poisson},
    {"impedance", "P impedance", "kg/(m\u00b2 s)", true, false, true,
     [](const ElasticCell& cell) { return cell.rho * cell.vp; }},
    {"shear-impedance", "S impedance", "kg/(m\u00b2 s)", false, true, true,
     [](const ElasticCell& cell) { return cell.rho * cell.vs; }},
};

}  // namespace

std::span<const DerivedProperty> derived_properties() { return rows; }

std::optional<DerivedProperty> find_derived_property(const std::string& name) {
  for (const auto& row : rows)
    if (name == row.name) return row;
  return std::nullopt;
}

}  // namespace slipwave::plot
