// SPDX-License-Identifier: BSD-3-Clause
#include "gather/comparison.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/error.hpp"

namespace slipwave {
namespace {

using Complex = std::complex<double>;

double ratio(double a, double b, double both_zero) {
  if (b > 0) return a / b;
  if (a == 0 && b == 0) return both_zero;
  return a > 0 ? std::numeric_limits<double>::infinity() : std::numeric_limits<double>::quiet_NaN();
}

/// First and second derivative by tau (in samples) of the correlation Re sum_k m_k S_k exp(2 pi i k tau/N),
/// m = 1, 2, 2, ..., 1.
struct Slope {
  double first = 0;
  double second = 0;
};

Slope slope_at(std::span<const Complex> cross, std::size_t length, double tau) {
  const double omega = 2 * std::numbers::pi / static_cast<double>(length);
  const Complex step = std::polar(1.0, omega * tau);
  Complex turn = 1;
  Slope slope;
  for (std::size_t k = 0; k < cross.size(); ++k, turn *= step) {
    const double twice = k == 0 || 2 * k == length ? 1 : 2;
    const double frequency = omega * static_cast<double>(k);
    const Complex value = twice * cross[k] * turn;
    slope.first -= frequency * value.imag();
    slope.second -= frequency * frequency * value.real();
  }
  return slope;
}

/// The maximum next to the whole sample `start`: Newton on the derivative, never further than one sample.
double refined(std::span<const Complex> cross, std::size_t length, double start) {
  double tau = start;
  for (int iteration = 0; iteration < 20; ++iteration) {
    const Slope slope = slope_at(cross, length, tau);
    if (!(slope.second < 0)) return tau;
    const double next = std::clamp(tau - slope.first / slope.second, start - 1, start + 1);
    if (std::fabs(next - tau) < 1e-9) return next;
    tau = next;
  }
  return tau;
}

}  // namespace

void Comparison::Sums::add(const Sums& other) {
  a2 += other.a2;
  b2 += other.b2;
  difference2 += other.difference2;
  peak_a = std::max(peak_a, other.peak_a);
  peak_b = std::max(peak_b, other.peak_b);
}

// Twice the length, so that the circular correlation of the transform is the plain one.
Comparison::Comparison(const SampleAxis& axis)
    : axis_(axis),
      transform_(fast_transform_length(2 * static_cast<std::size_t>(std::max<std::int64_t>(axis.count, 1)))) {
  cross_.resize(transform_.bins());
  cross_all_.resize(transform_.bins());
}

Misfit Comparison::add(std::span<const double> a, std::span<const double> b) {
  const auto count = static_cast<std::size_t>(axis_.count);
  if (a.size() != count || b.size() != count)
    throw Error(std::to_string(a.size()) + " and " + std::to_string(b.size()) + " samples, expected " +
                std::to_string(count) + " as in the first trace");
  Sums sums;
  for (std::size_t n = 0; n < count; ++n) {
    sums.a2 += a[n] * a[n];
    sums.b2 += b[n] * b[n];
    sums.difference2 += (a[n] - b[n]) * (a[n] - b[n]);
    sums.peak_a = std::max(sums.peak_a, std::fabs(a[n]));
    sums.peak_b = std::max(sums.peak_b, std::fabs(b[n]));
  }
  const auto of_a = transform_.forward(a);
  spectrum_a_.assign(of_a.begin(), of_a.end());
  const auto of_b = transform_.forward(b);
  for (std::size_t k = 0; k < cross_.size(); ++k) {
    cross_[k] = spectrum_a_[k] * std::conj(of_b[k]);
    cross_all_[k] += cross_[k];
  }
  all_.add(sums);
  return misfit_of(sums, cross_);
}

void Comparison::include(const Comparison& other) {
  all_.add(other.all_);
  for (std::size_t n = 0; n < cross_all_.size(); ++n) cross_all_[n] += other.cross_all_[n];
}

Misfit Comparison::overall() { return misfit_of(all_, cross_all_); }

Misfit Comparison::misfit_of(const Sums& sums, std::span<const Complex> cross) {
  Misfit misfit;
  misfit.nrms_percent = 200 * ratio(std::sqrt(sums.difference2), std::sqrt(sums.a2) + std::sqrt(sums.b2), 0);
  misfit.relative_l2 = ratio(std::sqrt(sums.difference2), std::sqrt(sums.b2), 0);
  misfit.peak_ratio = ratio(sums.peak_a, sums.peak_b, 1);
  misfit.lag_s = sums.a2 > 0 && sums.b2 > 0 ? lag_of(cross) : std::numeric_limits<double>::quiet_NaN();
  return misfit;
}

double Comparison::lag_of(std::span<const Complex> cross) {
  const auto correlation = transform_.backward(cross);
  const auto best = std::max_element(correlation.begin(), correlation.end()) - correlation.begin();
  const auto length = static_cast<std::ptrdiff_t>(transform_.length());
  const auto lag = best < length / 2 ? best : best - length;
  return refined(cross, transform_.length(), static_cast<double>(lag)) * axis_.interval_s;
}

}  // namespace slipwave
