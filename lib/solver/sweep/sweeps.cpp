#include "solver/sweep/sweeps.hpp"

#include <algorithm>
#include <limits>

#include "parallel/threads.hpp"

namespace slipwave::solver {
namespace {

/// Columns swept together across: what they need stays in the first cache.
constexpr std::int64_t stripe_width = 256;

}  // namespace

template <int D, class Real>
Sweeps<D, Real>::Sweeps(State<D, Real>& state, const Domain<D>& domain, int order)
    : state_(state),
      kernels_{&kernels<Real>(order, false), &kernels<Real>(order, true)},
      edges_(domain.edges),
      order_(order),
      reach_(reach_of(order)),
      shear_(domain.shear()) {
  for (int axis = 0; axis < D; ++axis) {
    pairs_[axis] = make_pairs(axis);
    changed_[axis] = rows_changed(axis);
    for (const int side : {0, 1})
      if (reach_ > 0) free_edges_[axis][side] = FreeSurface<D, Real>(state.layout, domain, axis, side);
  }
  // Each looks at all cells.
  parallel_for(2 * D, 1, [&](std::int64_t begin, std::int64_t end, int) {
    for (auto n = begin; n < end; ++n) {
      const int axis = int(n / 2);
      const auto wave = Wave(n % 2);
      const CorrectedAt<D> bent = [&domain, axis](Index<D> at, int side) {
        at[std::size_t(axis)] = side ? domain.grid.shape[std::size_t(axis)] - 1 : 0;
        return !surface_slope(domain, at, axis, side, FieldRows<D>::velocity(axis)).empty();
      };
      ends_[axis][wave] = InterfaceStencils(domain.impedance[wave], edges_, axis, wave, reach_, bent);
    }
  });
}

template <int D, class Real>
Workspace<Real> Sweeps<D, Real>::make_workspace(std::int64_t widest) const {
  return Workspace<Real>(widest, FieldRows<D>::count, D);
}

template <int D, class Real>
Ring<Real> Sweeps<D, Real>::make_ring(int axis, std::int64_t first, std::int64_t width) const {
  const int waiting = int(rows_behind() - reach_);
  // Faces need what leaves two rows. Without them it is kept until its row is brought forward.
  const int leaving = state_.uniform_interior[std::size_t(axis)].empty() ? 2 : waiting + 2;
  return Ring<Real>(first, width, leaving, waiting + 1, D);
}

template <int D, class Real>
std::int64_t Sweeps<D, Real>::interface_stencil_cells() const {
  std::size_t cells = 0;
  for (const auto& axis : ends_)
    for (const auto& wave : axis) cells += wave.size();
  return std::int64_t(cells);
}

template <int D, class Real>
auto Sweeps<D, Real>::make_pairs(int axis) const -> std::array<Pair, D> {
  using Rows = FieldRows<D>;
  std::array<Pair, D> all{};
  all[0] = {wave_p, Rows::velocity(axis), Rows::normal_stress(axis)};
  int n = 1;
  for (int other = 0; other < D; ++other)
    if (other != axis)
      all[n++] = {wave_s, Rows::velocity(other),
                  Rows::shear_stress(std::min(axis, other), std::max(axis, other))};
  return all;
}

template <int D, class Real>
auto Sweeps<D, Real>::rows_changed(int axis) const -> std::array<int, changed> {
  std::array<int, changed> rows{};
  int n = 0;
  rows[n++] = pairs_[axis][0].v;
  rows[n++] = pairs_[axis][0].s;
  for (int other = 0; other < D; ++other)
    if (other != axis) rows[n++] = FieldRows<D>::normal_stress(other);
  for (int p = 1; p < D; ++p) {
    rows[n++] = pairs_[axis][p].v;
    rows[n++] = pairs_[axis][p].s;
  }
  return rows;
}

/// What leaves the cells of these columns; `leaving` begins with the first of them.
template <int D, class Real>
void Sweeps<D, Real>::reconstruct_row(int axis, const Index<D>& line, const IndexRange& columns,
                                      const Real* fields, std::int64_t pitch, std::int64_t stride, Real scale,
                                      OutgoingWaves<Real> leaving, PrefetchQueue<Real>& coming) const {
  const auto number = state_.layout.line_number(line);
  const std::int64_t nx = state_.layout.shape()[0];
  // What fills up the last block of a line is of no material: it would keep all of a piece from being of one.
  const IndexRange whole{columns.first,
                         columns.last > nx ? std::max(columns.first, nx / lag * lag) : columns.last};
  const auto leave = [&](const Pair& pair, const IndexRange& part, Real* up, Real* down) {
    if (part.empty()) return;
    const auto* stretch = state_.stretch(number, part.first, part.last);
    const auto material = stretch ? stretch->rows() : state_.material_from(line, part.first);
    const auto from = part.first - columns.first;
    kernels_[stretch != nullptr]->leave(
        part.count(), stride, fields + pair.v * pitch + part.first, fields + pair.s * pitch + part.first,
        pair.wave == wave_p ? material.zp : material.zs, material.b, scale, up + from, down + from);
  };
  for (int p = 0; p < pair_count(); ++p) {
    const Pair& pair = pairs_[axis][p];
    Real* const up = leaving.up(p);
    Real* const down = leaving.down(p);
    leave(pair, whole, up, down);
    leave(pair, {whole.last, columns.last}, up, down);
    ends_[axis][pair.wave].correct(order_, number, columns, stride, fields + pair.v * pitch + columns.first,
                                   fields + pair.s * pitch + columns.first,
                                   state_.material_from(line, columns.first), scale, up, down);
    coming.prefetch_one();
  }
}

/// Brings these columns forward.
template <int D, class Real>
void Sweeps<D, Real>::update(int axis, const Index<D>& line, const IndexRange& columns, Real* fields,
                             std::int64_t pitch, Real scale, const Flux& flux, Workspace<Real>& work,
                             bool remember) {
  const auto& rows = changed_[axis];
  const int row_count = shear_ ? changed : changed_by_p;
  const auto field = [&](int n) { return fields + rows[n] * pitch; };
  // Made in place: a copy would wait for all that loops before this have written.
  const auto covered = layer_ ? layer_->covered(axis, line, columns) : std::array<IndexRange, 2>{};
  for (const auto& part : covered)
    for (int n = 0; n < row_count && !part.empty(); ++n)
      std::copy(field(n) + part.first, field(n) + part.last, work.before(n) + part.first - columns.first);
  const auto swept = [&](std::int64_t x) -> SweptRows<Real> {
    const auto at = [&](int n) { return field(n) + x; };
    if constexpr (D == 2) return {at(0), at(1), at(2), at(3), at(4)};
    if constexpr (D == 3) return {at(0), at(1), at(2), at(4), at(5), at(3), at(6), at(7)};
  };
  const auto number = state_.layout.line_number(line);
  const auto stretch_of = [&](const IndexRange& part) {
    return state_.stretch(number, part.first, part.last);
  };
  const auto inside = [&](const IndexRange& part) {
    const auto from = part.first - columns.first;
    // Its material is known without looking for it in memory.
    face_kernels(true).inside(part.count(), scale, flux.below.at(from), flux.here.at(from),
                              flux.above.at(from), stretch_of(part)->rows(), swept(part.first));
  };
  const auto between_faces = [&](const IndexRange& part) {
    const auto from = part.first - columns.first;
    const auto* stretch = stretch_of(part);
    face_kernels(stretch != nullptr)
        .update(part.count(), scale, flux.lo.at(from), flux.hi.at(from),
                stretch ? stretch->rows() : state_.material_from(line, part.first), swept(part.first));
  };
  tell_apart(state_.uniform_interior[std::size_t(axis)].of(number), 0, columns, inside, between_faces);
  work.coming().prefetch_one();
  for (const auto& part : covered)
    for (int n = 0; n < row_count && !part.empty(); ++n)
      layer_->stretch(axis, line, rows[n], part, scale, work.before(n) + part.first - columns.first,
                      field(n) + part.first, remember);
}

template <int D, class Real>
void Sweeps<D, Real>::along(int axis, Real scale) {
  const auto& layout = state_.layout;
  const std::int64_t lines = layout.lines(), nx = layout.padded_nx();
  const std::int64_t widest = axis == 0 ? nx : stripe_width;
  std::vector<Workspace<Real>> work;
  for (int worker = 0; worker < parallel_workers(); ++worker) work.push_back(make_workspace(widest));
  for (std::int64_t line = 0; line < lines && axis < z_axis && bends(axis); ++line)
    keep(axis, line, {0, layout.shape()[0]});
  if (axis == 0) {
    parallel_for(lines, 4, [&](std::int64_t begin, std::int64_t end, int worker) {
      StripeBoundary<Real> boundary{};
      for (std::int64_t line = begin; line < end; ++line) {
        measure_side_surfaces(line);
        along_x(line, {0, layout.shape()[0]}, scale, boundary, work[std::size_t(worker)]);
      }
    });
    return;
  }
  const std::int64_t stripes = (nx + stripe_width - 1) / stripe_width, rows = layout.shape()[axis];
  // Free edges read columns of neighbouring stripes: these must not have moved.
  for (const int side : {0, 1})
    free_edges_[axis][side].measure(state_, 0, std::numeric_limits<std::int64_t>::max());
  const std::int64_t sheets = layout.lines() / rows;
  parallel_for(sheets * stripes, 1, [&](std::int64_t begin, std::int64_t end, int worker) {
    for (std::int64_t n = begin; n < end; ++n) {
      const auto stripe = n % stripes;
      const IndexRange columns{stripe * stripe_width, std::min((stripe + 1) * stripe_width, nx)};
      auto ring = make_ring(axis, columns.first, columns.count());
      Index<D> at{};
      if (D == 3) at[std::size_t(3 - axis)] = n / stripes;
      for (std::int64_t step = 0; step < rows + rows_behind(); ++step)
        across(axis, at, step, columns, scale, ring, work[std::size_t(worker)]);
    }
  });
}

template class Sweeps<2, float>;
template class Sweeps<2, double>;
template class Sweeps<3, float>;
template class Sweeps<3, double>;

}  // namespace slipwave::solver
