// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

namespace slipwave::solver {

/// Steps of which series are weighed together: the widest vector of doubles.
inline constexpr int steps_together = 8;
/// Values are brought together by so many.
inline constexpr std::int64_t values_together = 16;

/// Values next to each other that a series has weights for.
struct SeriesTerm {
  std::int64_t value, count;
};

/// Loops of what receivers record (Recorder). Sums are rounded alike by all instruction sets.
template <class Real>
struct SeriesKernels {
  /// Brings rows of n values, one row a step and n a multiple of values_together, together: [value][step].
  void (*bring_together)(std::int64_t n, const Real* const* steps, double* together);
  /// sums[step] = factor times the sum of weights times values over these terms, whose weights follow each
  /// other.
  void (*weigh)(const double* together, const SeriesTerm* first, const SeriesTerm* last,
                const double* weights, double factor, double* sums);
  /// sums[i] = sum of weights[k] rows[k][i] over k = 0 .. count-1, in this order.
  void (*combine)(std::int64_t n, int count, const double* weights, const double* const* rows, double* sums);
};

/// Returns the loops for the best instruction set of this processor.
template <class Real>
const SeriesKernels<Real>& series_kernels();

}  // namespace slipwave::solver
