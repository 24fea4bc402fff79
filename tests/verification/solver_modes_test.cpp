// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <complex>
#include <numbers>

#include "accuracy/dispersion.hpp"
#include "lab.hpp"
#include "long_form.hpp"

namespace slipwave::solver::solver_modes_test {
namespace {

using L = Lab<double>;
constexpr Rock rock{4500, 2250, 2500};

/// A standing wave in a square of side 1000 m between planes of symmetry: the displacement is the gradient
/// (P) or the curl (S) of a potential, cos kx cos kz or sin kx sin kz, times cos wt/w. Every equation of
/// motion holds term by term.
struct Mode {
  Wave wave;
  double kx, kz;
  double k2() const { return kx * kx + kz * kz; }
  double omega() const { return (wave == wave_p ? rock.vp : rock.vs) * std::sqrt(k2()); }
  double operator()(L::Row row, double x, double z, double t) const {
    const double cx = std::cos(kx * x), sx = std::sin(kx * x), cz = std::cos(kz * z), sz = std::sin(kz * z);
    const double moving = -std::sin(omega() * t), strained = std::cos(omega() * t) / omega();
    const double mu = rock.mu(), lambda = rock.lambda();
    if (wave == wave_p) switch (row) {
        case L::vx:
          return -kx * sx * cz * moving;
        case L::vz:
          return -kz * cx * sz * moving;
        case L::sxx:
          return -(lambda * k2() + 2 * mu * kx * kx) * cx * cz * strained;
        case L::szz:
          return -(lambda * k2() + 2 * mu * kz * kz) * cx * cz * strained;
        case L::sxz:
          return 2 * mu * kx * kz * sx * sz * strained;
      }
    switch (row) {
      case L::vx:
        return kz * sx * cz * moving;
      case L::vz:
        return -kx * cx * sz * moving;
      case L::sxx:
        return 2 * mu * kx * kz * cx * cz * strained;
      case L::szz:
        return -2 * mu * kx * kz * cx * cz * strained;
      case L::sxz:
        return mu * (kx * kx - kz * kz) * sx * sz * strained;
    }
    return 0;
  }
};

/// Error of all five fields after 0.2 s; stresses count over rho vp.
double error_of(const Mode& mode, int order, double h, double courant, bool merged, int time_order = 2) {
  const auto n = std::int64_t(1000 / h);
  const double time = 0.2;
  const auto steps = std::int64_t(std::ceil(time * rock.vp / (courant * h)));
  const double dt = time / double(steps);
  L lab(uniform_medium(n, n, h, rock), edges_all(EdgeLaw::mirror), order, dt, time_order);
  const auto each = [&](auto&& act) {
    for (const auto row : {L::vx, L::vz, L::sxx, L::szz, L::sxz})
      for (std::int64_t k = 0; k < n; ++k)
        for (std::int64_t i = 0; i < n; ++i) act(row, i, k, (double(i) + 0.5) * h, (double(k) + 0.5) * h);
  };
  each([&](L::Row row, auto i, auto k, double x, double z) { lab(row, i, k) = mode(row, x, z, 0); });
  if (merged) {
    lab.steps(steps);
  } else {
    for (std::int64_t step = 0; step < steps; ++step) lab.step();
  }
  std::vector<double> found, exact;
  each([&](L::Row row, auto i, auto k, double x, double z) {
    const double unit = row >= L::sxx ? rock.rho * rock.vp : 1;
    found.push_back(lab(row, i, k) / unit);
    exact.push_back(mode(row, x, z, time) / unit);
  });
  return relative_error(found, exact);
}

constexpr double pi = std::numbers::pi;
const Mode modes[] = {{wave_p, 4 * pi / 1000, 6 * pi / 1000}, {wave_s, 3 * pi / 1000, 2 * pi / 1000}};

// Proves (E3), (E9).
TEST(SplitStep, IsOfSecondOrderForPAndSWavesAcrossTheAxes) {
  // Wavelengths 28 and 55 cells at 10 m. Splitting leaves order 2; 0.1 for the next term.
  for (const auto& mode : modes)
    for (const int order : {3, 5, 7})
      for (const bool merged : {false, true}) {
        const double coarse = error_of(mode, order, 10, 0.9, merged),
                     fine = error_of(mode, order, 5, 0.9, merged);
        EXPECT_GE(observed_order(coarse, fine), 1.9)
            << "order " << order << (mode.wave == wave_p ? " P" : " S") << " errors " << coarse << ' '
            << fine;
      }
}

// Proves (E18).
TEST(FourthOrderInTime, LeavesTheOrderOfTheReconstructionAtTheLargestStep) {
  // Step and cell go together: order 4 or better, that of the reconstruction below (0.2 for the next term).
  // At twice the step of second order the error is still ten times smaller.
  for (const auto& mode : modes)
    for (const int order : {3, 5, 7}) {
      const double coarse = error_of(mode, order, 20, 2, true, 4),
                   fine = error_of(mode, order, 10, 2, true, 4);
      EXPECT_GE(observed_order(coarse, fine), std::min(order, 4) - 0.2)
          << order << ' ' << coarse << ' ' << fine;
      EXPECT_LT(fine, order == 3 ? 1 : 0.1 * error_of(mode, order, 10, 0.9, true, 2)) << order;
    }
}

// Proves (E3).
TEST(SplitStep, LeavesTheOrderOfTheReconstructionWhereTheCourantNumberIsSmall) {
  // The splitting error goes with dt^2: at a fifth of the Courant number it is 25 times smaller.
  for (const auto& mode : modes) {
    const double large = error_of(mode, 7, 20, 0.9, true), small = error_of(mode, 7, 20, 0.18, true);
    EXPECT_NEAR(large / small, 25, 5) << large << ' ' << small;
  }
}

/// exp(-i omega t) as the fields have it after `steps` of time dt: strain and motion, each the projection on
/// the mode's own pattern.
std::complex<double> projection(L& lab, const Mode& mode, double h) {
  const double quarter = pi / 2 / mode.omega();  // strained only at t = 0, moving only a quarter period later
  std::array<double, 2> along{}, size{};
  for (const auto row : {L::vx, L::vz, L::sxx, L::szz, L::sxz})
    for (std::int64_t k = 0; k < lab.grid().shape[1]; ++k)
      for (std::int64_t i = 0; i < lab.grid().shape[0]; ++i) {
        const bool moving = row == L::vx || row == L::vz;
        const double pattern = mode(row, (double(i) + 0.5) * h, (double(k) + 0.5) * h, moving ? quarter : 0);
        along[moving] += pattern * lab(row, i, k);
        size[moving] += pattern * pattern;
      }
  return {along[0] / size[0], -along[1] / size[1]};
}

// Proves (E15).
TEST(StepError, IsWhatTheSchemeDoesToAWaveAcrossTheAxes) {
  // A standing wave is made of four plane ones with the same error. Waves of 5 to 14 cells; a twentieth of
  // the error of a step for what the prediction leaves out, its square.
  const double h = 20;
  for (const auto& mode :
       {Mode{wave_p, 6 * pi / 1000, 10 * pi / 1000}, Mode{wave_s, 6 * pi / 1000, 10 * pi / 1000},
        Mode{wave_s, 2 * pi / 1000, 7 * pi / 1000}})
    for (const int order : {3, 5, 7})
      for (const int time_order : {2, 4}) {
        // The longer the wave the more steps.
        if (!long_form() && mode.kx < 3 * pi / 1000) continue;
        const double courant = time_order == 2 ? 0.9 : 1.8, dt = courant * h / rock.vp;
        L lab(uniform_medium(50, 50, h, rock), edges_all(EdgeLaw::mirror), order, dt, time_order);
        for (const auto row : {L::vx, L::vz, L::sxx, L::szz, L::sxz})
          for (std::int64_t k = 0; k < 50; ++k)
            for (std::int64_t i = 0; i < 50; ++i)
              lab(row, i, k) = mode(row, (double(i) + 0.5) * h, (double(k) + 0.5) * h, 0);
        const auto expected = step_error({order, courant, courant * rock.vs / rock.vp, time_order},
                                         mode.wave == wave_p ? WaveKind::p : WaveKind::s,
                                         2 * pi / std::sqrt(mode.k2()) / h, std::atan2(mode.kx, mode.kz));
        // What the first step makes of the wave beside itself stays and beats with it: the longer the run the
        // less it counts.
        const auto steps = std::int64_t(std::clamp(0.5 / std::abs(expected), 20., 2000.));
        lab.step();
        const auto begin = projection(lab, mode, h);
        for (std::int64_t n = 0; n < steps; ++n) lab.step();
        const auto turned = std::polar(1., mode.omega() * dt * double(steps));
        const auto found = std::log(projection(lab, mode, h) / begin * turned) / double(steps);
        EXPECT_LT(std::abs(found - expected), 0.05 * std::abs(expected) + 1e-6)
            << "order " << order << ' ' << time_order << " found " << found << " expected " << expected;
      }
}

// Proves (E15).
TEST(StepError, AlongAnAxisIsTheOneOfTheSweep) {
  // Nothing is split there: (E12) over the whole step.
  for (const int order : orders)
    for (const double cells : {4., 9., 30.}) {
      const auto p = step_error({order, 0.8, 0.4}, WaveKind::p, cells, 0);
      EXPECT_LT(
          std::abs(std::exp(p) - amplification(order, 0.8, cells) * std::polar(1., 2 * pi * 0.8 / cells)),
          1e-12);
      const auto s = step_error({order, 0.8, 0.4}, WaveKind::s, cells, 0);
      EXPECT_LT(
          std::abs(std::exp(s) - amplification(order, 0.4, cells) * std::polar(1., 2 * pi * 0.4 / cells)),
          1e-12);
    }
}

}  // namespace
}  // namespace slipwave::solver::solver_modes_test
