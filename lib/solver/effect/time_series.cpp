// SPDX-License-Identifier: BSD-3-Clause
#include "solver/effect/time_series.hpp"

#include <algorithm>

#include "base/instantiate.hpp"
#include "solver/kernels/kernels.hpp"

namespace slipwave::solver {

template <class Real>
void TimeSeries::values(double t_s, double step_s, std::int64_t first, std::int64_t count, Real* to) const {
  if (samples_.size() < 6) {
    std::fill(to, to + count, Real(0));
    return;
  }
  // Whole blocks, whatever the piece: its last cells would round differently.
  constexpr std::int64_t block = 16;
  const double place = (t_s - first_s_) / interval_s_, step = step_s / interval_s_;
  for (auto from = first / block * block; from < first + count; from += block) {
    Real values[block];
    interpolation_kernel<Real>()(block, samples_.data(), std::int64_t(samples_.size()), place, step, from,
                                 values);
    const auto begin = std::max(from, first), end = std::min(from + block, first + count);
    std::copy(values + (begin - from), values + (end - from), to + (begin - first));
  }
}

SLIPWAVE_INSTANTIATE_REAL(FUNCTION, TimeSeries::values);

}  // namespace slipwave::solver
