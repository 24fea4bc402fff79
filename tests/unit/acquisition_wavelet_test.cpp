// SPDX-License-Identifier: BSD-3-Clause
#include "acquisition/wavelet.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>

#include "base/error.hpp"
#include "base/fft.hpp"

namespace slipwave::acquisition_wavelet_test {
namespace {

constexpr double pi = std::numbers::pi;

/// Amplitude spectrum by a plain sum over samples, independent of the library's formulas.
double summed_spectrum(const Wavelet& w, double hz, double dt) {
  std::complex<double> sum = 0;
  for (int n = 0; n * dt <= w.duration_s(); ++n) sum += w(n * dt) * std::polar(1., -2 * pi * hz * n * dt);
  return std::abs(sum) * dt;
}

/// Energy above a frequency as a share of all, root mean square, by the trapezoidal rule on the closed form.
double share_above(const Wavelet& w, double hz, double end_hz) {
  double above = 0, all = 0;
  const int bins = 400000;
  for (int k = 0; k < bins; ++k) {
    const double f = (k + 0.5) * end_hz / bins, energy = std::pow(w.amplitude_spectrum(f), 2);
    all += energy;
    if (f > hz) above += energy;
  }
  return std::sqrt(above / all);
}

// Proves (W1).
TEST(Ricker, PeaksAtItsDelay) {
  const auto w = parse_wavelet("ricker:30");
  EXPECT_EQ(w(w.delay_s()), 1);
  EXPECT_DOUBLE_EQ(w.delay_s(), 0.05);
  EXPECT_LT(w(w.delay_s() + 1e-3), 1);
  EXPECT_LT(w(w.delay_s() - 1e-3), 1);
}

// Proves (W1).
TEST(Ricker, HasItsTroughsWhereItsSecondDerivativeHasThem) {
  // w' = 0 at a^2 = 3/2, w = -2 exp(-3/2) there.
  const auto w = parse_wavelet("ricker:10");
  const double a = std::sqrt(1.5) / (pi * 10);
  EXPECT_NEAR(w(w.delay_s() + a), -2 * std::exp(-1.5), 1e-14);
  EXPECT_NEAR(w(w.delay_s() - a), -2 * std::exp(-1.5), 1e-14);
}

// Proves (W1), (W2).
TEST(SmoothWavelets, StartAndEndAtNothing) {
  for (const auto& text : {"ricker:30", "gauss:30", "ricker:0.5"}) {
    const auto w = parse_wavelet(text);
    EXPECT_LT(std::abs(w(0)), 2e-8) << text;
    EXPECT_LT(std::abs(w(w.duration_s())), 2e-8) << text;
    EXPECT_EQ(w(-1e-9), 0);
    EXPECT_EQ(w(w.duration_s() * (1 + 1e-9)), 0);
  }
}

// Proves (W1), (W2), (W3).
TEST(Wavelets, HaveTheSpectrumOfTheirSamples) {
  for (const auto& text : {"ricker:30", "gauss:30", "sine:30", "sine:30:2.5", "sine:30:4"}) {
    const auto w = parse_wavelet(text);
    for (const double hz : {0.5, 10., 30., 47., 71.})
      EXPECT_NEAR(w.amplitude_spectrum(hz), summed_spectrum(w, hz, 1e-6), 1e-7 / 30) << text << ' ' << hz;
  }
}

// Proves (W1).
TEST(Ricker, HasItsSpectralPeakAtItsFrequencyInADft) {
  const auto w = parse_wavelet("ricker:25");
  const double dt = 1e-3;
  std::vector<double> samples(4000);
  for (int n = 0; n < 4000; ++n) samples[n] = w(n * dt);
  RealTransform transform(samples.size());
  const auto bins = transform.forward(samples);
  const double bin_hz = 1 / (4000 * dt);
  std::size_t largest = 0;
  for (std::size_t k = 0; k < bins.size(); ++k) {
    EXPECT_NEAR(std::abs(bins[k]) * dt, w.amplitude_spectrum(double(k) * bin_hz), 1e-9);
    if (std::abs(bins[k]) > std::abs(bins[largest])) largest = k;
  }
  EXPECT_DOUBLE_EQ(double(largest) * bin_hz, 25);
}

// Proves (W2).
TEST(Gaussian, PeaksAtItsDelayAndHasTheRickerAsSecondDerivative) {
  const auto gauss = parse_wavelet("gauss:20"), ricker = parse_wavelet("ricker:20");
  EXPECT_EQ(gauss(gauss.delay_s()), 1);
  const double h = 1e-5;
  for (const double t : {0.05, 0.06, 0.075, 0.08, 0.1}) {
    const double second = (gauss(t + h) - 2 * gauss(t) + gauss(t - h)) / (h * h);
    EXPECT_NEAR(second / (-2 * pi * pi * 20 * 20), ricker(t), 1e-5) << t;
  }
}

// Proves (W3).
TEST(Sine, RunsForItsCyclesAndIsZeroAfter) {
  const auto one = parse_wavelet("sine:20"), three = parse_wavelet("sine:20:3"),
             half = parse_wavelet("sine:20:0.5");
  EXPECT_DOUBLE_EQ(one.duration_s(), 0.05);
  EXPECT_DOUBLE_EQ(three.duration_s(), 0.15);
  EXPECT_DOUBLE_EQ(half.duration_s(), 0.025);
  EXPECT_EQ(one(0), 0);
  EXPECT_NEAR(one(0.0125), 1, 1e-12);
  EXPECT_NEAR(one(0.0375), -1, 1e-12);
  EXPECT_EQ(one(0.0626), 0);
  EXPECT_NEAR(three(0.1125), 1, 1e-12);
}

// Proves (W5).
TEST(Wavelets, HaveLittleAboveTheirHighestFrequency) {
  for (const auto& text : {"ricker:30", "gauss:30", "sine:30", "sine:30:8"}) {
    const auto w = parse_wavelet(text);
    for (const double share : {0.1, 0.01}) {
      const double highest = w.highest_frequency_hz(share);
      EXPECT_NEAR(share_above(w, highest, 30 * 200), share, 0.04 * share) << text;
    }
  }
  EXPECT_NEAR(parse_wavelet("ricker:30").highest_frequency_hz(), 2.53 * 30, 1);
  EXPECT_NEAR(parse_wavelet("ricker:3").highest_frequency_hz(), 2.53 * 3, 0.1);
}

TEST(ParseWavelet, KeepsTheText) {
  EXPECT_EQ(parse_wavelet("sine:30:2").text(), "sine:30:2");
  EXPECT_EQ(parse_wavelet("ricker:12.5").nominal_hz(), 12.5);
}

TEST(ParseWavelet, RefusesWhatItDoesNotKnow) {
  for (const auto& text : {"", "ricker", "ricker:", "ricker:0", "ricker:-3", "ricker:nan", "ricker:30:2",
                           "ricker:30Hz", "ricker:1e300", "sine:30:0", "sine:30:0.3", "sine:30:-1",
                           "sine:30:1:1", "gauss:inf", "Ricker:30", "file:", "file", "morlet:30"}) {
    try {
      parse_wavelet(text);
      ADD_FAILURE() << text;
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::usage) << text;
      EXPECT_NE(std::string(error.what()).find("expected"), std::string::npos) << error.what();
    }
  }
}

}  // namespace
}  // namespace slipwave::acquisition_wavelet_test
