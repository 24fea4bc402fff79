// SPDX-License-Identifier: BSD-3-Clause
#include "solver/sweep/anisotropic_cells.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/instantiate.hpp"
#include "solver/kernels/reconstruction.hpp"
#include "solver/sweep/matrix_faces.hpp"

namespace slipwave::solver {
std::int64_t CellList::end_of_run(std::int64_t begin, std::int64_t end) const {
  auto n = begin + 1;
  while (n < end && (*this)[n].x - (*this)[begin].x == n - begin) ++n;
  return n;
}

template <int D, class Real>
auto AnisotropicCells<D, Real>::of_axis(const AnisotropicMedium<D>& medium, int axis) -> OfAxis {
  const auto c = medium.elasticity.times(medium.rho);
  const auto axes = axes_of_pairs<D>(axis);
  const auto tensor = christoffel<D>(c, unit_vector<std::size_t(D)>(std::size_t(axis)));
  const auto waves = eigensystem_of(tensor);
  const auto impedance = in_pairs<D>(square_root_of(tensor), axis);
  OfAxis of{};
  for (std::size_t wave = 0; wave < D; ++wave) {
    of.waves[wave] = Real(std::sqrt(waves.values[wave]));
    const auto motion = in_pairs<D>(waves.vectors[wave], axis);
    for (std::size_t pair = 0; pair < D; ++pair) {
      of.waves[D + D * wave + pair] = Real(motion[pair]);
      if (pair >= wave) of.impedance[place_in<D>(wave, pair)] = Real(impedance[wave][pair]);
    }
  }
  const auto loops = medium.of_loops.times(medium.rho);
  std::size_t n = 0;
  const auto add = [&](int i, int j) {
    for (const int k : axes) of.missing[n++] = Real(c(i, j, k, axis) - loops(i, j, k, axis));
  };
  for (const int other : axes) add(other, other);
  for (std::size_t one = 0; one < D; ++one)
    for (std::size_t other = one + 1; other < D; ++other) add(axes[one], axes[other]);
  return of;
}

template <int D, class Real>
AnisotropicCells<D, Real>::AnisotropicCells(
    const Domain<D>& domain, int reach,
    const std::array<std::array<InterfaceStencils, std::size_t(D)>, std::size_t(D)>& stencils)
    : reach_(reach) {
  const auto& cells = domain.anisotropic_cells();
  if (cells.empty()) return;
  for (const auto& medium : domain.anisotropic_media())
    for (auto& of = media_.emplace_back(); auto& axis : of) axis = of_axis(medium, int(&axis - of.data()));
  const auto nx = domain.grid.shape[0];
  auto next = cells.begin();
  for (std::int64_t line = 0; line < domain.grid.size() / nx; ++line) {
    for (; next != cells.end() && next->cell < (line + 1) * nx; ++next)
      list_.cells.push_back({std::int32_t(next->cell - line * nx), next->medium});
    list_.end_line();
  }
  for (int axis = 0; axis < D; ++axis) add_endings(domain, axis, stencils[std::size_t(axis)]);
}

template <int D, class Real>
void AnisotropicCells<D, Real>::add_endings(const Domain<D>& domain, int axis,
                                            const std::array<InterfaceStencils, std::size_t(D)>& stencils) {
  const auto nx = domain.grid.shape[0];
  for (std::size_t n = 0; n < list_.cells.size(); ++n) {
    const auto line = domain.anisotropic_cells()[n].cell / nx;
    const auto x = list_.cells[n].x;
    Ending ending{std::int64_t(n), reach_, {}};
    bool ends = false;
    for (std::size_t pair = 0; pair < D; ++pair) {
      const auto* const found = stencils[pair].find(line, x);
      ends = ends || found;
      ending.stencils[pair] = found ? *found : whole_stencil<InterfaceStencil>(x, reach_, reach_);
      ending.reach = std::min(ending.reach, int(ending.stencils[pair].reach));
    }
    if (ends) endings_[std::size_t(axis)].push_back(ending);
  }
}

/// Writes the values of cells, one behind the other, into rows; where all are of one medium that they hold
/// already nothing is to be done.
template <int D, class Real>
template <std::size_t Count>
void AnisotropicCells<D, Real>::expand(std::int64_t first, std::int64_t count, int axis,
                                       const std::array<Real, Count> OfAxis::*values,
                                       RunOfValues<Count, Real>& to) const {
  const auto medium_of = [&](std::int64_t k) { return list_[first + k].medium; };
  const auto of_first = medium_of(0);
  std::int64_t alike = 1;
  while (alike < count && medium_of(alike) == of_first) ++alike;
  if (alike == count && to.of == of_first && to.filled >= count) return;
  const auto row_of = [&](std::int64_t k) -> const std::array<Real, Count>& {
    return media_[std::size_t(medium_of(k))][std::size_t(axis)].*values;
  };
  for (std::size_t n = 0; n < Count; ++n) std::fill(to.values[n], to.values[n] + alike, row_of(0)[n]);
  for (auto k = alike; k < count; ++k) {
    const auto& of = row_of(k);
    for (std::size_t n = 0; n < Count; ++n) to.values[n][k] = of[n];
  }
  to.of = of_first, to.filled = alike;
}

/// The motions of expanded waves.
template <int D, class Real>
static auto motions_of(const RunOfValues<std::size_t(D + D * D), Real>& waves) {
  return [&waves](std::size_t wave, std::size_t pair) { return waves.values[D + D * wave + pair]; };
}

/// In a level row (theory.md (T4)) components are reconstructed before they are turned, since reconstruction
/// is linear.
template <int D, class Real>
void AnisotropicCells<D, Real>::reconstruct_run(const IndexRange& run, std::int64_t at,
                                                const Row& row) const {
  const auto& [axis, kernels, stride, pairs, b, scale, outgoing, metric] = row;
  Real up[D][D][cells_at_once], down[D][D][cells_at_once];  // [wave][pair]
  Real sizes[D][cells_at_once];
  Waves of;
  for (auto first = run.first; first < run.last; first += cells_at_once) {
    const auto n = std::min(cells_at_once, run.last - first), to = at + first - run.first;
    expand(first, n, axis, &OfAxis::waves, of);
    for (std::size_t wave = 0; wave < D; ++wave)
      for (std::size_t p = 0; p < D; ++p)
        kernels.reconstruct(n, stride, pairs[p].v + to, pairs[p].s + to, of.values[wave], b + to, scale,
                            up[wave][p], down[wave][p]);
    const auto turn = [&](const Real(&waves)[D][D][cells_at_once], const auto& to_pair) {
      for (std::size_t wave = 0; wave < D; ++wave)
        weighted_sum<Real, D>(n, rows_from<D>(of.values + D + D * wave), rows_from<D>(waves[wave]),
                              sizes[wave]);
      put_components<D>(n, motions_of<D>(of), sizes, to_pair);
    };
    turn(up, [&](int p) { return row.outgoing.up(p) + to; });
    turn(down, [&](int p) { return row.outgoing.down(p) + to; });
  }
}

/// The faces of a curvilinear row have different sizes: each wave is one pair of numbers, as across the rows
/// (WavePair).
template <int D, class Real>
void AnisotropicCells<D, Real>::reconstruct_curvilinear_run(const IndexRange& run, std::int64_t at,
                                                            const Row& row) const {
  const auto& [axis, kernels, stride, pairs, b, scale, outgoing, of_row] = row;
  const auto& metric = *of_row;
  const Real sign = scale < 0 ? -1 : 1;
  WavesOfRun<D, Real> waves;
  Real mean[cells_at_once], turned[D][cells_at_once], traction[D][cells_at_once], sum[cells_at_once];
  Waves of;
  for (auto first = run.first; first < run.last; first += cells_at_once) {
    const auto n = std::min(cells_at_once, run.last - first), to = at + first - run.first;
    expand(first, n, axis, &OfAxis::waves, of);
    for (std::int64_t i = 0; i < n; ++i) {
      const Real lo = metric.half_lo[to + i], hi = metric.half_hi[to + i];
      mean[i] = lo + hi;
      for (std::size_t wave = 0; wave < D; ++wave) turned[wave][i] = sign * of.values[wave][i] * (lo - hi);
    }
    for (int k = -reach_; k <= reach_; ++k) {
      const Real* const half_j = metric.half_x + to + k * metric.stride;
      RowsOf<Real, D> velocities;
      for (std::size_t p = 0; p < D; ++p) {
        const Real* const stress = pairs[p].s + to + k * stride;
        for (std::int64_t i = 0; i < n; ++i) traction[p][i] = (half_j[i] + half_j[i + 1]) * stress[i];
        velocities[p] = pairs[p].v + to + k * stride;
      }
      for (std::size_t wave = 0; wave < D; ++wave) {
        const auto motion = rows_from<D>(of.values + D + D * wave);
        Real *const to_v = waves.pairs[wave][0][k + reach_], *const to_s = waves.pairs[wave][1][k + reach_];
        weighted_sum(n, motion, velocities, sum), weighted_sum(n, motion, rows_from<D>(traction), to_s);
        for (std::int64_t i = 0; i < n; ++i) to_v[i] = mean[i] * sum[i], to_s[i] += turned[wave][i] * sum[i];
      }
    }
    waves.reconstruct(
        n, reach_, kernels, [&](std::size_t wave) { return of.values[wave]; }, b + to, scale);
    put_components<D>(n, motions_of<D>(of), waves.up, [&](int p) { return row.outgoing.up(p) + to; });
    put_components<D>(n, motions_of<D>(of), waves.down, [&](int p) { return row.outgoing.down(p) + to; });
  }
}

template <int D, class Real>
template <int Order>
void AnisotropicCells<D, Real>::reconstruct_ending(const Ending& ending, std::int64_t at,
                                                   const Row& row) const {
  const auto& [axis, kernels, stride, pairs, b, scale, outgoing, metric] = row;
  constexpr int reach = reach_of(Order), count = 2 * reach + 1;
  const auto& of = media_[std::size_t(list_[ending.cell].medium)][std::size_t(axis)];
  MotionAt<Real> all[D][count];
  for (std::size_t p = 0; p < D; ++p)
    extended_pair<Real>(ending.stencils[p], reach,
                        {pairs[p].v + at, pairs[p].s + at, stride, pairs[p].corrections, scale,
                         metric ? metric->half_x + at : nullptr, metric ? metric->stride : 0},
                        all[p]);
  const Real sign = scale < 0 ? -1 : 1;
  const Real j_lo = metric ? 2 * metric->half_lo[at] : 1, j_hi = metric ? 2 * metric->half_hi[at] : 1;
  std::array<Real, std::size_t(D)> up{}, down{};
  for (std::size_t wave = 0; wave < D; ++wave) {
    const Real* const motion = of.waves.data() + D + D * wave;
    const Real z = of.waves[wave], courant = sign * scale * z * b[at];
    Real v_of[count] = {}, s_of[count] = {}, of_up = 0, of_down = 0, other = 0;
    for (int k = 0; k < count; ++k)
      for (std::size_t p = 0; p < D; ++p)
        v_of[k] += motion[p] * all[p][k].v, s_of[k] += motion[p] * all[p][k].t;
    reconstruct_cell<Order>(v_of + reach, s_of + reach, 1, sign * z * j_hi, courant, of_up, other);
    reconstruct_cell<Order>(v_of + reach, s_of + reach, 1, sign * z * j_lo, courant, other, of_down);
    for (std::size_t p = 0; p < D; ++p) up[p] += motion[p] * of_up, down[p] += motion[p] * of_down;
  }
  for (int p = 0; p < D; ++p)
    outgoing.up(p)[at] = up[std::size_t(p)], outgoing.down(p)[at] = down[std::size_t(p)];
}

template <int D, class Real>
void AnisotropicCells<D, Real>::reconstruct(std::int64_t line, const IndexRange& columns,
                                            const Row& row) const {
  if (empty()) return;
  const auto cells = list_.in(line, columns);
  if (cells.empty()) return;
  const auto& endings = endings_[std::size_t(row.axis)];
  auto ending = std::lower_bound(endings.begin(), endings.end(), cells.first,
                                 [](const Ending& one, std::int64_t cell) { return one.cell < cell; });
  for (auto n = cells.first; n < cells.last;) {
    const auto at = list_[n].x - columns.first;
    if (ending != endings.end() && ending->cell == n) {
      const auto as = [&]<std::size_t... N>(std::index_sequence<N...>) {
        ((ending->reach == reach_of(orders[N]) ? reconstruct_ending<orders[N]>(*ending, at, row) : void()),
         ...);
      };
      as(std::make_index_sequence<std::size_t(order_count)>());
      ++ending, ++n;
      continue;
    }
    const auto end =
        list_.end_of_run(n, ending != endings.end() ? std::min(ending->cell, cells.last) : cells.last);
    if (row.metric)
      reconstruct_curvilinear_run({n, end}, at, row);
    else
      reconstruct_run({n, end}, at, row);
    n = end;
  }
}

template <int D, class Real>
void AnisotropicCells<D, Real>::impedances_beside(int axis, std::int64_t line, const IndexRange& columns,
                                                  const MaterialRows<Real>& material, std::int64_t from,
                                                  RunOfImpedances<D, Real>& to) const {
  const auto cells = list_.in(line, columns);
  if (cells.count() == columns.count())
    return expand(cells.first, cells.count(), axis, &OfAxis::impedance, to);
  to.of = -1;
  for (auto& row : to.values) std::fill(row, row + columns.count(), Real(0));
  for (std::int64_t k = 0; k < columns.count(); ++k) {
    const auto i = from + k;
    const bool mirror = material.b[i] == 0 && material.zs[i] == 0;
    to.values[place_in<D>(0, 0)][k] = mirror ? Real(mirror_impedance) * material.zp[i] : material.zp[i];
    to.values[place_in<D>(1, 1)][k] = material.zs[i];
    if constexpr (D == 3) to.values[place_in<D>(2, 2)][k] = material.zs2[i];
  }
  for (auto n = cells.first; n < cells.last; ++n) {
    const auto& own = media_[std::size_t(list_[n].medium)][std::size_t(axis)].impedance;
    for (std::size_t m = 0; m < own.size(); ++m) to.values[m][list_[n].x - columns.first] = own[m];
  }
}

template <int D, class Real>
void AnisotropicCells<D, Real>::solve(const RowFaces<D, Real>& of, const MaterialRows<Real>& lo,
                                      const MaterialRows<Real>& hi, const Real* half_face) const {
  if (empty()) return;
  RunOfImpedances<D, Real> of_lo, of_hi;
  const auto shift = of.shift();
  each_run_of_faces(
      list_, of.lines[0], of.lines[1], shift, of.columns, cells_at_once, [&](const IndexRange& run) {
        const auto i = run.first - of.columns.first;
        impedances_beside(of.axis, of.lines[0], {run.first - shift, run.last - shift}, lo, i, of_lo);
        impedances_beside(of.axis, of.lines[1], run, hi, i, of_hi);
        FaceRows<D, Real> rows{};
        for (int p = 0; p < D; ++p) {
          rows.up[p] = of.below.up(p) + i, rows.down[p] = of.above.down(p) + i;
          rows.v[p] = of.states.v(p) + i, rows.s[p] = of.states.s(p) + i;
        }
        solve_faces(run.count(), of_lo, of_hi, rows);
        if (!half_face) return;
        // Impedances are J times as large as those that are kept: so are tractions, but not velocities.
        for (std::int64_t k = 0; k < run.count(); ++k) {
          const Real over = 1 / (half_face[i + k] + half_face[i + k]);
          for (int p = 0; p < D; ++p) rows.v[p][k] *= over;
        }
      });
}

template <int D, class Real>
void AnisotropicCells<D, Real>::add_stress(const RowPart<D, Real>& part, Real size, const Real* b,
                                           const RowFlux<Real>& flux, const SweptRows<Real>& rows,
                                           Real* shear) const {
  if (empty()) return;
  std::array<Real*, stresses> all;
  if constexpr (D == 2)
    all = {rows.s, rows.passive, rows.st};
  else
    all = {rows.s, rows.passive, rows.passive2, rows.st, rows.st2, shear};
  RunOfValues<stresses * D, Real> of;
  Real change[D][cells_at_once], sum[cells_at_once];
  list_.each_run(part.line, part.columns, [&](const IndexRange& run) {
    const auto i = list_[run.first].x - part.columns.first, n = run.count();
    expand(run.first, n, part.axis, &OfAxis::missing, of);
    for (int p = 0; p < D; ++p) {
      const Real *const from = flux.lo.v(p) + i, *const to = flux.hi.v(p) + i;
      for (std::int64_t k = 0; k < n; ++k) change[p][k] = size * b[i + k] * (to[k] - from[k]);
    }
    for (std::size_t m = 0; m < stresses; ++m) {
      weighted_sum<Real, D>(n, rows_from<D>(of.values + D * m), rows_from<D>(change), sum);
      Real* const stress = all[m] + i;
      for (std::int64_t k = 0; k < n; ++k) stress[k] += sum[k];
    }
  });
}

SLIPWAVE_INSTANTIATE_D_REAL(TYPE, class AnisotropicCells);

}  // namespace slipwave::solver
