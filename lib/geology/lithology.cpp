// SPDX-License-Identifier: BSD-3-Clause
#include "geology/lithology.hpp"

#include <algorithm>
#include <cmath>

namespace slipwave {
namespace {

constexpr double grain_modulus_pa = 36.6e9, grain_rho = 2650;  // quartz

/// Kf/(phi (K0 - Kf)).
double fluid_term(const Fluid& fluid, double porosity) {
  return fluid.bulk_modulus_pa / (porosity * (grain_modulus_pa - fluid.bulk_modulus_pa));
}

}  // namespace

double vs_of(Lithology rock, double vp) {
  double vs = vp / std::sqrt(3.0);
  if (rock == Lithology::shale) vs = 0.8621 * vp - 1172.4;
  if (rock == Lithology::sand) vs = 0.80416 * vp - 855.9;
  if (rock == Lithology::limestone) vs = (1.0168 - 0.05508e-3 * vp) * vp - 1030.5;
  return std::max(vs, vp / 5);
}

double density_of(Lithology rock, double vp) {
  const double vp_km_s = vp / 1000;
  switch (rock) {
    case Lithology::shale:
      return 1750 * std::pow(vp_km_s, 0.265);
    case Lithology::sand:
      return 1660 * std::pow(vp_km_s, 0.261);
    case Lithology::limestone:
      return 1359 * std::pow(vp_km_s, 0.386);
    case Lithology::evaporite:
      break;
  }
  return 2140;
}

Material brine_saturated(Lithology rock, double vp) { return {vp, vs_of(rock, vp), density_of(rock, vp)}; }

Material with_fluid(const Material& sand, const Fluid& fluid) {
  const double porosity = std::clamp((grain_rho - sand.rho) / (grain_rho - brine.rho), 0.02, 0.4);
  const double mu = sand.rho * sand.vs * sand.vs;
  const double before = sand.rho * sand.vp * sand.vp - 4. / 3 * mu;
  // K/(K0 - K) of the dry frame; that of loose sand, 0.9 mu, where the lines above would make it softer.
  const double loose = 0.9 * mu;
  const double frame = std::max(before / (grain_modulus_pa - before) - fluid_term(brine, porosity),
                                loose / (grain_modulus_pa - loose));
  const double ratio = frame + fluid_term(fluid, porosity);
  const double after = grain_modulus_pa * ratio / (1 + ratio);
  const double rho = sand.rho + porosity * (fluid.rho - brine.rho);
  return {std::sqrt((after + 4. / 3 * mu) / rho), std::sqrt(mu / rho), rho};
}

}  // namespace slipwave
