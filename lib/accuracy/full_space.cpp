// SPDX-License-Identifier: BSD-3-Clause
#include "accuracy/full_space.hpp"

#include <cmath>
#include <numbers>

namespace slipwave {
namespace {

/// g = H0(2)(k r)/(4i), which solves lap g + k^2 g = -delta for exp(i w t), with its first three derivatives
/// along r: {g, g', g'', g'''}.
std::array<std::complex<double>, 4> green(double k, double r) {
  const std::complex<double> i(0, 1);
  const auto h0 = std::cyl_bessel_j(0, k * r) - i * std::cyl_neumann(0, k * r);
  const auto h1 = std::cyl_bessel_j(1, k * r) - i * std::cyl_neumann(1, k * r);
  const auto g = h0 / (4. * i), g1 = -k * h1 / (4. * i);
  const auto g2 = -k * k * g - g1 / r;
  return {g, g1, g2, -k * k * g1 - g2 / r + g1 / (r * r)};
}

}  // namespace

Motion explosion_motion(const UniformMedium& rock, double omega, double x, double z) {
  const double r = std::hypot(x, z), n[2] = {x / r, z / r};
  const auto g = green(omega / rock.vp, r);  // and its derivatives in r
  const std::complex<double> scale = -1 / (rock.rho * rock.vp * rock.vp);
  const auto strain = [&](int a, int b) {
    return scale * (g[2] * n[a] * n[b] + g[1] / r * ((a == b ? 1. : 0.) - n[a] * n[b]));
  };
  const auto trace = strain(0, 0) + strain(1, 1);
  const std::complex<double> rate(0, omega);
  return {scale * g[1] * n[0], scale * g[1] * n[1],
          (rock.lambda() * trace + 2 * rock.mu() * strain(0, 0)) / rate,
          (rock.lambda() * trace + 2 * rock.mu() * strain(1, 1)) / rate, 2 * rock.mu() * strain(0, 1) / rate};
}

Motion force_motion(const UniformMedium& rock, double omega, double x, double z, int along) {
  const double r = std::hypot(x, z), n[2] = {x / r, z / r}, ks = omega / rock.vs;
  const auto s = green(ks, r), p = green(omega / rock.vp, r);
  Motion motion{};
  for (int i = 0; i < 2; ++i) {
    const double same = i == along ? 1 : 0;
    const auto hessian = (s[2] - p[2]) * n[i] * n[along] + (s[1] - p[1]) / r * (same - n[i] * n[along]);
    motion[std::size_t(i)] = std::complex<double>(0, omega) * (s[0] * same + hessian / (ks * ks)) / rock.mu();
  }
  return motion;
}

std::array<std::vector<double>, 5> ricker_response(double peak_hz, double interval_s, std::int64_t count,
                                                   const std::function<Motion(double omega)>& motion_at) {
  constexpr double pi = std::numbers::pi, period_s = 4;
  std::array<std::vector<double>, 5> traces;
  for (auto& trace : traces) trace.assign(std::size_t(count), 0);
  for (int bin = 1; bin < 6 * peak_hz * period_s; ++bin) {
    const double hz = bin / period_s, omega = 2 * pi * hz;
    const double size =
        2 / std::sqrt(pi) * hz * hz / std::pow(peak_hz, 3) * std::exp(-std::pow(hz / peak_hz, 2));
    const auto spectrum = size * std::polar(1., -omega * 1.5 / peak_hz);
    const Motion motion = motion_at(omega);
    const auto turn = std::polar(1., omega * interval_s);
    std::complex<double> phase = 2 / period_s * spectrum;
    for (std::size_t n = 0; n < std::size_t(count); ++n, phase *= turn)
      for (std::size_t row = 0; row < 5; ++row) traces[row][n] += (motion[row] * phase).real();
  }
  return traces;
}

}  // namespace slipwave
