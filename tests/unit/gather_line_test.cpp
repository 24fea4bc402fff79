// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "base/error.hpp"
#include "gather/fk_spectrum.hpp"
#include "gather/nrms.hpp"
#include "gather/phase_velocity.hpp"
#include "gather/receiver_line.hpp"
#include "gather/velocity_filter.hpp"
#include "refusal.hpp"

namespace slipwave::gather_line_test {
namespace {

const SampleAxis axis{400, 0.002, 0};
constexpr std::size_t receivers = 120;
constexpr double spacing_m = 4;

double ricker(double t_s) {
  const double arm = std::numbers::pi * 20 * t_s;
  return (1 - 2 * arm * arm) * std::exp(-arm * arm);
}

using Traces = std::vector<std::vector<double>>;

/// A plane wave of that velocity along the line, in its middle at 0.4 s, that fades towards both ends: a line
/// that cuts waves off spreads them over all wavenumbers.
Traces wave(double velocity) {
  Traces traces(receivers);
  for (std::size_t m = 0; m < receivers; ++m)
    for (std::int64_t n = 0; n < axis.count; ++n)
      traces[m].push_back(std::pow(std::sin(std::numbers::pi * double(m) / double(receivers - 1)), 2) *
                          ricker(double(n) * axis.interval_s - 0.4 -
                                 (double(m) - double(receivers) / 2) * spacing_m / velocity));
  return traces;
}

Traces sum(Traces one, const Traces& other) {
  for (std::size_t m = 0; m < one.size(); ++m)
    for (std::size_t n = 0; n < one[m].size(); ++n) one[m][n] += other[m][n];
  return one;
}

/// |a - b|/|b| in the middle third of the line, where no wave ends.
double difference(const Traces& a, const Traces& b) {
  double above = 0, below = 0;
  for (std::size_t m = receivers / 3; m < 2 * receivers / 3; ++m)
    for (std::size_t n = 0; n < a[m].size(); ++n) {
      above += std::pow(a[m][n] - b[m][n], 2);
      below += b[m][n] * b[m][n];
    }
  return std::sqrt(above / below);
}

Traces filtered(Traces traces, const FkFilterSettings& settings) {
  std::vector<std::vector<double>*> each;
  for (auto& trace : traces) each.push_back(&trace);
  FkFilter(axis, receivers, spacing_m, settings).apply(each);
  return traces;
}

FkFilterSettings fan(const char* text, bool reject = false) {
  return {parse_velocity_fan(text), std::nullopt, reject};
}

}  // namespace

TEST(VelocityFilter, KeepsTheWavesOfItsFanAndRemovesTheOthers) {
  const auto slow = wave(500), fast = wave(3000), both = sum(slow, fast);
  EXPECT_LT(difference(filtered(both, fan("1000,1500,inf,inf")), fast), 0.03);
  EXPECT_LT(difference(filtered(both, fan("1000,1500,inf,inf", true)), slow), 0.03);
  EXPECT_LT(difference(filtered(both, fan("300,400,700,1000")), slow), 0.03);
}

TEST(VelocityFilter, TellsOneWayFromTheOtherByASign) {
  const auto there = wave(800), back = wave(-800), both = sum(there, back);
  EXPECT_LT(difference(filtered(both, fan("+500,+600,+1200,+1500")), there), 0.03);
  EXPECT_LT(difference(filtered(both, fan("-500,-600,-1200,-1500")), back), 0.03);
  EXPECT_LT(difference(filtered(both, fan("500,600,1200,1500")), both), 0.03);
}

TEST(VelocityFilter, AndItsOppositeAddUpToWhatWasThere) {
  const auto both = sum(wave(500), wave(2000));
  for (const auto* text : {"700,1400", "+100,+900", "300,400,1000,inf"})
    EXPECT_LT(difference(sum(filtered(both, fan(text)), filtered(both, fan(text, true))), both), 1e-12)
        << text;
}

TEST(VelocityFilter, KeepsABandOfWavenumbers) {
  // At 20 Hz waves of 500 m/s have 0.04 1/m, of 3000 m/s 0.007 1/m.
  const auto slow = wave(500), fast = wave(3000), both = sum(slow, fast);
  const FkFilterSettings low{std::nullopt, parse_wavenumber_band("0,0,0.012,0.02"), false};
  EXPECT_LT(difference(filtered(both, low), fast), 0.15);
}

TEST(VelocityFilter, RefusesWhatIsNoFan) {
  for (const auto* text :
       {"", "500", "900,500", "500,900,700,1000", "-500,900", "0,0", "inf,inf", "a,b", "1,2,3"})
    EXPECT_THROW(parse_velocity_fan(text), Error) << text;
  for (const auto* text : {"0,1,2", "3,2,1,4", "-1,0,1,2", "0,0,0,0"})
    EXPECT_THROW(parse_wavenumber_band(text), Error) << text;
}

TEST(PhaseVelocity, HasItsRidgeAtTheVelocityOfAWave) {
  for (const double velocity : {400., -900.}) {
    PhaseVelocityTransform transform(axis, receivers, spacing_m, {},
                                     VelocityRange{velocity / 2, velocity * 2, 151}.values());
    const auto& velocities = transform.velocities();
    const std::size_t bins = std::size_t(axis.count) / 2 + 1;
    std::vector<double> image(velocities.size() * bins);
    transform.add(wave(velocity), image);
    const auto bin = std::size_t(std::lround(20 * double(axis.count) * axis.interval_s));
    std::size_t best = 0;
    for (std::size_t row = 0; row < velocities.size(); ++row)
      if (image[row * bins + bin] > image[best * bins + bin]) best = row;
    EXPECT_NEAR(velocities[best] / velocity, 1, 0.02);
  }
}

TEST(PhaseVelocity, IsTheFkSpectrumAtItsWavenumbers) {
  const FkTransform fk(axis, receivers, spacing_m, {});
  const auto traces = sum(wave(400), wave(-700));
  const auto k = fk.wavenumbers_per_m(), f = fk.frequencies_hz();
  std::vector<double> spectrum(k.size() * f.size());
  FkTransform(axis, receivers, spacing_m, {}).add(traces, spectrum);
  const std::size_t row = k.size() / 2 + 5, bin = 16;
  PhaseVelocityTransform transform(axis, receivers, spacing_m, {}, {f[bin] / k[row]});
  std::vector<double> image(f.size());
  transform.add(traces, image);
  EXPECT_NEAR(image[bin] / spectrum[row * f.size() + bin], 1, 1e-9);
}

TEST(PhaseVelocity, AreChosenWhereTheEnergyIs) {
  FkTransform transform(axis, receivers, spacing_m, {Window::hann, 2, true});
  std::vector<double> energy(transform.wavenumbers_per_m().size() * transform.frequencies_hz().size());
  transform.add(wave(-600), energy);
  const auto range = velocities_of_energy(transform, energy);
  EXPECT_LT(range.first, 0) << "more energy travels that way";
  EXPECT_GT(range.first, -600);
  EXPECT_LT(range.last, -600);
}

TEST(PhaseVelocity, RefusesRangesOfBothSigns) {
  EXPECT_EQ(parse_velocity_range("100:500:100").count, 5U);
  EXPECT_EQ(parse_velocity_range("-100:-500:100").values().front(), -500);
  for (const auto* text : {"100", "500:100", "-100:100", "0:100", "100:500:0", "100:500:-5", "1:1e9:1e-3"})
    EXPECT_THROW(parse_velocity_range(text), Error) << text;
}

TEST(ReceiverLine, NeedsReceiversEvenlySpaced) {
  const std::vector<std::array<double, 3>> line = {{0, 0, 30}, {0, 0, 10}, {0, 0, 20}};
  EXPECT_EQ(line_of(line).axis_name(), 'z');
  EXPECT_EQ(line_of(line).order, (std::vector<std::size_t>{1, 2, 0}));
  EXPECT_EQ(line_of(line).spacing_m, 10);
  EXPECT_THROW(line_of(std::vector<std::array<double, 3>>{{0, 0, 0}, {10, 0, 0}, {25, 0, 0}}), Error);
  EXPECT_THROW(line_of(std::vector<std::array<double, 3>>{{0, 0, 0}, {0, 0, 0}}), Error);
}

TEST(NrmsOverTime, IsThatOfTheSamplesRoundEachOne) {
  std::vector<double> a(100, 1), b(100, 1);
  for (std::size_t n = 50; n < 100; ++n) b[n] = -1;
  const auto nrms = nrms_over_time(a, b, 5);
  EXPECT_EQ(nrms[0], 0);
  EXPECT_EQ(nrms[44], 0);
  EXPECT_NEAR(nrms[50], 200 * std::sqrt(6 * 4 / 11.) / 2, 1e-12);
  EXPECT_EQ(nrms[99], 200);
  EXPECT_EQ(nrms_over_time(std::vector<double>(5), std::vector<double>(5), 2), std::vector<double>(5));
  a.assign(100, 1e12);
  a[99] = 3, b = a, b[99] = -3;
  EXPECT_EQ(nrms_over_time(a, b, 0)[99], 200) << "quiet samples beside loud ones";
}

}  // namespace slipwave::gather_line_test
