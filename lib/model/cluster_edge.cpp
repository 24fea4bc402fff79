// SPDX-License-Identifier: BSD-3-Clause
#include "model/cluster_edge.hpp"

#include <algorithm>
#include <cmath>

#include "base/instantiate.hpp"

namespace slipwave {
namespace {

/// Share of the cell at an index for the slope about another one.
template <int D>
double share_beside(const Model<D>& model, const Index<D>& at, std::size_t of) {
  const auto& grid = model.grid();
  for (std::size_t axis = 0; axis < D; ++axis)
    if (at[axis] < 0 || at[axis] >= grid.shape[axis]) return fracture_share_of(model, of);
  const auto cell = std::size_t(grid.flat(at));
  if (model.fracture[cell] == 0) return 0;
  return model.fracture[cell] == model.fracture[of] ? fracture_share_of(model, cell)
                                                    : fracture_share_of(model, of);
}

/// The direction in which a tensor without negative values is largest; of layers thinner than a cell, whose
/// shares fall to both sides, the one across.
template <int D>
Point<D> largest_direction(const SymmetricTensor<D, double>& of) {
  std::size_t most = 0;
  for (std::size_t axis = 1; axis < D; ++axis)
    if (of(int(axis), int(axis)) > of(int(most), int(most))) most = axis;
  Point<D> direction{};
  direction[most] = 1;
  for (int round = 0; round < 60; ++round) {
    Point<D> next{};
    for (std::size_t i = 0; i < D; ++i)
      for (std::size_t j = 0; j < D; ++j) next[i] += of(int(i), int(j)) * direction[j];
    const double size = length<D, double>(next);
    if (!(size > 0)) break;
    for (std::size_t i = 0; i < D; ++i) direction[i] = next[i] / size;
  }
  return direction;
}

}  // namespace

template <int D>
Point<D> edge_normal(const Model<D>& model, std::size_t cell) {
  const auto at = model.grid().index(std::int64_t(cell));
  const double here = fracture_share_of(model, cell);
  Point<D> slope{};
  SymmetricTensor<D, double> spread;
  double steps = 0;
  // All neighbours, those beside the cell more than those at its corners.
  Grid<D> about;
  about.shape.fill(3);
  for (std::int64_t n = 0; n < about.size(); ++n) {
    auto step = about.index(n);
    auto beside = at;
    double weight = 1;
    for (std::size_t axis = 0; axis < D; ++axis) {
      step[axis] -= 1;
      beside[axis] += step[axis];
      if (step[axis] == 0) weight *= 2;
    }
    const double change = weight * (share_beside(model, beside, cell) - here);
    steps += std::abs(change);
    for (std::size_t i = 0; i < D; ++i) {
      slope[i] += change * double(step[i]);
      for (std::size_t j = i; j < D; ++j)
        spread(int(i), int(j)) += change * change * double(step[i] * step[j]);
    }
  }
  const double size = length<D, double>(slope);
  if (!(size > 0.2 * steps)) return largest_direction<D>(spread);
  for (double& along : slope) along /= size;
  return slope;
}

template <int D>
double held_share(const Point<D>& normal, const Point<D>& edge, double lambda, double mu) {
  double cosine = 0;
  for (std::size_t axis = 0; axis < D; ++axis) cosine += normal[axis] * edge[axis];
  const double square = std::min(cosine * cosine, 1.);
  const double dipping = 4 * square * (1 - square) * (lambda + mu) / (lambda + 2 * mu);
  return D == 2 ? dipping : std::max(dipping, 1 - square);
}

SLIPWAVE_INSTANTIATE_D(FUNCTION, edge_normal);
SLIPWAVE_INSTANTIATE_D(FUNCTION, held_share);

}  // namespace slipwave
