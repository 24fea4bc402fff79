// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "base/fft.hpp"
#include "gather/trace.hpp"

namespace slipwave {

/// Weights put on the samples before the transform; not compensated for. The symmetric forms: the first and
/// last weights are equal.
enum class Window { none, hann, hamming, blackman, bartlett };

/// "none", "hann", ...: all names, for options.
std::vector<std::string> window_names();
const char* name_of(Window window);
/// Throws usage Error listing the names otherwise.
Window window_named(const std::string& name);
/// `count` weights.
std::vector<double> window_weights(Window window, std::size_t count);

struct SpectrumSettings {
  Window window = Window::none;
  double pad = 1;      // transform length over trace length, 1 to 1000: the rest is zeros
  bool power = false;  // energy density instead of amplitude
};

/// `pad` times `count`, rounded up; usage Error unless pad is 1 to 1000.
std::size_t padded_length(std::size_t count, double pad);

/// Spectra of traces of one sampling, at f_k = k / (length dt), k = 0 .. length/2:
///   amplitude  |F(f_k)|, F(f_k) = dt sum_n w_n x_n exp(-2 pi i f_k n dt), the Fourier integral's value;
///              unit u s = u/Hz
///   power      E_k = c_k |F(f_k)|^2, one-sided energy density, c = 2 (1 at 0 and at the Nyquist
///   frequency); unit u^2 s/Hz
/// Parseval: sum_k E_k df = sum_n (w_n x_n)^2 dt exactly, df = 1/(length dt).
class SpectrumTransform {
 public:
  /// Throws Error when the axis has no samples or interval, or pad is below 1.
  SpectrumTransform(const SampleAxis& axis, const SpectrumSettings& settings);

  std::size_t bins() const noexcept { return transform_.bins(); }
  std::size_t length() const noexcept { return transform_.length(); }
  double step_hz() const noexcept { return step_hz_; }
  std::vector<double> frequencies_hz() const;

  /// bins() values; the answer stays until the next call. Throws Error when samples.size() is not the axis'
  /// count.
  std::span<const double> of(std::span<const double> samples);

 private:
  double interval_s_;
  double step_hz_;
  bool power_;
  std::vector<double> weights_;
  RealTransform transform_;
  std::vector<double> weighted_;
  std::vector<double> values_;
};

/// Mean of spectra, bin by bin.
class SpectrumMean {
 public:
  void add(std::span<const double> spectrum);
  std::size_t count() const noexcept { return count_; }
  std::vector<double> mean() const;

 private:
  std::vector<double> sum_;
  std::size_t count_ = 0;
};

}  // namespace slipwave
