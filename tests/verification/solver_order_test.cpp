// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <complex>
#include <numbers>

#include "accuracy/dispersion.hpp"
#include "lab.hpp"

namespace slipwave::solver::solver_order_test {
namespace {

constexpr double pi = std::numbers::pi;
constexpr Rock rock{4500, 2250, 2500};

/// A wave of one kind along one axis: rows of its pair, speed and passive stresses' share.
struct Kind {
  int axis;
  Wave wave;
  Lab<double>::Row v, s;
  double speed() const { return wave == wave_p ? rock.vp : rock.vs; }
};
using L = Lab<double>;
constexpr Kind kinds[] = {{0, wave_p, L::vx, L::sxx},
                          {0, wave_s, L::vz, L::sxz},
                          {1, wave_p, L::vz, L::szz},
                          {1, wave_s, L::vx, L::sxz}};

/// A line of n cells along the axis, two lines wide, between planes of symmetry.
L line(const Kind& kind, std::int64_t n, double h, int order, double courant) {
  const auto medium = kind.axis == 0 ? uniform_medium(n, 2, h, rock) : uniform_medium(2, n, h, rock);
  return L(medium, edges_all(EdgeLaw::mirror), order, courant * h / kind.speed());
}
double& cell(L& lab, const Kind& kind, L::Row row, std::int64_t n) {
  return kind.axis == 0 ? lab(row, n, 1) : lab(row, 1, n);
}

/// Relative error of a Gaussian pulse exp(-(x/w)^2) of 100 m after 400 m of way; h divides 10 m.
double error_of_a_pulse(const Kind& kind, int order, double h, bool backwards) {
  const double width = 100, from = backwards ? 1200 : 800, way = backwards ? -400 : 400, courant = 0.8;
  const auto n = std::int64_t(2000 / h);  // its tails at the ends are below rounding
  L lab = line(kind, n, h, order, courant);
  const double z = rock.rho * kind.speed();
  // Averages over cells are what the fields hold.
  const auto average = [&](std::int64_t i, double centre) {
    const double low = (double(i) * h - centre) / width, high = (double(i + 1) * h - centre) / width;
    return std::sqrt(pi) / 2 * (std::erf(high) - std::erf(low)) * width / h;
  };
  for (std::int64_t i = 0; i < n; ++i) {
    cell(lab, kind, kind.v, i) = average(i, from);
    cell(lab, kind, kind.s, i) = (backwards ? z : -z) * average(i, from);
  }
  const auto steps = std::int64_t(std::llround(std::abs(way) / (courant * h)));
  for (std::int64_t step = 0; step < steps; ++step) lab.sweep(kind.axis, 1);
  std::vector<double> found, exact;
  for (std::int64_t i = 0; i < n; ++i) {
    found.push_back(cell(lab, kind, kind.v, i));
    exact.push_back(average(i, from + way));
  }
  return relative_error(found, exact);
}

// Proves (E4), (E5), (E5a), (E6), (E7).
TEST(Reconstruction, ConvergesWithItsOrderAlongEitherAxisForPAndS) {
  // 0.2: what the next term of the error takes off while the pulse is 10 to 20 cells wide.
  for (const int order : orders) {
    const double h = order > 7 ? 10 : order == 7 ? 5 : 2.5;
    for (const auto& kind : kinds)
      for (const bool backwards : {false, true}) {
        const double coarse = error_of_a_pulse(kind, order, h, backwards);
        const double fine = error_of_a_pulse(kind, order, h / 2, backwards);
        EXPECT_GE(observed_order(coarse, fine), order - 0.2)
            << "order " << order << " axis " << kind.axis << (kind.wave == wave_p ? " P " : " S ") << coarse
            << ' ' << fine;
      }
  }
}

// Proves (E5a).
TEST(Reconstruction, MovesAWaveAWholeCellAtCourantNumberOne) {
  // a = 1: F_up[u] = u_i whatever the order, so the wave moves by a cell per sweep, to rounding.
  for (const int order : orders)
    for (const auto& kind : kinds) {
      const std::int64_t n = 40;
      L lab = line(kind, n, 5, order, 1);
      const double z = rock.rho * kind.speed();
      const auto value = [](std::int64_t i) { return i > 8 && i < 20 ? double((i * 7) % 11) - 5 : 0.; };
      for (std::int64_t i = 0; i < n; ++i) {
        cell(lab, kind, kind.v, i) = value(i);
        cell(lab, kind, kind.s, i) = -z * value(i);
      }
      for (int step = 0; step < 15; ++step) lab.sweep(kind.axis, 1);
      for (std::int64_t i = 0; i < n; ++i)
        EXPECT_NEAR(cell(lab, kind, kind.v, i), i < 15 ? 0 : value(i - 15), 1e-12) << "order " << order;
    }
}

// Proves (E12).
TEST(Dispersion, OfASineIsTheOnePredicted) {
  // A standing wave s = cos kx, v = 0 between planes of symmetry is two travelling ones; each is multiplied
  // by the amplification factor g per step: after n steps s = Re g^n cos kx and v = Im(g^n) sin kx/Z.
  // Rounding: 50 steps of 1e-16 on fields of 1.
  constexpr std::int64_t n = 40;
  constexpr int steps = 50;
  for (const int order : orders)
    for (const double courant : {0.2, 0.5, 0.9, 1.})
      for (const int half_waves : {4, 10, 16, 20})
        for (const auto& kind : kinds) {
          L lab = line(kind, n, 5, order, courant);
          const double z = rock.rho * kind.speed(), cells = 2. * n / half_waves;
          const auto phase = [&](std::int64_t i) { return 2 * pi * (double(i) + 0.5) / cells; };
          for (std::int64_t i = 0; i < n; ++i)
            cell(lab, kind, kind.v, i) = kind.wave == wave_p ? 0 : std::cos(phase(i)) / z;
          if (kind.wave == wave_p)
            for (std::int64_t i = 0; i < n; ++i) cell(lab, kind, kind.s, i) = std::cos(phase(i));
          for (int step = 0; step < steps; ++step) lab.sweep(kind.axis, 1);
          const auto factor = std::pow(amplification(order, courant, cells), steps);
          double worst = 0;
          for (std::int64_t i = 0; i < n; ++i) {
            // P: s even and v odd about the planes; S: v even and s odd.
            const double even =
                kind.wave == wave_p ? cell(lab, kind, kind.s, i) : z * cell(lab, kind, kind.v, i);
            const double odd =
                kind.wave == wave_p ? z * cell(lab, kind, kind.v, i) : cell(lab, kind, kind.s, i);
            worst = std::max(worst, std::abs(even - factor.real() * std::cos(phase(i))));
            worst = std::max(worst, std::abs(odd - factor.imag() * std::sin(phase(i))));
          }
          EXPECT_LT(worst, 1e-12) << "order " << order << " Courant " << courant << " cells " << cells;
        }
}

// Proves (E12).
TEST(Dispersion, NeverAmplifiesAndLosesLessTheHigherTheOrder) {
  for (const double courant : {0.05, 0.3, 0.6, 0.95})
    for (double cells = 2; cells < 100; cells *= 1.1) {
      double before = 1;
      for (const int order : orders) {
        EXPECT_LE(std::abs(amplification(order, courant, cells)), 1 + 1e-14);
        const double loss = loss_per_wavelength({order, courant}, cells);
        EXPECT_LE(loss, before * (1 + 1e-9) + 1e-12) << order << ' ' << courant << ' ' << cells;
        before = loss;
      }
    }
}

}  // namespace
}  // namespace slipwave::solver::solver_order_test
