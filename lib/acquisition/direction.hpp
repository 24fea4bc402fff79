// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <numbers>

namespace slipwave {

/// The sine of an angle in degrees; exact at multiples of 90 degrees, so that those lie along the grid.
inline double sine_of_degrees(double degrees) {
  const double turned = std::remainder(degrees, 360.);
  if (std::fmod(turned, 180.) == 0) return 0.;
  return turned == 90 ? 1. : turned == -90 ? -1. : std::sin(turned * std::numbers::pi / 180);
}
inline double cosine_of_degrees(double degrees) { return sine_of_degrees(degrees + 90); }

}  // namespace slipwave
