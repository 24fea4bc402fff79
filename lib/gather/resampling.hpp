// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "gather/trace.hpp"

namespace slipwave {

/// Puts traces on other sample times by band-limited interpolation. With N the lower one of the two Nyquist
/// frequencies and D the larger one of the two intervals, the kernel is a windowed sinc,
///   y(t) = sum_m x_m h(t - t_m) / sum_m h(t - t_m),
///   h(t) = sinc(1.8 N t) I0(b sqrt(1 - (t/32D)^2)), zero beyond 32 D,  b = 10.06 (Kaiser, 100 dB).
/// Frequencies up to 0.8 N stay as they are to 2e-5; what lies above N, which would alias, is removed to
/// 2e-5. Constants stay exactly. The first sample keeps its time; the last one is not later than it was. The
/// trace is zero before and after itself, as far as its samples are concerned: within 32 D of its ends a
/// trace that does not end at zero is bent towards zero.
class Resampling {
 public:
  /// Throws Error when the interval is not above 0 or there would be more than 2^31 samples.
  Resampling(const SampleAxis& from, double interval_s);

  const SampleAxis& axis() const noexcept { return to_; }
  /// axis().count samples for as many as `from` has; throws Error when there are others.
  std::vector<double> of(std::span<const double> samples) const;

 private:
  /// Weights of the input samples from `first` on, relative to the sample at or before the new time.
  struct Row {
    std::int64_t first = 0;
    std::vector<double> weights;
  };

  SampleAxis from_, to_;
  double ratio_;           // new interval in old ones
  std::vector<Row> rows_;  // one for each phase: new sample n takes rows_[n % rows_.size()]
};

}  // namespace slipwave
