// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

#include "anisotropic_rocks.hpp"
#include "gauss_rule.hpp"
#include "viscoelastic.hpp"

namespace slipwave::solver {

/// Point forces in a homogeneous anisotropic space by the sum over plane waves in all directions (Wang and
/// Achenbach 1994): with delta(x) = -1/(8 pi^2) times the integral of delta''(n.x) over the unit sphere, each
/// plane is a problem in one dimension. Nothing is shared with the solver: the Christoffel matrix is summed
/// from C_ijkl, turned index by index, and its waves are found by rotations.
class AnisotropicSpace {
 public:
  template <class Scalar>
  using Voigt = std::array<std::array<Scalar, 6>, 6>;
  template <class Scalar>
  using Matrix = std::array<std::array<Scalar, 3>, 3>;
  explicit AnisotropicSpace(const Material& rock)
      : rock_(rock), c_(turned(upright_elasticity<3>(rock).voigt)) {}
  double stiffness(std::size_t one, std::size_t other) const { return c_[one][other]; }

  /// Velocity [component][sample] at an offset from a force along `axis` that grows and falls as the wavelet.
  std::array<std::vector<double>, 3> velocity(const Point<3>& at, int axis, const RickerForm& wavelet,
                                              double interval_s, std::size_t count) const {
    std::array<std::vector<double>, 3> found;
    for (auto& samples : found) samples.assign(count, 0);
    each_direction(at, 90, 48, [&](const Point<3>& direction, double way_m, double weight) {
      const auto [inertia, motion] = waves(c_, direction);
      for (std::size_t wave = 0; wave < 3; ++wave) {
        const double speed = std::sqrt(inertia[wave] / rock_.rho),
                     share = motion[std::size_t(axis)][wave] * weight / inertia[wave];
        for (std::size_t k = 0; k < count; ++k) {
          const double t = double(k) * interval_s,
                       size =
                           share * (way_m == 0 ? wavelet.slope(t) : -wavelet.bend(t - way_m / speed) / speed);
          for (std::size_t i = 0; i < 3; ++i) found[i][k] += size * motion[i][wave];
        }
      }
    });
    return found;
  }

  /// Moduli rho c^2 of the waves of a direction, and their motions in columns.
  template <class Scalar>
  static std::pair<std::array<Scalar, 3>, Matrix<Scalar>> waves(const Voigt<Scalar>& c, const Point<3>& n) {
    Matrix<Scalar> a{}, turned{};
    for (std::size_t i = 0; i < 3; ++i) turned[i][i] = 1;
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t k = 0; k < 3; ++k)
        for (std::size_t j = 0; j < 3; ++j)
          for (std::size_t l = 0; l < 3; ++l) a[i][k] += c[voigt(i, j)][voigt(k, l)] * (n[j] * n[l]);
    const double size = std::abs(a[0][0] + a[1][1] + a[2][2]);
    for (int sweep = 0; sweep < 8; ++sweep)
      for (const auto& [p, q] : {std::pair<std::size_t, std::size_t>{0, 1}, {0, 2}, {1, 2}}) {
        if (std::abs(a[p][q]) < 1e-15 * size) continue;
        const Scalar apart = a[p][p] - a[q][q], twice = 2. * a[p][q];
        // Of both halves of the tangent the smaller one.
        const Scalar root = std::sqrt(apart * apart + twice * twice);
        const Scalar tangent =
            twice / (std::norm(apart + root) > std::norm(apart - root) ? apart + root : apart - root);
        const Scalar cosine = 1. / std::sqrt(1. + tangent * tangent), sine = tangent * cosine;
        const auto turn = [&](Scalar& one, Scalar& other) {
          const auto before = one;
          one = cosine * before + sine * other, other = cosine * other - sine * before;
        };
        for (std::size_t i = 0; i < 3; ++i) turn(a[i][p], a[i][q]), turn(turned[i][p], turned[i][q]);
        for (std::size_t i = 0; i < 3; ++i) turn(a[p][i], a[q][i]);
      }
    return {{a[0][0], a[1][1], a[2][2]}, turned};
  }

 protected:
  /// what(direction, way along it, weight) of directions that make up the sum, the way and then the weight of
  /// the plane across the offset, which holds what follows the force at once, being 0 and of another kind.
  template <class What>
  static void each_direction(const Point<3>& at, int rings, int around, const What& what) {
    constexpr double pi = std::numbers::pi;
    const double distance = std::hypot(at[0], at[1], at[2]);
    const auto frame = frame_along(at, distance);
    // The wave is smooth in the cosine, from 0 to 1.
    const auto rule = gauss_rule(rings);
    for (int ring = -1; ring < rings; ++ring) {
      const auto [cosine, weight] = ring < 0 ? std::array{0., 1 / distance} : rule[std::size_t(ring)];
      const double sine = std::sqrt(1 - cosine * cosine);
      for (int n = 0; n < around; ++n) {
        const double angle = 2 * pi * n / around;
        Point<3> direction;
        for (std::size_t i = 0; i < 3; ++i)
          direction[i] =
              cosine * frame[0][i] + sine * (std::cos(angle) * frame[1][i] + std::sin(angle) * frame[2][i]);
        what(direction, distance * cosine, weight / (4 * pi * around));
      }
    }
  }
  /// Turns all four indices, one after another: about the third axis by the rotation, then about the second
  /// by the tilt, then about the third by the azimuth.
  Voigt<double> turned(const Voigt<double>& c) const {
    constexpr double degree = std::numbers::pi / 180;
    return about(2, rock_.azimuth * degree,
                 about(1, -rock_.tilt * degree, about(2, rock_.rotation * degree, c)));
  }
  Material rock_;

 private:
  static Voigt<double> about(std::size_t axis, double angle, const Voigt<double>& before) {
    Matrix<double> r{};
    const std::size_t one = (axis + 1) % 3, two = (axis + 2) % 3;
    r[axis][axis] = 1, r[one][one] = r[two][two] = std::cos(angle);
    r[two][one] = std::sin(angle), r[one][two] = -r[two][one];
    Voigt<double> turned{};
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = i; j < 3; ++j)
        for (std::size_t k = 0; k < 3; ++k)
          for (std::size_t l = k; l < 3; ++l)
            for (std::size_t n = 0; n < 81; ++n) {
              const std::size_t a = n / 27, b = n / 9 % 3, c = n / 3 % 3, d = n % 3;
              turned[voigt(i, j)][voigt(k, l)] +=
                  r[i][a] * r[j][b] * r[k][c] * r[l][d] * before[voigt(a, b)][voigt(c, d)];
            }
    return turned;
  }
  static std::size_t voigt(std::size_t i, std::size_t j) { return i == j ? i : 6 - i - j; }
  static Matrix<double> frame_along(const Point<3>& at, double distance) {
    Matrix<double> frame{};
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

  Voigt<double> c_;
};

/// Orthorhombic rock that attenuates, as theory.md (Q11) has its moduli: c_aa as P waves along the axes,
/// shear moduli as S waves, and c_ab by what it is less than sqrt(c_aa c_bb).
class AttenuatingSpace : AnisotropicSpace {
 public:
  using Moduli = Voigt<Complex>;
  /// Speeds hold at the reference frequency.
  AttenuatingSpace(const Material& rock, const Qualities& of, const Mechanisms& mechanisms,
                   double reference_hz)
      : AnisotropicSpace(rock),
        p_(standard_linear(mechanisms, of.p, reference_hz)),
        s_(standard_linear(mechanisms, of.s, reference_hz)) {}

  /// Pa.
  Moduli stiffness(double hz) const {
    const auto c = upright_elasticity<3>(rock_).voigt;
    const auto p = p_(hz), s = s_(hz);
    Voigt<double> real{}, imaginary{};
    for (std::size_t i = 0; i < 6; ++i)
      for (std::size_t j = 0; j < 6; ++j) {
        const double root = std::sqrt(c[i][i] * c[j][j]);
        const auto value = i < 3 && j < 3 ? root * p - (root - c[i][j]) * s : c[i][j] * s;
        real[i][j] = value.real(), imaginary[i][j] = value.imag();
      }
    const auto one = turned(real), other = turned(imaginary);
    Moduli all;
    for (std::size_t i = 0; i < 6; ++i)
      for (std::size_t j = 0; j < 6; ++j) all[i][j] = {one[i][j], other[i][j]};
    return all;
  }

  /// As that of the elastic space, frequency by frequency, of a Ricker wavelet.
  std::array<std::vector<double>, 3> velocity(const Point<3>& at, int axis, const RickerForm& ricker,
                                              double interval_s, std::size_t count) const {
    constexpr double pi = std::numbers::pi;
    constexpr int steps_per_peak = 8, frequencies = 26;
    std::array<std::vector<double>, 3> found;
    for (auto& samples : found) samples.assign(count, 0);
    for (int k = 1; k <= frequencies; ++k) {
      const double hz = k * ricker.peak_hz / steps_per_peak, share = hz / ricker.peak_hz;
      const Complex i_omega(0, 2 * pi * hz);
      const auto c = stiffness(hz);
      std::array<Complex, 3> motion{};
      each_direction(at, 30, 24, [&](const Point<3>& direction, double way_m, double weight) {
        const auto [moduli, motions] = waves(c, direction);
        for (std::size_t wave = 0; wave < 3; ++wave) {
          const auto speed = std::sqrt(moduli[wave] / rock_.rho),
                     size = way_m == 0 ? i_omega
                                       : -i_omega * i_omega * std::exp(-i_omega * way_m / speed) / speed;
          for (std::size_t i = 0; i < 3; ++i)
            motion[i] += weight / moduli[wave] * size * motions[i][wave] * motions[std::size_t(axis)][wave];
        }
      });
      // Of the wavelet (W1), its delay included, over a period of so many of its own.
      const double wavelet = 2 / std::sqrt(pi) * share * share * std::exp(-share * share) / ricker.peak_hz;
      for (std::size_t n = 0; n < count; ++n) {
        const auto turn =
            std::polar(wavelet, i_omega.imag() * (double(n) * interval_s - 1.5 / ricker.peak_hz));
        for (std::size_t i = 0; i < 3; ++i)
          found[i][n] += 2 * ricker.peak_hz / steps_per_peak * (turn * motion[i]).real();
      }
    }
    return found;
  }

 private:
  ModulusOf p_, s_;
};

}  // namespace slipwave::solver
