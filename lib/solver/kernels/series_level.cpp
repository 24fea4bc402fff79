// SPDX-License-Identifier: BSD-3-Clause
// The inner loops of records, compiled once for each instruction set as kernels_level.cpp is, but with every
// product rounded: traces depend on the instruction set by the fields alone.
#include <cstring>

#include "solver/kernels/series_kernels.hpp"

namespace slipwave::solver {

const SeriesKernels<float>& SLIPWAVE_SERIES_LEVEL(float);
const SeriesKernels<double>& SLIPWAVE_SERIES_LEVEL(double);

namespace {

using Steps = double __attribute__((vector_size(steps_together * sizeof(double))));

[[gnu::always_inline]] inline void load(Steps& to, const double* from) { std::memcpy(&to, from, sizeof to); }

template <class Real>
struct Eight;
template <>
struct Eight<float> {
  using Values = float __attribute__((vector_size(8 * sizeof(float))));
};
template <>
struct Eight<double> {
  using Values = double __attribute__((vector_size(8 * sizeof(double))));
};

/// Pairs of lanes of both, the lower or the upper of each half; then the same of pairs, and of halves.
template <class Values>
[[gnu::always_inline]] inline void interleave(Values& a, Values& b) {
  const Values low = __builtin_shufflevector(a, b, 0, 8, 1, 9, 4, 12, 5, 13);
  b = __builtin_shufflevector(a, b, 2, 10, 3, 11, 6, 14, 7, 15);
  a = low;
}
template <class Values>
[[gnu::always_inline]] inline void interleave_pairs(Values& a, Values& b) {
  const Values low = __builtin_shufflevector(a, b, 0, 1, 8, 9, 4, 5, 12, 13);
  b = __builtin_shufflevector(a, b, 2, 3, 10, 11, 6, 7, 14, 15);
  a = low;
}
template <class Values>
[[gnu::always_inline]] inline void interleave_halves(Values& a, Values& b) {
  const Values low = __builtin_shufflevector(a, b, 0, 1, 2, 3, 8, 9, 10, 11);
  b = __builtin_shufflevector(a, b, 4, 5, 6, 7, 12, 13, 14, 15);
  a = low;
}

/// Eight values of eight steps at a time are a square that is transposed in registers.
template <class Real>
[[gnu::noinline]] void bring_together(std::int64_t n, const Real* const* steps, double* together) {
  static_assert(steps_together == 8 && values_together % 8 == 0);
  using Values = typename Eight<Real>::Values;
  const Real* rows[8];
  std::memcpy(rows, steps, sizeof rows);
  for (std::int64_t i = 0; i < n; i += 8) {
    Values r[8];
    for (int step = 0; step < 8; ++step) std::memcpy(&r[step], rows[step] + i, sizeof r[step]);
    for (int step = 0; step < 8; step += 2) interleave(r[step], r[step + 1]);
    for (int four = 0; four < 8; four += 4) {
      interleave_pairs(r[four], r[four + 2]);
      interleave_pairs(r[four + 1], r[four + 3]);
    }
    for (int step = 0; step < 4; ++step) interleave_halves(r[step], r[step + 4]);
    // Where each value came to stand.
    constexpr int place[8] = {0, 2, 1, 3, 4, 6, 5, 7};
    for (int value = 0; value < 8; ++value) {
      const Steps values = __builtin_convertvector(r[place[value]], Steps);
      std::memcpy(together + (i + value) * steps_together, &values, sizeof values);
    }
  }
}

/// Each sum of products is four sums that do not wait for each other.
[[gnu::noinline]] void weigh(const double* together, const SeriesTerm* first, const SeriesTerm* last,
                             const double* weights, double factor, double* sums) {
  constexpr std::ptrdiff_t next = steps_together;
  Steps sum0{}, sum1{}, sum2{}, sum3{}, at;
  for (; first != last; ++first) {
    const double* values = together + first->value * steps_together;
    const double* const end = weights + first->count;
    for (; end - weights >= 4; weights += 4, values += 4 * next) {
      load(at, values);
      sum0 += weights[0] * at;
      load(at, values + next);
      sum1 += weights[1] * at;
      load(at, values + 2 * next);
      sum2 += weights[2] * at;
      load(at, values + 3 * next);
      sum3 += weights[3] * at;
    }
    for (; weights != end; ++weights, values += next) {
      load(at, values);
      sum0 += *weights * at;
    }
  }
  const Steps total = ((sum0 + sum1) + (sum2 + sum3)) * factor;
  std::memcpy(sums, &total, sizeof total);
}

[[gnu::noinline]] void combine(std::int64_t n, int count, const double* weights, const double* const* rows,
                               double* sums) {
  constexpr std::int64_t width = steps_together;
  std::int64_t i = 0;
  for (; i + width <= n; i += width) {
    Steps sum{}, at;
    for (int k = 0; k < count; ++k) {
      load(at, rows[k] + i);
      sum += weights[k] * at;
    }
    std::memcpy(sums + i, &sum, sizeof sum);
  }
  for (; i < n; ++i) {
    double sum = 0;
    for (int k = 0; k < count; ++k) sum += weights[k] * rows[k][i];
    sums[i] = sum;
  }
}

template <class Real>
constexpr SeriesKernels<Real> table = {bring_together<Real>, weigh, combine};

}  // namespace

const SeriesKernels<float>& SLIPWAVE_SERIES_LEVEL(float) { return table<float>; }
const SeriesKernels<double>& SLIPWAVE_SERIES_LEVEL(double) { return table<double>; }

}  // namespace slipwave::solver
