// SPDX-License-Identifier: BSD-3-Clause
#include "acquisition/wavelet.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <numbers>

#include "base/fft.hpp"

namespace slipwave {

namespace {

constexpr double pi = std::numbers::pi;

double squared(double x) { return x * x; }

/// sin(pi x)/(pi x)
double sinc(double x) { return std::abs(x) < 1e-8 ? 1 : std::sin(pi * x) / (pi * x); }

/// A wavelet from its beginning to its end, at equal intervals so short that nothing of note lies above half
/// the sampling frequency.
template <class Shape>
std::vector<double> fine_samples(const Shape& shape) {
  const double interval = shape.fine_interval_s();
  const auto count = std::size_t(std::ceil((shape.duration_s() - shape.start_s()) / interval)) + 1;
  std::vector<double> samples(count);
  for (std::size_t n = 0; n < count; ++n) {
    const double t = shape.start_s() + double(n) * interval;
    if (t <= shape.duration_s()) samples[n] = shape.value(t);
  }
  return samples;
}

/// Energy in frequency bins of equal width.
struct EnergySpectrum {
  std::vector<double> energy;
  double bin_hz = 0;
};

template <class Shape>
EnergySpectrum energy_spectrum(const Shape& shape) {
  const auto samples = fine_samples(shape);
  // Zeros behind the samples make the bins narrow; a wavelet that is long has narrow ones anyway.
  std::size_t length = 1;
  while (length < samples.size() * (samples.size() < 100000 ? 16 : 2)) length *= 2;
  RealTransform transform(length);
  EnergySpectrum spectrum{{}, 1 / (double(length) * shape.fine_interval_s())};
  for (const auto& amplitude : transform.forward(samples)) spectrum.energy.push_back(std::norm(amplitude));
  return spectrum;
}

}  // namespace

namespace shape {

double Ricker::value(double t_s) const {
  const double a2 = squared(pi * peak_hz * (t_s - delay_s()));
  return (1 - 2 * a2) * std::exp(-a2);
}

double Ricker::amplitude_spectrum(double hz) const {
  const double ratio2 = squared(hz / peak_hz);
  return 2 / std::sqrt(pi) / peak_hz * ratio2 * std::exp(-ratio2);
}

double Gaussian::value(double t_s) const { return std::exp(-squared(pi * frequency_hz * (t_s - delay_s()))); }

double Gaussian::amplitude_spectrum(double hz) const {
  return 1 / std::sqrt(pi) / frequency_hz * std::exp(-squared(hz / frequency_hz));
}

double Sine::value(double t_s) const { return std::sin(2 * pi * frequency_hz * t_s); }

double Sine::amplitude_spectrum(double hz) const {
  return frequency_hz * duration_s() / (frequency_hz + std::abs(hz)) *
         std::abs(sinc((std::abs(hz) - frequency_hz) * duration_s()));
}

Sampled::Sampled(std::vector<double> times_s, std::vector<double> values, double delay_s)
    : times_s_(std::move(times_s)), values_(std::move(values)), delay_s_(delay_s) {
  // Second derivatives of the natural cubic spline: a tridiagonal system, solved by elimination.
  const std::size_t n = times_s_.size();
  bend_.assign(n, 0);
  std::vector<double> upper(n, 0);
  for (std::size_t i = 1; i + 1 < n; ++i) {
    const double before = times_s_[i] - times_s_[i - 1], after = times_s_[i + 1] - times_s_[i];
    const double load = 6 * ((values_[i + 1] - values_[i]) / after - (values_[i] - values_[i - 1]) / before);
    const double pivot = 2 * (before + after) - before * upper[i - 1];
    upper[i] = after / pivot;
    bend_[i] = (load - before * bend_[i - 1]) / pivot;
  }
  for (std::size_t i = n - 1; i-- > 1;) bend_[i] -= upper[i] * bend_[i + 1];
}

double Sampled::value(double t_s) const {
  if (t_s < times_s_.front() || t_s > times_s_.back()) return 0;
  const auto above = std::upper_bound(times_s_.begin(), times_s_.end() - 1, t_s);
  const auto i = std::size_t(above - times_s_.begin()) - 1;
  const double width = times_s_[i + 1] - times_s_[i];
  const double b = (t_s - times_s_[i]) / width, a = 1 - b;
  return a * values_[i] + b * values_[i + 1] +
         (a * (a * a - 1) * bend_[i] + b * (b * b - 1) * bend_[i + 1]) * squared(width) / 6;
}

double Sampled::fine_interval_s() const {
  return (times_s_.back() - times_s_.front()) / double(4 * (times_s_.size() - 1));
}

double Sampled::nominal_hz() const {
  const auto spectrum = energy_spectrum(*this);
  const auto largest = std::max_element(spectrum.energy.begin(), spectrum.energy.end());
  return double(largest - spectrum.energy.begin()) * spectrum.bin_hz;
}

double Sampled::amplitude_spectrum(double hz) const {
  const auto samples = fine_samples(*this);
  const double interval = fine_interval_s();
  std::complex<double> sum = 0;
  for (std::size_t n = 0; n < samples.size(); ++n)
    sum += samples[n] * std::polar(1., -2 * pi * hz * double(n) * interval);
  return std::abs(sum) * interval;
}

}  // namespace shape

double Wavelet::operator()(double t_s) const {
  return std::visit(
      [&](const auto& shape) { return t_s < 0 || t_s > shape.duration_s() ? 0. : shape.value(t_s); }, shape_);
}

double Wavelet::delay_s() const {
  return std::visit([](const auto& shape) { return shape.delay_s(); }, shape_);
}

double Wavelet::duration_s() const {
  return std::visit([](const auto& shape) { return shape.duration_s(); }, shape_);
}

double Wavelet::nominal_hz() const {
  return std::visit([](const auto& shape) { return shape.nominal_hz(); }, shape_);
}

double Wavelet::amplitude_spectrum(double hz) const {
  return std::visit([&](const auto& shape) { return shape.amplitude_spectrum(hz); }, shape_);
}

double Wavelet::highest_frequency_hz(double share) const {
  const auto spectrum = std::visit([](const auto& shape) { return energy_spectrum(shape); }, shape_);
  double total = 0;
  for (const double energy : spectrum.energy) total += energy;
  double above = 0;
  for (std::size_t k = spectrum.energy.size(); k-- > 0;) {
    above += spectrum.energy[k];
    if (above > share * share * total) return double(k) * spectrum.bin_hz;
  }
  return 0;
}

}  // namespace slipwave
