// SPDX-License-Identifier: BSD-3-Clause
#include "solver/effect/stack_series.hpp"

#include <algorithm>
#include <utility>

namespace slipwave::solver {
namespace {

/// What comes later than the window has decayed by this.
constexpr double left_over = 1e-3;

double interval_for(const Wavelet& wavelet) {
  constexpr double per_shortest_period = 14;
  return 1 / (per_shortest_period * wavelet.highest_frequency_hz(0.01));
}

}  // namespace

StackSeries::StackSeries(std::vector<StackWave> waves,
                         const std::function<std::vector<Complex>(Complex omega)>& solve,
                         const Wavelet& wavelet, double amplitude, const SeriesWindow& window)
    : waves_(std::move(waves)),
      interval_s_(interval_for(wavelet)),
      first_s_(window.first_s),
      last_s_(window.last_s),
      length_(fast_transform_length(
          std::size_t((2 * (last_s_ - first_s_) + 2 * wavelet.duration_s()) / interval_s_) + 16)),
      bins_(length_ / 2 + 1),
      transform_(length_),
      largest_(std::abs(amplitude)) {
  const double window_s = double(length_) * interval_s_;
  decay_ = -std::log(left_over) / window_s;
  std::vector<double> samples;
  for (double t = 0; t <= wavelet.duration_s() && samples.size() < length_; t += interval_s_)
    samples.push_back(wavelet(t) * std::exp(-decay_ * t));
  const auto spectrum = transform_.forward(samples);
  source_.assign(spectrum.begin(), spectrum.end());
  for (std::size_t bin = 0; bin < bins_; ++bin) {
    const Complex omega(2 * std::numbers::pi * double(bin) / window_s, -decay_);
    source_[bin] *= amplitude * std::exp(Complex(0, -1) * omega * (window.arrival_s - first_s_));
    amplitudes_.push_back(solve(omega));
  }
}

TimeSeries StackSeries::series_of(const std::vector<Complex>& spectrum) {
  double first_s = 0;
  auto samples = samples_of(spectrum, first_s);
  return {std::move(samples), first_s, interval_s_};
}

/// Up to the last time needed, without what is next to nothing before and after.
std::vector<float> StackSeries::samples_of(const std::vector<Complex>& spectrum, double& first_s) {
  constexpr double nothing = 1e-8;
  constexpr std::size_t beside = 6;
  const auto all = transform_.backward(spectrum);
  const auto count = std::min(length_, std::size_t((last_s_ - first_s_) / interval_s_) + 2 * beside);
  std::vector<float> samples;
  double largest = 0;
  for (std::size_t n = 0; n < count; ++n) {
    samples.push_back(float(all[n] * std::exp(decay_ * double(n) * interval_s_)));
    largest = std::max(largest, std::abs(double(samples.back())));
  }
  const auto counts = [&](float value) {
    return std::abs(double(value)) > nothing * std::max(largest, largest_);
  };
  const auto first = std::find_if(samples.begin(), samples.end(), counts);
  const auto last = std::find_if(samples.rbegin(), std::make_reverse_iterator(first), counts).base();
  const auto skipped = std::max<std::int64_t>(first - samples.begin() - std::int64_t(beside), 0);
  const auto end =
      std::min<std::int64_t>(last - samples.begin() + std::int64_t(beside), std::int64_t(samples.size()));
  first_s = first_s_ + double(skipped) * interval_s_;
  if (first == samples.end()) return {};
  return {samples.begin() + skipped, samples.begin() + end};
}

}  // namespace slipwave::solver
