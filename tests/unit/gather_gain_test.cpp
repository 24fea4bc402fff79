// SPDX-License-Identifier: BSD-3-Clause
#include "gather/gain.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <numeric>
#include <vector>

#include "base/error.hpp"
#include "gather/taper.hpp"

namespace slipwave::gather_gain_test {
namespace {

const SampleAxis axis{501, 0.002, -0.1};

double time_of(std::size_t n) { return axis.start_s + static_cast<double>(n) * axis.interval_s; }

std::vector<double> after(const std::vector<std::string>& gains, std::vector<double> samples) {
  std::vector<Gain> parsed;
  for (const auto& gain : gains) parsed.push_back(parse_gain(gain));
  Gains(parsed).apply(samples, axis);
  return samples;
}

std::vector<double> sine(double hz) {
  std::vector<double> samples;
  for (std::size_t n = 0; n < 501; ++n)
    samples.push_back(std::sin(2 * std::numbers::pi * hz * static_cast<double>(n) * axis.interval_s));
  return samples;
}

}  // namespace

TEST(Gain, OfPowersAndExponentialsFollowsTheTimeOfTheSamples) {
  const auto power = after({"power:1.5"}, std::vector<double>(501, 2));
  const auto exponential = after({"exp:-3"}, std::vector<double>(501, 2));
  for (std::size_t n = 0; n < 501; ++n) {
    const double t = time_of(n);
    EXPECT_NEAR(power[n], t > 0 ? 2 * t * std::sqrt(t) : 0, 1e-12) << t;
    EXPECT_NEAR(exponential[n], 2 * std::exp(-3 * t), 1e-12);
  }
}

TEST(Gain, PowerUndoesTheSpreadingOfAWave) {
  std::vector<double> samples(501, 0.0);
  for (std::size_t n = 60; n < 501; ++n) samples[n] = 1 / time_of(n);
  const auto level = after({"power:1"}, samples);
  for (std::size_t n = 60; n < 501; ++n) EXPECT_NEAR(level[n], 1, 1e-12);
}

TEST(Gain, ControlMakesTheRootMeanSquareOneInItsWindow) {
  // 25 Hz: 20 samples a period, so a window of 21 or 41 samples holds whole periods but for one sample
  const auto level = after({"agc:0.4"}, sine(25));
  const std::vector<double> plain = sine(25);
  for (std::size_t n = 100; n < 400; ++n) {
    double sum = 0;
    for (std::size_t m = n - 100; m <= n + 100; ++m) sum += plain[m] * plain[m];
    EXPECT_NEAR(level[n], plain[n] / std::sqrt(sum / 201), 1e-12);
    EXPECT_NEAR(level[n], std::sqrt(2.0) * plain[n], 0.01);
  }
  // at the ends the window is what there is of it
  double sum = 0;
  for (std::size_t m = 0; m <= 105; ++m) sum += plain[m] * plain[m];
  EXPECT_NEAR(level[5], plain[5] / std::sqrt(sum / 106), 1e-12);
  // longer than the trace: one value for all
  const auto whole = after({"agc:100"}, sine(25));
  const auto balanced = after({"rms"}, sine(25));
  for (std::size_t n = 0; n < 501; ++n) EXPECT_NEAR(whole[n], balanced[n], 1e-12);
}

TEST(Gain, ControlDoesNotLoseTheWeakBehindTheStrong) {
  std::vector<double> samples = sine(25);
  for (std::size_t n = 250; n < 501; ++n) samples[n] *= 1e-12;
  const auto level = after({"agc:0.2"}, samples);
  for (std::size_t n = 301; n < 451; ++n) EXPECT_NEAR(level[n], std::sqrt(2.0) * sine(25)[n], 0.02) << n;
}

TEST(Gain, BalancesWholeTraces) {
  const auto rms = after({"rms"}, sine(7));
  EXPECT_NEAR(std::inner_product(rms.begin(), rms.end(), rms.begin(), 0.0), 501, 1e-9);
  const auto peak = after({"peak"}, {0.5, -4, 2});
  EXPECT_EQ(peak, (std::vector<double>{0.125, -1, 0.5}));
  // squares of these would be 0 and infinite
  EXPECT_NEAR(after({"rms"}, {1e-200, -1e-200})[1], -1, 1e-12);
  EXPECT_NEAR(after({"rms"}, {1e200, 1e200})[0], 1, 1e-12);
}

TEST(Gain, LeavesSilentTracesSilent) {
  for (const char* gain : {"rms", "peak", "agc:0.1", "power:-2", "exp:5"})
    for (const double value : after({gain}, std::vector<double>(501))) EXPECT_EQ(value, 0) << gain;
}

TEST(Gain, AppliesOneAfterTheOther) {
  EXPECT_EQ(after({"scale:3", "clip:2"}, {1, -1, 0.5}), (std::vector<double>{2, -2, 1.5}));
  EXPECT_EQ(after({"clip:2", "scale:3"}, {1, -1, 0.5}), (std::vector<double>{3, -3, 1.5}));
}

TEST(Gain, RefusesWhatItDoesNotKnow) {
  const auto said = [](const char* text) {
    try {
      parse_gain(text);
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::usage);
      return std::string(error.what());
    }
    return std::string("accepted");
  };
  const std::string known = ", expected one of power:P, exp:A, agc:T, rms, peak, scale:C, clip:C";
  EXPECT_EQ(said("tpow:2"), "found 'tpow:2'" + known);
  EXPECT_EQ(said("rms:2"), "found 'rms:2'" + known);
  EXPECT_EQ(said("agc"), "found 'agc'" + known);
  EXPECT_EQ(said(""), "found ''" + known);
  EXPECT_EQ(said("agc:0"), "found 'agc:0', expected T above 0");
  EXPECT_EQ(said("clip:-1"), "found 'clip:-1', expected C above 0");
  EXPECT_EQ(said("power:x"), "power: found 'x', expected a number");
}

TEST(Taper, HasCosineFlanksAndOnesBetween) {
  const auto weights = taper_weights(axis, {0.2, 0.1});
  EXPECT_EQ(weights[0], 0);
  EXPECT_NEAR(weights[50], 0.5, 1e-12);  // half way up
  EXPECT_NEAR(weights[25], (1 - std::sqrt(0.5)) / 2, 1e-12);
  for (std::size_t n = 100; n <= 450; ++n) EXPECT_EQ(weights[n], 1);
  EXPECT_NEAR(weights[475], 0.5, 1e-12);
  EXPECT_EQ(weights[500], 0);
  for (const double weight : taper_weights(axis, {0, 0})) EXPECT_EQ(weight, 1);
  // flanks that meet multiply
  EXPECT_NEAR(taper_weights(axis, {1, 1})[250], 0.25, 1e-12);
}

TEST(Taper, IsOneLengthOrTwo) {
  EXPECT_EQ(parse_taper("0.1").end_s, 0.1);
  EXPECT_EQ(parse_taper("0.1,0").end_s, 0);
  for (const char* text : {"", "-0.1", "0.1,-1", "1,2,3", "a"})
    EXPECT_THROW(parse_taper(text), Error) << text;
}

}  // namespace slipwave::gather_gain_test
