// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "gather/band_pass.hpp"
#include "gather/convolution.hpp"
#include "gather/gain.hpp"
#include "gather/resampling.hpp"
#include "gather/taper.hpp"
#include "gather/trace.hpp"

namespace slipwave {

/// What is done to traces, in this order; what is absent is left out.
struct FilterSteps {
  std::optional<TaperLengths> taper;
  std::optional<Kernel> convolution;
  std::optional<Ormsby> band;
  std::optional<double> interval_s;  // of the resampled trace
  std::vector<Gain> gains;           // one after the other
};

/// Carries steps out on traces of one sampling.
class TraceFilter {
 public:
  /// Throws usage Error when a step does not suit the sampling.
  TraceFilter(const SampleAxis& axis, FilterSteps steps);

  /// Returns the sample axis of what comes out.
  const SampleAxis& axis() const noexcept { return to_; }
  /// `start_s` is the time of the first sample. Throws Error naming the sample (from 1) that is not finite,
  /// or when there are more or fewer than the axis has.
  void apply(std::vector<double>& samples, double start_s);

 private:
  SampleAxis from_, to_;
  std::vector<double> taper_;
  std::vector<Convolution> convolutions_;
  std::optional<Resampling> resampling_;
  Gains gains_;
};

}  // namespace slipwave
