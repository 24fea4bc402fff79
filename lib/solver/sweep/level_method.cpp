// SPDX-License-Identifier: BSD-3-Clause
#include "solver/sweep/level_method.hpp"

#include <algorithm>
#include <cmath>

#include "base/instantiate.hpp"
#include "solver/sweep/uniform_interior.hpp"

namespace slipwave::solver {

template <int D, class Real>
LevelMethod<D, Real>::LevelMethod(const SweepTables<D, Real>& tables) : tables_(tables) {
  const auto& layout = tables.state.layout;
  const IndexRange all{0, layout.padded_nx()};
  for (int axis = 1; axis < D; ++axis) {
    auto& plain = plain_lines_[std::size_t(axis)];
    plain.resize(std::size_t(layout.lines()));
    for (std::int64_t line = 0; line < layout.lines(); ++line)
      plain[std::size_t(line)] = !tables.metric.curvilinear(line) && !tables.any_stencils(axis, line, all) &&
                                 !tables.anisotropic_cells.any(line, all);
  }
}

template <int D, class Real>
void LevelMethod<D, Real>::reconstruct(const RowPart<D, Real>& part, std::int64_t stride,
                                       OutgoingWaves<Real> outgoing, PrefetchQueue<Real>& prefetch) const {
  const auto& state = tables_.state;
  const auto& [axis, at, line, columns, fields, pitch, whole, remember] = part;
  const Real scale = tables_.scale_of(axis, at, whole);
  // Nothing reads the waves of the padding of a row.
  const IndexRange cells{columns.first, std::min(columns.last, state.layout.shape()[0])};
  const auto impedance_of = [](int p, const MaterialRows<Real>& material) {
    return p == 0 ? material.zp : p == 1 ? material.zs : material.zs2;
  };
  const auto material = state.material_from(at, columns.first, axis);
  const auto* const run = state.uniform_run(line, cells.first, cells.last);
  const auto of_cells = run ? run->template rows<D>(axis) : material;
  const auto& kernels = *tables_.kernels[false];
  for (int p = 0; p < tables_.pair_count(); ++p) {
    const auto& pair = tables_.pairs[axis][p];
    Real* const up = outgoing.up(p);
    Real* const down = outgoing.down(p);
    const Real* const v = part.field(pair.v);
    const Real* const s = part.field(pair.s);
    const auto& stencils = tables_.stencils_of(axis, p);
    // Between layers a few cells thick, interfaces leave nothing of a row.
    if (!stencils.all(line, cells))
      tables_.kernels[run != nullptr]->reconstruct(columns.count(), stride, v, s, impedance_of(p, of_cells),
                                                   of_cells.b, scale, up, down);
    if (stencils.in_line(line)) {
      auto of_pair = material;
      if (p > 0) of_pair.zs = impedance_of(p, material);
      stencils.correct(tables_.order, line, columns,
                       PairOfLine<Real>{v, s, stride, tables_.corrections_of(axis, p, whole == 1), scale},
                       of_pair, up, down);
    }
    // After the stencils beside interfaces: their waves keep to the criterion, too.
    if (tables_.monotone)
      kernels.limit(columns.count(), stride, v, s, state.material_layout.stride(axis),
                    impedance_of(p, material), material.b, scale, up, down);
    prefetch.prefetch_one();
  }
  if (!tables_.anisotropic_cells.empty())
    tables_.anisotropic_cells.reconstruct(
        line, columns,
        {axis, kernels, stride, tables_.pairs_from(axis, part.field(0), pitch, whole == 1), material.b, scale,
         outgoing});
}

template <int D, class Real>
void LevelMethod<D, Real>::solve(const RowFaces<D, Real>& faces) const {
  const auto& state = tables_.state;
  const auto first = faces.columns.first, last = faces.columns.last;
  const int axis = faces.axis;
  const auto shift = faces.shift();
  const auto lo = state.material_from(faces.at[0], first - shift, axis),
             hi = state.material_from(faces.at[1], first, axis);
  // Along x that of the cells on both sides, across that of each.
  const auto run_of = [&](std::int64_t line) {
    return line < 0 ? nullptr : state.uniform_run(line, first - shift, last);
  };
  const auto* const above = run_of(faces.lines[1]);
  const auto* const below = shift || !above ? above : run_of(faces.lines[0]);
  const auto rows_of = [&](const auto* run) { return run->template rows<D>(axis); };
  face_kernels(below).solve_riemann(last - first, faces.below, faces.above, below ? rows_of(below) : lo,
                                    below ? rows_of(above) : hi, faces.states);
  tables_.anisotropic_cells.solve(faces, lo, hi);
}

template <int D, class Real>
void LevelMethod<D, Real>::update(const RowPart<D, Real>& part, const RowFlux<Real>& flux,
                                  PrefetchQueue<Real>& prefetch) const {
  const auto& state = tables_.state;
  const int axis = part.axis;
  const Real scale = tables_.scale_of(axis, part.at, part.scale);
  const auto swept = [&](std::int64_t x) { return tables_.swept_rows(axis, part.fields + x, part.pitch); };
  const auto run_of = [&](const auto& of) { return state.uniform_run(part.line, of.first, of.last); };
  const auto without_faces = [&](const IndexRange& of) {
    const auto from = of.first - part.columns.first;
    // Its material is known without reading it from memory.
    face_kernels(true).update_uniform(of.count(), scale, flux.below.at(from), flux.here.at(from),
                                      flux.above.at(from), run_of(of)->template rows<D>(axis),
                                      swept(of.first));
  };
  const auto between_faces = [&](const IndexRange& of) {
    const auto from = of.first - part.columns.first;
    const auto* run = run_of(of);
    face_kernels(run).update(of.count(), scale, flux.lo.at(from), flux.hi.at(from),
                             run ? run->template rows<D>(axis) : state.material_from(part.at, of.first, axis),
                             swept(of.first));
  };
  split_by_runs(state.uniform_interior[std::size_t(axis)].of(part.line), 0, part.columns, without_faces,
                between_faces);
  tables_.add_missing_stress(part, std::abs(scale), flux);
  for (auto* treatment : tables_.treatments)
    treatment->add(axis, part.line, part.columns, scale, flux.lo, flux.hi, swept(part.columns.first),
                   part.remember);
  prefetch.prefetch_one();
}

template <int D, class Real>
bool LevelMethod<D, Real>::fuses(int axis, const Index<D>& here, const Index<D>& done,
                                 const IndexRange& columns) const {
  const auto& state = tables_.state;
  if (tables_.monotone) return false;
  Index<D> below = here;
  --below[axis];
  const auto number = state.layout.line_number(here);
  // Uniform runs are faster with their own loops.
  if (state.uniform_run(number, columns.first, columns.last)) return false;
  const auto lines = {number, state.layout.line_number(below), state.layout.line_number(done)};
  for (const auto* treatment : tables_.treatments)
    if (treatment->beside(axis, state.layout.line_number(done))) return false;
  // Rows in between become those before and behind others.
  if (tables_.scale_of(axis, here, 1) != tables_.scale_of(axis, done, 1)) return false;
  const auto& plain = plain_lines_[std::size_t(axis)];
  // The material may have been filled in since these were found.
  const auto is_plain = [&](auto line) {
    return plain[std::size_t(line)] && state.uniform_runs_of(line).empty();
  };
  if (std::all_of(lines.begin(), lines.end(), is_plain)) return true;
  for (const auto line : lines)
    if (tables_.metric.curvilinear(line) || tables_.anisotropic_cells.any(line, columns)) return false;
  // The outgoing waves downwards are not stored, which uniform runs would need.
  for (const auto line : lines)
    for (const auto& run : state.uniform_interior[std::size_t(axis)].of(line))
      if (run.first < columns.last && run.last > columns.first) return false;
  return !tables_.any_stencils(axis, number, columns);
}

template <int D, class Real>
void LevelMethod<D, Real>::advance(const RowFaces<D, Real>& faces, const RowPart<D, Real>& done,
                                   const RowFlux<Real>& flux) const {
  auto& state = tables_.state;
  const auto& layout = state.layout;
  const int axis = faces.axis;
  const auto& here = faces.at[1];
  const auto x = faces.columns.first, pitch = state.material_layout.row_pitch();
  const Real* const material = state.material_row(here, row_b) + x;
  const Real* const of_done = state.material_row(done.at, row_b) + x;
  const int one = axis_of_pair<D>(axis, 1), two = axis_of_pair<D>(axis, D - 1);
  const auto coupling = [&](int other) {
    return tables_.anisotropic ? of_done + coupling_row<D>(state.kind, axis, other) * pitch : nullptr;
  };
  const FusedRow<Real> rows{tables_.swept_rows(axis, state.field_row(here, 0) + x, layout.row_pitch()),
                            layout.stride(axis),
                            pitch,
                            faces.above.up(1) - faces.above.up(0),
                            faces.states.pitch,
                            material - state.material_layout.stride(axis),
                            material,
                            of_done,
                            faces.below.up(0),
                            faces.above.up(0),
                            faces.states.first,
                            flux.lo.first,
                            flux.hi.first,
                            coupling(one),
                            coupling(two),
                            p_row<D>(state.kind, axis) * pitch,
                            s_row<D>(state.kind, axis, one) * pitch,
                            s_row<D>(state.kind, axis, two) * pitch};
  const auto& all = *tables_.kernels[false];
  const auto loop = tables_.anisotropic ? all.fused_anisotropic_row[D - 2]
                    : tables_.shear     ? all.fused_row[D - 2]
                                        : all.fused_fluid_row;
  loop(faces.columns.count(), tables_.scale_of(axis, here, faces.scale), rows);
}

SLIPWAVE_INSTANTIATE_D_REAL(TYPE, class LevelMethod);

}  // namespace slipwave::solver
