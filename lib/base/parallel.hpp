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

/// Runs body(begin, end, worker) over pieces of 0 .. count, each at least `grain` long (the last may be
/// shorter), and returns when all are done. Pieces must not depend on each other; who takes which is left to
/// the moment, so a thread that the machine keeps waiting takes fewer. Subnormal numbers count as zero
/// inside. Two pieces of the same worker never run at once. What body throws is thrown here.
void parallel_for(std::int64_t count, std::int64_t grain,
                  const std::function<void(std::int64_t begin, std::int64_t end, int worker)>& body);

}  // namespace slipwave
