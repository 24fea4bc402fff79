// SPDX-License-Identifier: BSD-3-Clause
#include "gather/nrms.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "base/error.hpp"

namespace slipwave {

std::vector<double> nrms_over_time(std::span<const double> a, std::span<const double> b, std::size_t half) {
  if (a.size() != b.size())
    throw Error(std::to_string(a.size()) + " samples, expected " + std::to_string(b.size()) +
                " as in the other");
  std::vector<double> nrms(a.size());
  for (std::size_t n = 0; n < a.size(); ++n) {
    double a2 = 0, b2 = 0, difference2 = 0;
    // Summed anew: what running sums lose of loud samples would drown quiet ones.
    for (std::size_t m = n - std::min(n, half); m < std::min(a.size(), n + half + 1); ++m) {
      a2 += a[m] * a[m];
      b2 += b[m] * b[m];
      difference2 += (a[m] - b[m]) * (a[m] - b[m]);
    }
    const double sum = std::sqrt(a2) + std::sqrt(b2);
    nrms[n] = sum > 0 ? 200 * std::sqrt(difference2) / sum : 0;
  }
  return nrms;
}

}  // namespace slipwave
