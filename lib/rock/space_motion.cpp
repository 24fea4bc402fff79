// SPDX-License-Identifier: BSD-3-Clause
#include "rock/space_motion.hpp"

#include <algorithm>
#include <cmath>

#include "rock/plane_motion.hpp"
#include "rock/polynomial_roots.hpp"

namespace slipwave {
namespace {

using Complex = std::complex<double>;
using ComplexVector = std::array<Complex, 3>;

/// Numbers from the constant on.
using Quadratic = std::array<double, 3>;
using QuadraticMatrix = std::array<std::array<Quadratic, 3>, 3>;

/// The Christoffel matrix less the density, of slownesses along x and y, by powers of that down.
QuadraticMatrix inertia(const Elasticity<3>& c, double rho, const std::array<double, 2>& along) {
  QuadraticMatrix of{};
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k) {
      auto& powers = of[std::size_t(i)][std::size_t(k)];
      if (i == k) powers[0] = -rho;
      for (int a = 0; a < 2; ++a) {
        const double p = along[std::size_t(a)];
        for (int b = 0; b < 2; ++b) powers[0] += c(i, a, k, b) * p * along[std::size_t(b)];
        powers[1] += (c(i, a, k, 2) + c(i, 2, k, a)) * p;
      }
      powers[2] = c(i, 2, k, 2);
    }
  return of;
}

/// The determinant, of sixth degree.
std::array<double, 7> determinant(const QuadraticMatrix& of) {
  std::array<double, 7> sum{};
  const auto add = [&](const Quadratic& a, const Quadratic& b, const Quadratic& c, double sign) {
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j)
        for (std::size_t k = 0; k < 3; ++k) sum[i + j + k] += sign * a[i] * b[j] * c[k];
  };
  for (std::size_t n = 0; n < 3; ++n) {
    const auto next = (n + 1) % 3, last = (n + 2) % 3;
    add(of[0][n], of[1][next], of[2][last], 1);
    add(of[0][n], of[1][last], of[2][next], -1);
  }
  return sum;
}

/// What is at right angles to all rows of a matrix that has no inverse, of unit size: across the two rows
/// that point apart the most.
ComplexVector motion_of(const QuadraticMatrix& of, Complex down) {
  std::array<ComplexVector, 3> rows;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t k = 0; k < 3; ++k) rows[i][k] = of[i][k][0] + down * (of[i][k][1] + down * of[i][k][2]);
  ComplexVector motion{};
  double largest = 0;
  for (std::size_t n = 0; n < 3; ++n) {
    const auto &a = rows[n], &b = rows[(n + 1) % 3];
    const ComplexVector across = {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2],
                                  a[0] * b[1] - a[1] * b[0]};
    const double size = std::norm(across[0]) + std::norm(across[1]) + std::norm(across[2]);
    if (size > largest) largest = size, motion = across;
  }
  for (auto& part : motion) part /= std::sqrt(largest);
  return motion;
}

/// Returns the waves of a rock of any stiffness.
std::vector<LayerWave<3>> waves_of_any(const Material& rock, const std::array<double, 2>& along, bool down) {
  const auto stiffness = elasticity_of<3>(rock);
  const auto of = inertia(stiffness, rock.rho, along);
  const double size = std::sqrt(rock.rho / std::min({stiffness.voigt[3][3], stiffness.voigt[4][4]})) +
                      std::hypot(along[0], along[1]);
  std::vector<LayerWave<3>> all;
  for (const auto& root : roots_of(determinant(of), size)) all.push_back({root, motion_of(of, root)});
  // Three go down and three up; roots at grazing incidence fill the remaining places.
  std::stable_sort(all.begin(), all.end(), [&](const LayerWave<3>& one, const LayerWave<3>& other) {
    return goes_down<3>(stiffness, along, one) > goes_down<3>(stiffness, along, other);
  });
  return {all.begin() + (down ? 0 : 3), all.begin() + (down ? 3 : 6)};
}

/// Returns the waves of rock that is alike in all horizontal directions: in the plane of travel, and across
/// it.
std::vector<LayerWave<3>> waves_of_level_beds(const Material& rock, const std::array<double, 2>& along,
                                              bool down) {
  const double p = std::hypot(along[0], along[1]);
  const double x = p > 0 ? along[0] / p : 1, y = p > 0 ? along[1] / p : 0;
  std::vector<LayerWave<3>> all;
  for (const auto& wave : layer_waves(rock, p, down))
    all.push_back({wave.down, {x * wave.motion[0], y * wave.motion[0], wave.motion[1]}});
  if (rock.vs == 0) return all;
  // (rho - c66 p^2)/c55 is the square of the slowness down.
  const double stretch = std::sqrt(1 + 2 * rock.gamma);
  all.push_back({(down ? 1. : -1.) * slowness_across(rock.vs, p * stretch), {-y, x, 0}});
  return all;
}

}  // namespace

SpaceMotion space_motion(const Material& rock, const Point<3>& direction, const std::array<double, 2>& along,
                         bool shear) {
  const double level = direction[0] * along[0] + direction[1] * along[1];
  // Towards which P moves, and S waves of isotropic rock.
  const Point<3> usual =
      shear ? Point<3>{direction[2] * along[0], direction[2] * along[1], -level} : direction;
  if (!rock.is_anisotropic_in_3d()) return {shear ? rock.vs : rock.vp, usual};
  const auto waves = waves_along<3>(elasticity_of<3>(rock), direction);
  const auto share = [&](std::size_t wave) { return dot_product(waves.vectors[wave], usual); };
  const std::size_t wave = !shear ? 0 : std::abs(share(1)) >= std::abs(share(2)) ? 1 : 2;
  SpaceMotion found{std::sqrt(waves.values[wave] / rock.rho), waves.vectors[wave]};
  if (share(wave) < 0)
    for (auto& part : found.motion) part = -part;
  return found;
}

std::vector<LayerWave<3>> layer_waves(const Material& rock, const std::array<double, 2>& along, bool down) {
  const bool level = rock.tilt == 0 && !rock.orthorhombic && !rock.constants;
  return level ? waves_of_level_beds(rock, along, down) : waves_of_any(rock, along, down);
}

}  // namespace slipwave
