// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace slipwave {

/// How one cell slips by one rule.
struct History {
  std::string rule;
  /// At the end of every step by (S3), along the traction: what slip at that rate takes off it in a step,
  /// over the strength of the planes.
  std::vector<double> rate;
};

/// Load that goes to and fro, 3 S sin(2 pi n/100) after step n, on planes whose relaxation time is
/// `relaxation` steps: the law itself (by a thousand steps in one), implicit Euler (S5), the trapezoidal rule
/// (theta = 1/2 in (S6)), that rule with the theta of (S7), and (S10).
std::vector<History> histories(double relaxation, int steps);

}  // namespace slipwave
