// SPDX-License-Identifier: BSD-3-Clause
#include "gather/comparison.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "base/error.hpp"

namespace slipwave::gather_comparison_test {
namespace {

const SampleAxis axis{400, 0.004, 0};

/// A Ricker pulse of 20 Hz with its peak at `peak_s`: band-limited well below the Nyquist frequency of 125
/// Hz.
std::vector<double> pulse(double peak_s, double amplitude = 1) {
  std::vector<double> samples(static_cast<std::size_t>(axis.count));
  for (std::size_t n = 0; n < samples.size(); ++n) {
    const double arm = std::numbers::pi * 20 * (static_cast<double>(n) * axis.interval_s - peak_s);
    samples[n] = amplitude * (1 - 2 * arm * arm) * std::exp(-arm * arm);
  }
  return samples;
}

}  // namespace

TEST(Comparison, FindsNothingBetweenEqualTraces) {
  Comparison comparison(axis);
  const Misfit misfit = comparison.add(pulse(0.5), pulse(0.5));
  EXPECT_EQ(misfit.nrms_percent, 0);
  EXPECT_EQ(misfit.relative_l2, 0);
  EXPECT_EQ(misfit.peak_ratio, 1);
  EXPECT_NEAR(misfit.lag_s, 0, 1e-12);
}

TEST(Comparison, FindsDelaysBetweenTheSamples) {
  for (const double lag : {-0.3, -0.0513, -0.0011, 0.0, 0.0005, 0.002, 0.00321, 0.04, 0.7123}) {
    Comparison comparison(axis);
    EXPECT_NEAR(comparison.add(pulse(0.6 + lag), pulse(0.6)).lag_s, lag, 1e-7) << lag;
  }
}

TEST(Comparison, FollowsTheDefinitionsForScaledTraces) {
  Comparison comparison(axis);
  const Misfit misfit = comparison.add(pulse(0.5, 1.5), pulse(0.5, 1));
  EXPECT_NEAR(misfit.relative_l2, 0.5, 1e-14);
  EXPECT_NEAR(misfit.nrms_percent, 200 * 0.5 / 2.5, 1e-12);
  EXPECT_NEAR(misfit.peak_ratio, 1.5, 1e-14);
  EXPECT_NEAR(comparison.add(pulse(0.5, -1), pulse(0.5, 1)).nrms_percent, 200, 1e-12);
}

TEST(Comparison, SumsOverAllTraces) {
  Comparison comparison(axis);
  comparison.add(pulse(0.5, 2), pulse(0.5, 1));
  comparison.add(pulse(0.7, 3), pulse(0.7, 3));
  const Misfit all = comparison.overall();
  EXPECT_NEAR(all.relative_l2, std::sqrt(1.0 / 10.0), 1e-12);
  EXPECT_NEAR(all.nrms_percent, 200 * 1 / (std::sqrt(13) + std::sqrt(10)), 1e-10);
  EXPECT_NEAR(all.peak_ratio, 1, 1e-12);
  EXPECT_NEAR(all.lag_s, 0, 1e-12);
}

TEST(Comparison, IncludesWhatAnotherHasSeen) {
  Comparison first(axis), second(axis), both(axis);
  first.add(pulse(0.5), pulse(0.51));
  second.add(pulse(0.7, 3), pulse(0.7, 2));
  both.add(pulse(0.5), pulse(0.51));
  both.add(pulse(0.7, 3), pulse(0.7, 2));
  first.include(second);
  EXPECT_DOUBLE_EQ(first.overall().relative_l2, both.overall().relative_l2);
  EXPECT_DOUBLE_EQ(first.overall().nrms_percent, both.overall().nrms_percent);
  EXPECT_DOUBLE_EQ(first.overall().peak_ratio, both.overall().peak_ratio);
  EXPECT_NEAR(first.overall().lag_s, both.overall().lag_s, 1e-12);
}

TEST(Comparison, SaysWhatAZeroTraceMeans) {
  const std::vector<double> zero(400);
  Comparison comparison(axis);
  const Misfit both = comparison.add(zero, zero);
  EXPECT_EQ(both.relative_l2, 0);
  EXPECT_EQ(both.peak_ratio, 1);
  EXPECT_TRUE(std::isnan(both.lag_s));
  EXPECT_EQ(comparison.add(pulse(0.5), zero).relative_l2, std::numeric_limits<double>::infinity());
  EXPECT_EQ(comparison.add(zero, pulse(0.5)).relative_l2, 1);
  EXPECT_THROW(comparison.add(std::vector<double>(399), zero), Error);
}

}  // namespace slipwave::gather_comparison_test
