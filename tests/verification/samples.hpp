// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "gather/trace.hpp"

namespace slipwave::solver {

/// Those of all traces, one after the other.
inline std::vector<double> samples_of(const Gather& gather) {
  std::vector<double> all;
  for (const auto& trace : gather.traces) all.insert(all.end(), trace.samples.begin(), trace.samples.end());
  return all;
}

/// Of two records, over the largest sample of the second.
inline double largest_difference(const std::vector<double>& one, const std::vector<double>& other) {
  double largest = 0, scale = 0;
  for (std::size_t n = 0; n < one.size(); ++n) {
    largest = std::max(largest, std::abs(one[n] - other[n]));
    scale = std::max(scale, std::abs(other[n]));
  }
  return largest / scale;
}

}  // namespace slipwave::solver
