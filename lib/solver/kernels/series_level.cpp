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
[[gnu::noinline]] void bring_together(std::int64_t n, const Real* const* steps, double* together) {
  const Real* rows[steps_together];
  std::memcpy(rows, steps, sizeof rows);
  for (std::int64_t i = 0; i < n; ++i)
    for (int step = 0; step < steps_together; ++step)
      together[i * steps_together + step] = double(rows[step][i]);
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
