// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <complex>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "base/fft.hpp"

namespace slipwave {

/// Weights of a filter: values[j] belongs to the lag of first_lag + j samples, other lags weigh nothing.
struct Kernel {
  std::vector<double> values;
  std::int64_t first_lag = 0;
};

/// What a function of time h does to samples every interval_s, that is h(l interval) interval for all lags l
/// with from_s <= l interval <= to_s (to 1e-9 of an interval). Throws Error when there are more than 2^31.
Kernel sampled_kernel(const std::function<double(double t_s)>& h, double from_s, double to_s,
                      double interval_s);

/// Convolves traces of one length with a kernel:
///   y_n = sum_m h_(n-m) x_m,   n, m = 0 .. count-1,
/// the trace being zero before its first and after its last sample: nothing wraps round.
class Convolution {
 public:
  /// count >= 1. Throws Error when the transform would be longer than 2^31.
  Convolution(std::size_t count, const Kernel& kernel);

  /// In place; throws Error when samples.size() is not count.
  void apply(std::span<double> samples);

 private:
  std::size_t count_;
  RealTransform transform_;
  std::vector<std::complex<double>> response_;
  std::vector<std::complex<double>> spectrum_;
};

}  // namespace slipwave
