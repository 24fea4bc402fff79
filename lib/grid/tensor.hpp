// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace slipwave {

/// Radians.
inline constexpr double degree = std::numbers::pi / 180;

/// A symmetric tensor (stress, moment): the diagonal first, then the pairs of axes in order.
/// 2-D: xx, zz, xz. 3-D: xx, yy, zz, xy, xz, yz.
template <int D, class Real>
struct SymmetricTensor {
  static constexpr int components = D * (D + 1) / 2;
  std::array<Real, components> values{};

  /// Returns the place of component (i, j) in `values`.
  static constexpr int place(int i, int j) {
    if (i == j) return i;
    return D + std::min(i, j) * (2 * D - 3 - std::min(i, j)) / 2 + std::max(i, j) - 1;
  }
  constexpr Real& operator()(int i, int j) { return values[std::size_t(place(i, j))]; }
  constexpr const Real& operator()(int i, int j) const { return values[std::size_t(place(i, j))]; }
  bool operator==(const SymmetricTensor&) const = default;
};

/// s_n and tau, normal stress and shear traction, on planes with unit normal n (theory.md S1).
template <int D, class Real>
Real resolve(const std::array<Real, std::size_t(D)>& n, const SymmetricTensor<D, Real>& s,
             std::array<Real, std::size_t(D)>& tau) {
  Real s_n = 0;
  for (std::size_t i = 0; i < D; ++i) {
    tau[i] = 0;
    for (std::size_t j = 0; j < D; ++j) tau[i] += s(int(i), int(j)) * n[j];
    s_n += n[i] * tau[i];
  }
  for (std::size_t i = 0; i < D; ++i) tau[i] -= s_n * n[i];
  return s_n;
}

/// Its squares neither overflow nor vanish.
template <int D, class Real>
Real length(const std::array<Real, std::size_t(D)>& a) {
  Real largest = 0, sum = 0;
  for (const Real part : a) largest = std::max(largest, std::abs(part));
  if (!(largest > 0)) return largest;
  for (const Real part : a) sum += (part / largest) * (part / largest);
  return largest * std::sqrt(sum);
}

}  // namespace slipwave
