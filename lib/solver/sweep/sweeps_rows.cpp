#include <algorithm>
#include <cstring>

#include "solver/sweep/sweeps.hpp"

// Pieces of sweeps: along x a stretch of a line, along other axes a row of a stripe of columns.
namespace slipwave::solver {
namespace {

/// What enters the grid through an edge given what leaves it there (E11). The impedance of the ghost beyond
/// the edge is part of the law (fill_material).
template <class Real>
void enter(EdgeLaw law, Wave wave, std::int64_t n, const Real* leaving, Real* entering) {
  const bool motionless = extension_of(law, wave) == Extension::motionless;
  for (std::int64_t i = 0; i < n; ++i) entering[i] = motionless ? -leaving[i] : Real(0);
}

}  // namespace

template <int D, class Real>
void Sweeps<D, Real>::expect(std::int64_t line, const IndexRange& columns,
                             PrefetchQueue<Real>& coming) const {
  const Index<D> at = state_.layout.line_index(line);
  coming.clear();
  coming.add(state_.field_row(at, 0) + columns.first, columns.count(), state_.layout.row_pitch(),
             FieldRows<D>::count);
  if (!state_.stretch(line, columns.first, columns.last))
    coming.add(state_.material_row(at, 0) + columns.first, columns.count(),
               state_.material_layout.row_pitch(), material_rows);
}

/// At the low edge what goes up comes from what went down, at the high one the other way round.
template <int D, class Real>
void Sweeps<D, Real>::enter_at(int axis, int side, std::int64_t n, OutgoingWaves<Real> leaving,
                               OutgoingWaves<Real> entering) const {
  const EdgeLaw law = edges_[axis][side];
  for (int p = 0; p < D; ++p)
    enter(law, pairs_[axis][p].wave, n, side ? leaving.up(p) : leaving.down(p),
          side ? entering.down(p) : entering.up(p));
}

template <int D, class Real>
void Sweeps<D, Real>::along_x(std::int64_t line, const IndexRange& columns, Real scale,
                              StripeBoundary<Real>& boundary, Workspace<Real>& work, bool begins) {
  const auto& layout = state_.layout;
  const bool low = columns.first == 0, high = columns.last == layout.shape()[0];
  const std::int64_t first = low ? 0 : begins ? columns.first - lag : columns.first + lag;
  const IndexRange leave{first, high ? layout.padded_nx() : columns.last + lag};
  go_on({line,
         leave,
         {columns.first, high ? leave.last : columns.last},
         state_.field_row(layout.line_index(line), 0),
         layout.row_pitch(),
         true},
        begins || low, high, scale, boundary, work);
}

template <int D, class Real>
void Sweeps<D, Real>::along_copy(std::int64_t line, const Copy& copy, const IndexRange& columns, bool begins,
                                 Real scale, StripeBoundary<Real>& boundary, Workspace<Real>& work) {
  const IndexRange leave{begins ? columns.first - lag : columns.first + lag, columns.last + lag};
  go_on({line, leave, columns, copy.fields, copy.pitch, false}, begins, false, scale, boundary, work);
}

template <int D, class Real>
void Sweeps<D, Real>::put(std::int64_t line, const IndexRange& columns, const Real* copy,
                          std::int64_t pitch) {
  Real* const to = state_.field_row(state_.layout.line_index(line), 0);
  for (int row = 0; row < FieldRows<D>::count; ++row)
    std::copy(copy + row * pitch + columns.first, copy + row * pitch + columns.last,
              to + row * state_.layout.row_pitch() + columns.first);
}

/// A piece of a sweep along x with what the piece before it left, unless it begins.
template <int D, class Real>
void Sweeps<D, Real>::go_on(const Piece& piece, bool begins, bool ends, Real scale,
                            StripeBoundary<Real>& boundary, Workspace<Real>& work) {
  const auto faces = work.faces();
  const auto leaving = work.leaving();
  const std::int64_t last = piece.leave.last - std::min(piece.leave.first, piece.update.first);
  // Of the cells that wait their faces, what leaves them and what leaves the one before upwards.
  const bool uniform_interior = !state_.uniform_interior[0].empty();
  const auto waiting = [&](std::int64_t from, auto&& copy) {
    for (int p = 0; p < D; ++p) {
      copy(faces.v(p) + from, boundary.v[p]);
      copy(faces.s(p) + from, boundary.s[p]);
      if (uniform_interior) copy(leaving.up(p) + from - 1, boundary.up[p]);
      if (uniform_interior) copy(leaving.down(p) + from, boundary.down[p]);
      copy(leaving.up(p) + from + lag - 1, boundary.last_up[p]);
    }
  };
  // Of known size, so that nothing is called for it.
  if (!begins) waiting(0, [](Real* to, const auto& kept) { std::memcpy(to, kept, sizeof kept); });
  for (int p = 0; begins && p < D && piece.leave.first > 0; ++p) leaving.up(p)[-1] = 0;
  sweep_piece(piece, scale, work);
  if (ends) return;
  waiting(last - lag, [](const Real* from, auto& kept) { std::memcpy(kept, from, sizeof kept); });
}

template <int D, class Real>
const Real* Sweeps<D, Real>::ahead_along_x(std::int64_t line, const IndexRange& columns, Real scale,
                                           Workspace<Real>& work) {
  const auto& layout = state_.layout;
  const std::int64_t nx = layout.shape()[0];
  const IndexRange leave{std::max<std::int64_t>(columns.first - lag, 0),
                         columns.last + lag >= nx ? layout.padded_nx() : columns.last + lag};
  const Real* const from = state_.field_row(layout.line_index(line), 0);
  // Cell 0 of the copy would stand here.
  Real* const copy = work.copy() - leave.first;
  for (int row = 0; row < FieldRows<D>::count; ++row)
    std::copy(from + row * layout.row_pitch() + leave.first - max_reach,
              from + row * layout.row_pitch() + leave.last + max_reach,
              copy + row * work.pitch() + leave.first - max_reach);
  const auto leaving = work.leaving();
  for (int p = 0; p < D && leave.first > 0; ++p) leaving.up(p)[-1] = 0;
  sweep_piece({line, leave, columns, copy, work.pitch(), false}, scale, work);
  return copy;
}

/// What leaves the cell before the first that sends out is in its place.
template <int D, class Real>
void Sweeps<D, Real>::sweep_piece(const Piece& piece, Real scale, Workspace<Real>& work) {
  const std::int64_t nx = state_.layout.shape()[0], base = std::min(piece.leave.first, piece.update.first);
  const bool begins = piece.leave.first == 0, ends = piece.leave.last >= nx;
  const Index<D> at = state_.layout.line_index(piece.line);
  const auto first = work.leaving().at(piece.leave.first - base);
  if (begins) fill_ghost_cells(piece.line, 0, piece.fields, piece.pitch, scale);
  if (ends) fill_ghost_cells(piece.line, 1, piece.fields, piece.pitch, scale);
  reconstruct_row(0, at, piece.leave, piece.fields, piece.pitch, 1, scale, first, work.coming());
  if (begins) enter_at(0, 0, 1, first, first.at(-1));
  IndexRange met = piece.leave;
  if (ends) {
    const auto beyond = first.at(nx - piece.leave.first);
    met.last += lag;  // where the row fills whole blocks its last face is in the next one
    for (int p = 0; p < D; ++p)
      for (Real* const zero : {beyond.up(p), beyond.down(p)}) std::fill(zero, zero + met.last - nx, Real(0));
    enter_at(0, 1, 1, beyond.at(-1), beyond);
  }
  // The faces at the ends of a line have other material on one side.
  const std::int64_t inner_first = begins ? std::min(lag, met.last) : met.first;
  const std::int64_t inner_last = ends ? std::max(inner_first, (nx - 1) / lag * lag) : met.last;
  const auto faces = work.faces();
  const auto meet = [&](const IndexRange& part) {
    const auto here = first.at(part.first - piece.leave.first);
    const auto* stretch = state_.stretch(piece.line, part.first - 1, part.last);
    const auto lo = stretch ? stretch->rows() : state_.material_from(at, part.first - 1);
    face_kernels(stretch).meet(part.count(), here.at(-1), here, lo,
                               stretch ? lo : state_.material_from(at, part.first),
                               faces.at(part.first - base));
  };
  const auto uniform_interior = state_.uniform_interior[0].of(piece.line);
  for (const IndexRange& part : {IndexRange{met.first, inner_first}, IndexRange{inner_first, inner_last},
                                 IndexRange{inner_last, met.last}})
    // The first face of a run is that of the cell before it, too.
    tell_apart(
        uniform_interior, 1, part, [](const IndexRange&) {}, meet);
  work.coming().prefetch_one();
  const auto here = work.leaving().at(piece.update.first - base);
  const auto lo = faces.at(piece.update.first - base);
  update(0, at, piece.update, piece.fields, piece.pitch, scale, {lo, lo.at(1), here.at(-1), here, here.at(1)},
         work, piece.remember);
}

template <int D, class Real>
void Sweeps<D, Real>::across(int axis, const Index<D>& at, std::int64_t step, const IndexRange& columns,
                             Real scale, Ring<Real>& ring, Workspace<Real>& work) {
  const auto& layout = state_.layout;
  const std::int64_t rows = layout.shape()[axis], row = step - reach_;
  const IndexRange wide{columns.first, columns.last == layout.shape()[0] ? layout.padded_nx() : columns.last};
  const auto line = [&](std::int64_t k) {
    Index<D> index = at;
    index[axis] = k;
    return index;
  };
  if (row == 0) fill_ghost_rows(axis, at, 0, wide, scale);
  if (row == std::max<std::int64_t>(0, rows - reach_)) fill_ghost_rows(axis, at, 1, wide, scale);
  if (fused_row(axis, at, row, wide, scale, ring, work)) return;
  const std::int64_t x = wide.first, n = wide.count();
  if (row >= 0 && row < rows)
    reconstruct_row(axis, line(row), wide, state_.field_row(line(row), 0), layout.row_pitch(),
                    layout.stride(axis), scale, ring.leaving(row, x), work.coming());
  if (row >= 0 && row <= rows) {
    const auto above = ring.leaving(row - 1, x), here = ring.leaving(row, x);
    if (row == 0) enter_at(axis, 0, n, here, above);
    if (row == rows) enter_at(axis, 1, n, above, here);
    const auto inside = [&](std::int64_t k) {
      return k >= 0 && k < rows ? state_.uniform_interior[std::size_t(axis)].of(layout.line_number(line(k)))
                                : std::span<const IndexRange>();
    };
    const auto meet = [&](const IndexRange& part) {
      const auto stretch = [&](std::int64_t k) {
        return k >= 0 && k < rows ? state_.stretch(layout.line_number(line(k)), part.first, part.last)
                                  : nullptr;
      };
      const auto *lo = stretch(row - 1), *hi = stretch(row);
      const bool uniform = lo && hi;
      const auto from = [&](std::int64_t k) { return state_.material_from(line(k), part.first); };
      face_kernels(uniform).meet(part.count(), above.at(part.first - x), here.at(part.first - x),
                                 uniform ? lo->rows() : from(row - 1), uniform ? hi->rows() : from(row),
                                 ring.faces(row, part.first));
    };
    // Faces between cells that need none are left out.
    const auto below = inside(row - 1);
    tell_apart(
        inside(row), 0, wide,
        [&](const IndexRange& part) {
          tell_apart(
              below, 0, part, [](const IndexRange&) {}, meet);
        },
        meet);
  }
  work.coming().prefetch_one();
  const std::int64_t done = step - rows_behind();
  if (done >= 0 && done < rows)
    update(axis, line(done), wide, state_.field_row(line(done), 0), layout.row_pitch(), scale,
           {ring.faces(done, x), ring.faces(done + 1, x), ring.leaving(done - 1, x), ring.leaving(done, x),
            ring.leaving(done + 1, x)},
           work, true);
}

template <int D, class Real>
void Sweeps<D, Real>::pass_over(std::int64_t step, const IndexRange& columns, Ring<Real>& ring) const {
  const std::int64_t row = step - reach_;
  if (row < 0) return;
  const std::int64_t last =
      columns.last == state_.layout.shape()[0] ? state_.layout.padded_nx() : columns.last;
  const auto leaving = ring.leaving(row, columns.first);
  const auto faces = ring.faces(row, columns.first);
  const auto clear = [&](Real* zero) { std::fill(zero, zero + last - columns.first, Real(0)); };
  for (int p = 0; p < D; ++p)
    for (Real* const zero : {leaving.up(p), leaving.down(p), faces.v(p), faces.s(p)}) clear(zero);
}

template void Sweeps<2, float>::pass_over(std::int64_t, const IndexRange&, Ring<float>&) const;
template void Sweeps<2, float>::expect(std::int64_t, const IndexRange&, PrefetchQueue<float>&) const;
template void Sweeps<2, float>::along_x(std::int64_t, const IndexRange&, float, StripeBoundary<float>&,
                                        Workspace<float>&, bool);
template void Sweeps<2, float>::along_copy(std::int64_t, const Copy&, const IndexRange&, bool, float,
                                           StripeBoundary<float>&, Workspace<float>&);
template void Sweeps<2, float>::put(std::int64_t, const IndexRange&, const float*, std::int64_t);
template const float* Sweeps<2, float>::ahead_along_x(std::int64_t, const IndexRange&, float,
                                                      Workspace<float>&);
template void Sweeps<2, float>::across(int, const Index<2>&, std::int64_t, const IndexRange&, float,
                                       Ring<float>&, Workspace<float>&);
template void Sweeps<3, float>::pass_over(std::int64_t, const IndexRange&, Ring<float>&) const;
template void Sweeps<3, float>::expect(std::int64_t, const IndexRange&, PrefetchQueue<float>&) const;
template void Sweeps<3, float>::along_x(std::int64_t, const IndexRange&, float, StripeBoundary<float>&,
                                        Workspace<float>&, bool);
template void Sweeps<3, float>::along_copy(std::int64_t, const Copy&, const IndexRange&, bool, float,
                                           StripeBoundary<float>&, Workspace<float>&);
template void Sweeps<3, float>::put(std::int64_t, const IndexRange&, const float*, std::int64_t);
template const float* Sweeps<3, float>::ahead_along_x(std::int64_t, const IndexRange&, float,
                                                      Workspace<float>&);
template void Sweeps<3, float>::across(int, const Index<3>&, std::int64_t, const IndexRange&, float,
                                       Ring<float>&, Workspace<float>&);
template void Sweeps<2, double>::pass_over(std::int64_t, const IndexRange&, Ring<double>&) const;
template void Sweeps<2, double>::expect(std::int64_t, const IndexRange&, PrefetchQueue<double>&) const;
template void Sweeps<2, double>::along_x(std::int64_t, const IndexRange&, double, StripeBoundary<double>&,
                                         Workspace<double>&, bool);
template void Sweeps<2, double>::along_copy(std::int64_t, const Copy&, const IndexRange&, bool, double,
                                            StripeBoundary<double>&, Workspace<double>&);
template void Sweeps<2, double>::put(std::int64_t, const IndexRange&, const double*, std::int64_t);
template const double* Sweeps<2, double>::ahead_along_x(std::int64_t, const IndexRange&, double,
                                                        Workspace<double>&);
template void Sweeps<2, double>::across(int, const Index<2>&, std::int64_t, const IndexRange&, double,
                                        Ring<double>&, Workspace<double>&);
template void Sweeps<3, double>::pass_over(std::int64_t, const IndexRange&, Ring<double>&) const;
template void Sweeps<3, double>::expect(std::int64_t, const IndexRange&, PrefetchQueue<double>&) const;
template void Sweeps<3, double>::along_x(std::int64_t, const IndexRange&, double, StripeBoundary<double>&,
                                         Workspace<double>&, bool);
template void Sweeps<3, double>::along_copy(std::int64_t, const Copy&, const IndexRange&, bool, double,
                                            StripeBoundary<double>&, Workspace<double>&);
template void Sweeps<3, double>::put(std::int64_t, const IndexRange&, const double*, std::int64_t);
template const double* Sweeps<3, double>::ahead_along_x(std::int64_t, const IndexRange&, double,
                                                        Workspace<double>&);
template void Sweeps<3, double>::across(int, const Index<3>&, std::int64_t, const IndexRange&, double,
                                        Ring<double>&, Workspace<double>&);

}  // namespace slipwave::solver
