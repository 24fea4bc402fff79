// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>
#include <cstdint>

#include "grid/grid.hpp"
#include "grid/tensor.hpp"

/// How points of single fractures count to the cells about them (docs/theory.md (S30)).
namespace slipwave {

/// Shares of a point in three cells of an axis, the first of them `first`: a quadratic B-spline about it,
/// which keeps the place of the point wherever it lies in its cell.
struct SplineShares {
  std::int64_t first;
  std::array<double, 3> of;
};
/// `position` in cells from the centre of cell 0.
inline SplineShares spline_shares(double position) {
  const double nearest = std::floor(position + 0.5), off = position - nearest;
  return {std::int64_t(nearest) - 1,
          {(0.5 - off) * (0.5 - off) / 2, 0.75 - off * off, (0.5 + off) * (0.5 + off) / 2}};
}

/// Returns the shares of a point along each axis. Cells are counted in the grid, shares computed in the
/// larger one that it may be part of, so that they are the same numbers in both.
template <int D>
std::array<SplineShares, std::size_t(D)> spline_shares(const Grid<D>& grid, const Point<D>& at_m) {
  const auto place = grid.row_coordinates(at_m);
  std::array<SplineShares, std::size_t(D)> shares;
  for (std::size_t axis = 0; axis < D; ++axis) {
    shares[axis] = spline_shares((place[axis] - grid.origin_m[axis]) / grid.spacing_m - 0.5);
    shares[axis].first -= grid.first[axis];
  }
  return shares;
}

/// Components of the strain that a plane of unit density puts on rock for a stress (S19), those of the strain
/// row after row.
template <int D>
std::array<double, std::size_t(SymmetricTensor<D, double>::components) *
                       std::size_t(SymmetricTensor<D, double>::components)>
strain_of_plane(const Point<D>& n, double normal, double tangential) {
  constexpr auto components = std::size_t(SymmetricTensor<D, double>::components);
  std::array<double, components * components> all{};
  for (std::size_t of = 0; of < components; ++of) {
    SymmetricTensor<D, double> stress, strain;
    stress.values[of] = 1;
    Point<D> tau;
    const double s_n = resolve<D, double>(n, stress, tau);
    for (std::size_t i = 0; i < D; ++i)
      for (std::size_t j = i; j < D; ++j)
        strain(int(i), int(j)) =
            normal * s_n * n[i] * n[j] + tangential * (tau[i] * n[j] + n[i] * tau[j]) / 2;
    for (std::size_t c = 0; c < components; ++c) all[c * components + of] = strain.values[c];
  }
  return all;
}

}  // namespace slipwave
