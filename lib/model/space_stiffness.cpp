// SPDX-License-Identifier: BSD-3-Clause
#include "model/space_stiffness.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace slipwave {
namespace {

constexpr double degree = std::numbers::pi / 180;
/// Directions of half a sphere among which the largest turning is searched.
constexpr int rings = 16, around = 64;

/// The sum of C_ijkl n_j n_l.
std::array<SpaceVector, 3> christoffel(const SpaceStiffness& c, const SpaceVector& n) {
  std::array<SpaceVector, 3> matrix{};
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k <= i; ++k) {
      double sum = 0;
      for (int j = 0; j < 3; ++j)
        for (int l = 0; l < 3; ++l) sum += c(i, j, k, l) * n[std::size_t(j)] * n[std::size_t(l)];
      matrix[std::size_t(i)][std::size_t(k)] = matrix[std::size_t(k)][std::size_t(i)] = sum;
    }
  return matrix;
}

/// By Jacobi's rotations.
SpaceWaves eigenvectors(std::array<SpaceVector, 3> a) {
  SpaceWaves waves;
  auto& motions = waves.motions;
  for (std::size_t i = 0; i < 3; ++i) motions[i][i] = 1;
  constexpr int sweeps = 8;  // they converge quadratically
  for (int sweep = 0; sweep < sweeps; ++sweep)
    for (const auto& [p, q] : {std::pair<std::size_t, std::size_t>{0, 1}, {0, 2}, {1, 2}}) {
      if (a[p][q] == 0) continue;
      const double angle = std::atan2(2 * a[p][q], a[p][p] - a[q][q]) / 2;
      const double c = std::cos(angle), s = std::sin(angle);
      const auto turn = [&](double& one, double& other) {
        const double before = one;
        one = c * before + s * other, other = c * other - s * before;
      };
      for (std::size_t i = 0; i < 3; ++i) turn(a[i][p], a[i][q]);
      for (std::size_t i = 0; i < 3; ++i) turn(a[p][i], a[q][i]), turn(motions[p][i], motions[q][i]);
      a[p][q] = a[q][p] = 0;
    }
  for (std::size_t i = 0; i < 3; ++i) waves.moduli[i] = a[i][i];
  for (const auto& [p, q] : {std::pair<std::size_t, std::size_t>{0, 1}, {1, 2}, {0, 1}})
    if (waves.moduli[p] < waves.moduli[q])
      std::swap(waves.moduli[p], waves.moduli[q]), std::swap(motions[p], motions[q]);
  return waves;
}

}  // namespace

RockAxes axes_of(const Material& material) {
  const auto cosine = [](double degrees) { return std::cos(degrees * degree); };
  const auto sine = [](double degrees) { return std::sin(degrees * degree); };
  const double ct = cosine(material.tilt), st = sine(material.tilt);
  const double ca = cosine(material.azimuth), sa = sine(material.azimuth);
  const double cr = cosine(material.rotation), sr = sine(material.rotation);
  const SpaceVector down_dip = {ca * ct, sa * ct, st}, strike = {-sa, ca, 0};
  RockAxes axes;
  for (std::size_t i = 0; i < 3; ++i) {
    axes[0][i] = cr * down_dip[i] + sr * strike[i];
    axes[1][i] = cr * strike[i] - sr * down_dip[i];
  }
  axes[2] = {-ca * st, -sa * st, ct};
  return axes;
}

OrthorhombicStiffness SpaceStiffness::along_grid() const {
  const auto& c = voigt;
  return {c[0][0], c[1][1], c[2][2], c[3][3], c[4][4], c[5][5], c[0][1], c[0][2], c[1][2]};
}

SpaceStiffness turned(const OrthorhombicStiffness& upright, const RockAxes& axes) {
  std::array<std::array<double, 6>, 6> own{}, bond{}, half{};
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) own[std::size_t(i)][std::size_t(j)] = upright.normal(i, j);
  own[3][3] = upright.c44, own[4][4] = upright.c55, own[5][5] = upright.c66;
  // Bond's matrix of stresses: sigma_ij = sum of a_ki a_lj sigma_kl.
  for (int i = 0; i < 3; ++i)
    for (int j = i; j < 3; ++j)
      for (int k = 0; k < 3; ++k)
        for (int l = k; l < 3; ++l) {
          const auto a = [&](int axis, int component) {
            return axes[std::size_t(axis)][std::size_t(component)];
          };
          double of = a(k, i) * a(l, j);
          if (k != l) of += a(l, i) * a(k, j);
          bond[SpaceStiffness::pair(i, j)][SpaceStiffness::pair(k, l)] = of;
        }
  SpaceStiffness stiffness;
  for (std::size_t i = 0; i < 6; ++i)
    for (std::size_t j = 0; j < 6; ++j)
      for (std::size_t k = 0; k < 6; ++k) half[i][j] += bond[i][k] * own[k][j];
  for (std::size_t i = 0; i < 6; ++i)
    for (std::size_t j = i; j < 6; ++j) {
      double sum = 0;
      for (std::size_t k = 0; k < 6; ++k) sum += half[i][k] * bond[j][k];
      stiffness.voigt[i][j] = stiffness.voigt[j][i] = sum;
    }
  return stiffness;
}

SpaceStiffness space_stiffness_of(const Material& material) {
  return turned(stiffness_in_space(material), axes_of(material));
}

SpaceWaves waves_along(const SpaceStiffness& stiffness, const SpaceVector& direction) {
  return eigenvectors(christoffel(stiffness, direction));
}

SpaceVector phase_speeds(const SpaceStiffness& stiffness, double rho, const SpaceVector& direction) {
  auto speeds = waves_along(stiffness, direction).moduli;
  for (auto& speed : speeds) speed = std::sqrt(std::max(speed, 0.) / rho);
  return speeds;
}

double fastest_along_grid(const Material& material) {
  const auto stiffness = space_stiffness_of(material);
  double fastest = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    SpaceVector along{};
    along[axis] = 1;
    fastest = std::max(fastest, phase_speeds(stiffness, material.rho, along)[0]);
  }
  return fastest;
}

double fastest_in_space(const Material& material) {
  const auto own = stiffness_in_space(material);
  if (!material.orthorhombic)
    return std::max(fastest_p_speed_at_most(material), std::sqrt(own.c66 / material.rho));
  // About its own axes rock is what it is about any, and alike in all octants.
  const auto stiffness = turned(own, {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}});
  constexpr int most_turns = 200;
  double largest = 0;
  for (int n = 1; n < 8; ++n) {
    SpaceVector direction = {double(n & 1), double((n >> 1) & 1), double((n >> 2) & 1)};
    const double size = std::hypot(direction[0], direction[1], direction[2]);
    for (auto& part : direction) part /= size;
    // C_ijkl n_i u_j n_k u_l is the same with n and u exchanged, so it never falls from turn to turn.
    double modulus = 0;
    for (int turn = 0; turn < most_turns; ++turn) {
      const auto waves = waves_along(stiffness, direction);
      const bool settled = waves.moduli[0] < modulus * (1 + 1e-10);
      modulus = std::max(modulus, waves.moduli[0]), direction = waves.motions[0];
      if (settled) break;
    }
    largest = std::max(largest, modulus);
  }
  return std::sqrt(largest / material.rho);
}

double largest_turning(const SpaceStiffness& c, int axis) {
  double most = 0;
  for (int ring = 0; ring <= rings; ++ring)
    for (int k = 0; k < (ring == 0 ? 1 : around); ++k) {
      const double angle = ring * std::numbers::pi / 2 / rings, about = k * 2 * std::numbers::pi / around;
      const SpaceVector n = {std::sin(angle) * std::cos(about), std::sin(angle) * std::sin(about),
                             std::cos(angle)};
      const auto waves = waves_along(c, n);
      for (std::size_t wave = 0; wave < 3; ++wave) {
        // The group velocity along the axis times the phase speed and the density.
        double group = 0;
        for (int i = 0; i < 3; ++i)
          for (int l = 0; l < 3; ++l)
            for (int j = 0; j < 3; ++j)
              group += waves.motions[wave][std::size_t(i)] * waves.motions[wave][std::size_t(l)] *
                       c(i, axis, l, j) * n[std::size_t(j)];
        most = std::max(most, -n[std::size_t(axis)] * group / waves.moduli[wave]);
      }
    }
  return most < 1e-9 ? 0 : most;
}

namespace {

/// Makes of a positive matrix Cholesky's factor L, and of x L^-1 x.
void factor(std::array<std::array<double, 6>, 6>& l, std::array<double, 6>& x) {
  for (std::size_t i = 0; i < 6; ++i) {
    for (std::size_t j = 0; j <= i; ++j) {
      for (std::size_t k = 0; k < j; ++k) l[i][j] -= l[i][k] * l[j][k];
      l[i][j] = j < i ? l[i][j] / l[j][j] : std::sqrt(l[i][i]);
      if (j < i) x[i] -= l[i][j] * x[j];
    }
    x[i] /= l[i][i];
  }
}

/// Voigt's pair of a component of SymmetricTensor<3>, and back.
std::size_t exchanged(std::size_t component) { return component < 3 ? component : 8 - component; }

}  // namespace

std::array<double, 6> stress_of_strain(const SpaceStiffness& stiffness, const std::array<double, 6>& strain) {
  std::array<double, 6> stress{};
  for (std::size_t i = 0; i < 6; ++i)
    for (std::size_t j = 0; j < 6; ++j) stress[exchanged(i)] += stiffness.voigt[i][j] * strain[exchanged(j)];
  return stress;
}

std::array<double, 6> strain_of_stress(const SpaceStiffness& stiffness, const std::array<double, 6>& stress) {
  auto l = stiffness.voigt;
  std::array<double, 6> x{}, strain{};
  for (std::size_t i = 0; i < 6; ++i) x[i] = stress[exchanged(i)];
  factor(l, x);
  for (std::size_t i = 6; i-- > 0;) {
    for (std::size_t k = i + 1; k < 6; ++k) x[i] -= l[k][i] * x[k];
    x[i] /= l[i][i];
    strain[exchanged(i)] = x[i];
  }
  return strain;
}

double complementary(const SpaceStiffness& stiffness, const std::array<double, 6>& stress) {
  auto l = stiffness.voigt;
  auto x = stress;
  factor(l, x);
  double sum = 0;
  for (const double part : x) sum += part * part;
  return sum;
}

}  // namespace slipwave
