// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "solver/kernels/curvilinear_formulas.hpp"
#include "solver/sweep/by_line.hpp"
#include "solver/sweep/domain.hpp"
#include "solver/sweep/state.hpp"
#include "solver/sweep/surface_tractions.hpp"

namespace slipwave::solver {

/// A field's value in a cell of the grid and its weight in a sum.
template <int D>
struct SurfaceTerm {
  Index<D> cell{};
  int row = 0;
  double weight = 0;
};

/// All of what motion along each axis adds.
template <int D>
constexpr Point<D> whole_shares() {
  Point<D> shares{};
  for (auto& share : shares) share = 1;
  return shares;
}

/// By component of velocity, the correction of velocity at a free surface (side 0 low, 1 high of an axis) of
/// a solid: the difference between cell j before the surface and its image beyond it, over 2 j + 1, as a sum
/// of velocities of cells along the edge (theory.md (E11)), with such `shares` of what motion along each axis
/// adds. `at` is a cell of the edge. Empty where the image is not corrected: in fluid and void, beside them,
/// beside strong interfaces and free surfaces of another axis, and on grids of a few cells along the edge (in
/// 3-D: along both axes of it).
template <int D>
std::array<std::vector<SurfaceTerm<D>>, std::size_t(D)> surface_slopes(
    const Domain<D>& domain, const Index<D>& at, int axis, int side,
    const Point<D>& shares = whole_shares<D>());

/// A field's value `offset` from a cell, which beyond an edge is that of its image; nothing beyond a free
/// surface and where the rock there is not like that of the cell.
template <int D>
std::optional<SurfaceTerm<D>> surface_term(const Domain<D>& domain, const Index<D>& at,
                                           const Index<D>& offset, int row, double weight);

/// N of the surface where a cell ends on a side (0 low, 1 high) of an axis, in curvilinear rows with z = 1,
/// and how far the first ghost is from it along the axis, in cells.
template <int D>
std::pair<Point<D>, double> surface_at(const Domain<D>& domain, const Index<D>& at, int axis, int side);

/// Free surfaces across one axis on one side of cells (0 low, 1 high): an edge of the grid, or all faces
/// between cells and void inside it. In sweeps across it holds the corrections of the antisymmetric extension
/// of solids beyond (v even, s odd): the correction of velocity is surface_slopes(); the correction of
/// traction removes what sweeps along the surface have added to its tractions when a sweep across it begins,
/// half of what they add in a whole step. And it holds what stands for no traction (SurfaceTractions).
template <int D, class Real>
class FreeSurface {
 public:
  FreeSurface() = default;
  /// An edge of the grid. Empty where it has another law.
  FreeSurface(const Layout<D>& layout, const Domain<D>& domain, int axis, int side);
  /// Cells, in level rows if the axis is the last, that void is beside.
  static FreeSurface beside_void(const Layout<D>& layout, const Domain<D>& domain, int axis, int side);

  bool empty() const { return cells_.empty(); }
  std::int64_t memory_bytes() const {
    return bytes_of(cells_) + bytes_of(matrix_ends_) + bytes_of(terms_) + bytes_of(retained_) +
           inside_cells_.memory_bytes() + bytes_of(velocity_corrections_) + bytes_of(traction_corrections_) +
           tractions_.memory_bytes();
  }
  int side() const { return side_; }
  /// Whether it is not an edge of the grid.
  bool inside() const { return inside_; }
  /// Columns from what lies beyond the surface to its cells.
  int along_x() const { return axis_ > 0 ? 0 : outward_; }
  /// Copies the fields of the surface's cells on this row in these columns as they are now, across another
  /// axis than the last: update_corrections() reads the copy, since sweeps change row after row.
  void retain(const State<D, Real>& state, std::int64_t line, const IndexRange& columns);
  /// Computes all below at cells of these numbers for the following sweep across, from the fields or the
  /// copy, up to free_surface_reach cells beyond.
  void update_corrections(const State<D, Real>& state, const IndexRange& numbers);
  /// These return the corrections for a pair of the sweep across (0 P, then S by axes), by number: that of v
  /// over 2 j + 1, and that of s in a sweep over a whole step.
  const Real* velocity_correction(int pair) const { return velocity_corrections_[std::size_t(pair)].data(); }
  const Real* traction_correction(int pair) const { return traction_corrections_[std::size_t(pair)].data(); }
  const SurfaceTractions<D, Real>& tractions() const { return tractions_; }
  /// Place of a cell of the surface in these lists; at an edge cells along x follow each other.
  std::int64_t number(const Index<D>& at) const;
  /// Beside void: the number of a cell, or -1 where nothing is corrected.
  std::int64_t corrected(const Index<D>& at) const;
  /// Whether a pair of the sweep across is corrected in a cell of the surface.
  bool corrects(const Index<D>& at, int pair) const;
  /// The numbers of the cells in these columns of lines that follow each other, at an edge of its lines; at
  /// an edge of x whatever the columns.
  IndexRange numbers(const IndexRange& lines, const IndexRange& columns) const;
  /// The column of a cell.
  std::int64_t column(std::int64_t number) const {
    if (inside_) return inside_cells_[number].x;
    return axis_ > 0 ? number % layout_.padded_nx() : side_ ? layout_.shape()[0] - 1 : 0;
  }

 private:
  struct Term {
    std::int64_t place;
    Real weight;
  };
  /// One pair at one cell of the surface; the places of b and of the pair's impedance in the material.
  struct Cell {
    int pair;
    std::int64_t number, b, impedance;
    Real outward;  // over the height of the row in cells
    std::size_t terms_begin, terms_end;
  };
  /// A cell in a curvilinear row or of anisotropic rock: the place of b, and the density times the stiffness
  /// by which the slopes of all pairs put traction on the surface (theory.md (V7)).
  struct MatrixEnd {
    std::int64_t number, b;
    SmallMatrix<std::size_t(D), Real> stiffness;
  };
  /// A cell beside void: its column, its place in the fields, and whether it is corrected.
  struct InsideCell {
    std::int64_t x, place;
    bool corrected = false;
  };
  FreeSurface(const Layout<D>& layout, int axis, int side, bool inside);
  void find_corrections(const Domain<D>& domain, const std::vector<Index<D>>& cells);
  void find_corrections(const Domain<D>& domain, const Index<D>& at);
  bool corrects_all(const Domain<D>& domain, const Index<D>& at) const;
  /// Place of a field of a cell of the surface, or of the one behind it, in what update_corrections() reads.
  std::int64_t place_of(const Index<D>& at, int behind, int row) const;
  SmallMatrix<std::size_t(D), Real> stiffness_across(const Domain<D>& domain, const Index<D>& at) const;

  int axis_ = 0, side_ = 0;
  bool inside_ = false;
  int outward_ = 1;
  Layout<D> layout_;
  ByLine<InsideCell> inside_cells_;  // by number, inside the grid
  std::vector<Cell> cells_;          // by number
  std::vector<MatrixEnd> matrix_ends_;
  std::vector<Term> terms_;     // places in the fields, across all axes but the last in retained_
  std::vector<Real> retained_;  // [number][cell of the surface, the one behind it][row]
  int retained_cells_ = 1, retained_rows_ = D;
  std::array<std::vector<Real>, D> velocity_corrections_, traction_corrections_;
  SurfaceTractions<D, Real> tractions_;
};

}  // namespace slipwave::solver
