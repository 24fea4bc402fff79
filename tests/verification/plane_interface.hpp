// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>
#include <complex>
#include <numbers>
#include <utility>
#include <vector>

#include "lab.hpp"

namespace slipwave::solver {

/// Two half-spaces with their interface at b = 0, a line explosion at a = 0, `distance_m` above in `over`,
/// and its transmitted and reflected waves, by wave number: a runs along the interface, b across it, into
/// `under`. Each plane wave is scattered by the exact coefficients, found from the continuity of motion and
/// traction.
struct PlaneInterface {
  Rock over, under;  // either may be fluid
  double distance_m;

  /// The potentials of the outgoing waves, P and S above, P and S below, per incoming P potential.
  using Coefficients = std::array<std::complex<double>, 4>;
  Coefficients coefficients(std::complex<double> omega, double k) const {
    // A wave exp(-i k a + m b): P with potential f, v = grad f; S with g, v = (-g_b, g_a). Rows: v_a, v_b and
    // the rates of the tractions ab and bb, of one rock.
    const std::complex<double> i(0, 1);
    const auto rows = [&](const Rock& rock, bool p, double side) {
      const double c = p ? rock.vp : rock.vs, mu = rock.mu();
      const auto m = side * decay(c, omega, k);
      using Rows = std::array<std::complex<double>, 4>;
      if (p)
        return Rows{-i * k, m, -2. * mu * i * k * m,
                    -rock.lambda() * omega * omega / (c * c) + 2. * mu * m * m};
      return Rows{-m, -i * k, -mu * (k * k + m * m), -2. * mu * i * k * m};
    };
    std::array<std::array<std::complex<double>, 5>, 4> a{};
    const double scale = over.rho * over.vp * over.vp;  // of the tractions, for the pivots
    const auto put_column = [&](std::size_t column, const std::array<std::complex<double>, 4>& rows_of,
                                double sign) {
      for (std::size_t row = 0; row < 4; ++row)
        a[row][column] = sign * rows_of[row] / (row < 2 ? 1 : scale / over.vp);
    };
    put_column(4, rows(over, true, -1), -1);  // the incident wave, on the right-hand side
    put_column(0, rows(over, true, 1), 1);
    put_column(2, rows(under, true, -1), -1);
    if (over.vs > 0) put_column(1, rows(over, false, 1), 1);
    if (under.vs > 0) put_column(3, rows(under, false, -1), -1);
    // Fluid slides, and its S wave, which does not exist, is left out.
    const bool slides = over.vs == 0 || under.vs == 0;
    if (slides) {
      a[0] = {};
      if (over.vs == 0 && under.vs == 0) a[2] = {}, a[2][3] = 1;
      a[0][over.vs == 0 ? 1 : 3] = 1;
    }
    return solved(a);
  }

  /// Velocities along a and b per unit moment rate at (a, b), of all but the direct wave, as a sum over wave
  /// numbers: sources repeat every `period_m`.
  std::array<std::complex<double>, 2> scattered(std::complex<double> omega, double a, double b,
                                                double period_m) const {
    const std::complex<double> i(0, 1);
    const double dk = 2 * std::numbers::pi / period_m;
    const double largest = std::abs(omega) / over.vp + 25 / (distance_m + std::abs(b));
    std::array<std::complex<double>, 2> sum{};
    for (int n = -int(largest / dk); n <= int(largest / dk); ++n) {
      const double k = n * dk;
      const auto c = coefficients(omega, k);
      const bool up = b < 0;
      const Rock& rock = up ? over : under;
      const auto m = (up ? 1. : -1.) * decay(rock.vp, omega, k);
      const auto nu = decay(over.vp, omega, k);
      // The line explosion: f = -1/(rho vp^2) exp(-i k a - nu |b + distance|)/(2 nu), summed over k dk/2 pi.
      const auto scale =
          -std::exp(-i * k * a - nu * distance_m) / (2. * nu) / period_m / (over.rho * over.vp * over.vp);
      const auto p = c[up ? 0 : 2] * scale * std::exp(m * b);
      sum[0] += -i * k * p;
      sum[1] += m * p;
      if (rock.vs == 0) continue;
      const auto l = (up ? 1. : -1.) * decay(rock.vs, omega, k);
      const auto s = c[up ? 1 : 3] * scale * std::exp(l * b);
      sum[0] -= l * s;
      sum[1] += -i * k * s;
    }
    return sum;
  }

  /// The scattered velocities at t = n interval of a Ricker wavelet (W1) that begins at 0. Frequencies lie
  /// below the real axis, so what comes from the repeated sources, or after `window`, has decayed to 1e-7.
  std::array<std::vector<double>, 2> scattered_ricker(double peak_hz, double interval_s, std::size_t count,
                                                      double a, double b) const {
    constexpr double pi = std::numbers::pi;
    const double window_s = 1.3 * double(count) * interval_s, damping = 16 / window_s;
    const double period_m = 1.5 * std::max(over.vp, under.vp) * window_s;
    std::array<std::vector<double>, 2> traces;
    for (auto& trace : traces) trace.assign(count, 0);
    for (int bin = 0; bin < 5 * peak_hz * window_s; ++bin) {
      const std::complex<double> omega(2 * pi * bin / window_s, -damping);
      const auto f = omega / (2 * pi * peak_hz);
      const auto spectrum = 2 / (std::sqrt(pi) * peak_hz) * f * f * std::exp(-f * f) *
                            std::exp(std::complex<double>(0, -1.5 / peak_hz) * omega);
      const auto motion = scattered(omega, a, b, period_m);
      for (std::size_t n = 0; n < count; ++n) {
        const auto phase = std::exp(std::complex<double>(0, double(n) * interval_s) * omega);
        for (std::size_t row = 0; row < 2; ++row)
          traces[row][n] += (bin == 0 ? 1 : 2) / window_s * (motion[row] * spectrum * phase).real();
      }
    }
    return traces;
  }

  /// Gauss with pivots; `a` holds the right-hand side behind the matrix.
  static Coefficients solved(std::array<std::array<std::complex<double>, 5>, 4> a) {
    for (std::size_t column = 0; column < 4; ++column) {
      std::size_t best = column;
      for (std::size_t row = column; row < 4; ++row)
        if (std::abs(a[row][column]) > std::abs(a[best][column])) best = row;
      std::swap(a[column], a[best]);
      for (std::size_t row = 0; row < 4; ++row) {
        if (row == column) continue;
        const auto factor = a[row][column] / a[column][column];
        for (std::size_t n = column; n < 5; ++n) a[row][n] -= factor * a[column][n];
      }
    }
    Coefficients x;
    for (std::size_t row = 0; row < 4; ++row) x[row] = a[row][4] / a[row][row];
    return x;
  }

 private:
  /// Decay of a wave of wave number k along the interface with the distance from it.
  static std::complex<double> decay(double c, std::complex<double> omega, double k) {
    return std::sqrt(k * k - omega * omega / (c * c));
  }
};

}  // namespace slipwave::solver
