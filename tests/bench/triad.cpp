// SPDX-License-Identifier: BSD-3-Clause
// What memory gives: the triad a = b + s c of STREAM, and a += s b, which writes where it has read as the
// solver does.
#include <atomic>
#include <barrier>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "bench.hpp"
#include "measure.hpp"

namespace slipwave::bench {
namespace {

enum class Loop { triad, update };

#if defined(__x86_64__)
[[gnu::target_clones("avx512f", "avx2", "default")]]
#endif
void triad(std::int64_t n, float s, const float* b, const float* c, float* a) {
  for (std::int64_t i = 0; i < n; ++i) a[i] = b[i] + s * c[i];
}

#if defined(__x86_64__)
[[gnu::target_clones("avx512f", "avx2", "default")]]
#endif
void update(std::int64_t n, float s, const float* b, float* a) {
  for (std::int64_t i = 0; i < n; ++i) a[i] += s * b[i];
}

/// Every thread runs over arrays of its own, all begin and end together.
void run(benchmark::State& state, Loop loop, std::int64_t values, int threads) {
  const std::int64_t repeats = std::max<std::int64_t>(1, 4'000'000 / values);
  std::atomic<bool> over = false;
  std::barrier begin(threads + 1), end(threads + 1);
  const auto body = [&] {
    // First touched by the thread that uses it.
    std::vector<float> a(std::size_t(values), 1), b(std::size_t(values), 2), c(std::size_t(values), 3);
    for (begin.arrive_and_wait(); !over; begin.arrive_and_wait()) {
      for (std::int64_t n = 0; n < repeats; ++n) {
        if (loop == Loop::triad)
          triad(values, 1e-3F, b.data(), c.data(), a.data());
        else
          update(values, 1e-3F, b.data(), a.data());
        benchmark::DoNotOptimize(a.data());
        benchmark::ClobberMemory();
      }
      end.arrive_and_wait();
    }
  };
  std::vector<std::thread> team;
  for (int n = 0; n < threads; ++n) team.emplace_back(body);
  // Once before, while the arrays are filled.
  begin.arrive_and_wait();
  end.arrive_and_wait();
  const double seconds = least_seconds(state, [&] {
    begin.arrive_and_wait();
    end.arrive_and_wait();
  });
  over = true;
  begin.arrive_and_wait();
  for (auto& thread : team) thread.join();
  // Three streams either way; what a cache reads to write a whole line of `a` is not counted, as in STREAM.
  state.counters["bytes_per_s"] = 3. * sizeof(float) * double(values * repeats * threads) / seconds;
}

}  // namespace

void register_triad() {
  struct Place {
    const char* name;
    std::int64_t values;
  };
  // 24 KiB and 1 MiB in all, and far beyond the caches.
  for (const Place place : {Place{"first_cache", 2048}, {"second_cache", 87'000}, {"memory", 96'000'000}})
    for (const int threads : {1, 2})
      for (const Loop loop : {Loop::triad, Loop::update})
        benchmark::RegisterBenchmark(
            (std::string("triad/loop:") + (loop == Loop::triad ? "triad" : "update") +
             "/place:" + place.name + "/threads:" + std::to_string(threads))
                .c_str(),
            [=](benchmark::State& state) { run(state, loop, place.values, threads); })
            ->UseManualTime()
            ->Unit(benchmark::kMillisecond);
}

}  // namespace slipwave::bench
