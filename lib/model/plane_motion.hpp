// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <complex>

#include "model/anisotropy.hpp"
#include "model/averaging.hpp"

namespace slipwave {

// Plane waves in rock that may be anisotropic, with motion in the plane of x and z (theory.md (A17)).

/// A wave of one direction of its front: phase speed, m/s, and the direction of its motion, a unit vector. P
/// moves forward, SV towards +x where it travels down.
struct PlaneMotion {
  double speed = 0, x = 0, z = 0;
};
/// The front moves along the unit vector (across, down). Of an isotropic rock along it, or across it.
PlaneMotion plane_motion(const Material& rock, double across, double down, bool shear);
PlaneMotion plane_motion(const Elasticity<2>& c, double rho, double across, double down, bool shear);

/// The slowness across layers of a wave of a speed that is alike in all directions: down it decays, or
/// travels down.
std::complex<double> slowness_across(double speed, double along);

/// A wave of one slowness along x, that and down in s/m: it decays or carries energy the way it goes; motion
/// is of unit size.
struct LayerWave {
  std::complex<double> down;
  std::complex<double> x, z;
};
/// Both waves that go down, or up, in solid rock; of the smaller slowness first.
std::array<LayerWave, 2> layer_waves(const Material& rock, double along, bool down);

/// The stresses sxx, szz, sxz, per unit of velocity, that a wave of a slowness brings with it. Pa s/m.
template <class Number>
std::array<Number, 3> stress_of_motion(const Material& rock, double along, Number down, Number vx, Number vz);

}  // namespace slipwave
