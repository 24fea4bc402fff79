// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "solver/sweep/anisotropic_cells.hpp"
#include "solver/sweep/domain.hpp"
#include "solver/sweep/face_treatment.hpp"
#include "solver/sweep/free_surface.hpp"
#include "solver/sweep/interface_corrections.hpp"
#include "solver/sweep/interface_stencils.hpp"
#include "solver/sweep/metric.hpp"
#include "solver/sweep/row_method.hpp"
#include "solver/sweep/split_faces.hpp"
#include "solver/sweep/state.hpp"

namespace slipwave::solver {

/// What sweeps know of the cells and faces of a domain besides their state, for rows of any kind: stencils
/// and corrections beside interfaces, free surfaces, anisotropic cells, split faces, the metric.
template <int D, class Real>
struct SweepTables {
  static constexpr int z_axis = D - 1;
  /// A wave family along one axis: its fields' rows.
  struct Pair {
    Wave wave;
    int v, s;  // rows of the line
  };
  /// Rows that a sweep changes: of the P pair, the passive normal stresses, of the S pairs, and in 3-D where
  /// axes of rock are turned the shear stress across the axis.
  static constexpr int changed_at_most = 4 * D - 3;

  /// Keeps a reference to the state only.
  SweepTables(State<D, Real>& state, const Domain<D>& domain, int order);

  std::int64_t memory_bytes() const;
  /// Cells with stencils of their own across level faces: all axes and waves.
  std::int64_t stencil_cells() const;
  int pair_count() const { return shear ? D : 1; }
  int rows_changed() const { return shear ? 3 * D - 1 + (couples_all ? 1 : 0) : 2; }
  /// The fields that a sweep changes, from those of a cell on: field row 0, a pitch apart.
  SweptRows<Real> swept_rows(int axis, Real* fields, std::int64_t pitch) const;
  /// `scale` of a sweep along an axis over a row: along z in proportion to how much lower than a cell it is.
  Real scale_of(int axis, const Index<D>& at, Real scale) const {
    return axis == z_axis ? scale * metric.inverse_height(at[z_axis]) : scale;
  }
  const InterfaceStencils& stencils_of(int axis, int pair) const {
    return stencils[std::size_t(axis)][std::size_t(std::min(pair, distinct_pairs - 1))];
  }
  /// Whether any pair of an axis has stencils of its own in these columns.
  bool any_stencils(int axis, std::int64_t line, const IndexRange& columns) const;
  const FreeSurface<D, Real>& edge(int axis, int side) const { return surfaces[axis][side]; }
  const FreeSurface<D, Real>& beside_void(int axis, int side) const { return surfaces[axis][2 + side]; }
  /// Returns the corrections of a pair of the sweep along an axis; `whole`: of a whole step.
  PairCorrections<Real> corrections_of(int axis, int pair, bool whole) const;
  /// The fields of all pairs of a sweep along an axis, from those of a cell on, with these corrections.
  typename AnisotropicCells<D, Real>::Pairs pairs_from(int axis, const Real* fields, std::int64_t pitch,
                                                       bool whole) const;
  /// Adds to the stresses of anisotropic cells what loops have not; `size` is that of the fraction of the
  /// step in the row.
  void add_missing_stress(const RowPart<D, Real>& part, Real size, const RowFlux<Real>& flux) const;

  State<D, Real>& state;
  std::array<const Kernels<Real>*, 2> kernels;  // [uniform]
  EdgeLaws<D> edges;
  int order, reach;
  bool shear, anisotropic, couples_all, monotone = false;
  std::array<std::array<Pair, D>, D> pairs;                 // [axis]: P, then S by axes
  std::array<std::array<int, changed_at_most>, D> changed;  // [axis]: rows
  Metric<D, Real> metric;
  std::array<InterfaceCorrections<D, Real>, std::size_t(D)> corrections;  // [axis]
  /// [axis]: at the low and the high edge of the grid, then beside void on the low and the high side of
  /// cells.
  std::array<std::array<FreeSurface<D, Real>, 4>, D> surfaces;
  /// [axis], of P and of S pairs. The S pairs of an axis share theirs, but where they have different
  /// impedances.
  std::array<std::array<InterfaceStencils, D>, D> stencils;
  int distinct_pairs = 2;
  AnisotropicCells<D, Real> anisotropic_cells;
  std::unique_ptr<SplitFaces<D, Real>> split{};
  std::vector<FaceTreatment<D, Real>*> treatments{};

 private:
  std::array<Pair, D> make_pairs(int axis) const;
  std::array<int, changed_at_most> rows_changed_along(int axis) const;
  void find_stencils(const Domain<D>& domain);
};

}  // namespace slipwave::solver
