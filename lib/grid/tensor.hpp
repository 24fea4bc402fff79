#pragma once

#include <algorithm>
#include <array>

namespace slipwave {

/// A symmetric tensor (stress, moment): the diagonal first, then the pairs of axes in order.
/// 2-D: xx, zz, xz. 3-D: xx, yy, zz, xy, xz, yz.
template <int D, class Real>
struct SymmetricTensor {
  static constexpr int components = D * (D + 1) / 2;
  std::array<Real, components> values{};

  /// Where component (i, j) stands in `values`.
  static constexpr int place(int i, int j) {
    if (i == j) return i;
    return D + std::min(i, j) * (2 * D - 3 - std::min(i, j)) / 2 + std::max(i, j) - 1;
  }
  constexpr Real& operator()(int i, int j) { return values[std::size_t(place(i, j))]; }
  constexpr const Real& operator()(int i, int j) const { return values[std::size_t(place(i, j))]; }
  bool operator==(const SymmetricTensor&) const = default;
};

}  // namespace slipwave
