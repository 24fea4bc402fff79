// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <compare>
#include <cstdint>
#include <functional>
#include <map>
#include <vector>

#include "solver/kernels/curvilinear_formulas.hpp"
#include "solver/sweep/domain.hpp"
#include "solver/sweep/state.hpp"

namespace slipwave::solver {

/// What stands for zero traction at a free surface in a sweep across it over a whole step: as much, of second
/// order in the step, as gives waves along the surface of an isotropic solid the speed that splitting the
/// step takes from them (theory.md (E11b)). None where the extension beyond the surface has no corrections
/// (FreeSurface), or the axes of rock are tilted.
template <int D, class Real>
class SurfaceTractions {
 public:
  SurfaceTractions() = default;
  /// Makes an empty list for a surface of `cells` cells that end there on this side (0 low, 1 high) of an
  /// axis.
  SurfaceTractions(int axis, int side, std::int64_t cells);
  /// Functions of this type return the offset of a field (`row`) of a cell of the surface, or of the one
  /// behind it (`behind` 1), from the first field of the cell that is added.
  using Offset = std::function<std::int64_t(const Index<D>& at, int behind, int row)>;
  /// Adds a cell all of whose pairs are corrected, with numbers that ascend; its places in the fields and of
  /// b in the material.
  void add(const Domain<D>& domain, const Index<D>& at, std::int64_t number, std::int64_t place,
           std::int64_t b, const Offset& offset);
  /// Once all are added.
  void finish();

  bool empty() const { return cells_.empty(); }
  std::int64_t memory_bytes() const;
  /// Computes them at cells first <= number < last of the surface, numbered as by FreeSurface, from the
  /// fields before the sweep, up to free_surface_reach cells beyond.
  void update(const Real* fields, const Real* material, std::int64_t first, std::int64_t last);
  /// Returns the tractions of a pair of the sweep (0 P, then S by axes), by number.
  const Real* of(int pair) const { return tractions_[std::size_t(pair)].data(); }
  /// What the sweeps before have bent the velocity along the surface, to be added to the correction of
  /// the pair's (FreeSurface) (theory.md (E11c)).
  const Real* bend(int pair) const { return bends_[std::size_t(pair)].data(); }

 private:
  /// A field's value so far from the cell's first one.
  struct Term {
    std::int64_t offset;
    Real weight;
    auto operator<=>(const Term& other) const = default;  // NOLINT(modernize-use-nullptr): none is there
  };
  /// The terms of each pair: of stresses, of velocities, and of its bend.
  using Pattern = std::array<std::array<std::vector<Term>, 3>, std::size_t(D)>;
  /// A cell of the surface: places in the fields and of b, shares times mu rho, and lambda rho.
  struct Cell {
    std::int64_t number, place, b;
    std::array<Real, D> normal;  // by pair
    Real tangential, lambda, bend;
    RowVector<D, Real> direction;  // in a curvilinear row: N, normal to the surface
    std::int32_t pattern;
  };
  std::int64_t size_ = 0;
  int axis_ = 0, side_ = 0;
  std::vector<Cell> cells_;  // by number
  std::vector<Pattern> patterns_;
  std::map<Pattern, std::int32_t> number_of_pattern_;  // while cells are added
  std::array<std::vector<Real>, D> tractions_, bends_;
};

}  // namespace slipwave::solver
