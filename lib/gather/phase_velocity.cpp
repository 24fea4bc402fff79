// SPDX-License-Identifier: BSD-3-Clause
#include "gather/phase_velocity.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <map>
#include <numbers>

#include "base/error.hpp"
#include "base/parse.hpp"

namespace slipwave {
namespace {

constexpr std::size_t usual_count = 200, most_count = 100000;

}  // namespace

std::vector<double> VelocityRange::values() const {
  std::vector<double> values;
  for (std::size_t n = 0; n < count; ++n)
    values.push_back(first + (last - first) * double(n) / double(std::max<std::size_t>(count, 2) - 1));
  if (values.size() > 1 && values.front() > values.back()) std::reverse(values.begin(), values.end());
  return values;
}

VelocityRange parse_velocity_range(std::string_view text) {
  const auto numbers = parse_numbers(text, ':');
  const auto fail = [&] {
    throw Error(
        "found '" + std::string(text) + "', expected V1:V2 or V1:V2:DV in m/s, of one sign, |V1| < |V2|",
        ErrorKind::usage);
  };
  if (numbers.size() != 2 && numbers.size() != 3) fail();
  VelocityRange range{numbers[0], numbers[1], usual_count};
  if (!(range.first * range.last > 0) || !(std::fabs(range.first) < std::fabs(range.last))) fail();
  if (numbers.size() == 2) return range;
  const double steps = std::fabs(range.last - range.first) / numbers[2];
  if (!(numbers[2] > 0) || !(steps < double(most_count))) fail();
  const auto whole = std::floor(steps * (1 + 1e-9));
  range.count = std::size_t(whole) + 1;
  range.last = range.first + std::copysign(whole * numbers[2], range.last);
  return range;
}

VelocityRange velocities_of_energy(const FkTransform& transform, std::span<const double> energy) {
  const auto k = transform.wavenumbers_per_m();
  const auto f = transform.frequencies_hz();
  std::map<double, double> ways[2];  // energy by velocity: towards growing positions, and falling ones
  double sums[2] = {0, 0};
  for (std::size_t j = 0; j < k.size(); ++j)
    for (std::size_t n = 1; n < f.size() && k[j] != 0; ++n) {
      const std::size_t way = k[j] > 0 ? 0 : 1;
      ways[way][f[n] / std::fabs(k[j])] += energy[j * f.size() + n];
      sums[way] += energy[j * f.size() + n];
    }
  const std::size_t way = sums[1] > sums[0] ? 1 : 0;
  if (!(sums[way] > 0))
    throw Error("has no waves along its receivers, expected some; give --velocities V1:V2");
  const auto below = [&](double share) {
    double sum = 0;
    for (const auto& [velocity, part] : ways[way])
      if ((sum += part) >= share * sums[way]) return velocity;
    return ways[way].rbegin()->first;
  };
  const double sign = way == 0 ? 1 : -1;
  const double low = below(0.01), high = below(0.99);
  return {sign * low, sign * std::max(high, 1.01 * low), usual_count};
}

PhaseVelocityTransform::PhaseVelocityTransform(const SampleAxis& axis, std::size_t receivers,
                                               double spacing_m, const SpectrumSettings& settings,
                                               std::vector<double> velocities)
    : interval_s_(axis.interval_s),
      spacing_m_(spacing_m),
      power_(settings.power),
      velocities_(std::move(velocities)),
      along_(window_weights(settings.window, std::size_t(std::max<std::int64_t>(axis.count, 0)))),
      across_(window_weights(settings.window, receivers)),
      transform_(padded_length(along_.size(), settings.pad)) {}

void PhaseVelocityTransform::add(std::span<const std::vector<double>> traces, std::span<double> sum) {
  const std::size_t bins = transform_.bins();
  if (traces.size() != across_.size() || sum.size() != velocities_.size() * bins)
    throw Error(std::to_string(traces.size()) + " traces, expected " + std::to_string(across_.size()));
  std::vector<std::complex<double>> spectra;
  std::vector<double> weighted(along_.size());
  for (std::size_t m = 0; m < traces.size(); ++m) {
    for (std::size_t n = 0; n < along_.size(); ++n) weighted[n] = across_[m] * along_[n] * traces[m][n];
    const auto spectrum = transform_.forward(weighted);
    spectra.insert(spectra.end(), spectrum.begin(), spectrum.end());
  }
  const double step_hz = 1 / (double(transform_.length()) * interval_s_);
  for (std::size_t row = 0; row < velocities_.size(); ++row)
    for (std::size_t n = 1; n < bins; ++n) {
      // exp(2 pi i k m dx) with k = f/c
      const auto turn =
          std::polar(1., 2 * std::numbers::pi * double(n) * step_hz / velocities_[row] * spacing_m_);
      std::complex<double> phase = 1, stacked = 0;
      for (std::size_t m = 0; m < traces.size(); ++m, phase *= turn) stacked += phase * spectra[m * bins + n];
      const double magnitude = interval_s_ * spacing_m_ * std::abs(stacked);
      sum[row * bins + n] +=
          power_ ? (2 * n == transform_.length() ? 1 : 2) * magnitude * magnitude : magnitude;
    }
}

}  // namespace slipwave
