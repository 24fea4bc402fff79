// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "base/error.hpp"
#include "gather/band_pass.hpp"
#include "gather/convolution.hpp"
#include "gather/trace_filter.hpp"

namespace slipwave::gather_filter_test {
namespace {

constexpr double pi = std::numbers::pi;
const SampleAxis axis{700, 0.002, 0};
const Ormsby band{5, 12, 40, 60};

std::vector<double> noise(std::size_t count) {
  std::vector<double> samples(count);
  std::uint32_t state = 99;
  for (double& sample : samples) {
    state = state * 1664525U + 1013904223U;
    sample = static_cast<double>(state) / 4294967296.0 - 0.5;
  }
  return samples;
}

/// exp(-(t - 0.7)^2/(2 0.1^2)) cos(2 pi f (t - 0.7)): its spectrum is 1.6 Hz wide round f.
std::vector<double> burst(double f_hz) {
  std::vector<double> samples;
  for (std::int64_t n = 0; n < axis.count; ++n) {
    const double t = static_cast<double>(n) * axis.interval_s - 0.7;
    samples.push_back(std::exp(-t * t / 0.02) * std::cos(2 * pi * f_hz * t));
  }
  return samples;
}

/// The integral of W exp(2 pi i f t), by the midpoint rule, the slow and sure way.
double integral(const Ormsby& trapezoid, double t_s) {
  const int steps = 200000;
  const double step_hz = trapezoid.f4_hz / steps;
  double sum = 0;
  for (int k = 0; k < steps; ++k) {
    const double f = (k + 0.5) * step_hz;
    sum += 2 * trapezoid.weight(f) * std::cos(2 * pi * f * t_s) * step_hz;
  }
  return sum;
}

double largest_difference(const std::vector<double>& a, const std::vector<double>& b) {
  double largest = 0;
  for (std::size_t n = 0; n < a.size(); ++n) largest = std::max(largest, std::fabs(a[n] - b[n]));
  return largest;
}

}  // namespace

TEST(Convolution, IsTheDefiningSumWithoutWrappingRound) {
  const std::vector<double> kernel = noise(23);
  for (const std::size_t count : {1, 2, 7, 40, 111}) {
    for (const std::int64_t first : {-500, -60, -22, -9, 0, 3, 39, 200}) {
      const std::vector<double> samples = noise(count);
      std::vector<double> expected(count);
      for (std::size_t n = 0; n < count; ++n)
        for (std::size_t m = 0; m < count; ++m) {
          const std::int64_t j = static_cast<std::int64_t>(n) - static_cast<std::int64_t>(m) - first;
          if (j >= 0 && j < 23) expected[n] += kernel[static_cast<std::size_t>(j)] * samples[m];
        }
      std::vector<double> result = samples;
      Convolution(count, {kernel, first}).apply(result);
      EXPECT_LT(largest_difference(result, expected), 1e-13) << count << " " << first;
    }
  }
  Convolution convolution(5, {kernel, 0});
  std::vector<double> other(4);
  EXPECT_THROW(convolution.apply(other), Error);
}

TEST(Convolution, OfTwoGaussiansIsTheGaussianOfTheirSummedVariances) {
  const auto gaussian = [](double t, double sigma) {
    return std::exp(-t * t / (2 * sigma * sigma)) / (sigma * std::sqrt(2 * pi));
  };
  const double a_s = 0.03, b_s = 0.04;
  std::vector<double> samples;
  for (std::int64_t n = 0; n < axis.count; ++n)
    samples.push_back(gaussian(static_cast<double>(n) * axis.interval_s - 0.5, a_s));
  // the second one is late by 0.3 s
  const Kernel late =
      sampled_kernel([&](double t) { return gaussian(t - 0.3, b_s); }, 0, 0.6, axis.interval_s);
  Convolution(samples.size(), late).apply(samples);
  for (std::int64_t n = 0; n < axis.count; ++n)
    EXPECT_NEAR(samples[static_cast<std::size_t>(n)],
                gaussian(static_cast<double>(n) * axis.interval_s - 0.8, std::hypot(a_s, b_s)), 1e-10);
}

TEST(Kernel, HoldsTheLagsOfItsSpanEndsIncluded) {
  const Kernel kernel = sampled_kernel([](double t) { return t; }, -0.0061, 0.008, 0.002);
  EXPECT_EQ(kernel.first_lag, -3);
  ASSERT_EQ(kernel.values.size(), 8U);  // -3 .. 4
  EXPECT_DOUBLE_EQ(kernel.values[7], 0.008 * 0.002);
  EXPECT_DOUBLE_EQ(kernel.values[0], -0.006 * 0.002);
  // 0.3/0.1 is a little below 3 in floating point
  EXPECT_EQ(sampled_kernel([](double t) { return t; }, 0, 0.3, 0.1).values.size(), 4U);
  EXPECT_EQ(sampled_kernel([](double t) { return t; }, -0.3, 0, 0.1).first_lag, -3);
}

TEST(Ormsby, HasTheImpulseResponseOfItsTrapezoid) {
  for (const Ormsby& trapezoid : {band, Ormsby{0, 0, 30, 50}, Ormsby{10, 10, 20, 20}, Ormsby{7, 9, 9, 30}})
    for (const double t : {0.0, 1e-12, 0.0013, 0.02, 0.1, -0.37})
      EXPECT_NEAR(trapezoid.impulse_response(t), integral(trapezoid, t), 1e-6) << t;
  EXPECT_EQ(band.weight(26), 1);
  EXPECT_EQ(band.weight(-26), 1);
  EXPECT_DOUBLE_EQ(band.weight(8.5), 0.5);
  EXPECT_DOUBLE_EQ(band.weight(50), 0.5);
  EXPECT_EQ(band.weight(0), 0);
  EXPECT_EQ(band.weight(60), 0);
  EXPECT_EQ((Ormsby{10, 10, 20, 20}.weight(10)), 1);
  EXPECT_EQ((Ormsby{0, 0, 20, 30}.weight(0)), 1);
}

TEST(BandPass, OfASpikeIsTheImpulseResponseFromEndToEnd) {
  for (const std::size_t at : {std::size_t{0}, std::size_t{250}, std::size_t{699}}) {
    std::vector<double> samples(700);
    samples[at] = 1;
    band_pass(axis, band).apply(samples);
    for (std::size_t n = 0; n < samples.size(); ++n) {
      const double t = (static_cast<double>(n) - static_cast<double>(at)) * axis.interval_s;
      EXPECT_NEAR(samples[n], axis.interval_s * band.impulse_response(t), 1e-14) << n;
    }
  }
}

TEST(BandPass, WeighsFrequenciesAndShiftsNone) {
  Convolution filter = band_pass(axis, band);
  // A burst within 8 standard deviations of its frequency keeps only what the trapezoid says: where that is
  // linear, the burst times the weight (and the flank's slope turns it by nothing but amplitude).
  for (const double f : {26.0, 30.0, 90.0, 150.0}) {
    std::vector<double> samples = burst(f);
    std::vector<double> expected = samples;
    for (double& value : expected) value *= band.weight(f);
    filter.apply(samples);
    EXPECT_LT(largest_difference(samples, expected), 1e-6) << f;
  }
  // On a flank W = a + b f, and multiplying by f is the derivative over 2 pi of the wave a quarter turned.
  std::vector<double> samples = burst(50);
  filter.apply(samples);
  for (std::size_t n = 0; n < samples.size(); ++n) {
    const double t = static_cast<double>(n) * axis.interval_s - 0.7;
    const double envelope = std::exp(-t * t / 0.02);
    const double turned = t / 0.01 / (2 * pi) / 20 * std::sin(2 * pi * 50 * t);
    EXPECT_NEAR(samples[n], envelope * (0.5 * std::cos(2 * pi * 50 * t) + turned), 1e-6) << n;
  }
}

TEST(BandPass, ReachesTheNyquistFrequencyAndNoFurther) {
  std::vector<double> samples = noise(700);
  const std::vector<double> before = samples;
  band_pass(axis, {0, 0, 250, 250}).apply(samples);
  EXPECT_LT(largest_difference(samples, before), 1e-13);
  try {
    band_pass(axis, {0, 0, 240, 260});
    ADD_FAILURE();
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(),
                 "found F4 = 260 Hz, expected at most the Nyquist frequency 250 Hz of samples every 0.002 s");
    EXPECT_EQ(error.kind(), ErrorKind::usage);
  }
}

TEST(Ormsby, IsFourCornersInOrder) {
  EXPECT_EQ(parse_ormsby("0,0,30,40").f4_hz, 40);
  for (const char* text : {"", "5,10,20", "5,10,30,20", "-1,0,1,2", "0,0,0,0", "1,2,3,4,5", "1,2,x,4"})
    EXPECT_THROW(parse_ormsby(text), Error) << text;
}

TEST(TraceFilter, TakesItsStepsInTheOrderItSays) {
  FilterSteps steps;
  steps.taper = TaperLengths{0.1, 0.2};
  steps.convolution = Kernel{{0.5, -2}, 1};
  steps.band = band;
  steps.interval_s = 0.004;
  steps.gains = {{Gain::Kind::power, 2}, {Gain::Kind::peak, 1}};
  std::vector<double> by_hand = noise(700);
  multiply(by_hand, taper_weights(axis, *steps.taper));
  Convolution(700, *steps.convolution).apply(by_hand);
  band_pass(axis, band).apply(by_hand);
  by_hand = Resampling(axis, 0.004).of(by_hand);
  Gains(steps.gains).apply(by_hand, {350, 0.004, 0.1});
  TraceFilter filter(axis, steps);
  EXPECT_EQ(filter.axis().count, 350);
  std::vector<double> samples = noise(700);
  filter.apply(samples, 0.1);
  EXPECT_EQ(samples, by_hand);
}

TEST(TraceFilter, NamesTheSampleThatIsNoNumber) {
  TraceFilter filter(axis, {});
  std::vector<double> samples(700);
  samples[41] = std::nan("");
  try {
    filter.apply(samples, 0);
    ADD_FAILURE();
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(), "sample 42: nan, expected a finite number");
  }
  std::vector<double> shorter(699);
  EXPECT_THROW(filter.apply(shorter, 0), Error);
}

}  // namespace slipwave::gather_filter_test
