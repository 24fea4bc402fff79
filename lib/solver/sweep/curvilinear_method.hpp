// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "solver/sweep/anisotropic_cells.hpp"
#include "solver/sweep/curvilinear_stencils.hpp"
#include "solver/sweep/row_method.hpp"
#include "solver/sweep/sweep_tables.hpp"

namespace slipwave::solver {

/// Curvilinear rows of a fitted grid (theory.md (F1)-(F6)), and across the rows the faces before and behind
/// them.
template <int D, class Real>
class CurvilinearMethod final : public RowMethod<D, Real> {
 public:
  CurvilinearMethod(const SweepTables<D, Real>& tables, const Domain<D>& domain);

  void reconstruct(const RowPart<D, Real>& part, std::int64_t stride, OutgoingWaves<Real> outgoing,
                   PrefetchQueue<Real>& prefetch) const override;
  void solve(const RowFaces<D, Real>& faces) const override;
  void update(const RowPart<D, Real>& part, const RowFlux<Real>& flux,
              PrefetchQueue<Real>& prefetch) const override;
  /// Solves at faces across the rows and advances the cells of `done`, which none of them bounds, in one
  /// loop.
  void advance(const RowFaces<D, Real>& faces, const RowPart<D, Real>& done, const RowFlux<Real>& flux,
               PrefetchQueue<Real>& prefetch) const;

  /// Cells with stencils of their own across the rows.
  std::int64_t stencil_cells() const { return std::int64_t(stencils_.size()); }
  std::int64_t memory_bytes() const { return stencils_.memory_bytes() + anisotropic_across_.memory_bytes(); }

 private:
  static constexpr int z_axis = D - 1;
  const CurvilinearKernels<Real>& kernels() const { return tables_.kernels[false]->curvilinear[D - 2]; }
  bool fluid_at(const RowFaces<D, Real>& faces) const;
  /// Returns what the Riemann solution reads at faces across the rows.
  CurvilinearSolve<Real> across(const RowFaces<D, Real>& faces) const;
  /// Returns what the update of a row reads in a sweep across the rows.
  CurvilinearUpdate<Real> across(const RowPart<D, Real>& part, const RowFlux<Real>& flux) const;

  const SweepTables<D, Real>& tables_;
  AnisotropicCellsAcross<D, Real> anisotropic_across_;
  CurvilinearStencils<D, Real> stencils_;
};

}  // namespace slipwave::solver
