#include "solver/sweeps.hpp"

#include <algorithm>

#include "base/parallel.hpp"

namespace slipwave::solver {
namespace {

/// Columns swept together: few enough for the ring of faces to stay in the first cache.
constexpr std::int64_t widest_stripe = 256;
/// Rows of faces kept while their cells are still needed unchanged.
constexpr int ring_rows = max_reach + 2;
constexpr int buffers_a_pair = 4 + 2 * ring_rows;

}  // namespace

template <class Real>
void edge_state(EdgeLaw law, Wave wave, std::int64_t n, const Real* leaving, Real* entering) {
  const bool motionless = continuation(law, wave) == Continuation::motionless;
  for (std::int64_t i = 0; i < n; ++i) entering[i] = motionless ? -leaving[i] : Real(0);
}

template <int D, class Real>
Sweeps<D, Real>::Sweeps(State<D, Real>& state, const Domain<D>& domain, int order)
    : state_(state),
      kernels_(kernels<Real>(order)),
      edges_(domain.edges),
      order_(order),
      reach_(reach_of(order)),
      shear_(domain.shear()) {
  for (int axis = 0; axis < D; ++axis) {
    const BentAt<D> bent = [&domain, axis](Index<D> at, int side) {
      at[std::size_t(axis)] = side ? domain.grid.shape[std::size_t(axis)] - 1 : 0;
      return !edge_slope(domain, at, axis, side, FieldRows<D>::velocity(axis)).empty();
    };
    for (const Wave wave : {wave_p, wave_s})
      ends_[axis][wave] = SpanEnds(domain.impedance[wave], edges_, axis, wave, reach_, bent);
    for (const int side : {0, 1})
      if (reach_ > 0) free_edges_[axis][side] = FreeEdge<D, Real>(state.layout, domain, axis, side);
  }
  const auto row = std::max(state.layout.padded_nx() + 2 * Layout<D>::lead, widest_stripe);
  for (int worker = 0; worker < parallel_workers(); ++worker)
    scratch_.emplace_back(row * (buffers_a_pair * D + 4));
}

template <int D, class Real>
std::int64_t Sweeps<D, Real>::span_end_cells() const {
  std::size_t cells = 0;
  for (const auto& axis : ends_)
    for (const auto& wave : axis) cells += wave.size();
  return std::int64_t(cells);
}

template <int D, class Real>
auto Sweeps<D, Real>::pairs(int axis) const -> std::array<Pair, D> {
  using Rows = FieldRows<D>;
  std::array<Pair, D> all{};
  all[0] = {wave_p, Rows::velocity(axis), Rows::normal_stress(axis), &ends_[axis][wave_p]};
  int n = 1;
  for (int other = 0; other < D; ++other)
    if (other != axis)
      all[n++] = {wave_s, Rows::velocity(other),
                  Rows::shear_stress(std::min(axis, other), std::max(axis, other)), &ends_[axis][wave_s]};
  return all;
}

template <int D, class Real>
void Sweeps<D, Real>::along_x(const std::function<Real(std::int64_t)>& part) {
  const std::int64_t lines = state_.layout.lines();
  measure_free_edges(0);
  parallel_for(lines, 4, [&](std::int64_t begin, std::int64_t end, int worker) {
    Real* scratch = scratch_[std::size_t(worker)].data();
    for (std::int64_t line = begin; line < end; ++line)
      if (const Real scale = part(line); scale != 0)
        sweep_line(line, state_.field_row(state_.layout.line_index(line), 0), scale, scratch, true);
  });
}

template <int D, class Real>
void Sweeps<D, Real>::ahead_along_x(std::span<const std::int64_t> lines, Real scale,
                                    const std::function<Real*(std::int64_t)>& to) {
  const std::int64_t values = FieldRows<D>::count * state_.layout.row_pitch();
  measure_free_edges(0);
  parallel_for(std::int64_t(lines.size()), 4, [&](std::int64_t begin, std::int64_t end, int worker) {
    Real* scratch = scratch_[std::size_t(worker)].data();
    for (auto n = std::size_t(begin); n < std::size_t(end); ++n) {
      const Real* from = state_.field_row(state_.layout.line_index(lines[n]), 0);
      Real* const copy = to(lines[n]);
      std::copy(from - Layout<D>::lead, from - Layout<D>::lead + values, copy - Layout<D>::lead);
      sweep_line(lines[n], copy, scale, scratch, false);
    }
  });
}

template <int D, class Real>
void Sweeps<D, Real>::update(const Index<D>& at, Real* fields, int axis, const Pair& pair, std::int64_t width,
                             Real scale, const Real* v_lo, const Real* v_hi, const Real* s_lo,
                             const Real* s_hi, Real* spare, bool remember) {
  const bool stretched = layer_ && layer_->covers(axis, at);
  std::array<int, 2 + D> rows{pair.v, pair.s};
  std::size_t row_count = 2;
  if (pair.wave == wave_p)
    for (int other = 0; other < D; ++other)
      if (other != axis) rows[row_count++] = FieldRows<D>::normal_stress(other);
  const auto kept = [&](std::size_t n) { return spare + std::int64_t(n) * width; };
  const auto material = [&](int row) { return state_.material_row(at, row) + at[0]; };
  const auto field = [&](int row) { return fields + row * state_.layout.row_pitch() + at[0]; };
  for (std::size_t n = 0; n < row_count && stretched; ++n)
    layer_->keep(axis, at, width, field(rows[n]), kept(n));
  if (pair.wave == wave_s) {
    kernels_.update_shear(width, scale, v_lo, v_hi, s_lo, s_hi, material(row_b), material(row_zs),
                          material(row_cs), field(pair.v), field(pair.s));
  } else {
    kernels_.update_normal(width, scale, v_lo, v_hi, s_lo, s_hi, material(row_b), material(row_zp),
                           material(row_cp), material(row_zs), material(row_cs), field(pair.v), field(pair.s),
                           row_count > 2 ? field(rows[2]) : nullptr,
                           row_count > 3 ? field(rows[3]) : nullptr);
  }
  for (std::size_t n = 0; n < row_count && stretched; ++n)
    layer_->stretch(axis, at, rows[n], width, scale, kept(n), field(rows[n]), remember);
}

template <int D, class Real>
void Sweeps<D, Real>::sweep_line(std::int64_t line, Real* fields, Real scale, Real* scratch, bool remember) {
  const Index<D> at = state_.layout.line_index(line);
  const std::int64_t n = state_.layout.shape()[0], width = state_.layout.padded_nx();
  const std::int64_t row = width + 2 * Layout<D>::lead;
  // Index -1 (below the first cell) and n (beyond the last) exist in all four.
  Real* const up = scratch + Layout<D>::lead;
  Real* const down = up + row;
  Real* const v_face = down + row;  // v_face[i] lies below cell i
  Real* const s_face = v_face + row;
  const auto all = pairs(0);
  for (int p = 0; p < pair_count(); ++p) {
    const Pair& pair = all[p];
    Real* const v = fields + pair.v * state_.layout.row_pitch();
    Real* const s = fields + pair.s * state_.layout.row_pitch();
    fill_ghost_cells(line, v, s, p, pair.wave, scale);
    const Real* impedance = state_.material_row(at, pair.wave == wave_p ? row_zp : row_zs);
    const Real* courant = state_.material_row(at, pair.wave == wave_p ? row_cp : row_cs);
    kernels_.leave(width, 1, v, s, impedance, courant, scale, up, down);
    pair.ends->correct(order_, line, 0, n, 1, v, s, impedance, courant, scale, up, down);
    edge_state(edges_[0][0], pair.wave, 1, down, up - 1);
    edge_state(edges_[0][1], pair.wave, 1, up + n - 1, down + n);
    kernels_.meet(width, up - 1, impedance - 1, down, impedance, v_face, s_face);
    // Where the row fills whole vectors the last face lies one beyond what the kernel did.
    kernels_.meet(1, up + n - 1, impedance + n - 1, down + n, impedance + n, v_face + n, s_face + n);
    for (std::int64_t i = n + 1; i <= width; ++i) v_face[i] = s_face[i] = 0;
    update(at, fields, 0, pair, width, scale, v_face, v_face + 1, s_face, s_face + 1, s_face + row, remember);
  }
}

template <int D, class Real>
std::int64_t Sweeps<D, Real>::stripe_width() const {
  // A multiple of four stripes shares out evenly among the usual numbers of threads.
  const std::int64_t nx = state_.layout.padded_nx();
  const std::int64_t stripes = (nx + 4 * widest_stripe - 1) / (4 * widest_stripe) * 4;
  return ((nx + stripes - 1) / stripes + 15) / 16 * 16;
}

template <int D, class Real>
void Sweeps<D, Real>::across(int axis, Real scale) {
  const std::int64_t nx = state_.layout.padded_nx(), width = stripe_width();
  measure_free_edges(axis);
  const std::int64_t stripes = (nx + width - 1) / width;
  std::int64_t others = 1;
  for (int other = 1; other < D; ++other)
    if (other != axis) others *= state_.layout.shape()[other];
  parallel_for(others * stripes, 1, [&](std::int64_t begin, std::int64_t end, int worker) {
    Real* scratch = scratch_[std::size_t(worker)].data();
    for (std::int64_t n = begin; n < end; ++n) {
      Index<D> first{};
      first[0] = n % stripes * width;
      if constexpr (D == 3) first[axis == 1 ? 2 : 1] = n / stripes;
      sweep_columns(axis, first, std::min(width, nx - first[0]), scale, scratch);
    }
  });
}

template <int D, class Real>
void Sweeps<D, Real>::along(int axis, Real scale) {
  if (axis > 0) return across(axis, scale);
  along_x([scale](std::int64_t) { return scale; });
}

template <int D, class Real>
void Sweeps<D, Real>::sweep_columns(int axis, const Index<D>& first, std::int64_t width, Real scale,
                                    Real* scratch) {
  const std::int64_t n = state_.layout.shape()[axis], stride = state_.layout.stride(axis);
  const std::int64_t lag = std::max(reach_, 1);
  const auto all = pairs(axis);
  struct Rows {
    Real *up[2], *down, *entering, *v_face[ring_rows], *s_face[ring_rows];
  } rows[D];
  for (auto& r : rows) {
    r.up[0] = scratch, r.up[1] = scratch + width, r.down = scratch + 2 * width,
    r.entering = scratch + 3 * width;
    for (int k = 0; k < ring_rows; ++k) {
      r.v_face[k] = scratch + (4 + 2 * k) * width;
      r.s_face[k] = scratch + (5 + 2 * k) * width;
    }
    scratch += buffers_a_pair * width;
  }
  for (int p = 0; p < pair_count(); ++p) fill_ghost_lines(axis, first, width, p, all[p], scale);

  // Row k sends out its states, they meet those of row k-1 at face k; row k - lag is needed unchanged no
  // more.
  for (std::int64_t k = 0; k < n + lag; ++k) {
    Index<D> at = first;
    at[axis] = k;
    for (int p = 0; p < pair_count(); ++p) {
      const Pair& pair = all[p];
      Rows& r = rows[p];
      const int z_row = pair.wave == wave_p ? row_zp : row_zs, c_row = pair.wave == wave_p ? row_cp : row_cs;
      Real *up = r.up[k % 2], *up_before = r.up[(k + 1) % 2];
      if (k < n) {
        const Real* v = state_.field_row(at, pair.v) + first[0];
        const Real* s = state_.field_row(at, pair.s) + first[0];
        const Real* impedance = state_.material_row(at, z_row) + first[0];
        const Real* courant = state_.material_row(at, c_row) + first[0];
        kernels_.leave(width, stride, v, s, impedance, courant, scale, up, r.down);
        pair.ends->correct(order_, state_.layout.line_number(at), first[0], first[0] + width, stride, v, s,
                           impedance, courant, scale, up, r.down);
      }
      if (k <= n) {
        Index<D> before = at;
        before[axis] = k - 1;
        const Real *arriving_up = up_before, *arriving_down = r.down;
        if (k == 0)
          edge_state(edges_[axis][0], pair.wave, width, r.down, r.entering), arriving_up = r.entering;
        if (k == n)
          edge_state(edges_[axis][1], pair.wave, width, up_before, r.entering), arriving_down = r.entering;
        kernels_.meet(width, arriving_up, state_.material_row(before, z_row) + first[0], arriving_down,
                      state_.material_row(at, z_row) + first[0], r.v_face[k % ring_rows],
                      r.s_face[k % ring_rows]);
      }
      if (k >= lag) {
        Index<D> done = at;
        done[axis] = k - lag;
        const auto lo = (k - lag) % ring_rows, hi = (k - lag + 1) % ring_rows;
        update(done, state_.field_row(done, 0), axis, pair, width, scale, r.v_face[lo], r.v_face[hi],
               r.s_face[lo], r.s_face[hi], scratch, true);
      }
    }
  }
}

template void edge_state(EdgeLaw, Wave, std::int64_t, const float*, float*);
template void edge_state(EdgeLaw, Wave, std::int64_t, const double*, double*);
template class Sweeps<2, float>;
template class Sweeps<2, double>;

}  // namespace slipwave::solver
