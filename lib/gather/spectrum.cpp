// SPDX-License-Identifier: BSD-3-Clause
#include "gather/spectrum.hpp"

#include <cmath>
#include <complex>
#include <numbers>

#include "base/error.hpp"

namespace slipwave {
namespace {

struct WindowRow {
  Window window;
  const char* name;
  double a0, a1, a2;  // a0 - a1 cos(2 pi n/(N-1)) + a2 cos(4 pi n/(N-1))
};

constexpr WindowRow windows[] = {
    {Window::none, "none", 1, 0, 0},
    {Window::hann, "hann", 0.5, 0.5, 0},
    {Window::hamming, "hamming", 0.54, 0.46, 0},
    {Window::blackman, "blackman", 0.42, 0.5, 0.08},
    {Window::bartlett, "bartlett", 0, 0, 0},
};

std::size_t transform_length(const SampleAxis& axis, double pad) {
  if (axis.count < 1 || !(axis.interval_s > 0))
    throw Error("a spectrum of " + std::to_string(axis.count) + " samples every " + shown(axis.interval_s) +
                " s, expected at least one sample and an interval above 0");
  return padded_length(static_cast<std::size_t>(axis.count), pad);
}

}  // namespace

std::size_t padded_length(std::size_t count, double pad) {
  if (!(pad >= 1 && pad <= 1000))
    throw Error("zero padding of " + shown(pad) + " times the trace, expected 1 to 1000", ErrorKind::usage);
  return static_cast<std::size_t>(std::ceil(pad * static_cast<double>(count)));
}

std::vector<std::string> window_names() {
  std::vector<std::string> names;
  for (const WindowRow& row : windows) names.emplace_back(row.name);
  return names;
}

const char* name_of(Window window) {
  for (const WindowRow& row : windows)
    if (row.window == window) return row.name;
  return windows[0].name;
}

Window window_named(const std::string& name) {
  std::string known;
  for (const WindowRow& row : windows) {
    if (name == row.name) return row.window;
    known += (known.empty() ? "" : ", ") + std::string(row.name);
  }
  throw Error("window \"" + name + "\", expected one of " + known, ErrorKind::usage);
}

std::vector<double> window_weights(Window window, std::size_t count) {
  std::vector<double> weights(count, 1.0);
  if (window == Window::none || count < 2) return weights;
  const double last = static_cast<double>(count - 1);
  for (std::size_t n = 0; n < count; ++n) {
    const double at = static_cast<double>(n) / last;
    if (window == Window::bartlett) {
      weights[n] = 1 - std::fabs(2 * at - 1);
      continue;
    }
    for (const WindowRow& row : windows)
      if (row.window == window)
        weights[n] = row.a0 - row.a1 * std::cos(2 * std::numbers::pi * at) +
                     row.a2 * std::cos(4 * std::numbers::pi * at);
  }
  return weights;
}

SpectrumTransform::SpectrumTransform(const SampleAxis& axis, const SpectrumSettings& settings)
    : interval_s_(axis.interval_s),
      step_hz_(0),
      power_(settings.power),
      weights_(),
      transform_(transform_length(axis, settings.pad)) {
  weights_ = window_weights(settings.window, static_cast<std::size_t>(axis.count));
  step_hz_ = 1 / (static_cast<double>(length()) * interval_s_);
  weighted_.resize(weights_.size());
  values_.resize(bins());
}

std::vector<double> SpectrumTransform::frequencies_hz() const {
  std::vector<double> frequencies(bins());
  for (std::size_t k = 0; k < bins(); ++k)
    frequencies[k] = static_cast<double>(k) / (static_cast<double>(length()) * interval_s_);
  return frequencies;
}

std::span<const double> SpectrumTransform::of(std::span<const double> samples) {
  if (samples.size() != weights_.size())
    throw Error(std::to_string(samples.size()) + " samples, expected " + std::to_string(weights_.size()) +
                " as in the first trace");
  for (std::size_t n = 0; n < samples.size(); ++n) weighted_[n] = weights_[n] * samples[n];
  const auto spectrum = transform_.forward(weighted_);
  for (std::size_t k = 0; k < bins(); ++k) {
    const double magnitude = interval_s_ * std::abs(spectrum[k]);
    const bool alone = k == 0 || 2 * k == length();  // no partner at the negative frequency
    values_[k] = power_ ? (alone ? 1 : 2) * magnitude * magnitude : magnitude;
  }
  return values_;
}

void SpectrumMean::add(std::span<const double> spectrum) {
  if (count_ == 0) sum_.assign(spectrum.size(), 0.0);
  if (spectrum.size() != sum_.size())
    throw Error("a spectrum of " + std::to_string(spectrum.size()) + " frequencies, expected " +
                std::to_string(sum_.size()));
  for (std::size_t k = 0; k < sum_.size(); ++k) sum_[k] += spectrum[k];
  ++count_;
}

std::vector<double> SpectrumMean::mean() const {
  std::vector<double> mean = sum_;
  for (double& value : mean) value /= static_cast<double>(count_);
  return mean;
}

}  // namespace slipwave
