// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <complex>
#include <cstddef>
#include <span>
#include <vector>

#include "base/fft.hpp"
#include "gather/trace.hpp"

namespace slipwave {

/// How a differs from b.
struct Misfit {
  double nrms_percent = 0;  // 200 rms(a - b) / (rms(a) + rms(b)): 0 equal, 200 opposite
  double relative_l2 = 0;   // |a - b| / |b|; 0 when both are zero, infinite when only b is
  double peak_ratio = 1;    // max |a| / max |b|, likewise (1 when both are zero)
  double lag_s = 0;         // a(t + lag) fits b(t) best: above 0 when a comes later; NaN when either is zero
};

/// Compares traces pair by pair and all together. The lag is where the cross-correlation, summed over the
/// traces for the whole, is largest, found between the samples by band-limited interpolation.
class Comparison {
 public:
  /// For traces of that sampling.
  explicit Comparison(const SampleAxis& axis);

  /// The misfit of one pair; throws Error when the lengths are not the axis'.
  Misfit add(std::span<const double> a, std::span<const double> b);
  /// Takes in all pairs that another comparison of the same sampling has seen.
  void include(const Comparison& other);
  /// The misfit of all pairs so far as if they were one long trace.
  Misfit overall();

 private:
  /// Sums over samples, of a pair or of all.
  struct Sums {
    double a2 = 0, b2 = 0, difference2 = 0, peak_a = 0, peak_b = 0;
    void add(const Sums& other);
  };
  Misfit misfit_of(const Sums& sums, std::span<const std::complex<double>> cross);
  double lag_of(std::span<const std::complex<double>> cross);

  SampleAxis axis_;
  RealTransform transform_;
  std::vector<std::complex<double>> spectrum_a_;
  std::vector<std::complex<double>> cross_;
  std::vector<std::complex<double>> cross_all_;
  Sums all_;
};

}  // namespace slipwave
