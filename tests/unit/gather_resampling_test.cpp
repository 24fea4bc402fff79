// SPDX-License-Identifier: BSD-3-Clause
#include "gather/resampling.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "base/error.hpp"

namespace slipwave::gather_resampling_test {
namespace {

constexpr double pi = std::numbers::pi;

/// Ricker wavelet of 20 Hz with its peak at t = 0: below 1e-8 of its peak spectrum from 100 Hz on.
double ricker(double t_s) {
  const double arm = pi * 20 * t_s;
  return (1 - 2 * arm * arm) * std::exp(-arm * arm);
}

std::vector<double> sampled(const SampleAxis& axis, double (*function)(double)) {
  std::vector<double> samples;
  for (std::int64_t n = 0; n < axis.count; ++n)
    samples.push_back(function(static_cast<double>(n) * axis.interval_s - 0.75));
  return samples;
}

/// exp(-(t/0.15)^2/2) cos(2 pi f t), 1.06 Hz wide (standard deviation).
template <int F>
double burst(double t_s) {
  return std::exp(-t_s * t_s / 0.045) * std::cos(2 * pi * F * t_s);
}

double worst_error(double from_s, double to_s, double (*function)(double)) {
  const SampleAxis axis{static_cast<std::int64_t>(std::llround(1.5 / from_s)) + 1, from_s, 0.1};
  const Resampling resampling(axis, to_s);
  const std::vector<double> result = resampling.of(sampled(axis, function));
  const std::vector<double> expected = sampled(resampling.axis(), function);
  double worst = 0;
  for (std::size_t n = 0; n < result.size(); ++n) worst = std::max(worst, std::fabs(result[n] - expected[n]));
  return worst;
}

}  // namespace

TEST(Resampling, GivesABandLimitedPulseAtAnyNewTimes) {
  for (const double from_s : {0.001, 0.002, 0.004})
    for (const double to_s : {0.0005, 0.0007, 0.001, 0.0013, 0.002, 0.003, 0.004, 0.001 * std::sqrt(2.0)})
      EXPECT_LT(worst_error(from_s, to_s, ricker), 2e-5) << from_s << " to " << to_s;
}

TEST(Resampling, KeepsFrequenciesUpToFourFifthsOfTheLowerNyquist) {
  // 125 Hz either way; the bursts reach some 5 Hz to both sides of their middle
  EXPECT_LT(worst_error(0.001, 0.004, burst<10>), 2e-5);
  EXPECT_LT(worst_error(0.001, 0.004, burst<95>), 2e-5);
  EXPECT_LT(worst_error(0.004, 0.001, burst<95>), 2e-5);
  EXPECT_GT(worst_error(0.001, 0.004, burst<112>), 0.1);
}

TEST(Resampling, RemovesWhatWouldAlias) {
  const SampleAxis axis{1501, 0.001, 0};
  const Resampling resampling(axis, 0.004);
  for (const double value : resampling.of(sampled(axis, burst<130>))) EXPECT_LT(std::fabs(value), 2e-5);
  for (const double value : resampling.of(sampled(axis, burst<245>))) EXPECT_LT(std::fabs(value), 2e-5);
}

TEST(Resampling, KeepsConstantsAwayFromTheEnds) {
  for (const double to_s : {0.0003, 0.0011, 0.0029, 0.0007 * pi}) {
    const SampleAxis axis{800, 0.001, 0};
    const Resampling resampling(axis, to_s);
    const auto result = resampling.of(std::vector<double>(800, 3.0));
    const double reach_s = 33 * std::max(0.001, to_s);
    for (std::size_t n = 0; n < result.size(); ++n) {
      const double t = static_cast<double>(n) * to_s;
      if (t > reach_s && t < 0.799 - reach_s) {
        EXPECT_NEAR(result[n], 3, 1e-13) << to_s;
      }
    }
  }
}

TEST(Resampling, KeepsTheFirstTimeAndEndsNoLaterThanBefore) {
  const auto count = [](std::int64_t samples, double from_s, double to_s) {
    return Resampling({samples, from_s, 0}, to_s).axis().count;
  };
  EXPECT_EQ(count(1001, 0.001, 0.002), 501);
  EXPECT_EQ(count(1000, 0.001, 0.002), 500);
  EXPECT_EQ(count(1001, 0.001, 0.0005), 2001);
  EXPECT_EQ(count(1001, 0.001, 0.003), 334);
  EXPECT_EQ(count(11, 0.001, 0.1), 1);
  EXPECT_EQ(count(1, 0.001, 0.0001), 1);
  EXPECT_EQ(Resampling({1001, 0.001, 0.05}, 0.002).axis().start_s, 0.05);
  // the pulse at 0.75 s has its peak there, whatever the interval
  const SampleAxis axis{1501, 0.001, 0};
  const auto coarse = Resampling(axis, 0.0025).of(sampled(axis, ricker));
  EXPECT_NEAR(coarse[300], 1, 2e-5);
}

TEST(Resampling, RefusesIntervalsThatAreNone) {
  for (const double interval : {0.0, -0.001, std::nan("")})
    EXPECT_THROW(Resampling({100, 0.001, 0}, interval), Error);
  EXPECT_THROW(Resampling({100, 0, 0}, 0.001), Error);
  EXPECT_THROW(Resampling({60000, 0.001, 0}, 1e-12), Error);
  EXPECT_THROW(Resampling({100, 0.001, 0}, 0.002).of(std::vector<double>(99)), Error);
}

}  // namespace slipwave::gather_resampling_test
