#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "solver/kernels/bent_formulas.hpp"
#include "solver/sweep/domain.hpp"
#include "solver/sweep/state.hpp"

namespace slipwave::solver {

/// What stands for zero traction at a free surface at the top (side 0) or the bottom (1) of the grid in a
/// sweep across it over a whole step: as much, of second order in the step, as gives waves along the surface
/// of an isotropic solid the speed that splitting the step takes from them (theory.md (E11b)). None where the
/// extension beyond the surface has no corrections (FreeSurface), or the axes of rock are tilted.
template <int D, class Real>
class SurfaceTractions {
 public:
  SurfaceTractions() = default;
  SurfaceTractions(const Layout<D>& layout, const Domain<D>& domain, int side);

  bool empty() const { return cells_.empty(); }
  std::int64_t memory_bytes() const;
  /// Computes them at cells first <= number < last of the surface, numbered as by FreeSurface, from the
  /// fields before the sweep, up to free_surface_reach cells beyond.
  void update(const State<D, Real>& state, std::int64_t first, std::int64_t last);
  /// Of a pair of the sweep (0 P, then S by axes), by number.
  const Real* of(int pair) const { return tractions_[std::size_t(pair)].data(); }
  /// What the sweeps before have bent the velocity along the surface, to be added to the correction of
  /// the pair's (FreeSurface) (theory.md (E11c)).
  const Real* bend(int pair) const { return bends_[std::size_t(pair)].data(); }

 private:
  /// A field's value so far from the cell's first one.
  struct Term {
    std::int64_t offset;
    Real weight;
    bool operator==(const Term& other) const { return offset == other.offset && weight == other.weight; }
  };
  /// Of each pair its terms of stresses, of velocities, and of its bend.
  using Pattern = std::array<std::array<std::vector<Term>, 3>, std::size_t(D)>;
  /// A cell of the surface: places in the fields and of b, shares times mu rho, and lambda rho.
  struct Cell {
    std::int64_t number, place, b;
    std::array<Real, D> normal;  // by pair
    Real tangential, lambda, bend;
    RowVector<D, Real> direction;  // N, normal to the surface
    std::int32_t pattern;
  };
  std::vector<Cell> cells_;  // by number
  std::vector<Pattern> patterns_;
  std::array<std::vector<Real>, D> tractions_, bends_;
};

}  // namespace slipwave::solver
