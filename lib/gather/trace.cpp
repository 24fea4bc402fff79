// SPDX-License-Identifier: BSD-3-Clause
#include "gather/trace.hpp"

#include <cmath>

#include "base/error.hpp"

namespace slipwave {

void check_finite(std::span<const double> samples) {
  for (std::size_t n = 0; n < samples.size(); ++n)
    if (!std::isfinite(samples[n]))
      throw Error("sample " + std::to_string(n + 1) + ": " + shown(samples[n]) +
                  ", expected a finite number");
}

}  // namespace slipwave
