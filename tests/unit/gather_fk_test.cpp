// SPDX-License-Identifier: BSD-3-Clause
#include "gather/fk_spectrum.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <numeric>
#include <string>
#include <vector>

#include "base/error.hpp"

namespace slipwave::gather_fk_test {
namespace {

constexpr double pi = std::numbers::pi;
const SampleAxis axis{500, 0.002, 0};

double ricker(double t_s) {
  const double arm = pi * 25 * t_s;
  return (1 - 2 * arm * arm) * std::exp(-arm * arm);
}

/// |Fourier integral| of it.
double ricker_amplitude(double f_hz) {
  const double share = f_hz / 25;
  return 2 / (std::sqrt(pi) * 25) * share * share * std::exp(-share * share);
}

/// Traces of a wave of this slowness along a line, at x = 0 at 0.5 s.
std::vector<std::vector<double>> plane_wave(std::size_t receivers, double spacing_m, double slowness) {
  std::vector<std::vector<double>> traces(receivers);
  for (std::size_t m = 0; m < receivers; ++m)
    for (std::int64_t n = 0; n < axis.count; ++n)
      traces[m].push_back(ricker(static_cast<double>(n) * axis.interval_s - 0.5 -
                                 slowness * spacing_m * static_cast<double>(m)));
  return traces;
}

TraceHeader header_of(std::int64_t shot, double x_m, Component component = Component::vz) {
  TraceHeader header;
  header.shot = shot;
  header.component = component;
  header.receiver_m = {x_m, 0, 0};
  return header;
}

/// What adding traces of these shots and positions says.
std::string refusal(const std::vector<std::pair<std::int64_t, double>>& traces) {
  FkSpectra spectra(axis, {});
  try {
    for (const auto& [shot, x_m] : traces) spectra.add(header_of(shot, x_m), std::vector<double>(500));
    spectra.finish();
  } catch (const Error& error) {
    return error.what();
  }
  return "accepted";
}

}  // namespace

TEST(RealTransform2, IsTheDefiningDoubleSum) {
  for (const std::size_t rows : {1, 2, 5, 8})
    for (const std::size_t length : {1, 2, 7, 12}) {
      RealTransform2 transform(rows, length);
      const auto sample = [](std::size_t m, std::size_t n) {
        return std::sin(double(m * m + 3 * n) + 0.3 * double(n * n));
      };
      for (std::size_t m = 0; m < rows; ++m)
        for (std::size_t n = 0; n < length; ++n) transform.samples(m)[n] = sample(m, n);
      transform.forward();
      for (std::size_t j = 0; j < rows; ++j)
        for (std::size_t k = 0; k < transform.bins(); ++k) {
          std::complex<double> sum = 0;
          for (std::size_t m = 0; m < rows; ++m)
            for (std::size_t n = 0; n < length; ++n)
              sum +=
                  sample(m, n) *
                  std::polar(1.0, -2 * pi * (double(j * m) / double(rows) + double(k * n) / double(length)));
          EXPECT_LT(std::abs(transform.spectrum(j)[k] - sum), 1e-12) << rows << " " << length;
        }
    }
}

TEST(FkTransform, OfAPlaneWaveIsItsClosedForm) {
  // |F(k, f)| = |W(f)| dx |sin(pi M dx (k - p f))/sin(pi dx (k - p f))|, the sum of a geometric series
  const std::size_t receivers = 40;
  const double spacing_m = 12.5;
  for (const double slowness : {1 / 2500.0, -1 / 1800.0, 0.0}) {
    for (const double pad : {1.0, 1.5}) {
      FkTransform transform(axis, receivers, spacing_m, {Window::none, pad, false});
      const auto f = transform.frequencies_hz();
      const auto k = transform.wavenumbers_per_m();
      std::vector<double> sum(f.size() * k.size());
      transform.add(plane_wave(receivers, spacing_m, slowness), sum);
      for (std::size_t j = 0; j < k.size(); ++j)
        for (std::size_t n = 0; n < f.size(); ++n) {
          const double arm = pi * spacing_m * (k[j] - slowness * f[n]);
          const double series = std::fabs(std::sin(arm)) < 1e-12
                                    ? double(receivers)
                                    : std::sin(double(receivers) * arm) / std::sin(arm);
          EXPECT_NEAR(sum[j * f.size() + n], ricker_amplitude(f[n]) * spacing_m * std::fabs(series), 1e-9)
              << k[j] << " " << f[n];
        }
    }
  }
}

TEST(FkTransform, HasItsWavenumbersInOrderAndAllOfThem) {
  for (const std::size_t receivers : {2, 3, 8, 9}) {
    const FkTransform transform(axis, receivers, 10, {});
    const auto k = transform.wavenumbers_per_m();
    ASSERT_EQ(k.size(), receivers);
    for (std::size_t n = 0; n + 1 < k.size(); ++n)
      EXPECT_NEAR(k[n + 1] - k[n], 0.1 / double(receivers), 1e-15);
    EXPECT_EQ(k[receivers / 2], 0);
    EXPECT_GE(k.front(), -0.05);
    EXPECT_LT(k.back(), 0.05);
  }
}

TEST(FkTransform, KeepsTheEnergyOfTheWindowedGather) {
  for (const std::size_t receivers : {15, 16})
    for (const std::string& window : window_names())
      for (const double pad : {1.0, 1.3, 2.0}) {
        const SampleAxis shorter{pad == 2 ? 61 : 60, 0.004, 0};
        std::vector<std::vector<double>> traces(receivers);
        for (std::size_t m = 0; m < receivers; ++m)
          for (std::int64_t n = 0; n < shorter.count; ++n)
            traces[m].push_back(std::sin(0.37 * double(m * m) + 0.11 * double(n * n)));
        FkTransform transform(shorter, receivers, 25, {window_named(window), pad, true});
        const auto f = transform.frequencies_hz();
        const auto k = transform.wavenumbers_per_m();
        std::vector<double> power(f.size() * k.size());
        transform.add(traces, power);
        const auto along = window_weights(window_named(window), std::size_t(shorter.count));
        const auto across = window_weights(window_named(window), receivers);
        double energy = 0;
        for (std::size_t m = 0; m < receivers; ++m)
          for (std::size_t n = 0; n < along.size(); ++n)
            energy += std::pow(along[n] * across[m] * traces[m][n], 2) * 0.004 * 25;
        const double in_spectrum = std::accumulate(power.begin(), power.end(), 0.0) * (k[1] - k[0]) * f[1];
        EXPECT_NEAR(in_spectrum / energy, 1, 1e-12) << receivers << " " << window << " " << pad;
      }
}

TEST(FkSpectra, AreMeansOverTheShotsOfEachComponent) {
  const auto wave = plane_wave(21, 10, 1 / 2000.0);
  FkSpectra spectra(axis, {});
  for (int shot = 1; shot <= 3; ++shot)
    for (std::size_t m = 21; m-- > 0;) {  // positions in any order, components mixed
      std::vector<double> samples = wave[m];
      for (double& value : samples) value *= shot;
      spectra.add(header_of(shot, 10 * double(m)), samples);
      if (shot < 3) spectra.add(header_of(shot, 10 * double(m), Component::p), wave[m]);
    }
  spectra.finish();
  ASSERT_EQ(spectra.means().size(), 2U);
  const auto& vz = spectra.means().at(Component::vz);
  const auto& p = spectra.means().at(Component::p);
  EXPECT_EQ(vz.gathers, 3);
  EXPECT_EQ(p.gathers, 2);
  FkTransform transform(axis, 21, 10, {});
  std::vector<double> one(vz.values.size());
  transform.add(wave, one);
  for (std::size_t n = 0; n < one.size(); ++n) {
    EXPECT_NEAR(vz.values[n], 2 * one[n], 1e-12);
    EXPECT_NEAR(p.values[n], one[n], 1e-12);
  }
}

TEST(FkSpectra, RefuseWhatIsNoEvenLine) {
  EXPECT_EQ(refusal({{1, 0}, {1, 10}, {1, 20}}), "accepted");
  EXPECT_EQ(refusal({}), "has no traces, expected at least one");
  EXPECT_EQ(refusal({{1, 0}}), "shot 1, vz: has 1 receiver, expected a line of at least two");
  EXPECT_EQ(refusal({{1, 0}, {1, 10}, {1, 25}}),
            "shot 1, vz: receivers at x = 0 and 10 m, expected one every 12.5 m");
  EXPECT_EQ(refusal({{1, 5}, {1, 5}}), "shot 1, vz: its receivers lie in one place, expected a line");
  EXPECT_EQ(refusal({{1, 0}, {1, 10}, {2, 0}, {2, 10}, {2, 20}}),
            "shot 2, vz: 3 receivers every 10 m, expected 2 receivers every 10 m as in the first gather");
  EXPECT_EQ(refusal({{1, 0}, {1, 10}, {2, 0}, {2, 20}}),
            "shot 2, vz: 2 receivers every 20 m, expected 2 receivers every 10 m as in the first gather");
  EXPECT_EQ(refusal({{1, 0}, {1, 10}, {2, 0}, {2, 10}, {1, 20}}),
            "shot 1 comes again after another one, expected its traces together (sw-sort --key shot)");
}

}  // namespace slipwave::gather_fk_test
