// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

namespace slipwave {

/// A layer's top across a cell: its depth at the low and at the high side in x, counted from the cell's
/// upper edge in cells. A plane is exact; a curve is replaced by its chord, which shifts the share of the
/// cell by its curvature times h/8 at most.
struct Cut {
  double low = 0, high = 0;
  bool operator==(const Cut&) const = default;
};

/// A layer's top across a cell in 3-D: its depths at the four upright edges, at the low and the high side in
/// y. A plane is exact; any other top is replaced by the plane nearest to the four depths.
struct Cut3D {
  Cut low_y, high_y;
  /// The least and the largest depth of that plane in the cell.
  double least() const;
  double largest() const;
};

/// What belongs of a cell to each of a pile of layers, exactly: everything below a top is that layer's, down
/// to the tops of later layers, which cut it off. shares[i] is that of the layer under tops[i], and the last
/// one, behind them, what lies above all. The shares sum to 1 (to rounding) and none is negative.
std::vector<double> shares_of_cell(std::span<const Cut> tops);
/// In 3-D; where no top changes along y, the same bits as of the section.
std::vector<double> shares_of_cell(std::span<const Cut3D> tops);

}  // namespace slipwave
