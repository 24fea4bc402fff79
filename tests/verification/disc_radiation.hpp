// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

#include "accuracy/full_space.hpp"
#include "grid/grid.hpp"

/// What a compliant disc in a full space sends off under the waves of an explosion, as far as its own waves
/// do not act on it (Born): the radiation of the moment of its displacement jump. Time goes as exp(-i omega
/// t).
namespace slipwave::solver {

using Complex = std::complex<double>;
using Matrix = std::array<std::array<Complex, 3>, 3>;

/// g = exp(i k r)/r and the coefficients of its derivatives: g,i = d1 x_i; g,ij = d1 delta_ij + d2 x_i x_j;
/// g,ijl = d2 (delta_ij x_l + delta_il x_j + delta_jl x_i) + d3 x_i x_j x_l. Each is (1/r d/dr) of that
/// before.
struct Spherical {
  Complex d1, d2, d3;
  Spherical(double k, double r) {
    const Complex i(0, 1), wave = std::exp(i * k * r);
    const double kr = k * r, r2 = r * r;
    d1 = wave * (i * kr - 1.) / (r2 * r);
    d2 = wave * (3. - 3. * i * kr - kr * kr) / (r2 * r2 * r);
    d3 = wave * (-15. + 15. * i * kr + 6 * kr * kr - i * kr * kr * kr) / (r2 * r2 * r2 * r);
  }
};

/// Stress at x from an explosion of unit moment at the origin: u = grad phi, phi = -g/(4 pi (lambda + 2 mu)).
inline Matrix stress_of_explosion(const UniformMedium& rock, double omega, const Point<3>& x) {
  const double r = std::hypot(x[0], x[1], x[2]), k = omega / rock.vp, modulus = rock.rho * rock.vp * rock.vp;
  const Spherical g(k, r);
  const Complex value = std::polar(1 / r, k * r);
  Matrix stress{};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      stress[i][j] = -1 / (4 * std::numbers::pi * modulus) *
                     (i == j ? 2 * rock.mu() * (g.d1 + g.d2 * x[i] * x[j]) - rock.lambda() * k * k * value
                             : 2 * rock.mu() * g.d2 * x[i] * x[j]);
  return stress;
}

/// Displacement at x from a moment at the origin (Aki & Richards 2002, (3.23)): u_i = -M_jl G_ij,l.
inline std::array<Complex, 3> displacement_of_moment(const UniformMedium& rock, double omega, const Matrix& m,
                                                     const Point<3>& x) {
  const double r = std::hypot(x[0], x[1], x[2]), ks = omega / rock.vs;
  const Spherical s(ks, r), p(omega / rock.vp, r);
  const Complex d2 = (s.d2 - p.d2) / (ks * ks), d3 = (s.d3 - p.d3) / (ks * ks);
  Complex trace = 0, along = 0;
  std::array<Complex, 3> m_x{}, u{};
  for (std::size_t i = 0; i < 3; ++i) {
    trace += m[i][i];
    for (std::size_t j = 0; j < 3; ++j) m_x[i] += m[i][j] * x[j];
  }
  for (std::size_t i = 0; i < 3; ++i) along += m_x[i] * x[i];
  for (std::size_t i = 0; i < 3; ++i)
    u[i] =
        -(m_x[i] * (s.d1 + 2. * d2) + x[i] * (trace * d2 + along * d3)) / (4 * std::numbers::pi * rock.mu());
  return u;
}

struct CompliantDisc {
  Point<3> centre_m{}, normal{};
  double radius_m = 0, normal_m_per_pa = 0, tangential_m_per_pa = 0;
};

/// Displacement that it sends to some places, of an explosion of unit moment. Rings of points, `points` on a
/// radius.
inline std::vector<std::array<Complex, 3>> scattered_by(const CompliantDisc& disc, const UniformMedium& rock,
                                                        double omega, const Point<3>& source_m,
                                                        const std::vector<Point<3>>& receivers_m,
                                                        int points = 24) {
  const auto& n = disc.normal;
  // Directions in the disc.
  const std::size_t least = std::abs(n[0]) < 0.6 ? 0 : 1;
  Point<3> a{}, b{};
  a[least] = 1;
  const double off = n[least];
  double size = 0;
  for (std::size_t i = 0; i < 3; ++i) a[i] -= off * n[i], size = std::hypot(size, a[i]);
  for (double& part : a) part /= size;
  for (std::size_t i = 0; i < 3; ++i)
    b[i] = n[(i + 1) % 3] * a[(i + 2) % 3] - n[(i + 2) % 3] * a[(i + 1) % 3];
  std::vector<std::array<Complex, 3>> u(receivers_m.size());
  for (int ring = 0; ring < points; ++ring) {
    const double r = (ring + 0.5) / points * disc.radius_m;
    const int turns = 6 * ring + 3;
    const double area =
        std::numbers::pi * disc.radius_m * disc.radius_m * (2 * ring + 1) / (points * points) / turns;
    for (int turn = 0; turn < turns; ++turn) {
      const double angle = 2 * std::numbers::pi * turn / turns;
      Point<3> at{}, from_source{};
      for (std::size_t i = 0; i < 3; ++i) {
        at[i] = disc.centre_m[i] + r * (std::cos(angle) * a[i] + std::sin(angle) * b[i]);
        from_source[i] = at[i] - source_m[i];
      }
      const auto stress = stress_of_explosion(rock, omega, from_source);
      std::array<Complex, 3> traction{}, jump{};
      Complex across = 0, opening = 0;
      for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j) traction[i] += stress[i][j] * n[j];
      for (std::size_t i = 0; i < 3; ++i) across += traction[i] * n[i];
      for (std::size_t i = 0; i < 3; ++i)
        jump[i] =
            disc.normal_m_per_pa * across * n[i] + disc.tangential_m_per_pa * (traction[i] - across * n[i]);
      for (std::size_t i = 0; i < 3; ++i) opening += jump[i] * n[i];
      Matrix moment{};
      for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j)
          moment[i][j] = area * (rock.mu() * (jump[i] * n[j] + jump[j] * n[i]) +
                                 (i == j ? rock.lambda() * opening : 0.));
      for (std::size_t k = 0; k < receivers_m.size(); ++k) {
        Point<3> away{};
        for (std::size_t i = 0; i < 3; ++i) away[i] = receivers_m[k][i] - at[i];
        const auto part = displacement_of_moment(rock, omega, moment, away);
        for (std::size_t i = 0; i < 3; ++i) u[k][i] += part[i];
      }
    }
  }
  return u;
}

}  // namespace slipwave::solver
