// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "cube_shot.hpp"
#include "gauss_rule.hpp"
#include "model/anisotropy.hpp"

namespace slipwave::solver {

/// Point forces in a homogeneous anisotropic space by the sum over plane waves in all directions (Wang and
/// Achenbach 1994): with delta(x) = -1/(8 pi^2) times the integral of delta''(n.x) over the unit sphere, each
/// plane is a problem in one dimension. Nothing is shared with the solver: the Christoffel matrix is summed
/// from C_ijkl and turned by Jacobi's rotations.
class AnisotropicSpace {
 public:
  using Matrix = std::array<std::array<double, 3>, 3>;
  /// Stiffness by Voigt's indices, Pa.
  AnisotropicSpace(const std::array<std::array<double, 6>, 6>& stiffness, double rho)
      : c_(stiffness), rho_(rho) {}
  /// About axes that are turned as those of a rock.
  AnisotropicSpace(const std::array<std::array<double, 6>, 6>& upright, const Material& angles)
      : c_(upright), rho_(angles.rho) {
    turn(angles);
  }
  explicit AnisotropicSpace(const Material& material) : rho_(material.rho) {
    c_ = upright_elasticity<3>(material).voigt;
    turn(material);
  }
  double stiffness(std::size_t one, std::size_t other) const { return c_[one][other]; }

  /// Velocity [component][sample] at an offset from a force along `axis` that grows and falls as the wavelet.
  std::array<std::vector<double>, 3> velocity(const Point<3>& at, int axis, const RickerForm& wavelet,
                                              double interval_s, std::size_t count) const {
    const double distance = std::hypot(at[0], at[1], at[2]);
    std::array<std::vector<double>, 3> found;
    for (auto& samples : found) samples.assign(count, 0);
    // Angles from the direction of the receiver and about it.
    constexpr int rings = 90, around = 48;
    const auto frame = frame_along(at, distance);
    // The wave is smooth in the cosine, from 0 to 1.
    const auto rule = gauss_rule(rings);
    for (int ring = -1; ring < rings; ++ring) {
      // The plane across that direction, ring -1, holds what follows the force at once.
      const auto [cosine, weight] = ring < 0 ? std::array{0., 1.} : rule[std::size_t(ring)];
      const double sine = std::sqrt(1 - cosine * cosine);
      for (int n = 0; n < around; ++n) {
        const double angle = 2 * std::numbers::pi * n / around;
        Point<3> direction;
        for (std::size_t i = 0; i < 3; ++i)
          direction[i] =
              cosine * frame[0][i] + sine * (std::cos(angle) * frame[1][i] + std::sin(angle) * frame[2][i]);
        const auto [inertia, motion] = waves(direction);
        for (std::size_t wave = 0; wave < 3; ++wave) {
          const double speed = std::sqrt(inertia[wave] / rho_), part = motion[std::size_t(axis)][wave];
          const double share = 2 * std::numbers::pi / around * part;
          for (std::size_t k = 0; k < count; ++k) {
            const double t = double(k) * interval_s;
            const double size =
                ring < 0
                    ? wavelet.slope(t) / (8 * std::numbers::pi * std::numbers::pi * inertia[wave] * distance)
                    : -weight * wavelet.bend(t - distance * cosine / speed) /
                          (8 * std::numbers::pi * std::numbers::pi * inertia[wave] * speed);
            for (std::size_t i = 0; i < 3; ++i) found[i][k] += share * size * motion[i][wave];
          }
        }
      }
    }
    return found;
  }

  /// Moduli rho c^2 of the waves of a direction, and their motions in columns.
  std::pair<std::array<double, 3>, Matrix> waves(const Point<3>& n) const {
    Matrix a{}, turned = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t k = 0; k < 3; ++k)
        for (std::size_t j = 0; j < 3; ++j)
          for (std::size_t l = 0; l < 3; ++l) a[i][k] += c_[voigt(i, j)][voigt(k, l)] * n[j] * n[l];
    for (int sweep = 0; sweep < 12; ++sweep)
      for (const auto& [p, q] : {std::pair<std::size_t, std::size_t>{0, 1}, {0, 2}, {1, 2}}) {
        const double angle = std::atan2(2 * a[p][q], a[p][p] - a[q][q]) / 2, c = std::cos(angle),
                     s = std::sin(angle);
        for (std::size_t i = 0; i < 3; ++i) {
          const double one = a[i][p], other = a[i][q];
          a[i][p] = c * one + s * other, a[i][q] = c * other - s * one;
          const double of_p = turned[i][p], of_q = turned[i][q];
          turned[i][p] = c * of_p + s * of_q, turned[i][q] = c * of_q - s * of_p;
        }
        for (std::size_t i = 0; i < 3; ++i) {
          const double one = a[p][i], other = a[q][i];
          a[p][i] = c * one + s * other, a[q][i] = c * other - s * one;
        }
      }
    return {{a[0][0], a[1][1], a[2][2]}, turned};
  }

 private:
  /// Turns all four indices, one after another: about the third axis by the rotation, then about the second
  /// by the tilt, then about the third by the azimuth.
  void turn(const Material& material) {
    constexpr double degree = std::numbers::pi / 180;
    about(2, material.rotation * degree);
    about(1, -material.tilt * degree);
    about(2, material.azimuth * degree);
  }
  void about(std::size_t axis, double angle) {
    Matrix r{};
    const std::size_t one = (axis + 1) % 3, two = (axis + 2) % 3;
    r[axis][axis] = 1, r[one][one] = r[two][two] = std::cos(angle);
    r[two][one] = std::sin(angle), r[one][two] = -r[two][one];
    const auto before = c_;
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = i; j < 3; ++j)
        for (std::size_t k = 0; k < 3; ++k)
          for (std::size_t l = k; l < 3; ++l) {
            double sum = 0;
            for (std::size_t n = 0; n < 81; ++n) {
              const std::size_t a = n / 27, b = n / 9 % 3, c = n / 3 % 3, d = n % 3;
              sum += r[i][a] * r[j][b] * r[k][c] * r[l][d] * before[voigt(a, b)][voigt(c, d)];
            }
            c_[voigt(i, j)][voigt(k, l)] = sum;
          }
  }
  static std::size_t voigt(std::size_t i, std::size_t j) { return i == j ? i : 6 - i - j; }
  static Matrix frame_along(const Point<3>& at, double distance) {
    Matrix frame{};
    for (std::size_t i = 0; i < 3; ++i) frame[0][i] = at[i] / distance;
    // The axis that is most across it, made so wholly.
    std::size_t least = 0;
    for (std::size_t i = 1; i < 3; ++i)
      if (std::abs(frame[0][i]) < std::abs(frame[0][least])) least = i;
    frame[1][least] = 1;
    const double along = frame[0][least], length = std::sqrt(1 - along * along);
    for (std::size_t i = 0; i < 3; ++i) frame[1][i] = (frame[1][i] - along * frame[0][i]) / length;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
      frame[2][i] = frame[0][j] * frame[1][k] - frame[0][k] * frame[1][j];
    }
    return frame;
  }

  std::array<std::array<double, 6>, 6> c_{};
  double rho_;
};

}  // namespace slipwave::solver
