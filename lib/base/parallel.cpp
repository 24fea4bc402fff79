#include "base/parallel.hpp"

#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>

#if defined(__x86_64__)
#include <immintrin.h>
#endif

namespace slipwave {
namespace {

/// Pieces a worker gets on average: enough to even out what the machine takes from some of them.
constexpr std::int64_t pieces_a_worker = 4;

void flush_subnormals() {
#if defined(__x86_64__)
  _mm_setcsr(_mm_getcsr() | 0x8040);  // FTZ | DAZ
#elif defined(__aarch64__)
  std::uint64_t fpcr;
  asm volatile("mrs %0, fpcr" : "=r"(fpcr));
  asm volatile("msr fpcr, %0" : : "r"(fpcr | (1ull << 24)));
#endif
}

}  // namespace

struct ThreadLimit::Impl {
  tbb::global_control control;
};

ThreadLimit::ThreadLimit(int threads) {
  if (threads > 0)
    impl_.reset(
        new Impl{tbb::global_control(tbb::global_control::max_allowed_parallelism, std::size_t(threads))});
}

ThreadLimit::~ThreadLimit() = default;

int parallel_workers() { return tbb::this_task_arena::max_concurrency(); }

void parallel_for(std::int64_t count, std::int64_t grain,
                  const std::function<void(std::int64_t, std::int64_t, int)>& body) {
  const auto run = [&](const tbb::blocked_range<std::int64_t>& piece) {
    flush_subnormals();
    body(piece.begin(), piece.end(), std::max(0, tbb::this_task_arena::current_thread_index()));
  };
  const auto threads =
      std::int64_t(tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism));
  if (threads == 1 || count <= grain) {
    if (count > 0) run({0, count});
    return;
  }
  // Halving stops below twice the grain.
  const std::int64_t longest = std::max(grain, count / (pieces_a_worker * threads));
  tbb::parallel_for(tbb::blocked_range<std::int64_t>(0, count, std::size_t(longest)), run,
                    tbb::simple_partitioner());
}

}  // namespace slipwave
