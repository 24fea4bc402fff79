// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <complex>
#include <vector>

#include "model/elasticity.hpp"

namespace slipwave {

// Plane waves in space in rock that may be anisotropic (theory.md (A18)).

/// A wave of one direction of its front: phase speed, m/s, and the direction of its motion, a unit vector.
struct SpaceMotion {
  double speed = 0;
  Point<3> motion{};
};
/// The front moves along a unit vector, in the vertical plane whose horizontal direction is `along`. P moves
/// forward; S is the one of both S waves that moves more in that plane, towards `along` where it travels
/// down.
SpaceMotion space_motion(const Material& rock, const Point<3>& direction, const std::array<double, 2>& along,
                         bool shear);

/// A wave of one slowness along x and y, that and down in s/m: it decays or carries energy the way it goes.
/// Motion is of unit size.
struct SpaceLayerWave {
  std::complex<double> down;
  std::array<std::complex<double>, 3> motion;
};
/// All waves that go down, or up: three in rock, one in fluid.
std::vector<SpaceLayerWave> layer_waves(const Material& rock, const std::array<double, 2>& along, bool down);

/// The stresses by Voigt's pairs, per unit of velocity, that a wave of a slowness brings with it. Pa s/m.
template <class Number>
std::array<Number, 6> stress_of_motion(const Elasticity<3>& stiffness, const std::array<Number, 3>& slowness,
                                       const std::array<Number, 3>& velocity);

}  // namespace slipwave
