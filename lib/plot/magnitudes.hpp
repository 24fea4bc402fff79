// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace slipwave::plot {

/// How large numbers are, whatever their sign: percentiles of any count of them in the memory of a histogram.
class Magnitudes {
 public:
  Magnitudes();
  /// Zeros, NaN and infinities are left out: what is still should not set the scale.
  void add(std::span<const float> values);
  /// The magnitude below which `percent` of what was added lie, within 0.4 %; 100: the largest exactly. 0
  /// when nothing was added. 0 < percent <= 100.
  double percentile(double percent) const;
  double largest() const { return largest_; }
  /// With their signs; 0 when nothing was added.
  double lowest() const { return count_ > 0 ? double(lowest_) : 0; }
  double highest() const { return count_ > 0 ? double(highest_) : 0; }

 private:
  std::vector<std::int64_t> counts_;  // by exponent and first 8 bits of the fraction
  std::int64_t count_ = 0;
  float largest_ = 0;
  float lowest_ = std::numeric_limits<float>::max(), highest_ = std::numeric_limits<float>::lowest();
};

}  // namespace slipwave::plot
