// SPDX-License-Identifier: BSD-3-Clause
#include "gather/resampling.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "base/error.hpp"

namespace slipwave {
namespace {

constexpr double half_width = 32;  // in intervals of the coarser sampling
constexpr double kaiser = 10.06;
constexpr std::int64_t most_phases = 65536;
constexpr double most_samples = 2147483647.0;

/// h at a distance in intervals of the coarser sampling.
double kernel(double distance) {
  const double reach = distance / half_width;
  if (std::fabs(reach) > 1) return 0;
  const double arm = std::numbers::pi * 0.9 * distance;
  const double sinc = std::fabs(arm) < 1e-8 ? 1 : std::sin(arm) / arm;
  return sinc * std::cyl_bessel_i(0.0, kaiser * std::sqrt(1 - reach * reach));
}

/// After how many new samples the places among the old ones repeat; `count`, all of them, where they do not.
std::int64_t phases_of(double ratio, std::int64_t count) {
  for (std::int64_t phases = 1; phases < std::min(count, most_phases); ++phases) {
    const double span = ratio * static_cast<double>(phases);
    const double periods = static_cast<double>(count) / static_cast<double>(phases);
    if (span >= 0.5 && std::fabs(span - std::nearbyint(span)) * periods < 1e-6) return phases;
  }
  return count;
}

SampleAxis resampled(const SampleAxis& from, double interval_s) {
  if (!(interval_s > 0))
    throw Error("found " + shown(interval_s) + " s, expected an interval above 0", ErrorKind::usage);
  if (!(from.interval_s > 0) || from.count < 1)
    throw Error("found " + std::to_string(from.count) + " samples of " + shown(from.interval_s) +
                " s, expected at least one and an interval above 0");
  const double last = std::floor(static_cast<double>(from.count - 1) * from.interval_s / interval_s + 1e-6);
  if (!(last < most_samples))
    throw Error("resampling to " + shown(interval_s) + " s makes " + shown(last + 1) +
                    " samples, expected at most 2147483647",
                ErrorKind::usage);
  return {static_cast<std::int64_t>(last) + 1, interval_s, from.start_s};
}

/// Four sums side by side: additions need not wait for each other, and their order is always the same.
double product(const double* a, const double* b, std::int64_t count) {
  std::array<double, 4> sums{};
  std::int64_t n = 0;
  for (; n + 4 <= count; n += 4)
    for (std::int64_t lane = 0; lane < 4; ++lane)
      sums[static_cast<std::size_t>(lane)] += a[n + lane] * b[n + lane];
  for (; n < count; ++n) sums[0] += a[n] * b[n];
  return (sums[0] + sums[1]) + (sums[2] + sums[3]);
}

}  // namespace

Resampling::Resampling(const SampleAxis& from, double interval_s)
    : from_(from), to_(resampled(from, interval_s)), ratio_(interval_s / from.interval_s) {
  const std::int64_t phases = phases_of(ratio_, to_.count);
  if (phases < to_.count)  // exactly the same places in every period
    ratio_ = std::nearbyint(ratio_ * static_cast<double>(phases)) / static_cast<double>(phases);
  const double coarse = std::max(1.0, ratio_);
  for (std::int64_t phase = 0; phase < phases; ++phase) {
    const double place = ratio_ * static_cast<double>(phase);
    const auto first = static_cast<std::int64_t>(std::ceil(place - half_width * coarse));
    const auto last = static_cast<std::int64_t>(std::floor(place + half_width * coarse));
    Row row{first, {}};
    double sum = 0;
    for (std::int64_t m = first; m <= last; ++m) {
      row.weights.push_back(kernel((place - static_cast<double>(m)) / coarse));
      sum += row.weights.back();
    }
    for (double& weight : row.weights) weight /= sum;
    rows_.push_back(std::move(row));
  }
}

std::vector<double> Resampling::of(std::span<const double> samples) const {
  if (static_cast<std::int64_t>(samples.size()) != from_.count)
    throw Error(std::to_string(samples.size()) + " samples, expected " + std::to_string(from_.count) +
                " as in the first trace");
  std::vector<double> result(static_cast<std::size_t>(to_.count));
  const auto phases = static_cast<std::int64_t>(rows_.size());
  const auto period = static_cast<std::int64_t>(std::llround(ratio_ * static_cast<double>(phases)));
  for (std::int64_t n = 0; n < to_.count; ++n) {
    const Row& row = rows_[static_cast<std::size_t>(n % phases)];
    const std::int64_t first = row.first + n / phases * period;
    const std::int64_t begin = std::max<std::int64_t>(first, 0);
    const std::int64_t end =
        std::min<std::int64_t>(first + static_cast<std::int64_t>(row.weights.size()), from_.count);
    if (begin < end)
      result[static_cast<std::size_t>(n)] =
          product(samples.data() + begin, row.weights.data() + (begin - first), end - begin);
  }
  return result;
}

}  // namespace slipwave
