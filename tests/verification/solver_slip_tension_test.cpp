// SPDX-License-Identifier: BSD-3-Clause
// A plane P wave straight through a layer of planes at 45 degrees whose strength is friction under the wave's
// own pressure: none while the wave pulls. The rules of a step then differ by when the waves feel what slip
// takes off.
#include <gtest/gtest.h>

#include "layer_in_tension.hpp"

namespace slipwave::solver::tension::solver_slip_tension_test {
namespace {

// Proves (S27).
TEST(SlipInTension, IsFeltByTheWavesWithSecondOrderByTheCentredCorrectionAlone) {
  const auto exact = reference(1200);
  ASSERT_LT(errors_below_60_hz(reference(300), exact).back, 0.5);
  double centred[3], second[3];
  for (const int n : {0, 1, 2}) {
    const double h = 5 / std::exp2(n);
    const auto of = errors_below_60_hz(solved(SlipCorrection::centred, {h}, 0.9), exact);
    second[n] = errors_below_60_hz(solved(SlipCorrection::second, {h}, 0.9), exact).back;
    centred[n] = of.back;
    EXPECT_LT(of.through, centred[n]);
  }
  EXPECT_LT(centred[0], 3.5);
  EXPECT_LT(centred[2], 0.3);
  EXPECT_GT(observed_order(centred[0], centred[1]), 1.8);
  EXPECT_GT(observed_order(centred[1], centred[2]), 1.7);
  EXPECT_LT(observed_order(second[1], second[2]), 1.2);
  for (const int n : {0, 1, 2}) EXPECT_LT(centred[n], second[n] / 2) << n;
}

}  // namespace
}  // namespace slipwave::solver::tension::solver_slip_tension_test
