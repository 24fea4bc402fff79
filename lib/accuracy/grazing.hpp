#pragma once

#include <algorithm>
#include <cmath>

namespace slipwave {

/// The part of the waves between two points that comes back from an absorbing edge in which they graze along,
/// as measured for P waves (docs/accuracy.md): `mean_m` from the edge on average.
inline double grazing_share(double along_m, double mean_m, double wavelength_m, double zone_m) {
  const double way = along_m / (5 * wavelength_m), width = zone_m / (0.5 * wavelength_m);
  return std::min(0.5, 0.13 * way * way * std::exp(-mean_m / (0.4 * wavelength_m)) / (width * width));
}

}  // namespace slipwave
