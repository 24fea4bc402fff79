// SPDX-License-Identifier: BSD-3-Clause
#include "model/plane_motion.hpp"

#include <algorithm>
#include <cmath>

#include "model/anisotropy.hpp"
#include "model/polynomial_roots.hpp"

namespace slipwave {
namespace {

using Complex = std::complex<double>;

/// The Christoffel matrix less the density, of a slowness.
template <class Number>
struct Inertia {
  Number xx, zz, xz;
  Inertia(const Elasticity<2>& c, double rho, double along, Number down)
      : xx(c(1, 1) * along * along + 2 * c(1, 5) * along * down + c(5, 5) * down * down - rho),
        zz(c(5, 5) * along * along + 2 * c(3, 5) * along * down + c(3, 3) * down * down - rho),
        xz(c(1, 5) * along * along + (c(1, 3) + c(5, 5)) * along * down + c(3, 5) * down * down) {}
};

/// The four slownesses down of a slowness along x.
std::array<Complex, 4> slownesses(const Elasticity<2>& c, double rho, double along) {
  const std::array<double, 3> xx{c(1, 1) * along * along - rho, 2 * c(1, 5) * along, c(5, 5)},
      zz{c(5, 5) * along * along - rho, 2 * c(3, 5) * along, c(3, 3)},
      xz{c(1, 5) * along * along, (c(1, 3) + c(5, 5)) * along, c(3, 5)};
  std::array<double, 5> of{};
  for (std::size_t a = 0; a < 3; ++a)
    for (std::size_t b = 0; b < 3; ++b) of[a + b] += xx[a] * zz[b] - xz[a] * xz[b];
  const double size = std::sqrt(rho / c(5, 5)) + std::abs(along);
  return roots_of(of, size);
}

/// Motion that the equation of motion lets through, of unit size.
LayerWave wave_of(const Elasticity<2>& c, double rho, double along, Complex down) {
  const Inertia<Complex> of(c, rho, along, down);
  // Either row gives the motion; one of them may say nothing.
  const bool first = std::norm(of.xx) > std::norm(of.zz);
  const Complex x = first ? -of.xz : of.zz, z = first ? of.xx : -of.xz;
  const double size = std::sqrt(std::norm(x) + std::norm(z));
  return {down, x / size, z / size};
}

/// Whether it decays downwards or carries energy down.
bool goes_down(const Material& rock, double along, const LayerWave& wave) {
  if (wave.down.imag() != 0) return wave.down.imag() < 0;
  const auto stress = stress_of_motion(rock, along, wave.down, wave.x, wave.z);
  return (std::conj(wave.x) * stress[2] + std::conj(wave.z) * stress[1]).real() < 0;
}

}  // namespace

template <class Number>
std::array<Number, 3> stress_of_motion(const Material& rock, double along, Number down, Number vx,
                                       Number vz) {
  const auto c = elasticity_of<2>(rock);
  const Number xx = -along * vx, zz = -down * vz, xz = -(along * vz + down * vx);
  return {c(1, 1) * xx + c(1, 3) * zz + c(1, 5) * xz, c(1, 3) * xx + c(3, 3) * zz + c(3, 5) * xz,
          c(1, 5) * xx + c(3, 5) * zz + c(5, 5) * xz};
}

template std::array<double, 3> stress_of_motion(const Material&, double, double, double, double);
template std::array<Complex, 3> stress_of_motion(const Material&, double, Complex, Complex, Complex);

PlaneMotion plane_motion(const Material& rock, double across, double down, bool shear) {
  if (!rock.is_anisotropic())
    return shear ? PlaneMotion{rock.vs, down, -across} : PlaneMotion{rock.vp, across, down};
  return plane_motion(elasticity_of<2>(rock), rock.rho, across, down, shear);
}

PlaneMotion plane_motion(const Elasticity<2>& c, double rho, double across, double down, bool shear) {
  const auto waves = waves_along<2>(c, {across, down});
  const auto& [x, z] = waves.vectors[shear];
  PlaneMotion motion{std::sqrt(waves.values[shear] / rho), x, z};
  if (shear ? motion.x * down - motion.z * across < 0 : motion.x * across + motion.z * down < 0)
    motion.x = -motion.x, motion.z = -motion.z;
  return motion;
}

std::complex<double> slowness_across(double speed, double along) {
  const double square = 1 / (speed * speed) - along * along, least = 1e-7 / speed;
  // Where waves turn, up and down are one: kept apart by a hair.
  if (square >= 0) return std::max(std::sqrt(square), least);
  return {0, -std::max(std::sqrt(-square), least)};
}

std::array<LayerWave, 2> layer_waves(const Material& rock, double along, bool down) {
  const auto c = elasticity_of<2>(rock);
  std::array<LayerWave, 4> all;
  const auto roots = slownesses(c, rock.rho, along);
  std::transform(roots.begin(), roots.end(), all.begin(),
                 [&](const Complex& root) { return wave_of(c, rock.rho, along, root); });
  // Two go down and two up; those that lie along the layers are whichever are left.
  std::stable_sort(all.begin(), all.end(), [&](const LayerWave& one, const LayerWave& other) {
    return goes_down(rock, along, one) > goes_down(rock, along, other);
  });
  std::array<LayerWave, 2> both{all[down ? 0 : 2], all[down ? 1 : 3]};
  if (std::abs(both[0].down.real()) > std::abs(both[1].down.real())) std::swap(both[0], both[1]);
  return both;
}

}  // namespace slipwave
