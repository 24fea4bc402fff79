// SPDX-License-Identifier: BSD-3-Clause
#include "solver/sweep/tilted_cells.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "solver/kernels/reconstruction.hpp"

namespace slipwave::solver {
namespace {

/// Cells whose waves are reconstructed at once.
constexpr std::int64_t at_once = 64;

/// States of n faces from place i on, between cells of these impedances: Z of both sides times v* is the sum
/// of what comes in (theory.md (T5)).
template <class Real>
void solve_faces(std::int64_t n, const MatrixRows<Real>& lo, const MatrixRows<Real>& hi,
                 const OutgoingWaves<Real>& below, const OutgoingWaves<Real>& above,
                 const InterfaceStates<Real>& faces, std::int64_t i) {
  const Real* __restrict const lo_along = lo.along;
  const Real* __restrict const lo_mixed = lo.mixed;
  const Real* __restrict const lo_across = lo.across;
  const Real* __restrict const hi_along = hi.along;
  const Real* __restrict const hi_mixed = hi.mixed;
  const Real* __restrict const hi_across = hi.across;
  const Real* __restrict const up_p = below.up(0) + i;
  const Real* __restrict const up_s = below.up(1) + i;
  const Real* __restrict const down_p = above.down(0) + i;
  const Real* __restrict const down_s = above.down(1) + i;
  Real* __restrict const v_p = faces.v(0) + i;
  Real* __restrict const v_s = faces.v(1) + i;
  Real* __restrict const s_p = faces.s(0) + i;
  Real* __restrict const s_s = faces.s(1) + i;
  for (std::int64_t k = 0; k < n; ++k) {
    const Real a = lo_along[k] + hi_along[k], b = lo_mixed[k] + hi_mixed[k], c = lo_across[k] + hi_across[k];
    const Real p = up_p[k] + down_p[k], s = up_s[k] + down_s[k], share = 1 / (a * c - b * b);
    const Real p_of_face = (c * p - b * s) * share, s_of_face = (a * s - b * p) * share;
    v_p[k] = p_of_face, v_s[k] = s_of_face;
    s_p[k] = lo_along[k] * p_of_face + lo_mixed[k] * s_of_face - up_p[k];
    s_s[k] = lo_mixed[k] * p_of_face + lo_across[k] * s_of_face - up_s[k];
  }
}

/// Adds to n stresses what the differences of both velocities over a cell put on them.
template <class Real>
void add_share(std::int64_t n, Real size, const Real* __restrict of_p, const Real* __restrict of_s,
               const Real* __restrict lo_p, const Real* __restrict hi_p, const Real* __restrict lo_s,
               const Real* __restrict hi_s, Real* __restrict stress) {
  for (std::int64_t k = 0; k < n; ++k)
    stress[k] += of_p[k] * (size * (hi_p[k] - lo_p[k])) + of_s[k] * (size * (hi_s[k] - lo_s[k]));
}

}  // namespace

template <int D, class Real>
TiltedCells<D, Real>::TiltedCells(
    const State<D, Real>& state, const Domain<D>& domain, int reach,
    const std::array<std::array<InterfaceStencils, std::size_t(D)>, std::size_t(D)>& stencils) {
  if (domain.tilted().empty()) return;
  const auto& shape = domain.grid.shape;
  for (int axis = 0; axis < D; ++axis) {
    auto& of = of_axis_[std::size_t(axis)];
    of.first_cells.assign(std::size_t(shape[D - 1]) + 1, 0);
    for (const auto& tilted : domain.tilted()) {
      if (domain.bent(domain.grid.index(tilted.cell)[D - 1])) continue;
      add_cell(state, domain, axis, tilted, reach, stencils[std::size_t(axis)]);
      of.first_cells[std::size_t(domain.grid.index(tilted.cell)[D - 1]) + 1] = std::int64_t(of.x.size());
    }
    for (std::size_t row = 1; row < of.first_cells.size(); ++row)
      of.first_cells[row] = std::max(of.first_cells[row], of.first_cells[row - 1]);
    add_faces(axis, shape);
  }
}

template <int D, class Real>
void TiltedCells<D, Real>::add_cell(const State<D, Real>& state, const Domain<D>& domain, int axis,
                                    const TiltedMedium& tilted, int reach,
                                    const std::array<InterfaceStencils, std::size_t(D)>& stencils) {
  auto& of = of_axis_[std::size_t(axis)];
  const auto at = domain.grid.index(tilted.cell);
  const auto& c = tilted.stiffness;
  const double step = double(state.material.data()[state.material_layout.cell(at)]) * tilted.rho;  // dt/h
  const bool along_x = axis == 0;
  const double normal = along_x ? c.c11 : c.c33, mixed = along_x ? c.c15 : c.c35;
  const auto waves = waves_along(tilted, axis);
  // Of the cell as loops take it.
  const double zp = domain.impedance(wave_p, axis)(at), zs = domain.impedance(wave_s)(at);
  const double p = zp * zp / tilted.rho, mu = zs * zs / tilted.rho;
  const double coupling = domain.anisotropic() ? domain.coupling(at) / tilted.rho : p - 2 * mu;
  of.x.push_back(std::int32_t(at[0]));
  of.cosine.push_back(Real(waves.cosine)), of.sine.push_back(Real(waves.sine));
  for (const std::size_t wave : {0, 1}) of.z[wave].push_back(Real(waves.z[wave]));
  of.impedance.add(waves.along, waves.mixed, waves.across);
  of.more.add((normal - p) * step, mixed * step, (c.c55 - mu) * step);
  of.passive.push_back(Real((c.c13 - coupling) * step));
  of.passive_across.push_back(Real((along_x ? c.c35 : c.c15) * step));
  Ending ending{reach, {}, {}};
  bool ends = false;
  for (const Wave wave : {wave_p, wave_s}) {
    const auto* found = stencils[wave].find(at[D - 1], at[0]);
    ends = ends || found;
    ending.stencils[wave] = found ? *found : whole_stencil(of.x.back(), reach);
    ending.reach = std::min(ending.reach, int(ending.stencils[wave].reach));
    ending.courant[wave] = Real(waves.z[wave] / tilted.rho * step);
  }
  of.ending.push_back(ends ? std::int32_t(of.endings.size()) : none);
  if (ends) of.endings.push_back(ending);
}

/// Numbers of the cells of a row in these columns.
template <int D, class Real>
IndexRange TiltedCells<D, Real>::cells_of(const Axis& of, std::int64_t row, const IndexRange& columns) {
  const auto begin = of.x.begin(), first = begin + of.first_cells[std::size_t(row)],
             last = begin + of.first_cells[std::size_t(row) + 1];
  return {std::lower_bound(first, last, columns.first) - begin,
          std::lower_bound(first, last, columns.last) - begin};
}

/// Those on both sides of each cell.
template <int D, class Real>
void TiltedCells<D, Real>::add_faces(int axis, const Index<D>& shape) {
  auto& of = of_axis_[std::size_t(axis)];
  const auto number = [&](std::int64_t row, std::int64_t x) {
    if (row < 0 || row >= shape[D - 1]) return none;
    const auto found = cells_of(of, row, {x, x + 1});
    return found.empty() ? none : std::int32_t(found.first);
  };
  // Before a row there are faces of its cells and of those of the row before.
  const std::int64_t rows = axis == 0 ? shape[D - 1] : shape[D - 1] + 1;
  of.first_faces.assign(1, 0);
  for (std::int64_t row = 0; row < rows; ++row) {
    std::vector<std::int64_t> columns;
    for (const auto& [from, to] :
         {std::pair{row, std::int64_t(axis == 0)}, std::pair{row - (axis != 0), std::int64_t(0)}})
      if (from >= 0 && from < shape[D - 1])
        for (auto n = of.first_cells[std::size_t(from)]; n < of.first_cells[std::size_t(from) + 1]; ++n)
          columns.push_back(of.x[std::size_t(n)] + to);
    std::sort(columns.begin(), columns.end());
    columns.erase(std::unique(columns.begin(), columns.end()), columns.end());
    for (const auto x : columns)
      of.faces.push_back(
          {std::int32_t(x), axis == 0 ? number(row, x - 1) : number(row - 1, x), number(row, x)});
    of.first_faces.push_back(std::int64_t(of.faces.size()));
  }
}

template <int D, class Real>
bool TiltedCells<D, Real>::any(std::int64_t row, const IndexRange& columns) const {
  return !empty() && !cells_of(of_axis_[0], row, columns).empty();
}

/// Both waves of a run of cells whose stencils are whole, from v and s along their own directions of motion
/// (theory.md (T4)): reconstruction is linear, so components are reconstructed before they are turned. `at`
/// is the place of the first.
template <int D, class Real>
void TiltedCells<D, Real>::reconstruct_run(const Axis& of, const IndexRange& run,
                                           const Kernels<Real>& kernels, std::int64_t stride, std::int64_t at,
                                           const Pairs& pairs, const Real* b, Real scale,
                                           OutgoingWaves<Real> outgoing) const {
  Real up[2][2][at_once], down[2][2][at_once];  // [wave][pair]
  for (auto first = run.first; first < run.last; first += at_once) {
    const auto n = std::min(at_once, run.last - first), to = at + first - run.first;
    for (const std::size_t wave : {0, 1})
      for (const std::size_t p : {0, 1})
        kernels.reconstruct(n, stride, pairs[p].v + to, pairs[p].s + to, of.z[wave].data() + first, b + to,
                            scale, up[wave][p], down[wave][p]);
    const Real* const cosine = of.cosine.data() + first;
    const Real* const sine = of.sine.data() + first;
    const auto turn = [&](const Real(&waves)[2][2][at_once], Real* along, Real* across) {
      for (std::int64_t i = 0; i < n; ++i) {
        const Real fast = cosine[i] * waves[0][0][i] + sine[i] * waves[0][1][i],
                   slow = cosine[i] * waves[1][1][i] - sine[i] * waves[1][0][i];
        along[i] = cosine[i] * fast - sine[i] * slow;
        across[i] = sine[i] * fast + cosine[i] * slow;
      }
    };
    turn(up, outgoing.up(0) + to, outgoing.up(1) + to);
    turn(down, outgoing.down(0) + to, outgoing.down(1) + to);
  }
}

template <int D, class Real>
template <int Order>
void TiltedCells<D, Real>::reconstruct_ending(const Axis& of, std::size_t n, std::int64_t stride,
                                              std::int64_t at, const Pairs& pairs, Real scale,
                                              OutgoingWaves<Real> outgoing) const {
  constexpr int reach = reach_of(Order), count = 2 * reach + 1;
  const Ending& ending = of.endings[std::size_t(of.ending[n])];
  Real v[2][count], s[2][count];
  for (const std::size_t p : {0, 1})
    extended_pair(ending.stencils[p], reach, stride, pairs[p].v + at, pairs[p].s + at, pairs[p].corrections,
                  scale, v[p], s[p]);
  const Real sign = scale < 0 ? -1 : 1;
  Real up[2] = {0, 0}, down[2] = {0, 0};
  for (const std::size_t wave : {0, 1}) {
    const Real along = wave == 0 ? of.cosine[n] : -of.sine[n], across = wave == 0 ? of.sine[n] : of.cosine[n];
    Real v_of[count], s_of[count], of_up = 0, of_down = 0;
    for (int k = 0; k < count; ++k) {
      v_of[k] = along * v[0][k] + across * v[1][k];
      s_of[k] = along * s[0][k] + across * s[1][k];
    }
    reconstruct_cell<Order>(v_of + reach, s_of + reach, 1, sign * of.z[wave][n],
                            sign * scale * ending.courant[wave], of_up, of_down);
    up[0] += along * of_up, up[1] += across * of_up;
    down[0] += along * of_down, down[1] += across * of_down;
  }
  for (const int p : {0, 1}) outgoing.up(p)[at] = up[p], outgoing.down(p)[at] = down[p];
}

template <int D, class Real>
void TiltedCells<D, Real>::reconstruct(int axis, std::int64_t row, const IndexRange& columns,
                                       const Kernels<Real>& kernels, std::int64_t stride, const Pairs& pairs,
                                       const Real* b, Real scale, OutgoingWaves<Real> outgoing) const {
  if (empty()) return;
  const auto& of = of_axis_[std::size_t(axis)];
  const auto cells = cells_of(of, row, columns);
  for (auto n = cells.first; n < cells.last; ++n) {
    const auto at = of.x[std::size_t(n)] - columns.first;
    if (const auto ending = of.ending[std::size_t(n)]; ending != none) {
      const auto as = [&]<std::size_t... N>(std::index_sequence<N...>) {
        ((of.endings[std::size_t(ending)].reach == reach_of(orders[N])
              ? reconstruct_ending<orders[N]>(of, std::size_t(n), stride, at, pairs, scale, outgoing)
              : void()),
         ...);
      };
      as(std::make_index_sequence<std::size_t(order_count)>());
      continue;
    }
    const auto first = n;
    while (n + 1 < cells.last && of.x[std::size_t(n) + 1] == of.x[std::size_t(n)] + 1 &&
           of.ending[std::size_t(n) + 1] == none)
      ++n;
    reconstruct_run(of, {first, n + 1}, kernels, stride, at, pairs, b, scale, outgoing);
  }
}

template <int D, class Real>
void TiltedCells<D, Real>::solve(int axis, std::int64_t row, const IndexRange& columns,
                                 OutgoingWaves<Real> below, OutgoingWaves<Real> above,
                                 const MaterialRows<Real>& lo, const MaterialRows<Real>& hi,
                                 InterfaceStates<Real> faces) const {
  if (empty()) return;
  const auto& of = of_axis_[std::size_t(axis)];
  const auto begin = of.faces.begin() + of.first_faces[std::size_t(row)],
             end = of.faces.begin() + of.first_faces[std::size_t(row) + 1];
  auto face =
      std::lower_bound(begin, end, columns.first, [](const Face& one, std::int64_t x) { return one.x < x; });
  const auto inside = [](const Face& one) { return one.lo != none && one.hi != none; };
  while (face != end && face->x < columns.last) {
    const auto i = face->x - columns.first;
    if (!inside(*face)) {
      const auto impedance = [&](std::int32_t cell, const MaterialRows<Real>& material) {
        return cell == none ? Matrix{material.zp[i], 0, material.zs[i]} : of.impedance[cell];
      };
      const Matrix z = impedance(face->lo, lo), other = impedance(face->hi, hi);
      solve_faces<Real>(1, {&z.along, &z.mixed, &z.across}, {&other.along, &other.mixed, &other.across},
                        below, above, faces, i);
      ++face;
      continue;
    }
    const auto first = face++;
    while (face != end && face->x < columns.last && inside(*face) && face->x - first->x == face - first &&
           face->lo - first->lo == face - first && face->hi - first->hi == face - first)
      ++face;
    solve_faces<Real>(face - first, of.impedance.from(first->lo), of.impedance.from(first->hi), below, above,
                      faces, i);
  }
}

template <int D, class Real>
void TiltedCells<D, Real>::add_stress(int axis, std::int64_t row, const IndexRange& columns, Real size,
                                      InterfaceStates<Real> lo, InterfaceStates<Real> hi,
                                      const SweptRows<Real>& rows) const {
  if (empty()) return;
  const auto& of = of_axis_[std::size_t(axis)];
  const auto cells = cells_of(of, row, columns);
  for (auto n = cells.first; n < cells.last;) {
    const auto first = n++;
    const auto x = of.x[std::size_t(first)];
    while (n < cells.last && of.x[std::size_t(n)] - x == n - first) ++n;
    const auto i = x - columns.first;
    const Real* const lo_p = lo.v(0) + i;
    const Real* const lo_s = lo.v(1) + i;
    const Real* const hi_p = hi.v(0) + i;
    const Real* const hi_s = hi.v(1) + i;
    const auto add = [&](const Values& of_p, const Values& of_s, Real* stress) {
      add_share<Real>(n - first, size, of_p.data() + first, of_s.data() + first, lo_p, hi_p, lo_s, hi_s,
                      stress + i);
    };
    add(of.more.along, of.more.mixed, rows.s);
    add(of.more.mixed, of.more.across, rows.st);
    add(of.passive, of.passive_across, rows.passive);
  }
}

template <int D, class Real>
std::int64_t TiltedCells<D, Real>::memory_bytes() const {
  std::size_t bytes = 0;
  constexpr std::size_t values = 12;
  for (const auto& of : of_axis_)
    bytes += of.x.size() * (values * sizeof(Real) + 2 * sizeof(std::int32_t)) +
             of.endings.size() * sizeof(Ending) + of.faces.size() * sizeof(Face);
  return std::int64_t(bytes);
}

template class TiltedCells<2, float>;
template class TiltedCells<2, double>;

}  // namespace slipwave::solver
