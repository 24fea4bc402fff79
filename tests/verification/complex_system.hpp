// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <complex>
#include <utility>
#include <vector>

namespace slipwave::solver {

/// Linear equations with complex coefficients: rows with their right-hand side behind.
using ComplexSystem = std::vector<std::vector<std::complex<double>>>;

/// Their solution, by Gauss with pivots.
inline std::vector<std::complex<double>> solved(ComplexSystem a) {
  const auto count = a.size();
  for (std::size_t column = 0; column < count; ++column) {
    std::size_t best = column;
    for (std::size_t row = column; row < count; ++row)
      if (std::norm(a[row][column]) > std::norm(a[best][column])) best = row;
    std::swap(a[column], a[best]);
    for (std::size_t row = column + 1; row < count; ++row) {
      const auto factor = a[row][column] / a[column][column];
      if (factor == 0.) continue;
      for (std::size_t n = column; n <= count; ++n) a[row][n] -= factor * a[column][n];
    }
  }
  std::vector<std::complex<double>> x(count);
  for (std::size_t row = count; row-- > 0;) {
    x[row] = a[row][count];
    for (std::size_t n = row + 1; n < count; ++n) x[row] -= a[row][n] * x[n];
    x[row] /= a[row][row];
  }
  return x;
}

}  // namespace slipwave::solver
