// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>

namespace slipwave {

/// The part of the P waves between two points that comes back from an absorbing edge along which they graze,
/// as measured (docs/accuracy.md): `mean_m` from the edge on average. Beside the edge, what a wave sends into
/// the zone on its way comes back, however short the way.
inline double grazing_share(double along_m, double mean_m, double wavelength_m, double zone_m) {
  const double way = along_m / wavelength_m, away = mean_m / wavelength_m, zone = zone_m / wavelength_m;
  const double beside =
      0.115 * way / (way + 0.15) * std::exp(-away / 0.16) / (1 + std::pow(zone / 0.22, 2.6));
  const double along =
      0.46 * std::pow(way / 5, 2) * std::exp(-away / 0.4) / (1 + std::pow(zone / 0.34, 2.45));
  return std::min(0.5, beside + along);
}

/// The same of S waves of a force, `wavelength_m` still being that of P waves, for which zones are made.
inline double grazing_share_of_force(double along_m, double mean_m, double wavelength_m, double zone_m) {
  const double way = along_m / wavelength_m, away = mean_m / wavelength_m, zone = zone_m / wavelength_m;
  return 1 - std::exp(-0.39 * way * std::exp(-away / 0.2) / (1 + std::pow(zone / 0.2, 2.8)));
}

}  // namespace slipwave
