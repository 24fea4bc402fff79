// SPDX-License-Identifier: BSD-3-Clause
#include "rock/relations.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include "base/error.hpp"
#include "base/instantiate.hpp"
#include "base/parse.hpp"
#include "rock/anisotropy.hpp"

namespace slipwave {
namespace {

/// qs of vs in m/s, and the ratio of qp to it.
struct QualityRule {
  std::function<double(double)> qs;
  double ratio;
};

QualityRule quality_rule(const std::string& rule) {
  if (rule == "olsen") return {[](double vs) { return (vs < 1500 ? 0.02 : 0.1) * vs; }, 1.5};
  if (rule == "brocher")
    return {[](double vs) {
              const double v = vs / 1000;
              return vs < 300 ? 13 : -16 + v * (104.13 + v * (-25.225 + v * 8.2184));
            },
            2};
  if (rule.rfind("vs/", 0) == 0) {
    const double divisor = parse_number(rule.substr(3));
    if (divisor > 0) return {[divisor](double vs) { return vs / divisor; }, 2};
  }
  throw Error("found '" + rule + "', expected vs/N with N above 0, olsen or brocher", ErrorKind::usage);
}

}  // namespace

template <int D>
Field<D> vs_by_castagna(const Field<D>& vp, double fluid_vp) {
  Field<D> vs(vp.grid());
  for (std::size_t cell = 0; cell < vp.size(); ++cell) {
    const double speed = double(vp[cell]);
    // NaN passes on, so that check() names the cell.
    vs[cell] = speed <= fluid_vp ? 0 : float(std::fmax((speed - 1360) / 1.16, 0));
    if (std::isnan(speed)) vs[cell] = vp[cell];
  }
  return vs;
}

template <int D>
Field<D> rho_by_gardner(const Field<D>& vp, const Field<D>& vs) {
  Field<D> rho(vp.grid());
  for (std::size_t cell = 0; cell < vp.size(); ++cell) {
    if (vp[cell] == 0) {
      rho[cell] = 0;
    } else if (vs[cell] == 0) {
      rho[cell] = water_density;
    } else {
      rho[cell] = float(310 * std::pow(double(vp[cell]), 0.25));
    }
  }
  return rho;
}

template <int D>
void add_q_from_vs(Medium<D>& medium, const std::string& rule) {
  constexpr double least = 5;
  const auto of = quality_rule(rule);
  for (const auto property : {Property::qp, Property::qs})
    medium[property] = Field<D>(medium.grid(), float(PropertyRow::infinite));
  for (std::size_t cell = 0; cell < medium.vp.size(); ++cell) {
    if (!medium.is_solid(cell)) continue;
    const double vp = medium.vp[cell], vs = medium.vs[cell], qs = std::max(least, of.qs(vs));
    medium[Property::qs][cell] = float(qs);
    medium[Property::qp][cell] = float(std::min(of.ratio, 0.75 * vp * vp / (vs * vs)) * qs);
  }
}

template <int D>
void add_constant(Medium<D>& medium, Property property, double value) {
  const auto& row = row_of(property);
  medium[property] = Field<D>(medium.grid(), float(value));
  const bool of_solids = property == Property::qs || (row.if_absent && row.mean == Mean::elastic);
  for (std::size_t cell = 0; of_solids && cell < medium.vp.size(); ++cell)
    if (!medium.is_solid(cell)) medium[property][cell] = float(row.if_absent.value());
  complete_anisotropy(medium);
}

SLIPWAVE_INSTANTIATE_D(FUNCTION, add_q_from_vs);
SLIPWAVE_INSTANTIATE_D(FUNCTION, add_constant);
SLIPWAVE_INSTANTIATE_D(FUNCTION, vs_by_castagna);
SLIPWAVE_INSTANTIATE_D(FUNCTION, rho_by_gardner);

}  // namespace slipwave
