// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <memory>
#include <vector>

#include "scene/edges.hpp"
#include "solver/sweep/anisotropic_cells.hpp"
#include "solver/sweep/curvilinear_stencils.hpp"
#include "solver/sweep/domain.hpp"
#include "solver/sweep/free_surface.hpp"
#include "solver/sweep/interface_corrections.hpp"
#include "solver/sweep/interface_stencils.hpp"
#include "solver/sweep/metric.hpp"
#include "solver/sweep/split_faces.hpp"
#include "solver/sweep/state.hpp"
#include "solver/sweep/surface_tractions.hpp"
#include "solver/sweep/sweep_filter.hpp"
#include "solver/sweep/workspace.hpp"

namespace slipwave::solver {

/// The interface states of a face between rows that two grids share, in sweeps along the last axis: what one
/// finds there, and what the other is given (theory.md (B4)).
template <class Real>
struct SharedFaces {
  std::int64_t row = 0;  // the face before it
  bool given = false;
  std::int64_t rows = 0, pitch = 0;  // states a line, in the order of InterfaceStates; columns
  std::vector<Real> values{};        // [line along x][state][column]
  Real* of_line(std::int64_t line) { return values.data() + line * rows * pitch; }
  const Real* of_line(std::int64_t line) const { return values.data() + line * rows * pitch; }
};

/// Grid-characteristic sweeps in flux form along each axis (theory.md (E3)-(E10)). A sweep moves the fields
/// by `scale` of the time step, back in time where it is negative, under the part of the equations with
/// derivatives along its axis. Rows of a sweep along x, and columns of a sweep across, do not depend on each
/// other. Sweeps can be made in pieces, for the time tiles of TiledExecutor: the results do not depend on the
/// tiling.
template <int D, class Real>
class Sweeps {
 public:
  /// Makes the sweeps of a state; where it has the rows of fluid alone, all loops are of the P pair. Keeps a
  /// reference to the state only.
  Sweeps(State<D, Real>& state, const Domain<D>& domain, int order);
  /// From now on this filters what sweeps add; it must outlive them. Throws std::length_error beyond
  /// most_filters.
  void use(SweepFilter<D, Real>* filter);
  /// From now on this treats its faces, which are among Domain::split; it must outlive the sweeps.
  void use(FaceTreatment<D, Real>* treatment) { treatments_.push_back(treatment); }
  /// From now on the faces of the domain that fractures split are so; `unit` of the fields. Does nothing
  /// where there are none.
  void split_faces(const Domain<D>& domain, double dt_s, double unit);
  /// Null where there are none.
  SplitFaces<D, Real>* split() const { return split_.get(); }
  /// From now on own_rows() are those that the domain owns. Returns the faces to the grids above and below,
  /// where there are any, to be given where a neighbour has more columns.
  std::array<SharedFaces<Real>*, 2> share_faces(const Domain<D>& domain);
  /// Rows of the last axis that are swept: all, or those beside faces that are shared.
  const IndexRange& own_rows() const { return own_; }
  /// Steps of a sweep along the last axis that these rows need. Beyond them a face that is shared needs the
  /// outgoing waves of one more.
  IndexRange steps_of_own_rows() const {
    return {shared_[0] ? own_.first - 1 + reach_ : 0, own_.last + rows_behind()};
  }
  /// Whether nothing that faces of a line have retained or are given is other than zero in these columns.
  bool faces_at_rest(std::int64_t line, const IndexRange& columns) const {
    return (!split_ && !shared_[0] && !shared_[1]) || split_and_shared_at_rest(line, columns);
  }
  /// Lines along x of own_rows().
  IndexRange own_lines() const {
    const auto of_row = state_.layout.lines() / state_.layout.shape()[z_axis];
    return {own_.first * of_row, own_.last * of_row};
  }
  static constexpr std::size_t most_filters = 2;
  /// From now on outgoing waves keep to the criterion of monotonicity (C1). Throws std::logic_error where
  /// rows are curvilinear.
  void keep_monotone();

  /// A whole sweep along any axis, distributed to threads.
  void along(int axis, Real scale, const SweepTime& time = {});
  /// Lets filters change these columns before a sweep along x that follows none along another axis.
  void prepare_along_x(std::int64_t line, const IndexRange& columns, const SweepTime& time) const {
    for (auto* const filter : filters_)
      prepare(*filter, {0, time}, state_.layout.line_index(line), columns, state_.row_fields(line).first,
              state_.layout.row_pitch());
  }

  /// A piece of a sweep along x: advances columns `columns` of a row. Pieces of a row follow each other from
  /// cell 0 to the last, `boundary` passes values from one to the next. 2 * lag further cells must not change
  /// before (as many as there are).
  /// A piece that `begins` in the middle of a row reads 2 * lag cells before it instead of the boundary.
  void along_x(std::int64_t line, const IndexRange& columns, Real scale, StripeBoundary<Real>& boundary,
               Workspace<Real>& work, bool begins = false);
  static constexpr std::int64_t lag = Layout<D>::block;
  /// Computes in `copy` what along_x() would compute for these columns, and lag more cells on both sides; the
  /// state and the memory of filters stay as they are. The copy must have room for the reconstruction beyond
  /// those.
  void copy_ahead(const IndexRange& columns, Real scale, const RowFields<Real>& copy, Workspace<Real>& work);
  /// Computes in the workspace what copy_ahead() computes in a copy, and returns it.
  RowFields<Real> ahead_along_x(std::int64_t line, const IndexRange& columns, Real scale,
                                Workspace<Real>& work);
  /// A piece of a sweep along x in a copy of some columns, which must be far from the ends of the row and
  /// from filters. The first piece `begins`; the copy must hold 2 * lag cells more on both sides.
  void along_copy(const RowFields<Real>& copy, const IndexRange& columns, bool begins, Real scale,
                  StripeBoundary<Real>& boundary, Workspace<Real>& work);
  /// Writes these columns of a copy into its row.
  void put(const RowFields<Real>& copy, const IndexRange& columns);

  /// A piece of a sweep along an axis other than x, from row to row: row `step` - reach along the axis is
  /// reconstructed and row step - rows_behind() is updated, where there are such rows; `at` is their place on
  /// the third axis. Rows up to `step` and `reach` cells on both sides must be as they were before the sweep.
  /// Call for each step from 0 up to the number of rows + rows_behind() - 1 with the same columns and ring.
  void across(int axis, const Index<D>& at, std::int64_t step, const IndexRange& columns, Real scale,
              Ring<Real>& ring, Workspace<Real>& work);
  /// Does a piece of a sweep across where all cells are zero and stay so: clears outgoing waves and face
  /// states in the ring.
  void skip(std::int64_t step, const IndexRange& columns, Ring<Real>& ring) const;
  /// Rows by which the update of a sweep across is behind the newest row.
  std::int64_t rows_behind() const { return reach_ + std::max(reach_, 1); }
  /// For a sweep along that axis of columns from `first` on, once the material is filled in.
  Ring<Real> make_ring(int axis, std::int64_t first, std::int64_t width) const;

  /// Whether free surfaces or interfaces of an axis are corrected: sweeps along it then need the velocities
  /// there of free_surface_reach cells on all sides as they were before the sweep.
  bool corrects_surface(int axis) const {
    return std::any_of(surfaces_[axis].begin(), surfaces_[axis].end(),
                       [](const auto& surface) { return !surface.empty(); }) ||
           !corrections_[axis].empty() || (split_ && split_->any(axis));
  }
  /// Cells the reconstruction reads to each side.
  std::int64_t reach() const { return reach_; }
  /// Copies the velocities at the free surfaces of x on this row, or at those of an axis between x and z
  /// where this row is beside one of them.
  void retain(int axis, std::int64_t line, const IndexRange& columns);
  /// Corrections at the edges of x. Before the first piece of a row is swept along x.
  void correct_side_surfaces(std::int64_t line, const IndexRange& columns);
  /// In 3-D at the edges of y and before these of its rows, before they are swept along y in a plane.
  void correct_flank_surfaces(std::int64_t plane, const IndexRange& rows);
  /// At the edges of z, before across() of that step: of all columns (in 3-D rows of a plane) that it and the
  /// pieces before it were given, and free_surface_reach more.
  void correct_end_surfaces(std::int64_t step, const IndexRange& columns);

  /// Queues these columns of a row for prefetching.
  void queue_prefetch(std::int64_t line, const IndexRange& columns, PrefetchQueue<Real>& prefetch) const;
  Workspace<Real> make_workspace(std::int64_t widest) const;
  /// Cells with stencils of their own, beside strong interfaces, voids and contrasts: all axes and waves.
  std::int64_t interface_stencil_cells() const;
  /// What it holds besides the state.
  std::int64_t memory_bytes() const;
  /// Whether S waves are swept at all.
  bool shear() const { return shear_; }

 private:
  static constexpr int z_axis = D - 1;
  /// A wave family along one axis: its fields' rows and interface stencils.
  struct Pair {
    Wave wave;
    int v, s;  // rows of the line
  };
  /// A piece of a row: the cells to reconstruct, the cells to update, and where its fields are stored.
  struct Piece {
    std::int64_t line;
    IndexRange reconstructed, update;
    Real* fields;  // cell 0 of row 0
    std::int64_t pitch;
    bool remember;
  };
  void advance_piece(const Piece& piece, bool begins, bool ends, Real scale, StripeBoundary<Real>& boundary,
                     Workspace<Real>& work);
  void sweep_piece(const Piece& piece, Real scale, Workspace<Real>& work);
  void reconstruct_row(int axis, const Index<D>& line, const IndexRange& columns, const Real* fields,
                       std::int64_t pitch, std::int64_t stride, Real scale, OutgoingWaves<Real> outgoing,
                       PrefetchQueue<Real>& prefetch) const;
  /// Reconstructs a curvilinear row of a fitted grid.
  void reconstruct_curvilinear_row(int axis, const Index<D>& line, const IndexRange& columns,
                                   const Real* fields, std::int64_t pitch, std::int64_t stride, Real scale,
                                   OutgoingWaves<Real> outgoing, PrefetchQueue<Real>& prefetch) const;
  /// Returns what the Riemann solution reads at the face before a row, across the rows, where that face is
  /// not level or lies before or behind a curvilinear row.
  CurvilinearSolve<Real> curvilinear_face(const Index<D>& at, std::int64_t row, std::int64_t x,
                                          Ring<Real>& ring) const;
  /// Returns what the update of a curvilinear row reads in a sweep across the rows.
  CurvilinearUpdate<Real> curvilinear_update(const Index<D>& line, std::int64_t x, Real* fields,
                                             std::int64_t pitch, InterfaceStates<Real> lo,
                                             InterfaceStates<Real> hi) const;
  bool advance_curvilinear(int axis, const Index<D>& at, std::int64_t row, const IndexRange& columns,
                           Real scale, Ring<Real>& ring, Workspace<Real>& work);
  /// Whether an effect filters the update of any of these columns.
  bool filters(int axis, const Index<D>& line, const IndexRange& columns) const;
  const CurvilinearKernels<Real>& curvilinear_kernels() const { return kernels_[false]->curvilinear[D - 2]; }
  const InterfaceKernels<Real>& face_kernels(bool uniform) const {
    const auto& all = *kernels_[uniform];
    return anisotropic_ ? all.anisotropic_face[D - 2] : shear_ ? all.face[D - 2] : all.fluid_face;
  }
  /// What the update of cells reads, beginning with the first of them: the interface states before and behind
  /// them, the outgoing waves of them and their neighbours.
  struct Flux {
    InterfaceStates<Real> lo, hi;
    OutgoingWaves<Real> below, here, above;
  };
  void update(int axis, const Index<D>& line, const IndexRange& columns, Real* fields, std::int64_t pitch,
              Real scale, const Flux& flux, Workspace<Real>& work, bool remember);
  void update_curvilinear(int axis, const Index<D>& line, const IndexRange& columns, Real* fields,
                          std::int64_t pitch, Real scale, const Flux& flux,
                          const SweptRows<Real>& rows) const;
  /// The rows of fields that a sweep changes, from a cell on.
  SweptRows<Real> swept_rows(int axis, Real* fields, std::int64_t pitch) const;
  /// `scale` of a sweep along an axis over a row: along z in proportion to how much lower than a cell it is.
  Real scale_of(int axis, const Index<D>& line, Real scale) const {
    return axis == z_axis ? scale * metric_.inverse_height(line[z_axis]) : scale;
  }
  void solve_along(std::int64_t line, const IndexRange& cells, bool begins, bool ends,
                   OutgoingWaves<Real> outgoing, InterfaceStates<Real> faces) const;
  void solve_across(int axis, const Index<D>& at, std::int64_t row, const IndexRange& columns, Real scale,
                    Ring<Real>& ring) const;
  using Cells = AnisotropicCells<D, Real>;
  typename Cells::Pairs pairs_from(int axis, const Real* fields, std::int64_t pitch, bool whole) const;
  /// The states of faces across curvilinear rows, before `row`, beside anisotropic cells.
  void solve_anisotropic_across(const Index<D>& at, std::int64_t row, const IndexRange& columns,
                                const CurvilinearSolve<Real>& face, Real sign, bool fluid) const;
  /// What is missing in the stresses of anisotropic cells.
  void add_missing_stress(int axis, const Index<D>& line, const IndexRange& columns, Real* fields,
                          std::int64_t pitch, Real size, const Flux& flux) const;
  bool fused_row(int axis, const Index<D>& at, std::int64_t row, const IndexRange& columns, Real scale,
                 Ring<Real>& ring, Workspace<Real>& work);
  bool fuses(int axis, const Index<D>& at, std::int64_t row, const IndexRange& columns) const;
  FusedRow<Real> fused(int axis, const Index<D>& at, std::int64_t row, const IndexRange& columns,
                       Ring<Real>& ring);
  void find_stencils(const Domain<D>& domain);
  void find_plain_lines();
  /// Columns of a row, and those of its padding where they are its last.
  IndexRange with_padding(const IndexRange& columns) const {
    return {columns.first,
            columns.last == state_.layout.shape()[0] ? state_.layout.padded_nx() : columns.last};
  }
  /// Returns the columns of a piece along x whose outgoing waves it or a copy ahead of it finds anew.
  IndexRange lagging(const IndexRange& columns) const {
    return {columns.first == 0 ? 0 : columns.first + lag, columns.last + 2 * lag};
  }
  void prepare(SweepFilter<D, Real>& filter, const NextSweep& next, const Index<D>& line,
               const IndexRange& columns, Real* fields, std::int64_t pitch) const;
  template <class Advance>
  void filtered(int axis, const Index<D>& line, const IndexRange& columns, Real* fields, Real scale,
                std::int64_t pitch, Workspace<Real>& work, bool remember, Advance&& advance);
  /// The cells of a surface in these columns of lines that follow each other.
  void correct(FreeSurface<D, Real>& surface, const IndexRange& lines, const IndexRange& columns);
  void enter_grid(int axis, int side, std::int64_t n, OutgoingWaves<Real> outgoing,
                  OutgoingWaves<Real> entering) const;
  /// Instead of no traction at the cells of a surface in a line, in a sweep over a whole step: their waves in
  /// these columns enter them.
  void add_tractions(const FreeSurface<D, Real>& surface, const Index<D>& line, const IndexRange& columns,
                     OutgoingWaves<Real> entering) const;
  bool split_and_shared_at_rest(std::int64_t line, const IndexRange& columns) const;
  /// Keeps or sets the states of a face that another grid shares.
  void share(int axis, const Index<D>& at, std::int64_t row, const IndexRange& columns, Ring<Real>& ring);
  void fill_ghost_cells(std::int64_t line, int side, Real* fields, std::int64_t pitch, Real scale) const;
  void fill_ghost_rows(int axis, const Index<D>& at, int side, const IndexRange& columns, Real scale);
  std::array<Pair, D> make_pairs(int axis) const;
  /// Rows that a sweep changes: of the P pair, the passive normal stresses, of the S pairs, and in 3-D where
  /// axes of rock are turned the shear stress across the axis.
  static constexpr int changed = 3 * D - 1, changed_in_fluid = 2, changed_at_most = 4 * D - 3;
  std::array<int, changed_at_most> rows_changed(int axis) const;
  int rows_changed() const { return shear_ ? changed + (couples_all_ ? 1 : 0) : changed_in_fluid; }
  int pair_count() const { return shear_ ? D : 1; }

  State<D, Real>& state_;
  std::array<const Kernels<Real>*, 2> kernels_;  // [uniform]
  std::array<std::unique_ptr<SharedFaces<Real>>, 2> shared_;
  IndexRange own_;  // rows of the last axis that along() sweeps
  std::vector<SweepFilter<D, Real>*> filters_;
  EdgeLaws<D> edges_;
  int order_, reach_;
  bool shear_, anisotropic_, couples_all_, monotone_ = false;
  std::array<std::array<InterfaceStencils, D>, D>
      stencils_;  // [axis], of P and of S pairs as distinct_pairs_
  /// The S pairs of an axis share their stencils, but where they have different impedances.
  int distinct_pairs_ = 2;
  const InterfaceStencils& stencils_of(int axis, int pair) const {
    return stencils_[std::size_t(axis)][std::size_t(std::min(pair, distinct_pairs_ - 1))];
  }
  /// Whether any pair of an axis has stencils of its own in these columns.
  bool any_stencils(int axis, std::int64_t line, const IndexRange& columns) const {
    for (int pair = 0; pair < (shear_ ? distinct_pairs_ : 1); ++pair)
      if (stencils_of(axis, pair).any(line, columns)) return true;
    return false;
  }
  Cells anisotropic_cells_;
  AnisotropicCellsAcross<D, Real> anisotropic_across_;  // in curvilinear rows
  std::unique_ptr<SplitFaces<D, Real>> split_;
  std::vector<FaceTreatment<D, Real>*> treatments_;
  Metric<D, Real> metric_;
  /// [axis][line]: whether no cell of it needs more than a fused row: level, without stencils of its own.
  std::array<std::vector<char>, std::size_t(D)> plain_lines_;
  std::array<InterfaceCorrections<D, Real>, std::size_t(D)> corrections_;  // [axis]
  /// Returns the corrections of a pair of the sweep along an axis; `whole`: of a whole step.
  PairCorrections<Real> corrections_of(int axis, int pair, bool whole) const {
    const auto& interfaces = corrections_[axis];
    PairCorrections<Real> of{
        interfaces.velocity(pair), interfaces.traction(pair), split_ ? split_->images(pair) : nullptr, {}};
    for (const std::size_t side : {0, 1}) {
      const auto& surface = beside_void(axis, int(side));
      const auto& tractions = surface.tractions();
      of.beside_void[side] = {surface.velocity_correction(pair), surface.traction_correction(pair),
                              whole && !tractions.empty() ? tractions.bend(pair) : nullptr};
    }
    return of;
  }
  CurvilinearStencils<D, Real> curvilinear_stencils_;
  std::array<std::array<Pair, D>, D> pairs_;                 // [axis]: P, then S by axes
  std::array<std::array<int, changed_at_most>, D> changed_;  // [axis]
  /// [axis]: at the low and the high edge of the grid, then beside void on the low and the high side of
  /// cells.
  std::array<std::array<FreeSurface<D, Real>, 4>, D> surfaces_;
  const FreeSurface<D, Real>& edge(int axis, int side) const { return surfaces_[axis][side]; }
  const FreeSurface<D, Real>& beside_void(int axis, int side) const { return surfaces_[axis][2 + side]; }
};

}  // namespace slipwave::solver
