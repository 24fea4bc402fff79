// SPDX-License-Identifier: BSD-3-Clause
#include "gather/spectrum.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <numbers>
#include <numeric>
#include <sstream>
#include <vector>

#include "base/error.hpp"
#include "gather/spectrum_file.hpp"
#include "io/netcdf_file.hpp"
#include "segy_shared.hpp"

namespace slipwave::gather_spectrum_test {
namespace {

constexpr double dt_s = 0.002;

/// exp(-(t - 0.5)^2 / (2 sigma^2))
std::vector<double> gaussian(std::size_t count, double sigma_s) {
  std::vector<double> samples(count);
  for (std::size_t n = 0; n < count; ++n) {
    const double t = static_cast<double>(n) * dt_s - 0.5;
    samples[n] = std::exp(-t * t / (2 * sigma_s * sigma_s));
  }
  return samples;
}

SampleAxis axis_of(const std::vector<double>& samples) {
  return {static_cast<std::int64_t>(samples.size()), dt_s, 0};
}

}  // namespace

TEST(Spectrum, OfAGaussianIsItsFourierIntegral) {
  // the integral of exp(-t^2/2s^2) exp(-2 pi i f t) is s sqrt(2 pi) exp(-2 (pi s f)^2)
  const double sigma_s = 0.02;
  const std::vector<double> samples = gaussian(501, sigma_s);
  for (const double pad : {1.0, 2.5, 4.0}) {
    SpectrumTransform transform(axis_of(samples), {Window::none, pad, false});
    const auto frequencies = transform.frequencies_hz();
    const auto amplitude = transform.of(samples);
    ASSERT_EQ(frequencies.size(), amplitude.size());
    for (std::size_t k = 0; k < amplitude.size(); ++k) {
      const double arm = std::numbers::pi * sigma_s * frequencies[k];
      EXPECT_NEAR(amplitude[k], sigma_s * std::sqrt(2 * std::numbers::pi) * std::exp(-2 * arm * arm), 1e-12);
    }
  }
}

TEST(Spectrum, KeepsTheEnergyOfTheWindowedTrace) {
  for (const std::size_t count : {100, 101, 750}) {
    std::vector<double> samples = gaussian(count, 0.3);
    for (std::size_t n = 0; n < count; ++n) samples[n] *= std::sin(0.7 * static_cast<double>(n * n % 91));
    for (const std::string& name : window_names()) {
      for (const double pad : {1.0, 1.7, 3.0}) {
        SpectrumTransform transform(axis_of(samples), {window_named(name), pad, true});
        const auto energy = transform.of(samples);
        const auto weights = window_weights(window_named(name), count);
        double in_time = 0;
        for (std::size_t n = 0; n < count; ++n) in_time += std::pow(weights[n] * samples[n], 2) * dt_s;
        const double in_frequency = std::accumulate(energy.begin(), energy.end(), 0.0) * transform.step_hz();
        EXPECT_NEAR(in_frequency / in_time, 1, 1e-12) << name << " " << count << " " << pad;
      }
    }
  }
}

TEST(Spectrum, PutsASineAtItsFrequencyWithHalfItsAmplitudeTimesTheLength) {
  std::vector<double> samples(500);
  for (std::size_t n = 0; n < samples.size(); ++n)
    samples[n] = 3 * std::sin(2 * std::numbers::pi * 40 * static_cast<double>(n) * dt_s);
  SpectrumTransform transform(axis_of(samples), {});
  const auto amplitude = transform.of(samples);
  const auto peak = std::max_element(amplitude.begin(), amplitude.end()) - amplitude.begin();
  EXPECT_DOUBLE_EQ(transform.frequencies_hz()[static_cast<std::size_t>(peak)], 40);
  EXPECT_NEAR(amplitude[static_cast<std::size_t>(peak)], 3 * 0.5 * 1.0, 1e-12);  // trace of 1 s
}

TEST(Window, HasTheTextbookMiddleAndEnds) {
  const auto at = [](const char* name, std::size_t n) { return window_weights(window_named(name), 11)[n]; };
  EXPECT_NEAR(at("hann", 0), 0, 1e-15);
  EXPECT_NEAR(at("hann", 5), 1, 1e-15);
  EXPECT_NEAR(at("hamming", 0), 0.08, 1e-15);
  EXPECT_NEAR(at("blackman", 10), 0, 1e-15);
  EXPECT_NEAR(at("blackman", 5), 1, 1e-15);
  EXPECT_NEAR(at("bartlett", 1), 0.2, 1e-15);
  EXPECT_EQ(at("none", 3), 1);
  EXPECT_THROW(window_named("hanning"), Error);
}

TEST(Spectrum, RefusesWhatHasNoSpectrum) {
  EXPECT_THROW(SpectrumTransform({100, 0, 0}, {}), Error);
  EXPECT_THROW(SpectrumTransform({0, 0.001, 0}, {}), Error);
  EXPECT_THROW(SpectrumTransform({100, 0.001, 0}, {Window::none, 0.5, false}), Error);
  SpectrumTransform transform({100, 0.001, 0}, {});
  EXPECT_THROW(transform.of(std::vector<double>(99)), Error);
}

TEST(SpectrumText, HoldsAColumnAComponentWithItsUnit) {
  const Scratch scratch;
  OutputFile out(scratch.file("s.txt"), OutputFile::Content::text);
  const auto file = spectrum_text(out, {{0, 10}, false, "how", "sw-x", {}});
  std::map<Component, SpectrumMean> means;
  means[Component::vz].add(std::vector<double>{1, 3});
  means[Component::vz].add(std::vector<double>{2, 5});
  file->add_means(means);
  file->finish();
  std::ifstream in(scratch.file("s.txt"));
  std::stringstream text;
  text << in.rdbuf();
  EXPECT_EQ(text.str(), "# sw-x\n# how\n# frequency_Hz vz[m s-1 Hz-1] (mean of 2)\n0 1.5\n10 4\n");
}

TEST(SpectrumNetcdf, HoldsEveryTraceInOrder) {
  // more traces than go into one piece of the file
  const Scratch scratch;
  OutputFile out(scratch.file("s.nc"), OutputFile::Content::binary);
  const std::size_t bins = 1000;
  std::vector<double> frequencies(bins);
  std::iota(frequencies.begin(), frequencies.end(), 0.0);
  const auto file = spectrum_netcdf(out, {frequencies, true, "how", "sw-x", {}});
  for (int trace = 0; trace < 100; ++trace) {
    TraceHeader header;
    header.shot = trace / 10;
    header.channel = trace;
    header.component = Component::p;
    header.receiver_m = {2.5 * trace, 0, 7};
    std::vector<double> values(bins, trace);
    values[0] = -trace;
    file->add(header, values);
  }
  file->finish();
  const NetcdfFile read = NetcdfFile::open(scratch.file("s.nc"));
  const auto values = read.get<double>("power");
  ASSERT_EQ(values.size(), 100 * bins);
  const auto shot = read.get<int>("shot");
  const auto x_m = read.get<double>("receiver_x");
  for (std::size_t trace = 0; trace < 100; ++trace) {
    EXPECT_EQ(values[trace * bins], -double(trace));
    EXPECT_EQ(values[trace * bins + bins - 1], double(trace));
    EXPECT_EQ(shot[trace], int(trace) / 10);
    EXPECT_EQ(x_m[trace], 2.5 * double(trace));
  }
}

}  // namespace slipwave::gather_spectrum_test
