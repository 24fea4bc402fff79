// SPDX-License-Identifier: BSD-3-Clause
#include "parallel/threads.hpp"

#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>
#include <tbb/task_group.h>

#include <algorithm>
#include <atomic>
#include <vector>

#if defined(__x86_64__)
#include <immintrin.h>
#endif

namespace slipwave {
namespace {

/// Pieces a worker gets on average: enough to even out what the machine takes from some of them.
constexpr std::int64_t pieces_a_worker = 4;

int this_worker() { return std::max(0, tbb::this_task_arena::current_thread_index()); }

/// What was done before the pieces began is seen by them, what they did by those who waited for them, and
/// what a worker left by whoever works next under its number. TBB sees to all this itself; the same in our
/// own atomics is for the thread sanitizer, which cannot check a TBB that was compiled without it.
class Handover {
 public:
  Handover() : workers_(std::size_t(parallel_workers())) { begun_.store(true, std::memory_order_release); }
  template <class Body>
  void piece(Body&& body) {
    begun();
    auto& worker = workers_[std::size_t(this_worker())];
    (void)worker.load(std::memory_order_acquire);
    body();
    worker.store(true, std::memory_order_release);
    ended_.fetch_add(1, std::memory_order_release);
  }
  void begun() const { (void)begun_.load(std::memory_order_acquire); }
  void ended() const { (void)ended_.load(std::memory_order_acquire); }

 private:
  std::vector<std::atomic<bool>> workers_;
  std::atomic<bool> begun_ = false;
  std::atomic<std::int64_t> ended_ = 0;
};

}  // namespace

void flush_subnormals() {
#if defined(__x86_64__)
  _mm_setcsr(_mm_getcsr() | 0x8040);  // FTZ | DAZ
#elif defined(__aarch64__)
  std::uint64_t fpcr;
  asm volatile("mrs %0, fpcr" : "=r"(fpcr));
  asm volatile("msr fpcr, %0" : : "r"(fpcr | (1ull << 24)));
#endif
}

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

int parallel_threads() {
  return std::min(parallel_workers(),
                  int(tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism)));
}

void parallel_for(std::int64_t count, std::int64_t grain,
                  const std::function<void(std::int64_t, std::int64_t, int)>& body) {
  const auto run = [&](const tbb::blocked_range<std::int64_t>& piece) {
    flush_subnormals();
    body(piece.begin(), piece.end(), this_worker());
  };
  const std::int64_t threads = parallel_threads();
  if (threads == 1 || count <= grain) {
    if (count > 0) run({0, count});
    return;
  }
  // Halving stops below twice the grain.
  const std::int64_t longest = std::max(grain, count / (pieces_a_worker * threads));
  Handover handover;
  tbb::parallel_for(
      tbb::blocked_range<std::int64_t>(0, count, std::size_t(longest)),
      [&](const auto& piece) { handover.piece([&] { run(piece); }); }, tbb::simple_partitioner());
  handover.ended();
}

namespace {

/// The pieces of parallel_tiles() and what each still waits for.
class Pieces {
 public:
  Pieces(std::int64_t tiles, std::int64_t bands, std::int64_t in_progress,
         const std::function<void(std::int64_t, std::int64_t, int)>& body)
      : tiles_(tiles), bands_(bands), in_progress_(in_progress), body_(body) {
    waits_ = std::make_unique<std::atomic<int>[]>(std::size_t(tiles * bands));
    for (std::int64_t tile = 0; tile < tiles; ++tile)
      for (std::int64_t band = 0; band < bands; ++band)
        waits(tile, band) = (band > 0) + (tile > 0) + (band == 0 && tile >= in_progress);
  }
  void run() {
    group_.run_and_wait([this] { run_from(0, 0); });
    handover_.ended();
  }

 private:
  std::atomic<int>& waits(std::int64_t tile, std::int64_t band) {
    return waits_[std::size_t(tile * bands_ + band)];
  }
  /// One thing a piece waited for is done: whether it was the last.
  bool ready(std::int64_t tile, std::int64_t band) {
    return tile < tiles_ && band < bands_ && waits(tile, band).fetch_sub(1) == 1;
  }
  void run_from(std::int64_t tile, std::int64_t band) {
    for (;;) {
      flush_subnormals();
      handover_.begun();
      // Those it waited for have counted down here.
      (void)waits(tile, band).load(std::memory_order_acquire);
      handover_.piece([&] { body_(tile, band, this_worker()); });
      const auto start = [this](std::int64_t next_pass, std::int64_t next_band) {
        if (ready(next_pass, next_band))
          group_.run([this, next_pass, next_band] { run_from(next_pass, next_band); });
      };
      const bool last = band + 1 == bands_;
      if (band > 0) start(tile + 1, band - 1);
      if (last) start(tile + 1, band);
      if (last) start(tile + in_progress_, 0);
      // The next band shares most with this one.
      if (last || !ready(tile, band + 1)) return;
      ++band;
    }
  }

  std::int64_t tiles_, bands_, in_progress_;
  const std::function<void(std::int64_t, std::int64_t, int)>& body_;
  std::unique_ptr<std::atomic<int>[]> waits_;
  Handover handover_;
  tbb::task_group group_;
};

}  // namespace

void parallel_tiles(std::int64_t tiles, std::int64_t bands, std::int64_t in_progress,
                    const std::function<void(std::int64_t, std::int64_t, int)>& body) {
  if (parallel_threads() > 1 && in_progress > 1 && tiles > 1 && bands > 2) {
    Pieces(tiles, bands, in_progress, body).run();
    return;
  }
  flush_subnormals();
  for (std::int64_t tile = 0; tile < tiles; ++tile)
    for (std::int64_t band = 0; band < bands; ++band) body(tile, band, 0);
}

void parallel_jobs(std::int64_t count, int at_once, const std::function<void(std::int64_t)>& body) {
  const int threads = parallel_threads();
  at_once = std::clamp(at_once, 1, threads);
  if (at_once == 1) {
    for (std::int64_t job = 0; job < count; ++job) body(job);
    return;
  }
  tbb::task_arena outer(at_once);
  Handover handover;
  outer.execute([&] {
    tbb::parallel_for(
        tbb::blocked_range<std::int64_t>(0, count, 1),
        [&](const tbb::blocked_range<std::int64_t>& jobs) {
          tbb::task_arena inner(std::max(1, threads / at_once));
          for (std::int64_t job = jobs.begin(); job < jobs.end(); ++job)
            inner.execute([&] { handover.piece([&] { body(job); }); });
        },
        tbb::simple_partitioner());
  });
  handover.ended();
}

}  // namespace slipwave
