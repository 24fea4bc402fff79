// SPDX-License-Identifier: BSD-3-Clause
#include "solver/sweep/bent_tilted_cells_in_space.hpp"

#include <algorithm>
#include <cmath>

#include "parallel/threads.hpp"
#include "solver/sweep/faces_in_space.hpp"

namespace slipwave::solver {
namespace {

constexpr int most_places = 2 * max_reach + 1;

/// Voigt's pairs above the diagonal, row by row.
template <class What>
void each_stiffness(const What& what) {
  std::size_t n = 0;
  for (std::size_t i = 0; i < 6; ++i)
    for (std::size_t j = i; j < 6; ++j) what(n++, i, j);
}

/// Adds to n values the sum of components by their weights.
template <class Real>
void combine(std::int64_t n, const Real* const* __restrict at, const Real (*__restrict weights)[64],
             Real* __restrict sum) {
  const Real *const a = at[0], *const b = at[1], *const c = at[2], *const d = at[3], *const e = at[4],
                    *const f = at[5];
  for (std::int64_t i = 0; i < n; ++i)
    sum[i] = weights[0][i] * a[i] + weights[1][i] * b[i] + weights[2][i] * c[i] + weights[3][i] * d[i] +
             weights[4][i] * e[i] + weights[5][i] * f[i];
}

}  // namespace

template <class Real>
BentTiltedCellsInSpace<Real>::BentTiltedCellsInSpace(const Domain<3>& domain, const Metric<3, Real>& metric,
                                                     int reach)
    : reach_(reach) {
  if (!metric.any_bent() || domain.tilted().empty()) return;
  const auto& shape = domain.grid.shape;
  const std::int64_t lines = shape[1] * shape[2];
  const auto bent = [&](std::int64_t row) { return row >= 0 && row < shape[2] && domain.bent(row); };
  first_.assign(1, 0);
  for (std::int64_t line = 0; line < lines; ++line) {
    auto at = domain.grid.index(line * shape[0]);
    const bool own = bent(at[2]), beside = bent(at[2] - 1) || bent(at[2] + 1);
    for (; (own || beside) && at[0] < shape[0]; ++at[0]) {
      if (const auto* const tilted = domain.tilted_at(at))
        cells_.push_back({std::int32_t(at[0]), tilted->medium});
      else if (!own && anisotropic_across_rows(domain, at))
        cells_.push_back({std::int32_t(at[0]), -1});
    }
    first_.push_back(std::int64_t(cells_.size()));
  }
  if (empty()) return;
  for (const auto& medium : domain.tilted_media()) {
    Medium of{};
    const auto& c = medium.stiffness.voigt;
    const double p = c[2][2], mu = c[4][4];
    each_stiffness([&](std::size_t n, std::size_t i, std::size_t j) {
      const double taken = j < 3 ? (i == j ? p : p - 2 * mu) : i == j ? mu : 0;
      of.more[n] = Real(medium.rho * (c[i][j] - taken));
    });
    media_.push_back(of);
  }
  values_ = Buffer<Real>(std::int64_t(cells_.size() * values));
  parallel_for(lines, 16, [&](std::int64_t begin, std::int64_t end, int) {
    for (auto line = begin; line < end; ++line) fill(domain, metric, line);
  });
}

template <class Real>
void BentTiltedCellsInSpace<Real>::fill(const Domain<3>& domain, const Metric<3, Real>& metric,
                                        std::int64_t line) {
  const auto from = first_[std::size_t(line)], to = first_[std::size_t(line) + 1], pitch = to - from;
  auto at = domain.grid.index(line * domain.grid.shape[0]);
  const auto first_of_line = at;
  for (auto n = from; n < to; ++n) {
    at[0] = cells_[std::size_t(n)].x;
    const auto waves = waves_across_rows(space_stiffness_at(domain, at), metric.across(first_of_line, at[0]));
    Real* value = values_.data() + from * std::int64_t(values) + (n - from);
    const auto put = [&](double of) { *value = Real(of), value += pitch; };
    for (const auto& face : waves.faces) {
      for (const double z : face.z) put(z);
      for (const auto& motion : face.motions)
        for (const double part : motion) put(part);
    }
    for (const double z : waves.courant_z) put(z);
  }
}

template <class Real>
IndexRange BentTiltedCellsInSpace<Real>::cells_of(std::int64_t line, const IndexRange& columns) const {
  const auto begin = cells_.begin(), first = begin + first_[std::size_t(line)],
             last = begin + first_[std::size_t(line) + 1];
  const auto before = [](const Cell& one, std::int64_t x) { return one.x < x; };
  return {std::lower_bound(first, last, columns.first, before) - begin,
          std::lower_bound(first, last, columns.last, before) - begin};
}

template <class Real>
std::int64_t BentTiltedCellsInSpace<Real>::end_of_run(std::int64_t first, std::int64_t last) const {
  auto n = first + 1;
  while (n < last && cells_[std::size_t(n)].x - cells_[std::size_t(first)].x == n - first) ++n;
  return n;
}

template <class Real>
auto BentTiltedCellsInSpace<Real>::rows_of(std::int64_t line, std::int64_t cell) const -> Rows {
  const auto from = first_[std::size_t(line)], pitch = first_[std::size_t(line) + 1] - from;
  return {values_.data() + from * std::int64_t(values) + (cell - from), pitch};
}

/// Of velocities and tractions in the pairs of the waves of n cells.
template <class Real>
void BentTiltedCellsInSpace<Real>::find_weights(const Rows& rows, std::int64_t n, Real sign,
                                                Weights (&weights)[3]) {
  for (std::size_t wave = 0; wave < 3; ++wave) {
    const std::size_t motions = 3 + 3 * wave;
    for (std::int64_t i = 0; i < n; ++i) {
      const Real before[] = {rows[motions][i], rows[motions + 1][i], rows[motions + 2][i]};
      const Real behind[] = {rows[of_face + motions][i], rows[of_face + motions + 1][i],
                             rows[of_face + motions + 2][i]};
      const auto pair = wave_pair_in_space<Real>(before, rows[wave][i], behind, rows[of_face + wave][i],
                                                 rows[2 * of_face + wave][i], sign);
      for (std::size_t c = 0; c < components; ++c)
        weights[wave].of[0][c][i] = pair.v[c], weights[wave].of[1][c][i] = pair.s[c];
    }
  }
}

template <class Real>
void BentTiltedCellsInSpace<Real>::reconstruct_across(std::int64_t line, const IndexRange& columns,
                                                      const Kernels<Real>& kernels,
                                                      const BentFields<const Real>& fields,
                                                      const BentAcross<Real>& metric, const Real* b,
                                                      Real scale, OutgoingWaves<Real> outgoing) const {
  if (empty()) return;
  const Real sign = scale < 0 ? -1 : 1;
  const auto cells = cells_of(line, columns);
  Weights weights[3];
  Real motion[components][at_once];
  Real pairs[3][2][most_places][at_once];
  for (auto first = cells.first; first < cells.last;) {
    const auto last = std::min(end_of_run(first, cells.last), first + at_once);
    const auto n = last - first, to = cells_[std::size_t(first)].x - columns.first;
    const auto rows = rows_of(line, first);
    find_weights(rows, n, sign, weights);
    for (int k = -reach_; k <= reach_; ++k) {
      const Real* const field = fields.first + to + k * fields.stride;
      const Real* const half_n = metric.half_n + to + k * metric.stride;
      for (std::int64_t i = 0; i < n; ++i) {
        const auto v = row_velocity<3>(field + i, fields.pitch);
        const auto t =
            row_traction<3>(field + i, fields.pitch, cell_normal<3>(half_n + i, metric.pitch, metric.stride));
        motion[0][i] = v.z, motion[1][i] = v.x, motion[2][i] = v.y;
        motion[3][i] = t.z, motion[4][i] = t.x, motion[5][i] = t.y;
      }
      const Real* const at[] = {motion[0], motion[1], motion[2], motion[3], motion[4], motion[5]};
      for (std::size_t wave = 0; wave < 3; ++wave)
        for (const std::size_t of : {0, 1}) combine(n, at, weights[wave].of[of], pairs[wave][of][k + reach_]);
    }
    Real up[3][at_once], down[3][at_once];
    for (std::size_t wave = 0; wave < 3; ++wave)
      kernels.reconstruct(n, at_once, pairs[wave][0][reach_], pairs[wave][1][reach_],
                          rows[2 * of_face + wave], b + to, scale, up[wave], down[wave]);
    for (int c = 0; c < 3; ++c) {
      const auto sum = [&](const Real(&waves)[3][at_once], std::size_t side, Real* __restrict result) {
        const auto of = [&](std::size_t wave) {
          return rows[side * of_face + 3 + 3 * wave + std::size_t(c)];
        };
        const Real* __restrict const one = of(0);
        const Real* __restrict const two = of(1);
        const Real* __restrict const three = of(2);
        for (std::int64_t i = 0; i < n; ++i)
          result[i] = one[i] * waves[0][i] + two[i] * waves[1][i] + three[i] * waves[2][i];
      };
      sum(up, 1, outgoing.up(c) + to), sum(down, 0, outgoing.down(c) + to);
    }
    first = last;
  }
}

template <class Real>
void BentTiltedCellsInSpace<Real>::impedances_beside(std::int64_t line, std::size_t side,
                                                     const IndexRange& columns,
                                                     const MaterialRows<Real>& material,
                                                     const BentAcross<Real>& metric, std::int64_t from,
                                                     const Impedances& other, Impedances& to) const {
  const auto cells = line < 0 ? IndexRange{} : cells_of(line, columns);
  if (cells.count() < columns.count())
    for (std::int64_t k = 0; k < columns.count(); ++k) {
      const auto i = from + k;
      const Real zp = material.zp[i], zs = material.zs[i];
      // Beyond the grid there is what the law of the edge says: as much as before it, or nothing.
      if (line < 0 && zs > 0) {
        for (std::size_t m = 0; m < symmetric; ++m) to[m][std::size_t(k)] = other[m][std::size_t(k)];
        continue;
      }
      const bool mirror = line < 0 && zp > 0;
      const auto normal = face_normal<3>(metric.half_n + i, metric.pitch);
      const Real over = metric.over_face[i], p = mirror ? Real(mirror_impedance) * zp : zp,
                 share = over * (p - zs), own = zs / over;
      const Real parts[] = {normal.z, normal.x, normal.y};
      std::size_t m = 0;
      for (std::size_t c = 0; c < 3; ++c)
        for (std::size_t d = c; d < 3; ++d)
          to[m++][std::size_t(k)] = share * parts[c] * parts[d] + (c == d ? own : Real(0));
    }
  for (auto first = cells.first; first < cells.last;) {
    const auto last = end_of_run(first, cells.last), n = last - first,
               k = cells_[std::size_t(first)].x - columns.first;
    // The face behind a cell that stands before it.
    const auto all = rows_of(line, first);
    const Rows rows{all.first + std::int64_t(side == 0 ? of_face : 0) * all.pitch, all.pitch};
    std::size_t m = 0;
    for (std::size_t c = 0; c < 3; ++c)
      for (std::size_t d = c; d < 3; ++d, ++m)
        for (std::int64_t i = 0; i < n; ++i) {
          Real sum = 0;
          for (std::size_t wave = 0; wave < 3; ++wave)
            sum += rows[wave][i] * rows[3 + 3 * wave + c][i] * rows[3 + 3 * wave + d][i];
          to[m][std::size_t(k + i)] = sum;
        }
    first = last;
  }
}

template <class Real>
void BentTiltedCellsInSpace<Real>::solve_across(std::int64_t lo, std::int64_t hi, const IndexRange& columns,
                                                const BentSolve<Real>& at, Real sign, bool fluid) const {
  if (empty()) return;
  const auto found = [&](std::int64_t line) { return line < 0 ? IndexRange{} : cells_of(line, columns); };
  auto before = found(lo), behind = found(hi);
  const auto face = [&](const IndexRange& cells) {
    return cells.empty() ? columns.last : std::int64_t(cells_[std::size_t(cells.first)].x);
  };
  const auto next_face = [&] { return std::min(face(before), face(behind)); };
  Impedances of_lo, of_hi;
  Real v[3][at_once], t[3][at_once];
  for (auto x = next_face(); x < columns.last; x = next_face()) {
    IndexRange run{x, x};
    while (run.count() < at_once && next_face() == run.last && run.last < columns.last) {
      if (face(before) == run.last) ++before.first;
      if (face(behind) == run.last) ++behind.first;
      ++run.last;
    }
    const auto i = x - columns.first, n = run.count();
    if (lo < 0) {
      impedances_beside(hi, 1, run, at.hi, at.metric, i, of_lo, of_hi);
      impedances_beside(lo, 0, run, at.lo, at.metric, i, of_hi, of_lo);
    } else {
      impedances_beside(lo, 0, run, at.lo, at.metric, i, of_hi, of_lo);
      impedances_beside(hi, 1, run, at.hi, at.metric, i, of_lo, of_hi);
    }
    FaceRows<Real> rows{};
    for (std::size_t m = 0; m < symmetric; ++m) rows.lo[m] = of_lo[m].data(), rows.hi[m] = of_hi[m].data();
    for (int c = 0; c < 3; ++c) {
      rows.up[c] = at.below.up(c) + i, rows.down[c] = at.above.down(c) + i;
      rows.v[c] = v[c], rows.s[c] = t[c];
    }
    solve_faces(n, rows);
    for (int c = 0; c < 3; ++c) std::copy(t[c], t[c] + n, at.faces.s(c) + i);
    const auto put = [&](std::int64_t k, RowVector<3, Real> velocity, Real* to, std::int64_t pitch) {
      to[k] = velocity.z, to[k + pitch] = velocity.x, to[k + 2 * pitch] = velocity.y;
    };
    for (std::int64_t k = 0; k < n; ++k) {
      const RowVector<3, Real> of_face{v[0][k], v[1][k], v[2][k]};
      if (!fluid) {
        put(k, of_face, at.faces.v(0) + i, 2 * at.faces.pitch);
        continue;
      }
      // A fluid slides along the face (F7).
      const auto normal = face_normal<3>(at.metric.half_n + i + k, at.metric.pitch);
      const Real over = at.metric.over_face[i + k];
      const auto seen_by = [&](const MaterialRows<Real>& material, const BentFields<const Real>& fields) {
        if (!(material.zp[i + k] > 0) || material.zs[i + k] > 0) return of_face;
        const auto own = sign * row_velocity<3>(fields.first + i + k, fields.pitch);
        return own + (over * over * dot(normal, of_face - own)) * normal;
      };
      put(k, seen_by(at.lo, at.fields_lo), at.faces.v(0) + i, 2 * at.faces.pitch);
      put(k, seen_by(at.hi, at.fields_hi), at.seen_above + i, at.seen_pitch);
    }
  }
}

template <class Real>
void BentTiltedCellsInSpace<Real>::add_stress_across(std::int64_t line, const IndexRange& columns, Real size,
                                                     const BentUpdate<Real>& of) const {
  if (empty()) return;
  const auto cells = cells_of(line, columns);
  const auto pitch = of.fields.pitch;
  // Rows of stresses by Voigt's pairs: xx, yy, zz, yz, xz, xy.
  constexpr std::array<int, 6> row_of = {3, 4, 5, 8, 7, 6};
  Real strain[6][at_once];
  for (auto first = cells.first; first < cells.last;) {
    // Of one medium.
    const auto medium = cells_[std::size_t(first)].medium;
    auto last = first + 1;
    const auto stop = std::min(end_of_run(first, cells.last), first + at_once);
    while (last < stop && cells_[std::size_t(last)].medium == medium) ++last;
    const auto n = last - first, i = cells_[std::size_t(first)].x - columns.first;
    for (std::int64_t k = 0; k < n; ++k) {
      const auto at = i + k;
      const Real moved = size * of.metric.over_j[at] * of.material.b[at];
      const auto normal = cell_normal<3>(of.metric.half_n + at, of.metric.pitch, of.metric.stride);
      const Real dz = moved * (of.hi.v(0)[at] - of.v_lo[at]),
                 dx = moved * (of.hi.v(1)[at] - of.v_lo[of.v_lo_pitch + at]),
                 dy = moved * (of.hi.v(2)[at] - of.v_lo[2 * of.v_lo_pitch + at]);
      strain[0][k] = normal.x * dx, strain[1][k] = normal.y * dy, strain[2][k] = dz;
      strain[3][k] = normal.y * dz + dy, strain[4][k] = normal.x * dz + dx;
      strain[5][k] = normal.x * dy + normal.y * dx;
    }
    const auto& more = media_[std::size_t(medium)].more;
    std::array<std::array<Real, 6>, 6> c;
    each_stiffness(
        [&](std::size_t m, std::size_t one, std::size_t other) { c[one][other] = c[other][one] = more[m]; });
    for (std::size_t row = 0; row < 6; ++row) {
      Real* __restrict const stress = of.fields.first + i + row_of[row] * pitch;
      const auto& by = c[row];
      for (std::int64_t k = 0; k < n; ++k)
        stress[k] += by[0] * strain[0][k] + by[1] * strain[1][k] + by[2] * strain[2][k] +
                     by[3] * strain[3][k] + by[4] * strain[4][k] + by[5] * strain[5][k];
    }
    first = last;
  }
}

template <class Real>
std::int64_t BentTiltedCellsInSpace<Real>::memory_bytes() const {
  return std::int64_t(cells_.size() * sizeof(Cell) + first_.size() * sizeof(std::int64_t) +
                      media_.size() * sizeof(Medium)) +
         values_.size() * std::int64_t(sizeof(Real));
}

template class BentTiltedCellsInSpace<float>;
template class BentTiltedCellsInSpace<double>;

}  // namespace slipwave::solver
