// SPDX-License-Identifier: BSD-3-Clause
#include "one_cell.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace slipwave::one_cell_test {
namespace {

/// How often the error of a rule changes its sign from step to step by more than a hundredth of the strength.
int turns(const History& found, const History& exact) {
  int count = 0;
  const auto error = [&](std::size_t n) { return found.rate[n] - exact.rate[n]; };
  for (std::size_t n = 1; n < found.rate.size(); ++n)
    count += error(n - 1) * error(n) < 0 && std::min(std::abs(error(n - 1)), std::abs(error(n))) > 0.01;
  return count;
}

double largest_error(const History& found, const History& exact) {
  double largest = 0;
  for (std::size_t n = 0; n < found.rate.size(); ++n)
    largest = std::max(largest, std::abs(found.rate[n] - exact.rate[n]));
  return largest;
}

}  // namespace

TEST(StiffSlip, RingsByTheTrapezoidalRuleAlone) {
  for (const double relaxation : {1e-6, 0.01, 0.05}) {
    const auto all = histories(relaxation, 150);
    EXPECT_EQ(turns(all[1], all[0]), 0) << relaxation;
    EXPECT_GE(turns(all[2], all[0]), 20) << relaxation;
    EXPECT_LE(turns(all[3], all[0]), 3) << relaxation;
    EXPECT_EQ(turns(all[4], all[0]), 0) << relaxation;
  }
}

TEST(SoftSlip, IsMetNearerByTheOrdersThatAreHigher) {
  const auto all = histories(5, 150);
  for (const std::size_t rule : {2, 3, 4})
    EXPECT_LT(largest_error(all[rule], all[0]), 0.2 * largest_error(all[1], all[0])) << all[rule].rule;
}

}  // namespace slipwave::one_cell_test
