// SPDX-License-Identifier: BSD-3-Clause
#include "solver/sweep/sweeps.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <stdexcept>

#include "base/instantiate.hpp"
#include "parallel/threads.hpp"

namespace slipwave::solver {
namespace {

/// Columns swept together across: their data stays in the first cache.
constexpr std::int64_t stripe_width = 256;

}  // namespace

template <int D, class Real>
Sweeps<D, Real>::Sweeps(State<D, Real>& state, const Domain<D>& domain, int order)
    : state_(state),
      tables_(state, domain, order),
      level_(tables_),
      curvilinear_(tables_, domain),
      own_{0, domain.grid.shape[z_axis]} {}

template <int D, class Real>
void Sweeps<D, Real>::use(SweepFilter<D, Real>* filter) {
  if (filters_.size() == most_filters) throw std::length_error("too many effects filter sweeps");
  filters_.push_back(filter);
}

template <int D, class Real>
void Sweeps<D, Real>::split_faces(const Domain<D>& domain, double dt_s, double unit) {
  if (domain.split.empty()) return;
  tables_.split = std::make_unique<SplitFaces<D, Real>>(state_, domain, dt_s, unit);
  use(tables_.split.get());
}

template <int D, class Real>
void Sweeps<D, Real>::keep_monotone() {
  if (tables_.metric.any_curvilinear())
    throw std::logic_error("no criterion of monotonicity on curvilinear rows");
  tables_.monotone = tables_.reach > 0;
}

template <int D, class Real>
Workspace<Real> Sweeps<D, Real>::make_workspace(std::int64_t widest) const {
  return Workspace<Real>(widest, state_.layout.rows(), tables_.pair_count());
}

template <int D, class Real>
Ring<Real> Sweeps<D, Real>::make_ring(int axis, std::int64_t first, std::int64_t width) const {
  const int waiting = int(rows_behind() - tables_.reach);
  // Faces need the outgoing waves of two rows. Uniform runs need them until their row is updated.
  const int outgoing = state_.uniform_interior[std::size_t(axis)].empty() ? 2 : waiting + 2;
  // Curvilinear faces have two velocities: what the cells on either side see.
  const int pairs =
      axis == z_axis && tables_.metric.any_curvilinear() ? D + D / 2 + D % 2 : tables_.pair_count();
  return Ring<Real>(first, width, outgoing, waiting + 1, pairs);
}

template <int D, class Real>
std::int64_t Sweeps<D, Real>::interface_stencil_cells() const {
  return tables_.stencil_cells() + curvilinear_.stencil_cells();
}

template <int D, class Real>
std::int64_t Sweeps<D, Real>::memory_bytes() const {
  return tables_.memory_bytes() + level_.memory_bytes() + curvilinear_.memory_bytes();
}

/// Advances these cells by advance(), and lets effects filter what that adds.
template <int D, class Real>
template <class Advance>
void Sweeps<D, Real>::filtered(const RowPart<D, Real>& part, Workspace<Real>& work, const Advance& advance) {
  // What copies ahead hold of the zones is read by nothing.
  if (filters_.empty() || !part.remember) return advance();
  const auto& rows = tables_.changed[part.axis];
  const int row_count = tables_.rows_changed();
  // Built in place: a copy would wait until all stores of the loops before this are done.
  std::array<std::array<IndexRange, 2>, most_filters> filtered;
  for (std::size_t f = 0; f < filters_.size(); ++f)
    filtered[f] = filters_[f]->filtered(part.axis, part.at, part.columns);
  const auto each_filtered = [&](auto&& what) {
    for (std::size_t f = 0; f < filters_.size(); ++f)
      for (const auto& cells : filtered[f])
        if (!cells.empty()) what(*filters_[f], cells, work.before() + cells.first - part.columns.first);
  };
  each_filtered([&](const auto&, const IndexRange& cells, Real* before) {
    for (int n = 0; n < row_count; ++n) {
      const Real* const field = part.fields + rows[n] * part.pitch;
      std::copy(field + cells.first, field + cells.last, before + n * work.pitch());
    }
  });
  advance();
  each_filtered([&](auto& filter, const IndexRange& cells, const Real* before) {
    filter.filter({part.axis,
                   part.scale,
                   part.at,
                   cells,
                   {rows.data(), std::size_t(row_count)},
                   before,
                   work.pitch(),
                   part.fields + cells.first,
                   part.pitch,
                   work.time()});
  });
  prepare_next(part, work);
}

template <int D, class Real>
void Sweeps<D, Real>::prepare_next(const RowPart<D, Real>& part, Workspace<Real>& work) const {
  for (auto* const filter : filters_)
    if (const auto next = filter->next(work.time(), part.scale); next.axis >= 0)
      prepare(*filter, next, part.at, part.columns, {part.line, part.fields, part.pitch});
}

template <int D, class Real>
void Sweeps<D, Real>::prepare(SweepFilter<D, Real>& filter, const NextSweep& next, const Index<D>& at,
                              const IndexRange& columns, const RowFields<Real>& fields) const {
  const std::span<const int> rows{tables_.changed[std::size_t(next.axis)].data(),
                                  std::size_t(tables_.rows_changed())};
  for (const auto& part : filter.filtered(next.axis, at, columns))
    if (!part.empty())
      filter.prepare(
          {next.axis, 0, at, part, rows, nullptr, 0, fields.first + part.first, fields.pitch, next.time});
}

template <int D, class Real>
void Sweeps<D, Real>::along(int axis, Real scale, const SweepTime& time) {
  const auto& layout = state_.layout;
  const std::int64_t lines = layout.lines(), nx = layout.padded_nx();
  auto& work = work_of_along_;
  while (std::ssize(work) < parallel_workers()) work.push_back(make_workspace(nx));
  for (auto& each : work) each.time() = time;
  for (std::int64_t line = 0; line < lines && axis != z_axis && corrects_surface(axis); ++line)
    retain(axis, line, {0, layout.shape()[0]});
  if (axis == 0) {
    const auto own = own_lines();
    parallel_for(own.count(), 4, [&](std::int64_t begin, std::int64_t end, int worker) {
      StripeBoundary<Real> boundary{};
      for (auto line = own.first + begin; line < own.first + end; ++line) {
        correct_side_surfaces(line, {0, layout.shape()[0]});
        along_x(line, {0, layout.shape()[0]}, scale, boundary, work[std::size_t(worker)]);
      }
    });
    return;
  }
  const std::int64_t stripes = (nx + stripe_width - 1) / stripe_width, rows = layout.shape()[axis];
  const IndexRange steps = axis == z_axis ? steps_of_own_rows() : IndexRange{0, rows + rows_behind()};
  const IndexRange sheets = axis == z_axis ? IndexRange{0, lines / rows} : own_;
  // Free surfaces read columns of neighbouring stripes: these must not have been advanced.
  for (auto& surface : tables_.surfaces[axis])
    surface.update_corrections(state_, {0, std::numeric_limits<std::int64_t>::max()});
  tables_.corrections[axis].update(state_, {0, lines}, {0, nx});
  if (axis == z_axis && tables_.split) tables_.split->update_all();
  parallel_for(sheets.count() * stripes, 1, [&](std::int64_t begin, std::int64_t end, int worker) {
    for (std::int64_t n = begin; n < end; ++n) {
      const auto stripe = n % stripes;
      const IndexRange columns{stripe * stripe_width, std::min((stripe + 1) * stripe_width, nx)};
      auto ring = make_ring(axis, columns.first, columns.count());
      Index<D> at{};
      if (D == 3) at[std::size_t(3 - axis)] = sheets.first + n / stripes;
      for (auto step = steps.first; step < steps.last; ++step)
        across(axis, at, step, columns, scale, ring, work[std::size_t(worker)]);
    }
  });
}

namespace {

/// The wave that enters the grid through an edge, from the outgoing wave there (E11). The impedance of the
/// ghost beyond the edge is part of the law (fill_material).
template <class Real>
void enter(EdgeLaw law, Wave wave, std::int64_t n, const Real* outgoing, Real* entering) {
  const bool motionless = extension_of(law, wave) == Extension::motionless;
  for (std::int64_t i = 0; i < n; ++i) entering[i] = motionless ? -outgoing[i] : Real(0);
}

}  // namespace

template <int D, class Real>
void Sweeps<D, Real>::queue_prefetch(std::int64_t line, const IndexRange& columns,
                                     PrefetchQueue<Real>& prefetch) const {
  const Index<D> at = state_.layout.line_index(line);
  prefetch.clear();
  prefetch.add(state_.field_row(at, 0) + columns.first, columns.count(), state_.layout.row_pitch(),
               state_.layout.rows());
  if (!state_.uniform_run(line, columns.first, columns.last))
    prefetch.add(state_.material_row(at, 0) + columns.first, columns.count(),
                 state_.material_layout.row_pitch(), state_.material_layout.rows());
  if (tables_.metric.curvilinear(line))
    prefetch.add(tables_.metric.first_row(at) + columns.first, columns.count(), tables_.metric.row_pitch(),
                 tables_.metric.rows_of_line);
}

/// At the low edge the wave upwards follows from the one downwards, at the high edge the other way round.
template <int D, class Real>
void Sweeps<D, Real>::enter_grid(int axis, int side, std::int64_t n, OutgoingWaves<Real> outgoing,
                                 OutgoingWaves<Real> entering) const {
  const EdgeLaw law = tables_.edges[axis][side];
  for (int p = 0; p < tables_.pair_count(); ++p)
    enter(law, tables_.pairs[axis][p].wave, n, side ? outgoing.up(p) : outgoing.down(p),
          side ? entering.down(p) : entering.up(p));
}

template <int D, class Real>
void Sweeps<D, Real>::add_tractions(const FreeSurface<D, Real>& surface, const Index<D>& line,
                                    const IndexRange& columns, OutgoingWaves<Real> entering) const {
  const auto& tractions = surface.tractions();
  if (tractions.empty()) return;
  const auto number = state_.layout.line_number(line);
  const std::int64_t from = columns.first + surface.along_x();
  const auto cells = surface.numbers({number, number + 1}, {from, columns.last + surface.along_x()});
  for (int p = 0; p < D; ++p)
    for (auto n = cells.first; n < cells.last; ++n) {
      const auto x = surface.column(n) - from;
      if (surface.side())
        entering.down(p)[x] += tractions.of(p)[n];
      else
        entering.up(p)[x] -= tractions.of(p)[n];
    }
}

template <int D, class Real>
void Sweeps<D, Real>::along_x(std::int64_t line, const IndexRange& columns, Real scale,
                              StripeBoundary<Real>& boundary, Workspace<Real>& work, bool begins) {
  const auto& layout = state_.layout;
  const bool low = columns.first == 0, high = columns.last == layout.shape()[0];
  const std::int64_t first = low ? 0 : begins ? columns.first - lag : columns.first + lag;
  const IndexRange reconstructed{first, high ? layout.padded_nx() : columns.last + lag};
  const IndexRange updated{columns.first, high ? reconstructed.last : columns.last};
  advance_piece(part_along(state_.row_fields(line), updated, scale, true), reconstructed, begins || low, high,
                boundary, work);
}

template <int D, class Real>
void Sweeps<D, Real>::along_copy(const RowFields<Real>& copy, const IndexRange& columns, bool begins,
                                 Real scale, StripeBoundary<Real>& boundary, Workspace<Real>& work) {
  const IndexRange reconstructed{begins ? columns.first - lag : columns.first + lag, columns.last + lag};
  advance_piece(part_along(copy, columns, scale, false), reconstructed, begins, false, boundary, work);
}

template <int D, class Real>
void Sweeps<D, Real>::put(const RowFields<Real>& copy, const IndexRange& columns) {
  const auto to = state_.row_fields(copy.row);
  for (int row = 0; row < state_.layout.rows(); ++row)
    std::copy(copy.field(row) + columns.first, copy.field(row) + columns.last, to.field(row) + columns.first);
}

/// A piece of a sweep along x with the stored values of the piece before it, unless it begins.
template <int D, class Real>
void Sweeps<D, Real>::advance_piece(const RowPart<D, Real>& piece, const IndexRange& reconstructed,
                                    bool begins, bool ends, StripeBoundary<Real>& boundary,
                                    Workspace<Real>& work) {
  const auto faces = work.faces();
  const auto outgoing = work.outgoing();
  const std::int64_t last = reconstructed.last - std::min(reconstructed.first, piece.columns.first);
  // Of the waiting cells their interface states, their outgoing waves and the one upwards of the cell before.
  const bool uniform_interior = !state_.uniform_interior[0].empty();
  const auto waiting = [&](std::int64_t from, auto&& copy) {
    for (int p = 0; p < tables_.pair_count(); ++p) {
      copy(faces.v(p) + from, boundary.v[p]);
      copy(faces.s(p) + from, boundary.s[p]);
      if (uniform_interior) copy(outgoing.up(p) + from - 1, boundary.up[p]);
      if (uniform_interior) copy(outgoing.down(p) + from, boundary.down[p]);
      copy(outgoing.up(p) + from + lag - 1, boundary.last_up[p]);
    }
  };
  // Of known size, so that it is inlined.
  if (!begins) waiting(0, [](Real* to, const auto& kept) { std::memcpy(to, kept, sizeof kept); });
  for (int p = 0; begins && p < tables_.pair_count() && reconstructed.first > 0; ++p) outgoing.up(p)[-1] = 0;
  sweep_piece(piece, reconstructed, work);
  if (ends) return;
  waiting(last - lag, [](const Real* from, auto& kept) { std::memcpy(kept, from, sizeof kept); });
}

template <int D, class Real>
void Sweeps<D, Real>::copy_ahead(const IndexRange& columns, Real scale, const RowFields<Real>& copy,
                                 Workspace<Real>& work) {
  const std::int64_t nx = state_.layout.shape()[0];
  const IndexRange reconstructed{std::max<std::int64_t>(columns.first - lag, 0),
                                 columns.last + lag >= nx ? state_.layout.padded_nx() : columns.last + lag};
  const auto from = state_.row_fields(copy.row);
  for (int row = 0; row < state_.layout.rows(); ++row)
    std::copy(from.field(row) + reconstructed.first - max_reach,
              from.field(row) + reconstructed.last + max_reach,
              copy.field(row) + reconstructed.first - max_reach);
  const auto outgoing = work.outgoing();
  for (int p = 0; p < tables_.pair_count() && reconstructed.first > 0; ++p) outgoing.up(p)[-1] = 0;
  sweep_piece(part_along(copy, columns, scale, false), reconstructed, work);
}

template <int D, class Real>
RowFields<Real> Sweeps<D, Real>::ahead_along_x(std::int64_t line, const IndexRange& columns, Real scale,
                                               Workspace<Real>& work) {
  // Cell 0 of the copy would be here.
  const RowFields<Real> copy{line, work.copy() - std::max<std::int64_t>(columns.first - lag, 0),
                             work.pitch()};
  copy_ahead(columns, scale, copy, work);
  return copy;
}

/// The outgoing waves of the cell before the first reconstructed one are already in place.
template <int D, class Real>
void Sweeps<D, Real>::sweep_piece(const RowPart<D, Real>& piece, const IndexRange& reconstructed,
                                  Workspace<Real>& work) {
  const std::int64_t nx = state_.layout.shape()[0], line = piece.line,
                     base = std::min(reconstructed.first, piece.columns.first);
  const bool begins = reconstructed.first == 0, ends = reconstructed.last >= nx, whole = piece.scale == 1;
  const auto first = work.outgoing().at(reconstructed.first - base);
  if (begins) fill_ghost_cells(line, 0, piece.fields, piece.pitch, piece.scale);
  if (ends) fill_ghost_cells(line, 1, piece.fields, piece.pitch, piece.scale);
  auto read = piece;
  read.columns = reconstructed;
  method(line).reconstruct(read, 1, first, work.prefetch());
  for (const int side : {0, 1})
    if (whole && !tables_.metric.curvilinear(line))
      add_tractions(tables_.beside_void(0, side), piece.at, reconstructed, first);
  const auto enter_by = [&](int side, OutgoingWaves<Real> outgoing, OutgoingWaves<Real> entering) {
    enter_grid(0, side, 1, outgoing, entering);
    if (whole) add_tractions(tables_.edge(0, side), piece.at, reconstructed, first);
  };
  if (begins) enter_by(0, first, first.at(-1));
  IndexRange with_faces = reconstructed;
  if (ends) {
    const auto beyond = first.at(nx - reconstructed.first);
    with_faces.last += lag;  // where the row fills whole blocks its last face is in the next one
    for (int p = 0; p < tables_.pair_count(); ++p)
      for (Real* const zero : {beyond.up(p), beyond.down(p)})
        std::fill(zero, zero + with_faces.last - nx, Real(0));
    enter_by(1, beyond.at(-1), beyond);
  }
  const auto states = work.faces();
  solve_along({0,
               {piece.at, piece.at},
               {line, line},
               with_faces,
               first.at(-1),
               first,
               states.at(with_faces.first - base),
               piece.scale},
              begins, ends);
  work.prefetch().prefetch_one();
  const auto here = work.outgoing().at(piece.columns.first - base);
  const auto lo = states.at(piece.columns.first - base);
  update(piece, {lo, lo.at(1), here.at(-1), here, here.at(1)}, work);
}

/// The interface states of the faces before these cells of a row.
template <int D, class Real>
void Sweeps<D, Real>::solve_along(const RowFaces<D, Real>& faces, bool begins, bool ends) const {
  const auto& cells = faces.columns;
  if (tables_.metric.curvilinear(faces.lines[1])) return curvilinear_.solve(faces);
  const auto solve = [&](const IndexRange& part) {
    const auto from = part.first - cells.first;
    auto of_part = faces;
    of_part.columns = part;
    of_part.below = faces.below.at(from), of_part.above = faces.above.at(from);
    of_part.states = faces.states.at(from);
    level_.solve(of_part);
  };
  // The faces at the ends of a row have other material on one side.
  const std::int64_t nx = state_.layout.shape()[0];
  const std::int64_t inner_first = begins ? std::min(lag, cells.last) : cells.first;
  const std::int64_t inner_last = ends ? std::max(inner_first, (nx - 1) / lag * lag) : cells.last;
  const auto uniform_interior = state_.uniform_interior[0].of(faces.lines[1]);
  for (const IndexRange& part : {IndexRange{cells.first, inner_first}, IndexRange{inner_first, inner_last},
                                 IndexRange{inner_last, cells.last}})
    // The first face of a run is that of the cell before it, too.
    split_by_runs(
        uniform_interior, 1, part, [](const IndexRange&) {}, solve);
}

template <int D, class Real>
void Sweeps<D, Real>::update(const RowPart<D, Real>& part, const RowFlux<Real>& flux, Workspace<Real>& work) {
  filtered(part, work, [&] { method(part.line).update(part, flux, work.prefetch()); });
}

template <int D, class Real>
RowFaces<D, Real> Sweeps<D, Real>::faces_before(int axis, const Index<D>& at, std::int64_t row,
                                                const IndexRange& columns, Real scale,
                                                Ring<Real>& ring) const {
  Index<D> lo = at, hi = at;
  lo[axis] = row - 1, hi[axis] = row;
  const auto& layout = state_.layout;
  return {axis,
          {lo, hi},
          {row > 0 ? layout.line_number(lo) : -1, row < layout.shape()[axis] ? layout.line_number(hi) : -1},
          columns,
          ring.outgoing(row - 1, columns.first),
          ring.outgoing(row, columns.first),
          ring.faces(row, columns.first),
          scale};
}

template <int D, class Real>
RowPart<D, Real> Sweeps<D, Real>::part_of(int axis, Index<D> at, std::int64_t row, const IndexRange& columns,
                                          Real scale) const {
  at[axis] = row;
  const auto& layout = state_.layout;
  return {axis,  at,  layout.line_number(at), columns, state_.field_row(at, 0), layout.row_pitch(),
          scale, true};
}

template <int D, class Real>
RowFlux<Real> Sweeps<D, Real>::flux_of(std::int64_t row, std::int64_t x, Ring<Real>& ring) {
  return {ring.faces(row, x), ring.faces(row + 1, x), ring.outgoing(row - 1, x), ring.outgoing(row, x),
          ring.outgoing(row + 1, x)};
}

/// The interface states of faces between two rows.
template <int D, class Real>
void Sweeps<D, Real>::solve_across(const RowFaces<D, Real>& faces) const {
  const auto curved = [&](int side) {
    return faces.lines[side] >= 0 && tables_.metric.curvilinear(faces.lines[side]);
  };
  if (curved(0) || curved(1)) return curvilinear_.solve(faces);
  level_.solve(faces);
}

template <int D, class Real>
void Sweeps<D, Real>::across(int axis, const Index<D>& at, std::int64_t step, const IndexRange& columns,
                             Real scale, Ring<Real>& ring, Workspace<Real>& work) {
  const auto& layout = state_.layout;
  const std::int64_t rows = layout.shape()[axis], row = step - tables_.reach;
  const IndexRange wide = with_padding(columns);
  const auto line = [&](std::int64_t k) {
    Index<D> index = at;
    index[axis] = k;
    return index;
  };
  if (row == 0) fill_ghost_rows(axis, at, 0, wide, scale);
  if (row == std::max<std::int64_t>(0, rows - tables_.reach)) fill_ghost_rows(axis, at, 1, wide, scale);
  if (fused_row(axis, at, row, wide, scale, ring, work)) return;
  const std::int64_t x = wide.first, n = wide.count();
  if (row >= 0 && row < rows) {
    const auto part = part_of(axis, at, row, wide, scale);
    method(part.line).reconstruct(part, layout.stride(axis), ring.outgoing(row, x), work.prefetch());
  }
  if (row >= 0 && row <= rows) {
    const auto above = ring.outgoing(row - 1, x), here = ring.outgoing(row, x);
    if (row == 0) enter_grid(axis, 0, n, here, above);
    if (row == rows) enter_grid(axis, 1, n, above, here);
    // Splittings of fourth order have no whole steps: nothing is missing there. Beside void only now: they
    // are known once the row behind that of the surface is there.
    if (axis == z_axis && scale == 1) {
      const auto surface = [&](int side, bool of_edge) -> const auto& {
        return of_edge ? tables_.edge(axis, side) : tables_.beside_void(axis, side);
      };
      if (row < rows) add_tractions(surface(0, row == 0), line(row), wide, above);
      if (row > 0) add_tractions(surface(1, row == rows), line(row - 1), wide, here);
    }
    if (advance_curvilinear(axis, at, row, wide, scale, ring, work)) return;
    const auto uniform_runs = [&](std::int64_t k) {
      return k >= 0 && k < rows ? state_.uniform_interior[std::size_t(axis)].of(layout.line_number(line(k)))
                                : std::span<const IndexRange>();
    };
    const auto solve = [&](const IndexRange& part) {
      solve_across(faces_before(axis, at, row, part, scale, ring));
    };
    // Faces between cells of uniform runs are left out.
    const auto below = uniform_runs(row - 1);
    split_by_runs(
        uniform_runs(row), 0, wide,
        [&](const IndexRange& part) {
          split_by_runs(
              below, 0, part, [](const IndexRange&) {}, solve);
        },
        solve);
    share(axis, at, row, wide, ring);
  }
  work.prefetch().prefetch_one();
  const std::int64_t done = step - rows_behind();
  if (done >= 0 && done < rows) update(part_of(axis, at, done, wide, scale), flux_of(done, x, ring), work);
}

template <int D, class Real>
std::array<SharedFaces<Real>*, 2> Sweeps<D, Real>::share_faces(const Domain<D>& domain) {
  own_ = domain.own;
  const auto& layout = state_.layout;
  const auto& part = domain.subdomain;
  if (part.continues(0)) own_.first -= part.exchanged;
  if (part.continues(1)) own_.last += part.exchanged;
  for (const int side : {0, 1}) {
    if (!part.ends_at_band(side)) continue;
    SharedFaces<Real> face{.row = side ? own_.last : own_.first, .pitch = layout.padded_nx()};
    face.rows = std::int64_t(2) * make_ring(z_axis, 0, 0).pairs();
    face.values.resize(std::size_t(layout.lines() / layout.shape()[z_axis] * face.rows * face.pitch));
    shared_[std::size_t(side)] = std::make_unique<SharedFaces<Real>>(std::move(face));
  }
  return {shared_[0].get(), shared_[1].get()};
}

template <int D, class Real>
bool Sweeps<D, Real>::split_and_shared_at_rest(std::int64_t line, const IndexRange& columns) const {
  if (tables_.split && !tables_.split->at_rest(line, columns)) return false;
  for (const auto& face : shared_) {
    if (!face || !face->given) continue;
    const auto at = state_.layout.line_index(line);
    const auto row = at[z_axis];
    if (row != face->row && row + 1 != face->row) continue;
    const Real* const values = std::as_const(*face).of_line(D == 3 ? at[1] : 0);
    for (std::int64_t n = 0; n < face->rows; ++n) {
      const Real* const states = values + n * face->pitch;
      if (std::any_of(states + columns.first, states + columns.last, [](Real state) { return state != 0; }))
        return false;
    }
  }
  return true;
}

template <int D, class Real>
void Sweeps<D, Real>::share(int axis, const Index<D>& at, std::int64_t row, const IndexRange& columns,
                            Ring<Real>& ring) {
  if (axis != z_axis) return;
  for (const auto& face : shared_) {
    if (!face || face->row != row) continue;
    const auto states = ring.faces(row, columns.first);
    Real* const values = face->of_line(D == 3 ? at[1] : 0) + columns.first;
    for (std::int64_t n = 0; n < face->rows; ++n) {
      Real *const here = states.first + n * states.pitch, *const there = values + n * face->pitch;
      face->given ? std::copy(there, there + columns.count(), here)
                  : std::copy(here, here + columns.count(), there);
    }
  }
}

template <int D, class Real>
bool Sweeps<D, Real>::filters(int axis, const Index<D>& line, const IndexRange& columns) const {
  return std::any_of(filters_.begin(), filters_.end(), [&](const auto* filter) {
    const auto parts = filter->filtered(axis, line, columns);
    return std::any_of(parts.begin(), parts.end(), [](const auto& part) { return !part.empty(); });
  });
}

/// The solution at the face before a row and the update of the row `reach` before, in one loop. Returns
/// false, and does nothing, where other work is needed between them.
template <int D, class Real>
bool Sweeps<D, Real>::advance_curvilinear(int axis, const Index<D>& at, std::int64_t row,
                                          const IndexRange& columns, Real scale, Ring<Real>& ring,
                                          Workspace<Real>& work) {
  const std::int64_t rows = state_.layout.shape()[axis], done = row - tables_.reach;
  const auto& metric = tables_.metric;
  // The update of the row just before would read what the solution writes.
  if (axis != z_axis || tables_.reach < 2 || done < 0 || !metric.curvilinear_row(done)) return false;
  if (!metric.curvilinear_row(row - 1) && (row == rows || !metric.curvilinear_row(row))) return false;
  const auto part = part_of(axis, at, done, columns, scale);
  if (filters(axis, part.at, columns)) return false;
  curvilinear_.advance(faces_before(axis, at, row, columns, scale, ring), part,
                       flux_of(done, columns.first, ring), work.prefetch());
  prepare_next(part, work);
  return true;
}

template <int D, class Real>
void Sweeps<D, Real>::skip(std::int64_t step, const IndexRange& columns, Ring<Real>& ring) const {
  const std::int64_t row = step - tables_.reach;
  if (row < 0) return;
  const std::int64_t last =
      columns.last == state_.layout.shape()[0] ? state_.layout.padded_nx() : columns.last;
  const auto outgoing = ring.outgoing(row, columns.first);
  const auto faces = ring.faces(row, columns.first);
  const auto clear = [&](Real* zero) { std::fill(zero, zero + last - columns.first, Real(0)); };
  for (int p = 0; p < tables_.pair_count(); ++p)
    for (Real* const zero : {outgoing.up(p), outgoing.down(p), faces.v(p), faces.s(p)}) clear(zero);
  for (int c = 0; c < D && ring.pairs() > D; ++c) clear(faces.v(D) + c * faces.pitch);
}

/// A row across in one loop. Returns false, and does nothing, where other work is needed between its parts.
template <int D, class Real>
bool Sweeps<D, Real>::fused_row(int axis, const Index<D>& at, std::int64_t row, const IndexRange& columns,
                                Real scale, Ring<Real>& ring, Workspace<Real>& work) {
  const std::int64_t done = row - std::max(tables_.reach, 1);
  if (done < 0 || row >= state_.layout.shape()[axis]) return false;
  if (axis == z_axis)
    for (const auto& face : shared_)
      if (face && face->row == row) return false;
  const auto part = part_of(axis, at, done, columns, scale);
  const auto faces = faces_before(axis, at, row, columns, scale, ring);
  if (!level_.fuses(axis, faces.at[1], part.at, columns)) return false;
  work.prefetch().prefetch(2);
  filtered(part, work, [&] { level_.advance(faces, part, flux_of(done, columns.first, ring)); });
  work.prefetch().prefetch(2);
  return true;
}

namespace {

/// Signs of the mirror image of a pair.
template <class Real>
struct Mirror {
  Real v, s;
  bool constant;
  explicit Mirror(Extension law)
      : v(law == Extension::motionless ? -1 : 1),
        s(law == Extension::traction_free ? -1 : 1),
        constant(law == Extension::constant) {}
};
/// What stands for a ghost: a cell, counted from the edge, times signs.
template <class Real>
struct Image {
  std::int64_t cell;
  Real v, s;
};
/// Returns the image for ghost j beyond an edge of that law; fewer cells than j are mirrored at the `other`
/// end, too.
template <class Real>
Image<Real> image_of(std::int64_t j, std::int64_t cells, const Mirror<Real>& edge,
                     const Mirror<Real>& other) {
  if (edge.constant) return {0, edge.v, edge.s};
  Image<Real> image = {j, edge.v, edge.s};
  bool beyond_other = false;
  for (; image.cell >= cells; image.cell -= cells) {
    beyond_other = !beyond_other;
    const auto& mirror = beyond_other ? other : edge;
    if (mirror.constant) return {cells - 1, image.v, image.s};
    image.v *= mirror.v, image.s *= mirror.s;
  }
  if (beyond_other) image.cell = cells - 1 - image.cell;
  return image;
}

}  // namespace

template <int D, class Real>
void Sweeps<D, Real>::retain(int axis, std::int64_t line, const IndexRange& columns) {
  if (axis == 0 && tables_.split) tables_.split->retain(line, lagging(columns));
  tables_.corrections[axis].retain(state_, line, axis == 0 ? lagging(columns) : columns);
  for (auto& surface : tables_.surfaces[axis])
    surface.retain(state_, line, axis == 0 && surface.inside() ? lagging(columns) : columns);
}

template <int D, class Real>
void Sweeps<D, Real>::correct(FreeSurface<D, Real>& surface, const IndexRange& lines,
                              const IndexRange& columns) {
  if (!surface.empty() && !lines.empty()) surface.update_corrections(state_, surface.numbers(lines, columns));
}

template <int D, class Real>
void Sweeps<D, Real>::correct_side_surfaces(std::int64_t line, const IndexRange& columns) {
  if (tables_.split) tables_.split->update_line(line, lagging(columns));
  tables_.corrections[0].update(state_, {line, line + 1}, lagging(columns));
  for (auto& surface : tables_.surfaces[0]) correct(surface, {line, line + 1}, lagging(columns));
}

template <int D, class Real>
void Sweeps<D, Real>::correct_flank_surfaces(std::int64_t plane, const IndexRange& rows) {
  const auto of_plane = state_.layout.shape()[1];
  const IndexRange whole{0, state_.layout.padded_nx()};
  tables_.corrections[1].update(
      state_, {plane * of_plane + rows.first, plane * of_plane + std::min(rows.last, of_plane)}, whole);
  for (auto& surface : tables_.surfaces[1]) {
    IndexRange of{rows.first, std::min(rows.last, of_plane)};
    if (!surface.inside()) {
      const auto edge = surface.side() ? of_plane : 0;  // the face
      if (edge < rows.first || edge >= rows.last) continue;
      of = surface.side() ? IndexRange{edge - 1, edge} : IndexRange{0, 1};
    }
    correct(surface, {plane * of_plane + of.first, plane * of_plane + of.last}, whole);
  }
}

template <int D, class Real>
void Sweeps<D, Real>::correct_end_surfaces(std::int64_t step, const IndexRange& columns) {
  const auto rows = state_.layout.shape()[z_axis], lines = D == 2 ? 1 : state_.layout.shape()[1];
  const IndexRange of_row =
      D == 2 ? IndexRange{0, 1} : IndexRange{columns.first, std::min(columns.last, lines)};
  const IndexRange cells = D == 2 ? columns : IndexRange{0, state_.layout.padded_nx()};
  tables_.corrections[z_axis].update(state_, {step * lines + of_row.first, step * lines + of_row.last},
                                     cells);
  for (auto& surface : tables_.surfaces[z_axis]) {
    // Inside of the row before: the one behind it must be as before the sweep, too.
    const auto row = surface.inside() || surface.side() ? step - 1 : 0;
    const bool due =
        surface.inside() ? row >= 0 && row < rows : step == (surface.side() ? rows : tables_.reach);
    if (due) correct(surface, {row * lines + of_row.first, row * lines + of_row.last}, cells);
  }
  if (tables_.split) tables_.split->update(step, columns);
}

/// Fills the ghost cells that stencils read beyond an end of a row.
template <int D, class Real>
void Sweeps<D, Real>::fill_ghost_cells(std::int64_t line, int side, Real* fields, std::int64_t pitch,
                                       Real scale) const {
  const std::int64_t n = state_.layout.shape()[0];
  const auto& edge = tables_.edge(0, side);
  const auto& all = tables_.pairs[0];
  for (int p = 0; p < tables_.pair_count(); ++p) {
    const Mirror<Real> mirror(extension_of(tables_.edges[0][side], all[p].wave));
    const Mirror<Real> other(extension_of(tables_.edges[0][1 - side], all[p].wave));
    Real* const v = fields + all[p].v * pitch;
    Real* const s = fields + all[p].s * pitch;
    for (std::int64_t j = 0; j < tables_.reach; ++j) {
      const auto image = image_of(j, n, mirror, other);
      const std::int64_t ghost = side ? n + j : -1 - j, cell = side ? n - 1 - image.cell : image.cell;
      v[ghost] = image.v * v[cell];
      s[ghost] = image.s * s[cell];
      if (edge.empty()) continue;
      v[ghost] += Real(2 * j + 1) * edge.velocity_correction(p)[line];
      s[ghost] += scale * edge.traction_correction(p)[line];
      if (scale == 1 && !edge.tractions().empty())
        v[ghost] += Real(2 * j + 1) * edge.tractions().bend(p)[line];
    }
  }
}

/// Fills the ghost rows that stencils read beyond the first or the last row of another axis.
template <int D, class Real>
void Sweeps<D, Real>::fill_ghost_rows(int axis, const Index<D>& at, int side, const IndexRange& columns,
                                      Real scale) {
  const std::int64_t n = state_.layout.shape()[axis];
  const auto& edge = tables_.edge(axis, side);
  const auto& all = tables_.pairs[axis];
  const auto first = edge.empty() ? 0 : edge.number(at);
  for (int p = 0; p < tables_.pair_count(); ++p) {
    const Mirror<Real> mirror(extension_of(tables_.edges[axis][side], all[p].wave));
    const Mirror<Real> other(extension_of(tables_.edges[axis][1 - side], all[p].wave));
    for (std::int64_t j = 0; j < tables_.reach; ++j) {
      const auto image = image_of(j, n, mirror, other);
      Index<D> ghost = at, cell = at;
      ghost[axis] = side ? n + j : -1 - j;
      cell[axis] = side ? n - 1 - image.cell : image.cell;
      const auto fill = [&](int row, Real sign, const Real* gain, Real share) {
        Real* const to = state_.field_row(ghost, row);
        const Real* const source = state_.field_row(cell, row);
        for (std::int64_t i = columns.first; i < columns.last; ++i)
          to[i] = sign * source[i] + (gain ? share * gain[i] : Real(0));
      };
      fill(all[p].v, image.v, edge.empty() ? nullptr : edge.velocity_correction(p) + first, Real(2 * j + 1));
      fill(all[p].s, image.s, edge.empty() ? nullptr : edge.traction_correction(p) + first, scale);
      // As in across().
      if (const auto& splitting = edge.tractions(); axis == z_axis && scale == 1 && !splitting.empty()) {
        const Real* const bend = splitting.bend(p) + first;
        Real* const v = state_.field_row(ghost, all[p].v);
        for (std::int64_t i = columns.first; i < columns.last; ++i) v[i] += Real(2 * j + 1) * bend[i];
      }
      // Tractions on curvilinear rows take all stresses.
      if (p > 0 || axis != z_axis || !tables_.metric.curvilinear_row(side ? n - 1 : 0)) continue;
      for (int row = D; row < FieldRows<D>::count; ++row)
        if (std::none_of(all.begin(), all.end(), [row](const auto& pair) { return pair.s == row; }))
          fill(row, image.s, nullptr, 0);
    }
  }
}

SLIPWAVE_INSTANTIATE_D_REAL(TYPE, class Sweeps);

}  // namespace slipwave::solver
