// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <complex>

#include "anisotropic_cube.hpp"
#include "viscoelastic.hpp"

namespace slipwave::solver {

/// Quality factors of P and S waves along the axes of a rock.
struct Qualities {
  double p, s;
};

/// Orthorhombic rock that attenuates, as theory.md (Q11) has its moduli: c_aa as P waves along the axes,
/// shear moduli as S waves, and c_ab by what it is less than sqrt(c_aa c_bb). Turned index by index.
class AttenuatingSpace {
 public:
  using Voigt = std::array<std::array<Complex, 6>, 6>;
  /// Speeds hold at the reference frequency.
  AttenuatingSpace(const Material& rock, const Qualities& of, const Mechanisms& mechanisms,
                   double reference_hz)
      : rock_(rock),
        p_(standard_linear(mechanisms, of.p, reference_hz)),
        s_(standard_linear(mechanisms, of.s, reference_hz)) {}

  /// Pa.
  Voigt stiffness(double hz) const {
    const auto c = upright_elasticity<3>(rock_);
    const auto p = p_(hz), s = s_(hz);
    std::array<std::array<double, 6>, 6> real{}, imaginary{};
    const auto put = [&](std::size_t i, std::size_t j, const Complex& value) {
      real[i][j] = value.real(), imaginary[i][j] = value.imag();
    };
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j) {
        const double root = std::sqrt(c.voigt[i][i] * c.voigt[j][j]);
        put(i, j, root * p - (root - c.voigt[i][j]) * s);
      }
    put(3, 3, c(4, 4) * s), put(4, 4, c(5, 5) * s), put(5, 5, c(6, 6) * s);
    const AnisotropicSpace one(real, rock_), other(imaginary, rock_);
    Voigt turned;
    for (std::size_t i = 0; i < 6; ++i)
      for (std::size_t j = 0; j < 6; ++j) turned[i][j] = {one.stiffness(i, j), other.stiffness(i, j)};
    return turned;
  }

  /// Velocity [component][sample] at an offset from a force along `axis` that grows and falls as a Ricker
  /// wavelet: AnisotropicSpace::velocity() frequency by frequency, with complex moduli.
  std::array<std::vector<double>, 3> velocity(const Point<3>& at, int axis, double peak_hz, double interval_s,
                                              std::size_t count) const {
    constexpr double pi = std::numbers::pi;
    constexpr int steps_per_peak = 8, frequencies = 26, rings = 30, around = 24;
    const double distance = std::hypot(at[0], at[1], at[2]);
    const auto frame = frame_along(at, distance);
    const auto rule = gauss_rule(rings);
    std::array<std::vector<double>, 3> found;
    for (auto& samples : found) samples.assign(count, 0);
    for (int k = 1; k <= frequencies; ++k) {
      const double hz = k * peak_hz / steps_per_peak, omega = 2 * pi * hz, share = hz / peak_hz;
      const auto c = stiffness(hz);
      std::array<Complex, 3> motion{};
      for (int ring = -1; ring < rings; ++ring) {
        const auto [cosine, weight] = ring < 0 ? std::array{0., 1.} : rule[std::size_t(ring)];
        const double sine = std::sqrt(1 - cosine * cosine);
        for (int n = 0; n < around; ++n) {
          const double angle = 2 * pi * n / around;
          Point<3> direction;
          for (std::size_t i = 0; i < 3; ++i)
            direction[i] =
                cosine * frame[0][i] + sine * (std::cos(angle) * frame[1][i] + std::sin(angle) * frame[2][i]);
          const auto [moduli, motions] = waves(c, direction);
          for (std::size_t wave = 0; wave < 3; ++wave) {
            const auto& modulus = moduli[wave];
            const auto speed = std::sqrt(modulus / rock_.rho);
            const Complex i_omega(0, omega);
            const auto size = ring < 0 ? i_omega / (8 * pi * pi * modulus * distance)
                                       : -weight * i_omega * i_omega *
                                             std::exp(-i_omega * distance * cosine / speed) /
                                             (8 * pi * pi * modulus * speed);
            for (std::size_t i = 0; i < 3; ++i)
              motion[i] += 2 * pi / around * size * motions[i][wave] * motions[std::size_t(axis)][wave];
          }
        }
      }
      // Of the wavelet (W1), its delay included, over a period of so many of its own.
      const double wavelet = 2 / std::sqrt(pi) * share * share * std::exp(-share * share) / peak_hz;
      for (std::size_t n = 0; n < count; ++n) {
        const auto turn = std::polar(wavelet, omega * (double(n) * interval_s - 1.5 / peak_hz));
        for (std::size_t i = 0; i < 3; ++i)
          found[i][n] += 2 * peak_hz / steps_per_peak * (turn * motion[i]).real();
      }
    }
    return found;
  }

 private:
  using Matrix = std::array<std::array<Complex, 3>, 3>;
  /// As AnisotropicSpace::waves(): by rotations of complex angles.
  static std::pair<std::array<Complex, 3>, Matrix> waves(const Voigt& c, const Point<3>& n) {
    const auto voigt = [](std::size_t i, std::size_t j) { return i == j ? i : 6 - i - j; };
    Matrix a{}, turned{};
    for (std::size_t i = 0; i < 3; ++i) turned[i][i] = 1;
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t k = 0; k < 3; ++k)
        for (std::size_t j = 0; j < 3; ++j)
          for (std::size_t l = 0; l < 3; ++l) a[i][k] += c[voigt(i, j)][voigt(k, l)] * n[j] * n[l];
    const double size = std::abs(a[0][0] + a[1][1] + a[2][2]);
    for (int sweep = 0; sweep < 8; ++sweep)
      for (const auto& [p, q] : {std::pair<std::size_t, std::size_t>{0, 1}, {0, 2}, {1, 2}}) {
        if (std::abs(a[p][q]) < 1e-15 * size) continue;
        const auto apart = a[p][p] - a[q][q], twice = 2. * a[p][q];
        // Of both halves of the tangent the smaller one.
        const auto root = std::sqrt(apart * apart + twice * twice);
        const auto tangent = std::norm(apart + root) > std::norm(apart - root) ? twice / (apart + root)
                                                                               : twice / (apart - root);
        const auto cosine = 1. / std::sqrt(1. + tangent * tangent), sine = tangent * cosine;
        const auto turn = [&](Complex& one, Complex& other) {
          const auto before = one;
          one = cosine * before + sine * other, other = cosine * other - sine * before;
        };
        for (std::size_t i = 0; i < 3; ++i) turn(a[i][p], a[i][q]), turn(turned[i][p], turned[i][q]);
        for (std::size_t i = 0; i < 3; ++i) turn(a[p][i], a[q][i]);
      }
    return {{a[0][0], a[1][1], a[2][2]}, turned};
  }
  static std::array<Point<3>, 3> frame_along(const Point<3>& at, double distance) {
    std::array<Point<3>, 3> frame{};
    for (std::size_t i = 0; i < 3; ++i) frame[0][i] = at[i] / distance;
    const std::size_t least = std::abs(at[0]) < std::abs(at[1]) ? (std::abs(at[0]) < std::abs(at[2]) ? 0 : 2)
                                                                : (std::abs(at[1]) < std::abs(at[2]) ? 1 : 2);
    Point<3> other{};
    other[least] = 1;
    const auto cross = [](const Point<3>& a, const Point<3>& b) {
      return Point<3>{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
    };
    frame[1] = cross(frame[0], other);
    const double length = std::hypot(frame[1][0], frame[1][1], frame[1][2]);
    for (auto& part : frame[1]) part /= length;
    frame[2] = cross(frame[0], frame[1]);
    return frame;
  }

  Material rock_;
  ModulusOf p_, s_;
};

}  // namespace slipwave::solver
