// SPDX-License-Identifier: BSD-3-Clause
#include "solver/sweep/anisotropic_cells.hpp"

#include <algorithm>
#include <utility>

#include "base/instantiate.hpp"
#include "parallel/threads.hpp"
#include "solver/sweep/matrix_faces.hpp"

namespace slipwave::solver {
namespace {

/// Puts a vector into rows a pitch apart.
template <int D, class Real>
void put(const RowVector<D, Real>& vector, Real* to, std::int64_t pitch) {
  const auto all = components<D>(vector);
  for (std::size_t c = 0; c < D; ++c) to[std::int64_t(c) * pitch] = all[c];
}

}  // namespace

template <int D, class Real>
AnisotropicCellsAcross<D, Real>::AnisotropicCellsAcross(const Domain<D>& domain,
                                                        const Metric<D, Real>& metric, int reach)
    : reach_(reach) {
  if (!metric.any_curvilinear() || domain.anisotropic_cells().empty()) return;
  const auto& shape = domain.grid.shape;
  const std::int64_t lines = domain.grid.size() / shape[0];
  const auto curvilinear = [&](std::int64_t row) {
    return row >= 0 && row < shape[D - 1] && domain.curvilinear(row);
  };
  for (std::int64_t line = 0; line < lines; ++line) {
    auto at = domain.grid.index(line * shape[0]);
    const auto row = at[D - 1];
    const bool own = curvilinear(row), beside = curvilinear(row - 1) || curvilinear(row + 1);
    for (; (own || beside) && at[0] < shape[0]; ++at[0]) {
      if (const auto* const cell = domain.anisotropic_cell(at))
        list_.cells.push_back({std::int32_t(at[0]), cell->medium});
      else if (!own && anisotropic_across_rows(domain, at))
        list_.cells.push_back({std::int32_t(at[0]), -1});
    }
    list_.end_line();
  }
  if (empty()) return;
  for (const auto& medium : domain.anisotropic_media()) {
    const auto missing = sum_of(medium.elasticity.voigt, medium.of_loops.voigt, -1.);
    auto& of = media_.emplace_back();
    for (std::size_t i = 0; i < stresses; ++i)
      for (std::size_t k = 0; k < stresses; ++k) of[i][k] = Real(medium.rho * missing[i][k]);
  }
  values_ = Buffer<Real>(std::int64_t(list_.cells.size() * values));
  parallel_for(lines, 16, [&](std::int64_t begin, std::int64_t end, int) {
    for (auto line = begin; line < end; ++line) fill(domain, metric, line);
  });
}

template <int D, class Real>
void AnisotropicCellsAcross<D, Real>::fill(const Domain<D>& domain, const Metric<D, Real>& metric,
                                           std::int64_t line) {
  const auto from = list_.first[std::size_t(line)], to = list_.first[std::size_t(line) + 1],
             pitch = to - from;
  auto at = domain.grid.index(line * domain.grid.shape[0]);
  const auto first_of_line = at;
  for (auto n = from; n < to; ++n) {
    at[0] = list_[n].x;
    const auto waves = waves_across_rows<D>(elasticity_at(domain, at), metric.across(first_of_line, at[0]));
    Real* value = values_.data() + from * std::int64_t(values) + (n - from);
    const auto put = [&](const auto& all) {
      for (const double of : all) *value = Real(of), value += pitch;
    };
    for (const auto& face : waves.faces) {
      put(face.z);
      for (const auto& motion : face.motions) put(motion);
    }
    put(waves.courant_z);
  }
}

template <int D, class Real>
auto AnisotropicCellsAcross<D, Real>::rows_of(std::int64_t line, std::int64_t cell) const -> Rows {
  const auto from = list_.first[std::size_t(line)], pitch = list_.first[std::size_t(line) + 1] - from;
  return {values_.data() + from * std::int64_t(values) + (cell - from), pitch};
}

template <int D, class Real>
std::optional<RowWaves<D, Real>> AnisotropicCellsAcross<D, Real>::waves_of(std::int64_t line,
                                                                           std::int64_t x) const {
  if (empty()) return {};
  const auto* const cell = list_.find(line, x);
  if (!cell) return {};
  const auto rows = rows_of(line, cell - list_.cells.data());
  RowWaves<D, Real> waves;
  const Real* value = rows.first;
  const auto get = [&](auto& all) {
    for (auto& of : all) of = *value, value += rows.pitch;
  };
  for (auto& face : waves.faces) {
    get(face.z);
    for (auto& motion : face.motions) get(motion);
  }
  get(waves.courant_z);
  return waves;
}

template <int D, class Real>
void AnisotropicCellsAcross<D, Real>::find_weights(const Rows& rows, std::int64_t n, Real sign,
                                                   Weights& weights) {
  for (std::size_t wave = 0; wave < D; ++wave) {
    const auto motion = D + D * wave;
    for (std::int64_t i = 0; i < n; ++i) {
      const auto pair =
          wave_pair<D, Real>(rows[motion] + i, rows[wave][i], rows[of_face + motion] + i,
                             rows[of_face + wave][i], rows.pitch, rows[2 * of_face + wave][i], sign);
      for (std::size_t c = 0; c < motion_parts; ++c)
        weights[wave][0][c][i] = pair.v[c], weights[wave][1][c][i] = pair.s[c];
    }
  }
}

template <int D, class Real>
void AnisotropicCellsAcross<D, Real>::load(std::int64_t n, const Real* field, std::int64_t pitch,
                                           const Real* half_n, const CurvilinearAcross<Real>& metric,
                                           Motion& motion) {
  for (std::int64_t i = 0; i < n; ++i) {
    const auto v = row_velocity<D>(field + i, pitch);
    const auto t = row_traction<D>(field + i, pitch, cell_normal<D>(half_n + i, metric.pitch, metric.stride));
    motion[0][i] = v.z, motion[1][i] = v.x, motion[D][i] = t.z, motion[D + 1][i] = t.x;
    if constexpr (D == 3) motion[2][i] = v.y, motion[5][i] = t.y;
  }
}

template <int D, class Real>
void AnisotropicCellsAcross<D, Real>::reconstruct(std::int64_t line, const IndexRange& columns,
                                                  const Kernels<Real>& kernels,
                                                  const CurvilinearFields<const Real>& fields,
                                                  const CurvilinearAcross<Real>& metric, const Real* b,
                                                  Real scale, OutgoingWaves<Real> outgoing) const {
  if (empty()) return;
  const Real sign = scale < 0 ? -1 : 1;
  Weights weights;
  Motion motion;
  WavesOfRun<D, Real> waves;
  Real sums[D][cells_at_once];
  list_.each_run(line, columns, [&](const IndexRange& run) {
    const auto n = run.count(), to = list_[run.first].x - columns.first;
    const auto rows = rows_of(line, run.first);
    find_weights(rows, n, sign, weights);
    for (int k = -reach_; k <= reach_; ++k) {
      load(n, fields.first + to + k * fields.stride, fields.pitch, metric.half_n + to + k * metric.stride,
           metric, motion);
      for (std::size_t wave = 0; wave < D; ++wave)
        for (const std::size_t of : {0, 1})
          weighted_sum<Real, motion_parts>(n, rows_from<motion_parts>(weights[wave][of]),
                                           rows_from<motion_parts>(motion),
                                           waves.pairs[wave][of][k + reach_]);
    }
    waves.reconstruct(
        n, reach_, kernels, [&](std::size_t wave) { return rows[2 * of_face + wave]; }, b + to, scale);
    const auto put_resolved = [&](const Real(&sizes)[D][cells_at_once], std::size_t side, Real* result) {
      const auto motion_of = [&](std::size_t wave, std::size_t c) {
        return rows[side * of_face + D + D * wave + c];
      };
      put_components<D>(n, motion_of, sizes, [&](int c) { return sums[c]; });
      for (std::int64_t i = 0; i < n; ++i) {
        std::array<Real, std::size_t(D)> sum;
        for (std::size_t c = 0; c < D; ++c) sum[c] = sums[c][i];
        const auto face = to + i + std::int64_t(side) * metric.stride;
        put<D>(resolved_on_face<D>(row_vector<D>(sum), face_normal<D>(metric.half_n + face, metric.pitch),
                                   metric.over_face[face]),
               result + i, 2 * outgoing.pitch);
      }
    };
    put_resolved(waves.up, 1, outgoing.up(0) + to), put_resolved(waves.down, 0, outgoing.down(0) + to);
  });
}

template <int D, class Real>
void AnisotropicCellsAcross<D, Real>::impedances_beside(
    std::int64_t line, std::size_t side, const IndexRange& columns, const MaterialRows<Real>& material,
    const CurvilinearAcross<Real>& metric, std::int64_t from, const RunOfImpedances<D, Real>& other,
    RunOfImpedances<D, Real>& to) const {
  const auto cells = list_.in(line, columns);
  for (std::int64_t k = 0; k < columns.count() && cells.count() < columns.count(); ++k) {
    const auto i = from + k;
    const Real zp = material.zp[i], zs = material.zs[i];
    // Beyond the grid there is what the law of the edge says: as much as before it, or nothing.
    if (line < 0 && zs > 0) {
      for (std::size_t m = 0; m < symmetric<D>; ++m) to.values[m][k] = other.values[m][k];
      continue;
    }
    const bool mirror = line < 0 && zp > 0;
    const auto normal = components<D>(face_normal<D>(metric.half_n + i, metric.pitch));
    const Real over = metric.over_face[i], p = mirror ? Real(mirror_impedance) * zp : zp,
               share = over * (p - zs), own = zs / over;
    for (std::size_t c = 0; c < D; ++c)
      for (std::size_t d = c; d < D; ++d)
        to.values[place_in<D>(c, d)][k] = share * normal[c] * normal[d] + (c == d ? own : Real(0));
  }
  list_.each_run(line, columns, [&](const IndexRange& run) {
    const auto k = list_[run.first].x - columns.first;
    // The face behind a cell that stands before it.
    const auto all = rows_of(line, run.first);
    const Rows rows{all.first + std::int64_t(side == 0 ? of_face : 0) * all.pitch, all.pitch};
    for (std::size_t c = 0; c < D; ++c)
      for (std::size_t d = c; d < D; ++d)
        for (std::int64_t i = 0; i < run.count(); ++i) {
          Real sum = 0;
          for (std::size_t wave = 0; wave < D; ++wave)
            sum += rows[wave][i] * rows[D + D * wave + c][i] * rows[D + D * wave + d][i];
          to.values[place_in<D>(c, d)][k + i] = sum;
        }
  });
}

template <int D, class Real>
void AnisotropicCellsAcross<D, Real>::solve(std::int64_t lo, std::int64_t hi, const IndexRange& columns,
                                            const CurvilinearSolve<Real>& at, Real sign, bool fluid) const {
  if (empty()) return;
  RunOfImpedances<D, Real> of_lo, of_hi;
  Real up[D][cells_at_once], down[D][cells_at_once], v[D][cells_at_once];
  each_run_of_faces(list_, lo, hi, 0, columns, cells_at_once, [&](const IndexRange& run) {
    const auto i = run.first - columns.first, n = run.count();
    const auto beside_lo = [&] { impedances_beside(lo, 0, run, at.lo, at.metric, i, of_hi, of_lo); };
    if (lo >= 0) beside_lo();
    impedances_beside(hi, 1, run, at.hi, at.metric, i, of_lo, of_hi);
    if (lo < 0) beside_lo();
    const auto normal_of = [&](std::int64_t k) {
      return face_normal<D>(at.metric.half_n + i + k, at.metric.pitch);
    };
    const auto load_waves = [&](const Real* from, std::int64_t pitch, Real(&to)[D][cells_at_once]) {
      for (std::int64_t k = 0; k < n; ++k) {
        std::array<Real, std::size_t(D)> resolved;
        for (std::size_t c = 0; c < D; ++c) resolved[c] = from[i + k + std::int64_t(c) * pitch];
        put<D>(from_face<D>(row_vector<D>(resolved), normal_of(k), at.metric.over_face[i + k]), to[0] + k,
               cells_at_once);
      }
    };
    load_waves(at.below.up(0), 2 * at.below.pitch, up),
        load_waves(at.above.down(0), 2 * at.above.pitch, down);
    FaceRows<D, Real> rows{};
    for (int c = 0; c < D; ++c)
      rows.up[c] = up[c], rows.down[c] = down[c], rows.v[c] = v[c], rows.s[c] = at.faces.s(c) + i;
    solve_faces(n, of_lo, of_hi, rows);
    for (std::int64_t k = 0; k < n; ++k) {
      std::array<Real, std::size_t(D)> states;
      for (std::size_t c = 0; c < D; ++c) states[c] = v[c][k];
      const auto of_face = row_vector<D>(states);
      const auto normal = normal_of(k);
      const Real over = at.metric.over_face[i + k];
      // A fluid slides along the face (F7).
      const auto seen_by = [&](const MaterialRows<Real>& material,
                               const CurvilinearFields<const Real>& fields) {
        if (!fluid || !(material.zp[i + k] > 0) || material.zs[i + k] > 0) return of_face;
        const auto own = sign * row_velocity<D>(fields.first + i + k, fields.pitch);
        return own + (over * over * dot(normal, of_face - own)) * normal;
      };
      put<D>(seen_by(at.lo, at.fields_lo), at.faces.v(0) + i + k, 2 * at.faces.pitch);
      if (fluid) put<D>(seen_by(at.hi, at.fields_hi), at.seen_above + i + k, at.seen_pitch);
    }
  });
}

template <int D, class Real>
void AnisotropicCellsAcross<D, Real>::add_stress(std::int64_t line, const IndexRange& columns, Real size,
                                                 const CurvilinearUpdate<Real>& of) const {
  if (empty()) return;
  const auto axes = axes_of_pairs<D>(D - 1);
  Real strain[stresses][cells_at_once];
  const auto add = [&](const IndexRange& run) {
    const auto medium = list_[run.first].medium;
    const auto n = run.count(), i = list_[run.first].x - columns.first;
    for (std::int64_t k = 0; k < n; ++k) {
      const auto at = i + k;
      const Real moved = size * of.metric.over_j[at] * of.material.b[at];
      const auto normal =
          components<D>(cell_normal<D>(of.metric.half_n + at, of.metric.pitch, of.metric.stride));
      std::array<Real, std::size_t(D)> change;
      for (std::size_t c = 0; c < D; ++c)
        change[c] = moved * (of.hi.v(int(c))[at] - of.v_lo[std::int64_t(c) * of.v_lo_pitch + at]);
      for (std::size_t c = 0; c < D; ++c)
        for (std::size_t d = c; d < D; ++d)
          strain[Elasticity<D>::pair(axes[c], axes[d])][k] =
              c == d ? normal[c] * change[c] : normal[c] * change[d] + normal[d] * change[c];
    }
    for (int one = 0; one < D; ++one)
      for (int other = one; other < D; ++other) {
        using Rows = FieldRows<D>;
        const auto& by = media_[std::size_t(medium)][Elasticity<D>::pair(one, other)];
        Real* __restrict const stress = of.fields.first + i + Rows::stress(one, other) * of.fields.pitch;
        for (std::int64_t k = 0; k < n; ++k) {
          Real sum = by[0] * strain[0][k] + by[1] * strain[1][k] + by[2] * strain[2][k];
          if constexpr (D == 3) sum += by[3] * strain[3][k] + by[4] * strain[4][k] + by[5] * strain[5][k];
          stress[k] += sum;
        }
      }
  };
  list_.each_run(line, columns, add, true);
}

SLIPWAVE_INSTANTIATE_D_REAL(TYPE, class AnisotropicCellsAcross);

}  // namespace slipwave::solver
