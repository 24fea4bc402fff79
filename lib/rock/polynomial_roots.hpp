// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstddef>

namespace slipwave {

/// All roots of a polynomial at once (Durand and Kerner), of real coefficients from the constant on; none is
/// much larger than `size`. Roots are real or pairs; near where both of a pair meet they are known to half
/// the digits.
template <std::size_t Count>
std::array<std::complex<double>, Count - 1> roots_of(const std::array<double, Count>& of, double size) {
  using Complex = std::complex<double>;
  constexpr std::size_t degree = Count - 1;
  std::array<Complex, degree> roots;
  for (std::size_t n = 0; n < degree; ++n) roots[n] = size * std::exp(Complex(0, 0.4 + 1.5 * double(n)));
  constexpr int rounds = 500;
  for (int round = 0; round < rounds; ++round) {
    double most = 0;
    for (std::size_t n = 0; n < degree; ++n) {
      Complex value = of[degree], others = of[degree];
      for (std::size_t power = degree; power-- > 0;) value = value * roots[n] + of[power];
      for (std::size_t m = 0; m < degree; ++m)
        if (m != n) others *= roots[n] - roots[m];
      roots[n] -= value / others;
      most = std::max(most, std::abs(value / others));
    }
    if (most < 1e-15 * size) break;
  }
  for (auto& root : roots)
    if (std::abs(root.imag()) < 1e-7 * size) root = root.real();
  return roots;
}

}  // namespace slipwave
