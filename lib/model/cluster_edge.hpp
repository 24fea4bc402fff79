// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>

#include "grid/tensor.hpp"
#include "model/model.hpp"

/// Cells that the edge of a cluster cuts: planes slip in a part of them, which the rest holds
/// (docs/theory/slip.md).
namespace slipwave {

/// Share of its volume in which the planes of a fractured cell slip.
template <int D>
double fracture_share_of(const Model<D>& model, std::size_t cell) {
  return model.fracture_share.empty() ? 1 : double(model.fracture_share[cell]);
}
/// Whether the edge of its cluster cuts a cell.
template <int D>
bool is_cut(const Model<D>& model, std::size_t cell) {
  return fracture_share_of(model, cell) < 1;
}

/// Unit normal of the edge in a cell that it cuts: along the slope of the shares of the cell and its
/// neighbours, of which those of other sets and beyond the grid count as the cell itself does; of clusters
/// thinner than a cell, where they have no slope, along which shares change most.
template <int D>
Point<D> edge_normal(const Model<D>& model, std::size_t cell);

/// The stress by which the rest of an isotropic cell holds a slip strain of its part across an edge with this
/// normal, over 2 mu and per volume of the rest (S38); `ratio` is lambda/(lambda + 2 mu).
template <int D, class Real>
SymmetricTensor<D, Real> held_strain(const SymmetricTensor<D, Real>& slip,
                                     const std::array<Real, std::size_t(D)>& edge, Real ratio) {
  // Within the edge: (1 - m m).e.(1 - m m).
  std::array<Real, std::size_t(D)> across{};
  Real twice = 0, trace = 0;
  for (std::size_t i = 0; i < D; ++i) {
    for (std::size_t j = 0; j < D; ++j) across[i] += slip(int(i), int(j)) * edge[j];
    twice += across[i] * edge[i];
    trace += slip(int(i), int(i));
  }
  const Real beside = ratio * (trace - twice);
  SymmetricTensor<D, Real> held;
  for (std::size_t i = 0; i < D; ++i)
    for (std::size_t j = i; j < D; ++j)
      held(int(i), int(j)) = slip(int(i), int(j)) - across[i] * edge[j] - edge[i] * across[j] +
                             (twice - beside) * edge[i] * edge[j] + (i == j ? beside : Real(0));
  return held;
}

/// What of it acts along planes with a normal, over mu times their slip: the most over the directions of slip
/// in 3-D (S39). 0 where an edge is parallel to planes of 2-D or at right angles to them.
template <int D>
double held_share(const Point<D>& normal, const Point<D>& edge, double lambda, double mu);

}  // namespace slipwave
