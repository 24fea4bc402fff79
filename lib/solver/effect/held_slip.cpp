// SPDX-License-Identifier: BSD-3-Clause
#include "solver/effect/held_slip.hpp"

#include <cmath>

#include "base/instantiate.hpp"
#include "model/cluster_edge.hpp"

namespace slipwave::solver {

template <int D, class Real>
HeldSlip<D, Real>::HeldSlip(std::size_t cells) : cells_(cells), held_(cells * std::size_t(components)) {}

template <int D, class Real>
void HeldSlip<D, Real>::put(std::size_t place, double share, double held, const Point<D>& edge, double lambda,
                            double mu) {
  const double stiffness = share + (1 - share) * held;
  auto& cell = cells_[place];
  cell.passed = Real(share / stiffness);
  // Planes along their edge or across it are not held: nothing is kept, to the last bit.
  cell.held = held > 1e-12 ? Real((1 - share) / stiffness) : Real(0);
  cell.ratio = Real(lambda / (lambda + 2 * mu));
  for (std::size_t axis = 0; axis < D; ++axis) cell.edge[axis] = Real(edge[axis]);
}

template <int D, class Real>
void HeldSlip<D, Real>::to_part(const Real* stress, std::int64_t pitch, std::size_t place, std::int64_t n,
                                Real* part) const {
  for (std::int64_t c = 0; c < components; ++c)
    for (std::int64_t i = 0; i < n; ++i)
      part[c * piece + i] =
          stress[c * pitch + i] + held_[std::size_t(c) * cells_.size() + place + std::size_t(i)];
}

/// A change d of the stress in the part is that of slip -d/(2 mu'), mu' being mu times the part's stiffness.
template <int D, class Real>
void HeldSlip<D, Real>::from_part(Real* stress, std::int64_t pitch, std::size_t place, std::int64_t n,
                                  const Real* before, const Real* after, bool as_whole) {
  for (std::int64_t i = 0; i < n; ++i) {
    const auto& cell = cells_[place + std::size_t(i)];
    if (!(cell.passed > 0)) continue;
    SymmetricTensor<D, Real> change;
    Real any = 0;
    for (std::int64_t c = 0; c < components; ++c) {
      change.values[std::size_t(c)] = after[c * piece + i] - before[c * piece + i];
      any = std::max(any, std::abs(change.values[std::size_t(c)]));
    }
    if (!(any > 0)) continue;
    const Real passed = as_whole ? Real(1) : cell.passed;
    for (std::int64_t c = 0; c < components; ++c)
      stress[c * pitch + i] += passed * change.values[std::size_t(c)];
    if (as_whole || !(cell.held > 0)) continue;
    const auto held = held_strain<D, Real>(change, cell.edge, cell.ratio);
    for (std::int64_t c = 0; c < components; ++c)
      held_[std::size_t(c) * cells_.size() + place + std::size_t(i)] +=
          cell.held * held.values[std::size_t(c)];
  }
}

SLIPWAVE_INSTANTIATE_D_REAL(TYPE, class HeldSlip);

}  // namespace slipwave::solver
