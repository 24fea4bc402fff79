// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "solver/sweep/state.hpp"

namespace slipwave::solver {

/// Values along an axis of columns of one width and of columns `ratio` times as wide (theory.md (B2), (B3)).
/// What goes from wide columns to narrow ones keeps its sum of squares, times their width, and comes back as
/// it was. Beyond the ends rows are their images, even or odd.
template <class Real>
class BandColumns {
 public:
  /// `wide`: how many wide columns there are.
  BandColumns(int ratio, std::int64_t wide);
  std::int64_t wide() const { return wide_; }
  std::int64_t narrow() const { return wide_ * ratio_; }
  /// The sign of the image beyond each end.
  using Images = std::array<Real, 2>;
  /// (B2): `from` and `to` hold one value each `stride` values; `lanes` such rows stand side by side.
  void to_narrow(const Real* from, std::int64_t stride_from, Real* to, std::int64_t stride_to,
                 std::int64_t lanes, const Images& images);
  /// (B3), its transpose over the ratio.
  void to_wide(const Real* from, std::int64_t stride_from, Real* to, std::int64_t stride_to,
               std::int64_t lanes, const Images& images);

 private:
  /// Columns from -reach_ to wide + reach_, all lanes of each, of the parts that rows are taken apart into:
  /// every ratio-th narrow column from n on, or wide columns. This is column 0.
  Real* part(int n) { return parts_.data() + (std::int64_t(n) * (wide_ + 2 * reach_) + reach_) * lanes_; }
  void make_room(int parts, std::int64_t lanes);
  void extend(int parts, const Images& images);
  template <class Add>
  void sum(Add&& add_all);
  void sum_isometry();
  void add(Real tap, const Real* beside, std::size_t first, std::size_t last);

  int ratio_;
  std::int64_t wide_, reach_, lanes_ = 1;
  // Of (B1): [narrow column][offset], the middle one is offset 0; and from offset 0 on, of wide columns.
  std::vector<std::vector<Real>> interpolation_;
  std::vector<Real> isometry_;
  std::vector<Real> parts_, sums_;
};

}  // namespace slipwave::solver
