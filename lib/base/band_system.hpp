// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <complex>
#include <cstddef>
#include <utility>
#include <vector>

namespace slipwave {

/// A system of linear equations with a narrow band, solved by Gauss with pivots: each equation reaches
/// half_band unknowns to either side of the diagonal, at most.
template <std::size_t half_band>
class BandSystem {
 public:
  using Complex = std::complex<double>;
  explicit BandSystem(std::size_t count) : count_(count), matrix_(count * band), right_(count) {}
  Complex& at(std::size_t row, std::size_t column) { return matrix_[row * band + column + half_band - row]; }
  Complex& right(std::size_t row) { return right_[row]; }
  std::vector<Complex> solve() {
    for (std::size_t n = 0; n < count_; ++n) {
      const auto last_row = std::min(n + half_band + 1, count_),
                 last = std::min(n + 2 * half_band + 1, count_);
      std::size_t best = n;
      for (auto row = n + 1; row < last_row; ++row)
        if (std::norm(at(row, n)) > std::norm(at(best, n))) best = row;
      if (best != n) {
        for (auto column = n; column < last; ++column) std::swap(at(n, column), at(best, column));
        std::swap(right_[n], right_[best]);
      }
      for (auto row = n + 1; row < last_row; ++row) {
        if (at(row, n) == 0.) continue;
        const auto factor = at(row, n) / at(n, n);
        for (auto column = n; column < last; ++column) at(row, column) -= factor * at(n, column);
        right_[row] -= factor * right_[n];
      }
    }
    for (auto n = count_; n-- > 0;) {
      for (auto column = n + 1; column < std::min(n + 2 * half_band + 1, count_); ++column)
        right_[n] -= at(n, column) * right_[column];
      right_[n] /= at(n, n);
    }
    return std::move(right_);
  }

 private:
  static constexpr std::size_t band = 3 * half_band + 1;
  std::size_t count_;
  std::vector<Complex> matrix_, right_;
};

}  // namespace slipwave
