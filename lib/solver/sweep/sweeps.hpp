// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <memory>
#include <vector>

#include "solver/sweep/curvilinear_method.hpp"
#include "solver/sweep/domain.hpp"
#include "solver/sweep/level_method.hpp"
#include "solver/sweep/row_method.hpp"
#include "solver/sweep/state.hpp"
#include "solver/sweep/sweep_filter.hpp"
#include "solver/sweep/sweep_tables.hpp"
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
  Sweeps(const Sweeps&) = delete;
  Sweeps& operator=(const Sweeps&) = delete;
  /// From now on this filters what sweeps add; it must outlive them. Throws std::length_error beyond
  /// most_filters.
  void use(SweepFilter<D, Real>* filter);
  /// From now on this treats its faces, which are among Domain::split; it must outlive the sweeps.
  void use(FaceTreatment<D, Real>* treatment) { tables_.treatments.push_back(treatment); }
  /// From now on the faces of the domain that fractures split are so; `unit` of the fields. Does nothing
  /// where there are none.
  void split_faces(const Domain<D>& domain, double dt_s, double unit);
  /// Null where there are none.
  SplitFaces<D, Real>* split() const { return tables_.split.get(); }
  /// From now on own_rows() are those that the domain owns and what other processes refresh. Returns the
  /// faces to the grids of other cells above and below, where there are any, to be given where a neighbour
  /// has more columns.
  std::array<SharedFaces<Real>*, 2> share_faces(const Domain<D>& domain);
  /// Rows of the last axis that are swept: all, or those beside faces that are shared.
  const IndexRange& own_rows() const { return own_; }
  /// Steps of a sweep along the last axis that these rows need. Beyond them a face that is shared needs the
  /// outgoing waves of one more.
  IndexRange steps_of_own_rows() const {
    return {own_.first > 0 ? own_.first - 1 + tables_.reach : 0, own_.last + rows_behind()};
  }
  /// Whether nothing that faces of a line have retained or are given is other than zero in these columns.
  bool faces_at_rest(std::int64_t line, const IndexRange& columns) const {
    return (!tables_.split && !shared_[0] && !shared_[1]) || split_and_shared_at_rest(line, columns);
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
      prepare(*filter, {0, time}, state_.layout.line_index(line), columns, state_.row_fields(line));
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
  std::int64_t rows_behind() const { return tables_.reach + std::max(tables_.reach, 1); }
  /// For a sweep along that axis of columns from `first` on, once the material is filled in.
  Ring<Real> make_ring(int axis, std::int64_t first, std::int64_t width) const;

  /// Whether free surfaces or interfaces of an axis are corrected: sweeps along it then need the velocities
  /// there of free_surface_reach cells on all sides as they were before the sweep.
  bool corrects_surface(int axis) const {
    const auto& surfaces = tables_.surfaces[axis];
    return std::any_of(surfaces.begin(), surfaces.end(),
                       [](const auto& surface) { return !surface.empty(); }) ||
           !tables_.corrections[axis].empty() || (tables_.split && tables_.split->any(axis));
  }
  /// Cells the reconstruction reads to each side.
  std::int64_t reach() const { return tables_.reach; }
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
  bool shear() const { return tables_.shear; }

 private:
  static constexpr int z_axis = D - 1;
  /// A piece of a row: the cells that it advances, and those whose outgoing waves it finds anew.
  void advance_piece(const RowPart<D, Real>& piece, const IndexRange& reconstructed, bool begins, bool ends,
                     StripeBoundary<Real>& boundary, Workspace<Real>& work);
  void sweep_piece(const RowPart<D, Real>& piece, const IndexRange& reconstructed, Workspace<Real>& work);
  /// Cells of a row along x, of the state or a copy.
  RowPart<D, Real> part_along(const RowFields<Real>& row, const IndexRange& columns, Real scale,
                              bool remember) const {
    return {0, state_.layout.line_index(row.row), row.row, columns, row.first, row.pitch, scale, remember};
  }
  const RowMethod<D, Real>& method(std::int64_t line) const {
    if (tables_.metric.curvilinear(line)) return curvilinear_;
    return level_;
  }
  bool advance_curvilinear(int axis, const Index<D>& at, std::int64_t row, const IndexRange& columns,
                           Real scale, Ring<Real>& ring, Workspace<Real>& work);
  bool fused_row(int axis, const Index<D>& at, std::int64_t row, const IndexRange& columns, Real scale,
                 Ring<Real>& ring, Workspace<Real>& work);
  /// Whether an effect filters the update of any of these columns.
  bool filters(int axis, const Index<D>& line, const IndexRange& columns) const;
  void update(const RowPart<D, Real>& part, const RowFlux<Real>& flux, Workspace<Real>& work);
  void solve_along(const RowFaces<D, Real>& faces, bool begins, bool ends) const;
  void solve_across(const RowFaces<D, Real>& faces) const;
  /// In a sweep across: the faces before a row, the cells of a row in the state, and what their update reads.
  RowFaces<D, Real> faces_before(int axis, const Index<D>& at, std::int64_t row, const IndexRange& columns,
                                 Real scale, Ring<Real>& ring) const;
  RowPart<D, Real> part_of(int axis, Index<D> at, std::int64_t row, const IndexRange& columns,
                           Real scale) const;
  static RowFlux<Real> flux_of(std::int64_t row, std::int64_t x, Ring<Real>& ring);
  /// Columns of a row, and those of its padding where they are its last.
  IndexRange with_padding(const IndexRange& columns) const {
    return {columns.first,
            columns.last == state_.layout.shape()[0] ? state_.layout.padded_nx() : columns.last};
  }
  /// Returns the columns of a piece along x whose outgoing waves it or a copy ahead of it finds anew.
  IndexRange lagging(const IndexRange& columns) const {
    return {columns.first == 0 ? 0 : columns.first + lag, columns.last + 2 * lag};
  }
  void prepare(SweepFilter<D, Real>& filter, const NextSweep& next, const Index<D>& at,
               const IndexRange& columns, const RowFields<Real>& fields) const;
  /// Lets filters change cells, which a sweep has just advanced, before the next one.
  void prepare_next(const RowPart<D, Real>& part, Workspace<Real>& work) const;
  template <class Advance>
  void filtered(const RowPart<D, Real>& part, Workspace<Real>& work, const Advance& advance);
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

  State<D, Real>& state_;
  SweepTables<D, Real> tables_;
  LevelMethod<D, Real> level_;
  CurvilinearMethod<D, Real> curvilinear_;
  std::array<std::unique_ptr<SharedFaces<Real>>, 2> shared_;
  IndexRange own_;  // rows of the last axis that along() sweeps
  std::vector<SweepFilter<D, Real>*> filters_;
  std::vector<Workspace<Real>> work_of_along_;  // by worker, made in its first call
};

}  // namespace slipwave::solver
