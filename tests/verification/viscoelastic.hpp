// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <complex>
#include <functional>
#include <numbers>

#include "accuracy/full_space.hpp"
#include "rock/attenuation.hpp"

namespace slipwave::solver {

using Complex = std::complex<double>;

/// A modulus over that of the reference frequency's phase speed, by frequency in Hz, which may be complex.
using ModulusOf = std::function<Complex(Complex hz)>;

/// The model of constant Q at all frequencies: M ~ (i f)^(2 g), g = atan(1/Q)/pi, with the phase speed c at
/// reference_hz (Kjartansson 1979, eqs. 21, 28): M/(rho c^2) = cos^2(pi g/2) (i f/f0)^(2 g).
inline ModulusOf constant_q(double q, double reference_hz) {
  if (std::isinf(q)) return [](Complex) { return Complex(1); };
  return [q, reference_hz](Complex hz) {
    const double gamma = std::atan(1 / q) / std::numbers::pi;
    const double cosine = std::cos(std::numbers::pi * gamma / 2);
    return cosine * cosine * std::pow(Complex(0, 1) * hz / reference_hz, 2 * gamma);
  };
}

/// The modulus of a generalised standard linear solid (theory.md (Q1)), brought to the phase speed.
inline ModulusOf standard_linear(const Mechanisms& mechanisms, double q, double reference_hz) {
  const auto shares = mechanisms.shares(q);
  const auto modulus = [mechanisms, shares](Complex hz) {
    Complex sum = 1;
    for (int l = 0; l < mechanisms.count(); ++l)
      sum -= shares[std::size_t(l)] / (1. + Complex(0, 2 * std::numbers::pi) * hz / mechanisms.rate(l));
    return sum;
  };
  const double slow = std::pow(modulus(reference_hz), -0.5).real();
  return [modulus, slow](Complex hz) { return slow * slow * modulus(hz); };
}

/// A rock at one frequency: complex speeds, m/s.
struct LossyRock {
  Complex vp, vs;
  double rho;
  LossyRock(const UniformMedium& rock, double omega, const ModulusOf& p, const ModulusOf& s)
      : vp(rock.vp * std::sqrt(p(omega / (2 * std::numbers::pi)))),
        vs(rock.vs * std::sqrt(s(omega / (2 * std::numbers::pi)))),
        rho(rock.rho) {}
  Complex mu() const { return rho * vs * vs; }
  Complex p_modulus() const { return rho * vp * vp; }
};

/// Modified Bessel functions K0 and K1 of a complex argument to 1e-12 where |w| > 0.3, by their integrals
/// (Abramowitz & Stegun 9.6.23 with t = 1 + s^2/w), which the trapezoidal rule takes to that.
inline std::array<Complex, 2> bessel_k(Complex w) {
  constexpr double step = 0.02;
  Complex k0 = step / 2, k1 = 0;
  for (double s = step; s < 6; s += step) {
    const auto root = std::sqrt(1. + s * s / (2. * w));
    k0 += step * std::exp(-s * s) / root;
    k1 += step * std::exp(-s * s) * s * s * root;
  }
  const auto front = std::sqrt(std::numbers::pi / (2. * w)) * std::exp(-w) * 2. / std::sqrt(std::numbers::pi);
  return {front * k0, 2. * front * k1};
}

/// A function of distance and its first two derivatives, which solves lap g + k^2 g = -delta: waves leave.
struct Outgoing {
  Complex g, slope, bend;
  /// Of a plane, a line or a point: 1, 2, 3 dimensions.
  Outgoing(int dimensions, Complex k, double r) {
    const Complex q = Complex(0, 1) * k;
    constexpr double pi = std::numbers::pi;
    if (dimensions == 1) {
      g = std::exp(-q * r) / (2. * q);
      slope = -q * g, bend = q * q * g;
    } else if (dimensions == 2) {
      const auto [k0, k1] = bessel_k(q * r);
      g = k0 / (2 * pi), slope = -q * k1 / (2 * pi), bend = q * q * (k0 + k1 / (q * r)) / (2 * pi);
    } else {
      g = std::exp(-q * r) / (4 * pi * r);
      slope = -(q + 1 / r) * g;
      bend = (q * q + 2. * q / r + 2 / (r * r)) * g;
    }
  }
};

/// Velocity at an offset in a full space, of an explosion of unit moment rate (FullSpace of accuracy).
template <int D>
std::array<Complex, D> lossy_explosion(const LossyRock& rock, double omega, const std::array<double, D>& at) {
  double r = 0;
  for (const double x : at) r += x * x;
  r = std::sqrt(r);
  const Outgoing p(D, omega / rock.vp, r);
  std::array<Complex, D> v;
  for (std::size_t i = 0; i < D; ++i) v[i] = -p.slope * (at[i] / r) / rock.p_modulus();
  return v;
}

/// The same of a unit force along an axis.
template <int D>
std::array<Complex, D> lossy_force(const LossyRock& rock, double omega, const std::array<double, D>& at,
                                   int along) {
  double r = 0;
  for (const double x : at) r += x * x;
  r = std::sqrt(r);
  const Complex ks = omega / rock.vs, i_omega(0, omega);
  const Outgoing p(D, omega / rock.vp, r), s(D, ks, r);
  std::array<Complex, D> v;
  for (std::size_t i = 0; i < D; ++i) {
    const double same = int(i) == along ? 1 : 0, both = at[i] * at[std::size_t(along)] / (r * r);
    const auto second = (s.bend - p.bend) * both + (s.slope - p.slope) / r * (same - both);
    v[i] = i_omega * (s.g * same + second / (ks * ks)) / rock.mu();
  }
  return v;
}

}  // namespace slipwave::solver
