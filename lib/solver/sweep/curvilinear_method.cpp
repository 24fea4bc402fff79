// SPDX-License-Identifier: BSD-3-Clause
#include "solver/sweep/curvilinear_method.hpp"

#include <cmath>

#include "base/instantiate.hpp"

namespace slipwave::solver {
namespace {

/// Halves of rows to prefetch after the reconstruction and after the update: with those of the metric there
/// are twice as many as of a level row.
constexpr int prefetched = 3;

}  // namespace

template <int D, class Real>
CurvilinearMethod<D, Real>::CurvilinearMethod(const SweepTables<D, Real>& tables, const Domain<D>& domain)
    : tables_(tables),
      anisotropic_across_(domain, tables.metric, tables.reach),
      stencils_(domain, tables.reach, tables.corrections[z_axis], tables.metric) {}

template <int D, class Real>
void CurvilinearMethod<D, Real>::reconstruct(const RowPart<D, Real>& part, std::int64_t stride,
                                             OutgoingWaves<Real> outgoing,
                                             PrefetchQueue<Real>& prefetch) const {
  const auto& [axis, at, line, columns, fields, pitch, scale, remember] = part;
  prefetch.prefetch(prefetched);
  const auto material = tables_.state.material_from(at, columns.first);
  const auto& level_kernels = *tables_.kernels[false];
  if (axis == z_axis) {
    const CurvilinearFields<const Real> all{part.field(0), pitch, stride};
    const auto metric = tables_.metric.across(at, columns.first);
    kernels().reconstruct_across(columns.count(), scale, all, material, metric, outgoing);
    anisotropic_across_.reconstruct(line, columns, level_kernels, all, metric, material.b, scale, outgoing);
    stencils_.correct(tables_.order, line, columns, {all, metric, material, scale},
                      tables_.corrections[z_axis], anisotropic_across_, outgoing);
    return;
  }
  const auto metric = tables_.metric.along(axis, at, columns.first);
  const auto swept = tables_.pairs_from(axis, part.field(0), pitch, scale == 1);
  CurvilinearPairs<Real> pairs{};
  for (std::size_t p = 0; p < D; ++p) pairs.v[p] = swept[p].v, pairs.s[p] = swept[p].s;
  kernels().reconstruct_along(columns.count(), stride, pairs, material, scale, metric, outgoing);
  for (int p = 0; p < D; ++p)
    tables_.stencils_of(axis, p).correct(
        tables_.order, line, columns,
        PairOfLine<Real>{pairs.v[p], pairs.s[p], stride, swept[std::size_t(p)].corrections, scale}, material,
        outgoing.up(p), outgoing.down(p), &metric);
  tables_.anisotropic_cells.reconstruct(
      line, columns, {axis, level_kernels, stride, swept, material.b, scale, outgoing, &metric});
}

template <int D, class Real>
void CurvilinearMethod<D, Real>::solve(const RowFaces<D, Real>& faces) const {
  if (faces.axis == z_axis) {
    const bool fluid = fluid_at(faces);
    const Real sign = faces.scale < 0 ? -1 : 1;
    const auto at = across(faces);
    kernels().solve_across[fluid](faces.columns.count(), sign, at);
    anisotropic_across_.solve(faces.lines[0], faces.lines[1], faces.columns, at, sign, fluid);
    return;
  }
  const auto x = faces.columns.first;
  const auto lo = tables_.state.material_from(faces.at[0], x - faces.shift(), faces.axis),
             hi = tables_.state.material_from(faces.at[1], x, faces.axis);
  const Real* const half_face = tables_.metric.along(faces.axis, faces.at[1], x).half_lo;
  kernels().solve_along(faces.columns.count(), faces.below, faces.above, lo, hi, half_face, faces.states);
  tables_.anisotropic_cells.solve(faces, lo, hi, half_face);
}

template <int D, class Real>
void CurvilinearMethod<D, Real>::update(const RowPart<D, Real>& part, const RowFlux<Real>& flux,
                                        PrefetchQueue<Real>& prefetch) const {
  const auto n = part.columns.count();
  if (part.axis == z_axis) {
    const auto of = across(part, flux);
    kernels().update_across(n, part.scale, of);
    anisotropic_across_.add_stress(part.line, part.columns, std::abs(part.scale), of);
  } else {
    const auto rows = tables_.swept_rows(part.axis, part.field(0), part.pitch);
    kernels().update_along(n, part.scale, flux.lo, flux.hi,
                           tables_.state.material_from(part.at, part.columns.first),
                           tables_.metric.along(part.axis, part.at, part.columns.first).over_j, rows);
    tables_.add_missing_stress(part, std::abs(part.scale), flux);
  }
  prefetch.prefetch(prefetched + 1);
}

template <int D, class Real>
void CurvilinearMethod<D, Real>::advance(const RowFaces<D, Real>& faces, const RowPart<D, Real>& done,
                                         const RowFlux<Real>& flux, PrefetchQueue<Real>& prefetch) const {
  const bool fluid = fluid_at(faces);
  const auto at = across(faces);
  const auto of = across(done, flux);
  kernels().advance_across[fluid](faces.columns.count(), done.scale, at, of);
  anisotropic_across_.solve(faces.lines[0], faces.lines[1], faces.columns, at, Real(done.scale < 0 ? -1 : 1),
                            fluid);
  anisotropic_across_.add_stress(done.line, done.columns, std::abs(done.scale), of);
  prefetch.prefetch(prefetched + 2);
}

template <int D, class Real>
bool CurvilinearMethod<D, Real>::fluid_at(const RowFaces<D, Real>& faces) const {
  return tables_.metric.fluid_at_face(tables_.state.layout.line_number(faces.at[1]));
}

template <int D, class Real>
CurvilinearSolve<Real> CurvilinearMethod<D, Real>::across(const RowFaces<D, Real>& faces) const {
  const auto& state = tables_.state;
  const auto x = faces.columns.first;
  const auto fields = [&](const Index<D>& line) {
    return CurvilinearFields<const Real>{state.field_row(line, 0) + x, state.layout.row_pitch(), 0};
  };
  const auto& [lo, hi] = faces.at;
  return {faces.below,       faces.above,       state.material_from(lo, x),   state.material_from(hi, x),
          fields(lo),        fields(hi),        tables_.metric.across(hi, x), faces.states,
          faces.states.v(D), faces.states.pitch};
}

template <int D, class Real>
CurvilinearUpdate<Real> CurvilinearMethod<D, Real>::across(const RowPart<D, Real>& part,
                                                           const RowFlux<Real>& flux) const {
  const auto x = part.columns.first;
  const bool fluid = tables_.metric.fluid_at_face(part.line);
  return {flux.lo,
          flux.hi,
          flux.lo.v(fluid ? D : 0),
          fluid ? flux.lo.pitch : 2 * flux.lo.pitch,
          tables_.state.material_from(part.at, x),
          tables_.metric.across(part.at, x),
          {part.field(0), part.pitch, 0}};
}

SLIPWAVE_INSTANTIATE_D_REAL(TYPE, class CurvilinearMethod);

}  // namespace slipwave::solver
