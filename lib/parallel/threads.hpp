// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <memory>

namespace slipwave {

/// Limits the threads of parallel_for to `threads` (0: as many as the process may run on) while it lives.
class ThreadLimit {
 public:
  explicit ThreadLimit(int threads);
  ~ThreadLimit();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// How many workers parallel_for may use: worker numbers are below this.
int parallel_workers();
/// How many of them work at once.
int parallel_threads();

/// From now on subnormal numbers count as zero in this thread, as they do for good in every thread that has
/// worked for the functions below.
void flush_subnormals();

/// Runs body(begin, end, worker) over pieces of 0 .. count, each at least `grain` long (the last may be
/// shorter), and returns when all are done. Pieces must not depend on each other; who takes which is left to
/// the moment, so a thread that has to wait takes fewer. Subnormal numbers count as zero
/// inside. Two pieces of the same worker never run at once. What body throws is thrown here.
void parallel_for(std::int64_t count, std::int64_t grain,
                  const std::function<void(std::int64_t begin, std::int64_t end, int worker)>& body);

/// Runs body(tile, band, worker) for all tiles over a row of bands, several tiles at a time, each behind
/// the one before it: a piece begins when the band before it in its tile and the band behind it in the tile
/// before are done (the last band: that one in the tile before), and a tile begins when the one `in_progress`
/// before it has ended. So a tile may change what it and the bands next to it share with the tile before.
/// Otherwise as parallel_for; with one thread tile after tile.
void parallel_tiles(std::int64_t tiles, std::int64_t bands, std::int64_t in_progress,
                    const std::function<void(std::int64_t tile, std::int64_t band, int worker)>& body);

/// Runs body(job) for all jobs, `at_once` of them at a time; each has its even share of the threads to itself
/// for what it does in parallel.
void parallel_jobs(std::int64_t count, int at_once, const std::function<void(std::int64_t job)>& body);

}  // namespace slipwave
