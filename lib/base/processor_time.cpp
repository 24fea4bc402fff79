// SPDX-License-Identifier: BSD-3-Clause
#include "base/processor_time.hpp"

#include <ctime>

namespace slipwave {

double processor_time_s() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return double(now.tv_sec) + 1e-9 * double(now.tv_nsec);
}

}  // namespace slipwave
