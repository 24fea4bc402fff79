// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

#include "lab.hpp"

namespace slipwave::solver {

/// The Ricker wavelet (W1), delayed by 1.5/F, at complex times too: there it is the same entire function.
struct EntireRicker {
  double peak_hz;
  double delay_s() const { return 1.5 / peak_hz; }
  double rate() const { return std::pow(std::numbers::pi * peak_hz, 2); }
  template <class Time>
  Time value(Time t) const {
    const Time s = t - delay_s(), x = rate() * s * s;
    return (1. - 2. * x) * std::exp(-x);
  }
  template <class Time>
  Time slope(Time t) const {
    const Time s = t - delay_s(), x = rate() * s * s;
    return rate() * s * (4. * x - 6.) * std::exp(-x);
  }
};

/// vx and vz (down) of one receiver at t = n interval.
using SurfaceMotion = std::array<std::vector<double>, 2>;

/// Vertical slowness sqrt(1/c^2 - p^2) for p in the first quadrant, decaying with depth.
inline std::complex<double> vertical_slowness(double c, std::complex<double> p) {
  return std::sqrt(1 / (c * c) - p * p);
}

/// Rayleigh's function: zero at the slowness of the surface wave.
inline std::complex<double> rayleigh(const Rock& rock, std::complex<double> p) {
  const auto g = 1 / (rock.vs * rock.vs) - 2. * p * p;
  return g * g + 4. * p * p * vertical_slowness(rock.vp, p) * vertical_slowness(rock.vs, p);
}

/// Speed of the surface wave: the root of Rayleigh's function, by bisection.
inline double rayleigh_speed(const Rock& rock) {
  double low = 0.3 * rock.vs, high = rock.vs * (1 - 1e-12);
  for (int n = 0; n < 100; ++n) {
    const double c = (low + high) / 2, s = c / rock.vs, p = c / rock.vp;
    (std::pow(2 - s * s, 2) < 4 * std::sqrt((1 - p * p) * (1 - s * s)) ? low : high) = c;
  }
  return low;
}

/// Garvin (1956): velocity of the surface at the horizontal distance x from a line explosion at `depth`, per
/// unit of a moment rate that is the wavelet. Cagniard's path of the P wave, t = p x + a depth, taken as t =
/// R/vp cosh(theta): the root at its beginning is gone and the trapezoidal rule converges exponentially.
inline SurfaceMotion garvin(const Rock& rock, double x, double depth, const EntireRicker& wavelet,
                            double interval_s, std::int64_t count) {
  const std::complex<double> i(0, 1);
  const double r = std::hypot(x, depth), first_s = r / rock.vp;
  const double last_s = std::max(double(count) * interval_s, 1.1 * first_s);
  const double theta_max = std::acosh(last_s / first_s);
  // The surface wave passes as a peak of width depth/r.
  const int points = 2000 + int(4 * theta_max * r / depth);
  const double step = theta_max / points,
               scale = 1 / (std::numbers::pi * rock.rho * std::pow(rock.vp * rock.vs, 2));
  SurfaceMotion motion;
  for (auto& trace : motion) trace.assign(std::size_t(count), 0);
  for (int n = 0; n <= points; ++n) {
    const double theta = n * step, t_front = first_s * std::cosh(theta);
    const auto p = (std::abs(x) * std::cosh(theta) + i * depth * std::sinh(theta)) / (r * rock.vp);
    const auto a = (depth * std::cosh(theta) - i * std::abs(x) * std::sinh(theta)) / (r * rock.vp);
    const auto b = vertical_slowness(rock.vs, p), g = 1 / (rock.vs * rock.vs) - 2. * p * p;
    const auto ia = i * a / (g * g + 4. * p * p * a * b);
    const double weight = scale * step * (n == 0 ? 0.5 : 1);
    const double kx = std::copysign(2 * weight, x) * (ia * p * b).imag(), kz = -weight * (ia * g).imag();
    // The wavelet counts for no longer than twice its delay.
    const auto from = std::int64_t(std::ceil(t_front / interval_s));
    const auto to = std::int64_t((t_front + 2 * wavelet.delay_s()) / interval_s);
    for (auto sample = from; sample < std::min(to + 1, count); ++sample) {
      const double slope = wavelet.slope(double(sample) * interval_s - t_front);
      motion[0][std::size_t(sample)] += kx * slope;
      motion[1][std::size_t(sample)] += kz * slope;
    }
  }
  return motion;
}

/// Lamb (1904): velocity of the surface at the distance x from a vertical line force on it (down), per unit
/// of a force that is the wavelet: u_z = Im int F(t - p x) a/D dp/(pi mu vs^2) and u_x = Im int F(t - p x) p
/// (g - 2 a b)/D dp/(pi mu). The wavelet being entire, the path leaves the real axis, its branch points and
/// Rayleigh's pole, and the integrand is smooth.
inline SurfaceMotion lamb(const Rock& rock, double x, const EntireRicker& wavelet, double interval_s,
                          std::int64_t count) {
  constexpr double pi = std::numbers::pi;
  const double far = std::abs(x), mu = rock.mu();
  const double p_max =
      std::max((double(count) * interval_s + 3 / wavelet.peak_hz) / far, 1.5 / rayleigh_speed(rock));
  const double height = 0.25 / wavelet.peak_hz / far, ramp_end = 0.9 / rock.vp;
  const int points = 12000;
  const double step = p_max / points;
  SurfaceMotion motion;
  for (auto& trace : motion) trace.assign(std::size_t(count), 0);
  for (int n = 0; n <= points; ++n) {
    const double s = n * step, rise = 0.5 * pi * std::min(s / ramp_end, 1.);
    const std::complex<double> p(s, height * std::pow(std::sin(rise), 4));
    const double tilt =
        s < ramp_end ? height * 4 * std::pow(std::sin(rise), 3) * std::cos(rise) * 0.5 * pi / ramp_end : 0;
    const auto dp = std::complex<double>(1, tilt) * step * (n == 0 || n == points ? 0.5 : 1);
    const auto a = vertical_slowness(rock.vp, p), b = vertical_slowness(rock.vs, p);
    const auto g = 1 / (rock.vs * rock.vs) - 2. * p * p, d = rayleigh(rock, p);
    const auto kz = a / d * dp / (pi * mu * rock.vs * rock.vs);
    const auto kx = std::copysign(1, x) * p * (g - 2. * a * b) / d * dp / (pi * mu);
    const auto near = [&](double t) { return std::int64_t(std::floor((s * far + t) / interval_s)); };
    const auto last = std::min(near(3.5 / wavelet.peak_hz), count - 1);
    for (auto sample = std::max<std::int64_t>(near(-0.5 / wavelet.peak_hz), 0); sample <= last; ++sample) {
      const auto slope = wavelet.slope(double(sample) * interval_s - p * far);
      motion[0][std::size_t(sample)] += (slope * kx).imag();
      motion[1][std::size_t(sample)] += (slope * kz).imag();
    }
  }
  return motion;
}

}  // namespace slipwave::solver
