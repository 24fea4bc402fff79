// SPDX-License-Identifier: BSD-3-Clause
// The criterion of monotonicity (theory.md (C1)): waves without overshoots.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "lab.hpp"

namespace slipwave::solver::solver_monotone_test {
namespace {

constexpr Rock rock{4500, 2250, 2500}, soft{2000, 900, 2000};

/// A wave of one kind along one axis.
template <class Real>
struct Pulse {
  using L = Lab<Real>;
  int axis;
  Wave wave;
  typename L::Row v, s;

  double speed(const Rock& of) const { return wave == wave_p ? of.vp : of.vs; }
  double impedance(const Rock& of) const { return of.rho * speed(of); }
  Real& cell(L& lab, typename L::Row row, std::int64_t n) const {
    return axis == 0 ? lab(row, n, 1) : lab(row, 1, n);
  }
  /// 120 cells, from `border` on of another rock; a square pulse of cells 20 to 40 travels to larger numbers.
  L lab(int order, double courant, bool monotone, std::int64_t border = 120) const {
    auto medium = axis == 0 ? uniform_medium(120, 2, 5, rock) : uniform_medium(2, 120, 5, rock);
    for (std::int64_t n = border; n < 120; ++n)
      for (std::int64_t beside = 0; beside < 2; ++beside)
        put(medium, axis == 0 ? Index<2>{n, beside} : Index<2>{beside, n}, soft);
    L lab(medium, edges_all(EdgeLaw::mirror), order, courant * 5 / speed(rock));
    if (monotone) lab.keep_monotone();
    for (std::int64_t n = 20; n < 40; ++n)
      for (std::int64_t beside = 0; beside < 2; ++beside) {
        const auto set = [&](typename L::Row row, double value) {
          (axis == 0 ? lab(row, n, beside) : lab(row, beside, n)) = Real(value);
        };
        set(v, 1), set(s, -impedance(rock));
      }
    return lab;
  }
};
template <class Real>
std::vector<Pulse<Real>> pulses() {
  using L = Lab<Real>;
  return {{0, wave_p, L::vx, L::sxx},
          {0, wave_s, L::vz, L::sxz},
          {1, wave_p, L::vz, L::szz},
          {1, wave_s, L::vx, L::sxz}};
}

struct Range {
  double least, largest, variation;
};
template <class Real>
Range range_of(const Pulse<Real>& pulse, Lab<Real>& lab, std::int64_t first = 0, std::int64_t last = 120) {
  Range range{1e30, -1e30, 0};
  for (auto n = first; n < last; ++n) {
    const double value = pulse.cell(lab, pulse.v, n);
    range.least = std::min(range.least, value), range.largest = std::max(range.largest, value);
    if (n > first) range.variation += std::abs(value - double(pulse.cell(lab, pulse.v, n - 1)));
  }
  return range;
}

template <class Real>
void expect_no_overshoot() {
  for (const int order : orders)
    for (const auto& pulse : pulses<Real>())
      for (const double courant : {0.1, 0.5, 0.9, 1.}) {
        SCOPED_TRACE("order " + std::to_string(order) + ", axis " + std::to_string(pulse.axis) + ", wave " +
                     std::to_string(pulse.wave) + ", Courant " + std::to_string(courant));
        auto lab = pulse.lab(order, courant, true);
        double before = range_of(pulse, lab).variation;
        // In single precision every step rounds.
        const double rounding = std::is_same_v<Real, double> ? 1e-6 : 5e-6;
        for (int step = 0; step < int(50 / courant); ++step) {
          lab.sweep(pulse.axis, 1);
          const auto now = range_of(pulse, lab);
          ASSERT_LE(now.variation, before + rounding) << step;
          ASSERT_GE(now.least, -rounding) << step;
          ASSERT_LE(now.largest, 1 + rounding) << step;
          before = now.variation;
        }
        // Not because it is smeared: orders above 1 keep its height.
        if (order > 1) {
          EXPECT_GT(range_of(pulse, lab).largest, 0.98);
        }
      }
}

// Proves (C1).
TEST(Monotone, ASquarePulseHasNoOvershootsAndItsVariationNeverGrows) {
  expect_no_overshoot<double>();
  expect_no_overshoot<float>();
}

TEST(Monotone, WithoutTheCriterionTheSamePulseOvershoots) {
  for (const int order : orders)
    for (const auto& pulse : pulses<double>()) {
      if (order == 1) continue;
      auto lab = pulse.lab(order, 0.5, false);
      for (int step = 0; step < 100; ++step) lab.sweep(pulse.axis, 1);
      EXPECT_GT(range_of(pulse, lab).largest, 1.03) << order;
      EXPECT_LT(range_of(pulse, lab).least, -0.03) << order;
    }
}

// Proves (C1).
TEST(Monotone, TransmittedAndReflectedPulsesDoNotExceedTheirCoefficients) {
  // Into rock of lower impedance: 2 Z_1/(Z_1 + Z_2) behind the border and, before it, the incident pulse and
  // the reflected one, (Z_1 - Z_2)/(Z_1 + Z_2), on top of each other.
  constexpr std::int64_t border = 60;
  for (const int order : orders)
    for (const auto& pulse : pulses<double>())
      for (const double courant : {0.2, 0.5, 0.8, 1.}) {
        SCOPED_TRACE("order " + std::to_string(order) + ", axis " + std::to_string(pulse.axis) + ", wave " +
                     std::to_string(pulse.wave) + ", Courant " + std::to_string(courant));
        auto lab = pulse.lab(order, courant, true, border);
        const double z1 = pulse.impedance(rock), z2 = pulse.impedance(soft);
        const double through = 2 * z1 / (z1 + z2), back = (z1 - z2) / (z1 + z2);
        for (int step = 0; step < int(60 / courant); ++step) {
          lab.sweep(pulse.axis, 1);
          const auto after = range_of(pulse, lab, border, 120), ahead = range_of(pulse, lab, 0, border);
          ASSERT_LE(after.largest, through + 1e-12) << step;
          ASSERT_GE(after.least, -1e-12) << step;
          ASSERT_LE(ahead.largest, 1 + back + 1e-12) << step;
          ASSERT_GE(ahead.least, -1e-12) << step;
        }
        // Not because it is smeared.
        if (order > 1) {
          EXPECT_GT(range_of(pulse, lab, border, 120).largest, 0.97 * through);
        }
      }
}

/// What a step makes of the wave that travels away from a border, in the cell beside it. Before the border
/// fields are constant; behind it are the waves that come towards it.
struct BesideABorder {
  double w, next;       // the wave in that cell and in the next one
  double toward, v, s;  // the waves that come towards the border; the fields before it
  double z, z_before, courant;

  /// Returns the wave that enters by the exact Riemann solution (E8).
  double entering() const { return (2 * z * (z_before * v - s) + (z - z_before) * toward) / (z + z_before); }
  bool is_extremum() const { return (w - entering()) * (next - w) <= 0; }

  /// Returns the wave after a step of that pulse's sweep; `turned` cells are counted from the other end.
  double after(const Pulse<double>& pulse, int order, const Rock& before, const Rock& behind,
               bool turned) const {
    constexpr std::int64_t cells = 40, border = 20;
    const auto place = [&](std::int64_t n) { return turned ? cells - 1 - n : n; };
    const double way = turned ? -1 : 1;
    auto medium = pulse.axis == 0 ? uniform_medium(cells, 2, 5, before) : uniform_medium(2, cells, 5, before);
    const auto index = [&](std::int64_t n, std::int64_t beside) {
      return pulse.axis == 0 ? Index<2>{place(n), beside} : Index<2>{beside, place(n)};
    };
    for (std::int64_t n = border; n < cells; ++n)
      for (std::int64_t beside = 0; beside < 2; ++beside) put(medium, index(n, beside), behind);
    Lab<double> lab(medium, edges_all(EdgeLaw::mirror), order, courant * 5 / pulse.speed(behind));
    lab.keep_monotone();
    for (std::int64_t n = 0; n < cells; ++n)
      for (std::int64_t beside = 0; beside < 2; ++beside) {
        const auto at = index(n, beside);
        const double away = n == border ? w : next;
        lab(pulse.v, at[0], at[1]) = way * (n < border ? v : (away + toward) / (2 * z));
        lab(pulse.s, at[0], at[1]) = n < border ? s : (toward - away) / 2;
      }
    lab.sweep(pulse.axis, 1);
    return z * way * pulse.cell(lab, pulse.v, place(border)) - pulse.cell(lab, pulse.s, place(border));
  }
};

// Proves (C1).
TEST(Monotone, BesideABorderAWaveStaysBetweenItselfAndWhatEntersAndAnExtremumIsOfFirstOrder) {
  std::mt19937 random(1);
  const auto draw = [&](double least, double largest) {
    return least + (largest - least) * double(random()) / double(std::mt19937::max());
  };
  int between = 0, extrema = 0, at_the_bound = 0;
  for (int n = 0; n < 150; ++n)
    for (const auto& pulse : pulses<double>()) {
      const bool into_soft = n % 2;
      const Rock &before = into_soft ? rock : soft, &behind = into_soft ? soft : rock;
      BesideABorder border{draw(-1, 1),
                           draw(-4, 4),
                           draw(-1, 1),
                           0,
                           draw(-1, 1),
                           pulse.impedance(behind),
                           pulse.impedance(before),
                           draw(0.1, into_soft ? 0.35 : 0.95)};
      border.v = draw(-1, 1) / border.z_before;
      const double entering = border.entering(), rounding = 1e-9;
      const double after = border.after(pulse, 3 + 2 * (n % 3), before, behind, n % 4 > 1);
      if (border.is_extremum()) {
        ++extrema;
        EXPECT_NEAR(after, border.w - border.courant * (border.w - entering), rounding) << n;
      } else {
        ++between;
        EXPECT_GE(after, std::min(border.w, entering) - rounding) << n;
        EXPECT_LE(after, std::max(border.w, entering) + rounding) << n;
        at_the_bound += std::abs(after - entering) < rounding;
      }
    }
  EXPECT_GT(between, 100);
  EXPECT_GT(extrema, 100);
  EXPECT_GT(at_the_bound, 20);
}

}  // namespace
}  // namespace slipwave::solver::solver_monotone_test
