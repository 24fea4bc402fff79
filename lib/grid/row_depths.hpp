// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace slipwave {

/// A horizon that a row of faces of a fitted grid follows.
struct FittedHorizon {
  std::string name;
  std::string role;      // "surface", "floor" or "layer"
  std::int64_t row = 0;  // cells of this row and below lie under it
  bool operator==(const FittedHorizon&) const = default;
};

/// The depths of a grid whose rows follow horizons (a fitted grid): columns are upright and `spacing` apart,
/// the rows bend. x = xi, z = z(xi, zeta): a place has row coordinates (xi, zeta), in which cell (i, k) lies
/// at xi = (i + 1/2) h, zeta = (k + 1/2) h from the origin, as in a regular grid. Depths are given at the
/// corners of cells (theory.md (F1)).
template <int D>
class RowDepths {
 public:
  using Index = std::array<std::int64_t, std::size_t(D)>;

  RowDepths() = default;
  /// Depths in m at the corners, x fastest, one more than cells along each axis. Throws Error naming row and
  /// column where they do not deepen from corner to corner, or are not finite.
  RowDepths(const Index& cells, std::vector<double> corners_m, std::vector<FittedHorizon> horizons = {});

  const Index& cells() const { return cells_; }
  const std::vector<double>& corners_m() const { return corners_m_; }
  const std::vector<FittedHorizon>& horizons() const { return horizons_; }

  /// Depth of a corner, m: 0 .. cells along each axis.
  double corner(const Index& at) const { return corners_m_[corner_place(at)]; }
  /// Depth of the centre of a cell, m: the mean of its corners.
  double centre(const Index& at) const;
  /// Height of a cell at its centre, m.
  double height(const Index& at) const;
  /// Slope of a row along a horizontal axis at the centre of a cell: dz/dx or dz/dy, for cells `spacing_m`
  /// wide.
  double slope(const Index& at, int axis, double spacing_m) const;
  /// Returns the factor by which the row coordinate changes faster than the place along the normal of the
  /// row: |grad zeta|, 1 in a regular grid. A wave of speed c crosses c stretch dt/h cells in dt.
  double stretch(const Index& at, double spacing_m) const;
  /// Depth at row coordinates counted in cells from the first corner, not rounded to corners: cubics through
  /// the four nearest along each axis across, straight within a row. Outside as at the edge; above the first
  /// and below the last row with the heights of those.
  double depth(const std::array<double, std::size_t(D)>& corner_position) const;
  /// Inverse of depth(): the row coordinate, in cells from the first corner, of a depth at a place whose
  /// other coordinates are given (the last entry of `at` is the depth in m).
  double row_position(std::array<double, std::size_t(D)> at) const;
  /// Depths of a row of corners, m, x fastest.
  std::span<const double> row(std::int64_t row_of_corners) const {
    const std::size_t a_row = corners_m_.size() / std::size_t(cells_[D - 1] + 1);
    return {corners_m_.data() + std::size_t(row_of_corners) * a_row, a_row};
  }
  /// Whether a row of corners is level.
  bool row_is_level(std::int64_t row_of_corners) const;
  /// The first row of corners that is not level.
  std::optional<std::int64_t> first_curvilinear_row() const;
  /// Least and largest height of a cell at its centre, m.
  std::array<double, 2> heights() const;

  bool operator==(const RowDepths&) const = default;

 private:
  std::size_t corner_place(const Index& at) const {
    std::int64_t n = 0;
    for (int axis = D - 1; axis >= 0; --axis) n = n * (cells_[std::size_t(axis)] + 1) + at[std::size_t(axis)];
    return std::size_t(n);
  }
  /// Depths of the corners of a cell, m: bit n of a corner's number says on which side along axis n it is.
  std::array<double, std::size_t(1) << D> corners_of(const Index& at) const {
    std::array<double, std::size_t(1) << D> depths{};
    for (std::size_t n = 0; n < depths.size(); ++n) {
      Index of = at;
      for (std::size_t axis = 0; axis < D; ++axis) of[axis] += std::int64_t(n >> axis & 1);
      depths[n] = corner(of);
    }
    return depths;
  }
  /// Depth of a row of corners at a place between columns.
  double of_row(std::int64_t row, const std::array<double, std::size_t(D)>& corner_position) const;

  Index cells_{};
  std::vector<double> corners_m_;
  std::vector<FittedHorizon> horizons_;
};

extern template class RowDepths<2>;
extern template class RowDepths<3>;

}  // namespace slipwave
