#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "solver/sweep/domain.hpp"
#include "solver/sweep/interface_stencils.hpp"
#include "solver/sweep/state.hpp"

namespace slipwave::solver {

/// Cells whose axes of symmetry do not lie along the grid, in 2-D: interfaces cut them (theory.md 1.11), or
/// their beds dip (1.12). The
/// loops of a sweep take them for isotropic or upright ones; then this overwrites their outgoing waves, the
/// states of their faces, and adds to their stresses what is missing.
template <int D, class Real>
class TiltedCells {
 public:
  TiltedCells() = default;
  /// `stencils` by axis and wave, at the order that reaches `reach` cells.
  TiltedCells(const State<D, Real>& state, const Domain<D>& domain, int reach,
              const std::array<std::array<InterfaceStencils, 2>, std::size_t(D)>& stencils);

  bool empty() const { return of_axis_[0].cells.empty(); }
  /// Whether a row holds any in these columns.
  bool any(std::int64_t row, const IndexRange& columns) const;

  /// One pair of a sweep: v and s of the first of the columns, and its corrections.
  struct PairFields {
    const Real *v, *s;
    PairCorrections<Real> corrections;
  };
  using Pairs = std::array<PairFields, 2>;
  /// Outgoing waves of the cells of these columns of a row, from the fields of P and S.
  void reconstruct(int axis, std::int64_t row, const IndexRange& columns, std::int64_t stride,
                   const Pairs& pairs, Real scale, OutgoingWaves<Real> outgoing) const;
  /// States of the faces before the cells of these columns (along x of a row, along z before row `row`),
  /// between the outgoing waves of the cells before (`below`) and behind them.
  void solve(int axis, std::int64_t row, const IndexRange& columns, OutgoingWaves<Real> below,
             OutgoingWaves<Real> above, const MaterialRows<Real>& lo, const MaterialRows<Real>& hi,
             InterfaceStates<Real> faces) const;
  /// Adds to the stresses of these columns, advanced as isotropic ones; `size` is that of the fraction of the
  /// step.
  void add_stress(int axis, std::int64_t row, const IndexRange& columns, Real size, InterfaceStates<Real> lo,
                  InterfaceStates<Real> hi, const SweptRows<Real>& rows) const;

  std::int64_t memory_bytes() const;

 private:
  /// A symmetric matrix of the components along and across the axis.
  struct Matrix {
    Real along, mixed, across;
  };
  struct Cell {
    std::int32_t x;
    int reach;                     // of the reconstruction
    Real cosine, sine;             // motion of the faster wave: along the axis and across it
    std::array<Real, 2> z;         // impedances of both waves
    std::array<Real, 2> courant;   // Courant numbers of both waves over a whole step
    Matrix impedance;              // the same as a matrix
    Matrix more;                   // stiffness times dt/h, less that of the isotropic cell
    Real passive, passive_across;  // the same, of the passive stress
    std::array<InterfaceStencil, 2> stencils;
  };
  /// A face before column x; numbers of the cells before and behind it, or `none`.
  struct Face {
    std::int32_t x, lo, hi;
  };
  static constexpr std::int32_t none = -1;
  struct Axis {
    std::vector<Cell> cells;                // by row, then x
    std::vector<std::int64_t> first_cells;  // of each row, and the end
    std::vector<Face> faces;
    std::vector<std::int64_t> first_faces;
  };
  void add_faces(int axis, const Index<D>& shape);
  template <int Order>
  void reconstruct_cell_of(const Cell& cell, std::int64_t stride, std::int64_t at, const Pairs& pairs,
                           Real scale, std::array<Real, 2>& up, std::array<Real, 2>& down) const;

  std::array<Axis, std::size_t(D)> of_axis_;
};

}  // namespace slipwave::solver
