// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "grid/tensor.hpp"
#include "model/model.hpp"

namespace slipwave::solver {

/// The stress in the parts of cells in which planes slip while the rest of the cell holds them, where edges
/// of clusters cut cells (theory/slip.md). Slip corrections act on it as on that of a whole cell.
template <int D, class Real>
class HeldSlip {
 public:
  /// Makes room for so many cells, none of them cut.
  explicit HeldSlip(std::size_t cells);
  /// Describes a cell that an edge cuts, in rock with these Lame parameters. `held` is what of the held
  /// stress acts on the planes (S39), `edge` the normal of the edge.
  void put(std::size_t place, double share, double held, const Point<D>& edge, double lambda, double mu);

  /// Applies act(stress, pitch, place, count) to the n cells from `place` on, in pieces; components of the
  /// stress are `pitch` apart. It gets the stress of the parts that slip, and the change of that is made one
  /// of the stress of the cells. With `as_whole` the change is taken over as it is.
  template <class Act>
  void apply(Real* stress, std::int64_t pitch, std::size_t place, std::int64_t n, bool as_whole,
             const Act& act) {
    alignas(64) std::array<Real, components * piece> part;
    for (std::int64_t done = 0; done < n; done += piece) {
      const std::int64_t count = std::min(piece, n - done);
      Real* const cells = stress + done;
      const auto first = place + std::size_t(done);
      to_part(cells, pitch, first, count, part.data());
      const auto before = part;
      act(part.data(), piece, first, count);
      from_part(cells, pitch, first, count, before.data(), part.data(), as_whole);
    }
  }

  /// What changes from step to step: stress of the parts less that of their cells, component by component.
  std::vector<Real>& memory() { return held_; }
  std::int64_t memory_bytes() const {
    return std::int64_t(held_.size() * sizeof(Real) + cells_.size() * sizeof(Cell));
  }

 private:
  static constexpr std::int64_t components = SymmetricTensor<D, Real>::components, piece = 64;
  struct Cell {
    Real passed = 0;           // of a change of stress in the part on to that of the cell
    Real held = 0, ratio = 0;  // (S38): 1 - share over the part's stiffness; lambda/(lambda + 2 mu)
    std::array<Real, std::size_t(D)> edge{};
  };
  void to_part(const Real* stress, std::int64_t pitch, std::size_t place, std::int64_t n, Real* part) const;
  void from_part(Real* stress, std::int64_t pitch, std::size_t place, std::int64_t n, const Real* before,
                 const Real* after, bool as_whole);

  std::vector<Cell> cells_;
  std::vector<Real> held_;
};

}  // namespace slipwave::solver
