// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "grid/field.hpp"
#include "solver/kernels/kernels.hpp"
#include "solver/sweep/anisotropic_cells.hpp"
#include "solver/sweep/domain.hpp"
#include "solver/sweep/interface_corrections.hpp"
#include "solver/sweep/interface_stencils.hpp"
#include "solver/sweep/metric.hpp"
#include "solver/sweep/row_waves.hpp"

namespace slipwave::solver {

/// Two media that touch at a face of a curvilinear grid, before and behind it.
template <int D, class Real>
struct WeldedFace {
  /// The share R of velocities in the order of RowVector: R = (Z_l + Z_r)^-1 Z_r with the cell before as l
  /// (theory.md (F13)); for that behind it is 1 - R.
  SmallMatrix<std::size_t(D), Real> share;
  std::array<bool, 2> solid;
};

/// Cells of curvilinear rows whose stencils across the rows would reach over a strong interface of P or S, or
/// into void: beyond, velocities and tractions are extended along and across the normal of that face
/// (theory.md (E10), (F6), (F13)).
template <int D, class Real>
class CurvilinearStencils {
 public:
  CurvilinearStencils() = default;
  CurvilinearStencils(const Domain<D>& domain, int reach, const InterfaceCorrections<D, Real>& corrections,
                      const Metric<D, Real>& metric);

  std::size_t size() const { return list_.cells.size(); }
  std::int64_t memory_bytes() const { return list_.memory_bytes() + bytes_of(welds_); }
  /// What sweeps across a row read, from the first of some columns on.
  struct Row {
    CurvilinearFields<const Real> fields;
    CurvilinearAcross<Real> metric;
    MaterialRows<Real> material;
    Real scale;
  };
  /// Overwrites the outgoing waves of the listed cells of these columns of a row; those of anisotropic cells
  /// are known to `anisotropic`.
  void correct(int order, std::int64_t line, const IndexRange& columns, const Row& row,
               const InterfaceCorrections<D, Real>& corrections,
               const AnisotropicCellsAcross<D, Real>& anisotropic, OutgoingWaves<Real> outgoing) const;

 private:
  /// A side serves P and S; the weld is a place in welds_.
  using Side = StencilSide<2, std::int32_t>;

  ByLine<Stencil<Side>> list_;
  std::vector<WeldedFace<D, Real>> welds_;
};

}  // namespace slipwave::solver
