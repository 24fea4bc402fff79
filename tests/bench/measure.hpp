// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <limits>

namespace slipwave::bench {

/// Runs `work` as often as Google Benchmark asks and returns the least seconds it took: on a machine with
/// other work, that is the time of the work itself.
template <class Work>
double least_seconds(benchmark::State& state, const Work& work) {
  double least = std::numeric_limits<double>::infinity();
  for (auto _ : state) {
    const auto begin = std::chrono::steady_clock::now();
    work();
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    state.SetIterationTime(seconds);
    least = std::min(least, seconds);
  }
  return least;
}

}  // namespace slipwave::bench
