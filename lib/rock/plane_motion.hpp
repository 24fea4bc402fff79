// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <complex>
#include <vector>

#include "rock/anisotropy.hpp"
#include "rock/averaging.hpp"
#include "rock/elasticity.hpp"

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

/// A wave of one slowness along the layers, that and down in s/m: it decays or carries energy the way it
/// goes; motion is of unit size.
template <int D>
struct LayerWave {
  std::complex<double> down;
  std::array<std::complex<double>, std::size_t(D)> motion;
};
/// The waves that go down, or up, in the plane: two in rock, that of the smaller slowness first, one in
/// fluid.
std::vector<LayerWave<2>> layer_waves(const Material& rock, double along, bool down);

/// The stresses by Voigt's pairs, per unit of velocity, that a wave of a slowness brings with it. Pa s/m.
template <int D, class Number>
std::array<Number, Elasticity<D>::components> stress_of_motion(
    const Elasticity<D>& stiffness, const std::array<Number, std::size_t(D)>& slowness,
    const std::array<Number, std::size_t(D)>& velocity) {
  std::array<Number, Elasticity<D>::components> strain, stress{};
  for (int i = 0; i < D; ++i)
    for (int j = i; j < D; ++j) {
      const auto a = std::size_t(i), b = std::size_t(j);
      strain[Elasticity<D>::pair(i, j)] =
          i == j ? -(slowness[a] * velocity[a]) : -(slowness[a] * velocity[b] + slowness[b] * velocity[a]);
    }
  for (std::size_t i = 0; i < strain.size(); ++i)
    for (std::size_t j = 0; j < strain.size(); ++j) stress[i] += stiffness.voigt[i][j] * strain[j];
  return stress;
}

/// Whether a wave decays downwards, or carries energy down.
template <int D>
bool goes_down(const Elasticity<D>& stiffness, const std::array<double, std::size_t(D - 1)>& along,
               const LayerWave<D>& wave) {
  using Complex = std::complex<double>;
  if (wave.down.imag() != 0) return wave.down.imag() < 0;
  std::array<Complex, std::size_t(D)> slowness{};
  std::copy(along.begin(), along.end(), slowness.begin());
  slowness.back() = wave.down;
  const auto stress = stress_of_motion<D, Complex>(stiffness, slowness, wave.motion);
  Complex power = 0;
  for (int i = 0; i < D; ++i)
    power += std::conj(wave.motion[std::size_t(i)]) * stress[Elasticity<D>::pair(i, D - 1)];
  return power.real() < 0;
}

}  // namespace slipwave
