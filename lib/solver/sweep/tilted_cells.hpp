// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "solver/kernels/kernels.hpp"
#include "solver/sweep/domain.hpp"
#include "solver/sweep/interface_stencils.hpp"
#include "solver/sweep/state.hpp"

namespace slipwave::solver {

/// Rows of symmetric matrices of the components along and across an axis.
template <class Real>
struct MatrixRows {
  const Real *along, *mixed, *across;
};

/// One pair of a sweep: v and s of the first of the columns, and its corrections.
template <class Real>
struct TiltedPairFields {
  const Real *v, *s;
  PairCorrections<Real> corrections;
};

/// Cells whose axes of symmetry do not lie along the grid, in 2-D: interfaces cut them
/// (theory/anisotropy.md), or their beds dip. The loops of a sweep take them for isotropic or upright
/// ones; then this overwrites their outgoing waves, the states of their faces, and adds to their stresses
/// what is missing.
template <int D, class Real>
class TiltedCells {
 public:
  TiltedCells() = default;
  /// `stencils` by axis and wave, at the order that reaches `reach` cells.
  TiltedCells(const State<D, Real>& state, const Domain<D>& domain, int reach,
              const std::array<std::array<InterfaceStencils, std::size_t(D)>, std::size_t(D)>& stencils);

  bool empty() const { return of_axis_[0].x.empty(); }
  /// Whether a row holds any in these columns.
  bool any(std::int64_t row, const IndexRange& columns) const;

  using PairFields = TiltedPairFields<Real>;
  using Pairs = std::array<PairFields, 2>;
  /// Outgoing waves of the cells of these columns of a row, from the fields of P and S; `b` is dt/(rho h) of
  /// the first of them.
  void reconstruct(int axis, std::int64_t row, const IndexRange& columns, const Kernels<Real>& kernels,
                   std::int64_t stride, const Pairs& pairs, const Real* b, Real scale,
                   OutgoingWaves<Real> outgoing) const;
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
  static constexpr std::int32_t none = -1;
  /// A value of each cell of an axis, in their order.
  using Values = std::vector<Real>;
  /// A symmetric matrix of the components along and across the axis.
  struct Matrix {
    Real along, mixed, across;
  };
  struct Matrices {
    Values along, mixed, across;
    void add(double of_along, double of_mixed, double of_across) {
      along.push_back(Real(of_along)), mixed.push_back(Real(of_mixed)), across.push_back(Real(of_across));
    }
    MatrixRows<Real> from(std::int32_t n) const {
      return {along.data() + n, mixed.data() + n, across.data() + n};
    }
    Matrix operator[](std::int32_t n) const {
      return {along[std::size_t(n)], mixed[std::size_t(n)], across[std::size_t(n)]};
    }
  };
  /// A cell whose stencils end at interfaces or edges.
  struct Ending {
    int reach;                    // of the reconstruction
    std::array<Real, 2> courant;  // Courant numbers of both waves over a whole step
    std::array<InterfaceStencil, 2> stencils;
  };
  /// A face before column x; numbers of the cells before and behind it, or `none`.
  struct Face {
    std::int32_t x, lo, hi;
  };
  struct Axis {
    std::vector<std::int32_t> x;            // by row, then x
    std::vector<std::int64_t> first_cells;  // of each row, and the end
    Values cosine, sine;                    // motion of the faster wave: along the axis and across it
    std::array<Values, 2> z;                // impedances of both waves
    Matrices impedance;                     // the same as a matrix
    Matrices more;                          // stiffness times dt/h, less that of the cell as loops take it
    Values passive, passive_across;         // the same, of the passive stress
    std::vector<std::int32_t> ending;       // its place among `endings`, or `none`
    std::vector<Ending> endings;
    std::vector<Face> faces;
    std::vector<std::int64_t> first_faces;
  };
  static IndexRange cells_of(const Axis& of, std::int64_t row, const IndexRange& columns);
  void add_cell(const State<D, Real>& state, const Domain<D>& domain, int axis, const TiltedMedium& tilted,
                int reach, const std::array<InterfaceStencils, std::size_t(D)>& stencils);
  void add_faces(int axis, const Index<D>& shape);
  void reconstruct_run(const Axis& of, const IndexRange& run, const Kernels<Real>& kernels,
                       std::int64_t stride, std::int64_t at, const Pairs& pairs, const Real* b, Real scale,
                       OutgoingWaves<Real> outgoing) const;
  template <int Order>
  void reconstruct_ending(const Axis& of, std::size_t n, std::int64_t stride, std::int64_t at,
                          const Pairs& pairs, Real scale, OutgoingWaves<Real> outgoing) const;

  std::array<Axis, std::size_t(D)> of_axis_;
};

}  // namespace slipwave::solver
