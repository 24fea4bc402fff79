// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

#include "lab.hpp"
#include "plane_interface.hpp"

namespace slipwave::solver {

/// A solid disc in a solid and a line explosion outside it, by angular orders: potentials of P (f cos m a)
/// and S (g sin m a) waves, with a the angle from the source, outside of it Hankel and inside Bessel
/// functions, and motion and traction continuous at its edge.
struct ElasticDisc {
  using Complex = std::complex<double>;
  Rock around, inside;
  double radius_m, source_m;  // of the source from the centre

  /// Velocities along the radius and across it of a Ricker wavelet that peaks at 1.5/F, at t = n interval,
  /// for receivers at a radius and an angle from the source; of all that the disc adds outside, and of all
  /// inside. Of frequencies at equal steps: the motion repeats, so it must have ended after twice the window.
  std::vector<std::array<std::vector<double>, 2>> ricker(double peak_hz, double interval_s, std::size_t count,
                                                         const std::vector<Point<2>>& polar) const {
    constexpr double pi = std::numbers::pi;
    const double period_s = 2 * double(count) * interval_s;
    std::vector<std::array<std::vector<double>, 2>> traces(polar.size());
    for (auto& of : traces)
      for (auto& trace : of) trace.assign(count, 0);
    for (int bin = 1; bin < 3.5 * peak_hz * period_s; ++bin) {
      const double omega = 2 * pi * bin / period_s, f = bin / (period_s * peak_hz);
      const auto wavelet = 2 / (std::sqrt(pi) * peak_hz) * f * f * std::exp(-f * f) *
                           std::exp(Complex(0, -1.5 / peak_hz * omega));
      const auto motion = motions(omega, polar);
      for (std::size_t r = 0; r < polar.size(); ++r)
        for (std::size_t row = 0; row < 2; ++row)
          for (std::size_t n = 0; n < count; ++n)
            traces[r][row][n] +=
                2 / period_s *
                (wavelet * motion[r][row] * std::exp(Complex(0, omega * double(n) * interval_s))).real();
    }
    return traces;
  }

 private:
  /// A cylinder function of k r and its first two derivatives by r.
  struct Radial {
    Complex f, d, dd;
  };
  static Complex cylinder(int m, double x, bool outgoing) {
    const double j = std::cyl_bessel_j(double(m), x);
    return outgoing ? Complex(j, -std::cyl_neumann(double(m), x)) : Complex(j, 0);
  }
  static Radial radial(int m, double k, double r, bool outgoing) {
    const double x = k * r;
    const auto f = cylinder(m, x, outgoing);
    const auto d = k * (double(m) / x * f - cylinder(m + 1, x, outgoing));
    return {f, d, -d / r - (k * k - m * m / (r * r)) * f};
  }
  /// Motion along and across the radius, and the tractions rr and ra over it, of P and of S.
  using Rows = std::array<Complex, 4>;
  static Rows of_p(const Rock& rock, double omega, int m, double r, const Radial& at) {
    const double k = omega / rock.vp;
    return {at.d, -m / r * at.f, -rock.lambda() * k * k * at.f + 2 * rock.mu() * at.dd,
            -2 * rock.mu() * m * (at.d / r - at.f / (r * r))};
  }
  static Rows of_s(const Rock& rock, int m, double r, const Radial& at) {
    const double over = m / (r * r);
    return {m / r * at.f, -at.d, 2 * rock.mu() * (m / r * at.d - over * at.f),
            rock.mu() * (-m * over * at.f - at.dd + at.d / r)};
  }

  std::vector<std::array<Complex, 2>> motions(double omega, const std::vector<Point<2>>& polar) const {
    std::vector<std::array<Complex, 2>> motion(polar.size());
    const double p = omega / around.vp, s = omega / around.vs, p_in = omega / inside.vp,
                 s_in = omega / inside.vs;
    const Complex amplitude = Complex(0, 0.25) / (around.rho * around.vp * around.vp);
    const int last = int(std::max(s, s_in) * radius_m) + 12;
    const double scale = around.lambda() * s;
    for (int m = 0; m <= last; ++m) {
      const auto incident = (m ? 2. : 1.) * amplitude * cylinder(m, p * source_m, true);
      const double a = radius_m;
      const std::array columns = {
          of_p(around, omega, m, a, radial(m, p, a, true)), of_s(around, m, a, radial(m, s, a, true)),
          of_p(inside, omega, m, a, radial(m, p_in, a, false)), of_s(inside, m, a, radial(m, s_in, a, false)),
          of_p(around, omega, m, a, radial(m, p, a, false))};
      std::array<std::array<Complex, 5>, 4> system{};
      std::array<double, 4> size{};
      for (std::size_t column = 0; column < 4; ++column) {
        for (std::size_t row = 0; row < 4; ++row) {
          system[row][column] = (column < 2 ? 1. : -1.) * columns[column][row] / (row < 2 ? 1 : scale);
          size[column] = std::max(size[column], std::abs(system[row][column]));
        }
        for (std::size_t row = 0; row < 4; ++row) system[row][column] /= size[column];
      }
      for (std::size_t row = 0; row < 4; ++row)
        system[row][4] = -incident * columns[4][row] / (row < 2 ? 1 : scale);
      const auto waves = PlaneInterface::solved(system);
      for (std::size_t n = 0; n < polar.size(); ++n) {
        const auto [r, angle] = polar[n];
        const bool out = r > radius_m;
        const auto rock = out ? around : inside;
        const auto from_p = of_p(rock, omega, m, r, radial(m, out ? p : p_in, r, out));
        const auto from_s = of_s(rock, m, r, radial(m, out ? s : s_in, r, out));
        const auto of = out ? 0U : 2U;
        const auto c_p = waves[of] / size[of], c_s = waves[of + 1] / size[of + 1];
        motion[n][0] += (c_p * from_p[0] + c_s * from_s[0]) * std::cos(m * angle);
        motion[n][1] += (c_p * from_p[1] + c_s * from_s[1]) * std::sin(m * angle);
      }
    }
    return motion;
  }
};

}  // namespace slipwave::solver
