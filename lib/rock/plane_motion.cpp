// SPDX-License-Identifier: BSD-3-Clause
#include "rock/plane_motion.hpp"

#include <algorithm>
#include <cmath>

#include "rock/anisotropy.hpp"
#include "rock/polynomial_roots.hpp"

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
LayerWave<2> wave_of(const Elasticity<2>& c, double rho, double along, Complex down) {
  const Inertia<Complex> of(c, rho, along, down);
  // Either row gives the motion; one of them may say nothing.
  const bool first = std::norm(of.xx) > std::norm(of.zz);
  const Complex x = first ? -of.xz : of.zz, z = first ? of.xx : -of.xz;
  const double size = std::sqrt(std::norm(x) + std::norm(z));
  return {down, {x / size, z / size}};
}

/// In isotropic rock, or fluid.
std::vector<LayerWave<2>> isotropic_waves(const Material& rock, double along, bool down) {
  std::vector<LayerWave<2>> waves;
  for (const bool shear : {false, true}) {
    if (shear && rock.vs == 0) continue;
    const double speed = shear ? rock.vs : rock.vp;
    const auto q = (down ? 1. : -1.) * slowness_across(speed, along);
    // Along the slowness, or across it.
    const Complex x = shear ? q : Complex(along), z = shear ? Complex(-along) : q;
    const double size = std::sqrt(std::norm(x) + std::norm(z));
    waves.push_back({q, {x / size, z / size}});
  }
  return waves;
}

}  // namespace

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

std::vector<LayerWave<2>> layer_waves(const Material& rock, double along, bool down) {
  if (!rock.is_anisotropic()) return isotropic_waves(rock, along, down);
  const auto c = elasticity_of<2>(rock);
  std::vector<LayerWave<2>> all;
  for (const auto& root : slownesses(c, rock.rho, along)) all.push_back(wave_of(c, rock.rho, along, root));
  // Two go down and two up; roots at grazing incidence fill the remaining places.
  std::stable_sort(all.begin(), all.end(), [&](const LayerWave<2>& one, const LayerWave<2>& other) {
    return goes_down<2>(c, {along}, one) > goes_down<2>(c, {along}, other);
  });
  std::vector<LayerWave<2>> both(all.begin() + (down ? 0 : 2), all.begin() + (down ? 2 : 4));
  if (std::abs(both[0].down.real()) > std::abs(both[1].down.real())) std::swap(both[0], both[1]);
  return both;
}

}  // namespace slipwave
