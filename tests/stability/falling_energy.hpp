// SPDX-License-Identifier: BSD-3-Clause
// What is asked of the energy of a box in which a random wave field evolves freely.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "planning/plan.hpp"

namespace slipwave {

/// Runs and expects that the energy never rises above the lowest value so far by more than `rounding` of it,
/// and ends finite; after the first hundred steps it looks once in `looks_every` of them. Energies below
/// `floor` are rounding itself.
template <class Box>
void expect_no_growth(Box& box, int steps, double rounding, int looks_every = 1, double floor = 0) {
  const double begin = box.energy();
  ASSERT_GT(begin, 0);
  double lowest = begin;
  for (int n = 1; n <= steps; ++n) {
    box.step();
    if (n > 100 && n % looks_every != 0) continue;
    const double now = box.energy();
    // Written so that NaN fails.
    ASSERT_TRUE(now <= lowest * (1 + rounding) + floor)
        << "step " << n << ": the energy is " << now << ", it was down to " << lowest << " and began as "
        << begin;
    lowest = std::min(lowest, now);
  }
}

/// What (E10) may give back in a thousand steps where speeds differ, as a share of the energy, which is as
/// the square of the amplitude.
inline const double gain_of_interfaces = std::expm1(2 * gain_in_a_step * 1000);

/// Runs and expects that each thousand steps leave less energy than there was, but for `rounding` of the
/// first and a `gain` of what was left: beside corrected surfaces and interfaces (E11) it wavers from step to
/// step once most of it has left.
template <class Box>
void expect_fall_in_the_long_run(Box& box, int steps, double rounding = 0, double gain = 0) {
  double before = box.energy();
  ASSERT_GT(before, 0);
  const double begin = before, lost_in_rounding = before * rounding;
  for (int n = 1; n <= steps; ++n) {
    box.step();
    if (n % 1000 != 0) continue;
    const double now = box.energy();
    // Written so that NaN fails.
    ASSERT_TRUE(now < before * (1 + gain) + lost_in_rounding && now < begin * (1 + rounding))
        << "step " << n << ": the energy is " << now << ", a thousand steps ago it was " << before
        << ", at first " << begin;
    before = now;
  }
}

}  // namespace slipwave
