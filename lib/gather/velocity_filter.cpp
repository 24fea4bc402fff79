// SPDX-License-Identifier: BSD-3-Clause
#include "gather/velocity_filter.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "base/error.hpp"
#include "base/parse.hpp"

namespace slipwave {
namespace {

/// 0 below the first and above the last of four ends, 1 between the middle ones, linear between.
double trapezoid(const std::array<double, 4>& ends, double value) {
  if (value < ends[0] || value > ends[3]) return 0;
  if (value < ends[1]) return (value - ends[0]) / (ends[1] - ends[0]);
  if (value > ends[2]) return std::isinf(ends[3]) ? 1 : (ends[3] - value) / (ends[3] - ends[2]);
  return 1;
}

/// Points over the width of a bin at which its weight is taken: an edge within it counts by its share.
constexpr int points_a_bin = 8;

}  // namespace

VelocityFan parse_velocity_fan(std::string_view text) {
  const auto fail = [&] {
    throw Error(
        "found '" + std::string(text) +
            "', expected V1,V2 or V1,V2,V3,V4 in m/s, none below the one before it, without signs, or "
            "all of them with + or -",
        ErrorKind::usage);
  };
  const auto parts = split(text, ',');
  if (parts.size() != 2 && parts.size() != 4) fail();
  std::vector<double> values;
  std::array<int, 3> signs{};
  for (std::string_view part : parts) {
    const int sign = part.starts_with('+') ? 2 : part.starts_with('-') ? 0 : 1;
    ++signs[std::size_t(sign)];
    if (sign != 1) part.remove_prefix(1);
    values.push_back(part == "inf" ? std::numeric_limits<double>::infinity() : parse_number(part));
  }
  const auto sign = std::find(signs.begin(), signs.end(), int(parts.size()));
  const bool growing =
      std::is_sorted(values.begin(), values.end()) && values.front() >= 0 && values.back() > 0;
  if (sign == signs.end() || !growing || std::isinf(values.front())) fail();
  VelocityFan fan;
  fan.way = int(sign - signs.begin()) - 1;
  if (values.size() == 2)
    fan.v = {values[0], values[0], values[1], values[1]};
  else
    std::copy(values.begin(), values.end(), fan.v.begin());
  return fan;
}

std::array<double, 4> parse_wavenumber_band(std::string_view text) {
  const auto numbers = parse_numbers(text, ',');
  if (numbers.size() != 4 || !std::is_sorted(numbers.begin(), numbers.end()) || numbers[0] < 0 ||
      !(numbers[3] > 0))
    throw Error("found '" + std::string(text) +
                    "', expected K1,K2,K3,K4 in 1/m from 0 on, none below the one before it",
                ErrorKind::usage);
  return {numbers[0], numbers[1], numbers[2], numbers[3]};
}

double FkFilterSettings::weight(double k, double f) const {
  double kept = 1;
  if (fan) {
    const double velocity = k == 0 ? std::numeric_limits<double>::infinity() : f / std::fabs(k);
    const bool other_way = k != 0 && fan->way != 0 && (k > 0) != (fan->way > 0);
    kept *= other_way ? 0 : trapezoid(fan->v, velocity);
  }
  if (wavenumbers_per_m) kept *= trapezoid(*wavenumbers_per_m, std::fabs(k));
  return reject ? 1 - kept : kept;
}

FkFilter::FkFilter(const SampleAxis& axis, std::size_t receivers, double spacing_m,
                   const FkFilterSettings& settings)
    : receivers_(receivers),
      spacing_m_(spacing_m),
      transform_(fast_transform_length(2 * receivers), fast_transform_length(2 * std::size_t(axis.count))) {
  const double highest_per_m = 0.5 / spacing_m;
  if (settings.wavenumbers_per_m && settings.wavenumbers_per_m->back() > highest_per_m)
    throw Error("found K4 = " + shown(settings.wavenumbers_per_m->back()) +
                    " 1/m, expected at most the Nyquist wavenumber " + shown(highest_per_m) +
                    " 1/m of receivers every " + shown(spacing_m) + " m",
                ErrorKind::usage);
  const std::size_t rows = transform_.rows(), bins = transform_.bins();
  const double step_per_m = 1 / (double(rows) * spacing_m);
  const double step_hz = 1 / (double(transform_.length()) * axis.interval_s);
  weights_.resize(rows * bins);
  for (std::size_t j = 0; j < rows; ++j) {
    // the transform's exponent is negative along both axes: its row j is the wavenumber -j
    const double k = -(2 * j <= rows ? double(j) : double(j) - double(rows)) * step_per_m;
    for (std::size_t n = 0; n < bins; ++n) {
      double sum = 0;
      for (int point = 0; point < points_a_bin; ++point)
        sum += settings.weight(k + ((point + 0.5) / points_a_bin - 0.5) * step_per_m, double(n) * step_hz);
      weights_[j * bins + n] = sum / points_a_bin;
    }
  }
}

void FkFilter::apply(std::span<std::vector<double>* const> traces) {
  if (traces.size() != receivers_)
    throw Error(std::to_string(traces.size()) + " traces, expected " + std::to_string(receivers_));
  transform_.clear();
  for (std::size_t m = 0; m < traces.size(); ++m)
    std::copy(traces[m]->begin(), traces[m]->end(), transform_.samples(m).begin());
  transform_.forward();
  const std::size_t bins = transform_.bins();
  for (std::size_t j = 0; j < transform_.rows(); ++j) {
    const auto spectrum = transform_.spectrum(j);
    for (std::size_t n = 0; n < bins; ++n) spectrum[n] *= weights_[j * bins + n];
  }
  transform_.backward();
  for (std::size_t m = 0; m < traces.size(); ++m) {
    const auto samples = transform_.samples(m);
    std::copy(samples.begin(), samples.begin() + std::ptrdiff_t(traces[m]->size()), traces[m]->begin());
  }
}

}  // namespace slipwave
