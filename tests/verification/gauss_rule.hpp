// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

namespace slipwave::solver {

/// Points and weights of Gauss's rule from 0 to 1: zeros of Legendre's polynomial, by Newton's method.
inline std::vector<std::array<double, 2>> gauss_rule(int count) {
  std::vector<std::array<double, 2>> rule;
  for (int n = 0; n < count; ++n) {
    double x = std::cos(std::numbers::pi * (n + 0.75) / (count + 0.5)), slope = 0;
    for (int step = 0; step < 8; ++step) {
      double before = 1, value = x;
      for (int degree = 2; degree <= count; ++degree) {
        const double next = ((2 * degree - 1) * x * value - (degree - 1) * before) / degree;
        before = value, value = next;
      }
      slope = count * (x * value - before) / (x * x - 1);
      x -= value / slope;
    }
    rule.push_back({(1 + x) / 2, 1 / ((1 - x * x) * slope * slope)});
  }
  return rule;
}

}  // namespace slipwave::solver
