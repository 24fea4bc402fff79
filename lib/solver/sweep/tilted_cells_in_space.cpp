// SPDX-License-Identifier: BSD-3-Clause
#include "solver/sweep/tilted_cells_in_space.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "solver/kernels/reconstruction.hpp"

namespace slipwave::solver {
namespace {

/// The axes of motion of the pairs of sweeps along an axis.
std::array<int, 3> axes_of_pairs(int axis) {
  return {axis, axis_of_pair<3>(axis, 1), axis_of_pair<3>(axis, 2)};
}

/// Adds to n stresses what two velocities over cells put on them.
template <class Real>
void add_share(std::int64_t n, const Real* __restrict of_one, const Real* __restrict one,
               const Real* __restrict of_other, const Real* __restrict other, Real* __restrict stress) {
  for (std::int64_t k = 0; k < n; ++k) stress[k] += of_one[k] * one[k] + of_other[k] * other[k];
}

/// J s of n cells of a bent row.
template <class Real>
void scale_by_height(std::int64_t n, const Real* __restrict half_j, const Real* __restrict stress,
                     Real* __restrict to) {
  for (std::int64_t i = 0; i < n; ++i) to[i] = (half_j[i] + half_j[i + 1]) * stress[i];
}

/// The pair of numbers of a wave with this motion, from velocities and tractions.
template <class Real>
void combine_pairs(std::int64_t n, const std::array<const Real*, 3>& motion,
                   const std::array<const Real*, 3>& velocities, const std::array<const Real*, 3>& tractions,
                   const Real* __restrict mean, const Real* __restrict turned, Real* __restrict v,
                   Real* __restrict s) {
  const Real* __restrict const q = motion[0];
  const Real* __restrict const r = motion[1];
  const Real* __restrict const t = motion[2];
  const Real* __restrict const v0 = velocities[0];
  const Real* __restrict const v1 = velocities[1];
  const Real* __restrict const v2 = velocities[2];
  const Real* __restrict const s0 = tractions[0];
  const Real* __restrict const s1 = tractions[1];
  const Real* __restrict const s2 = tractions[2];
  for (std::int64_t i = 0; i < n; ++i) {
    const Real own = q[i] * v0[i] + r[i] * v1[i] + t[i] * v2[i];
    v[i] = mean[i] * own;
    s[i] = turned[i] * own + (q[i] * s0[i] + r[i] * s1[i] + t[i] * s2[i]);
  }
}

}  // namespace

template <class Real>
auto TiltedCells<3, Real>::of_axis(const TiltedMediumInSpace& medium, int axis) -> OfAxis {
  const auto& c = medium.stiffness;
  const double rho = medium.rho;
  const auto axes = axes_of_pairs(axis);
  SpaceVector along{};
  along[std::size_t(axis)] = 1;
  const auto waves = waves_along(c, along);
  OfAxis of{};
  std::array<double, symmetric> impedance{};
  for (std::size_t wave = 0; wave < 3; ++wave) {
    const double z = std::sqrt(rho * waves.moduli[wave]);
    of.waves[wave] = Real(z);
    const auto motion = [&](std::size_t pair) { return waves.motions[wave][std::size_t(axes[pair])]; };
    std::size_t n = 0;
    for (std::size_t one = 0; one < 3; ++one) {
      of.waves[impedances + 3 * wave + one] = Real(motion(one));
      for (std::size_t other = one; other < 3; ++other) impedance[n++] += z * motion(one) * motion(other);
    }
  }
  for (std::size_t n = 0; n < symmetric; ++n) of.impedance[n] = Real(impedance[n]);
  const auto [a, p, q] = axes;
  // Of the stress i j by the velocity along k.
  const std::array<std::array<int, 3>, stresses> of_stress = {{{a, a, p},
                                                               {a, a, q},
                                                               {p, p, p},
                                                               {p, p, q},
                                                               {q, q, p},
                                                               {q, q, q},
                                                               {a, p, a},
                                                               {a, p, q},
                                                               {a, q, a},
                                                               {a, q, p},
                                                               {p, q, a},
                                                               {p, q, p},
                                                               {p, q, q}}};
  for (std::size_t n = 0; n < stresses; ++n)
    of.missing[n] = Real(rho * c(of_stress[n][0], of_stress[n][1], of_stress[n][2], a));
  // Loops of bent rows take it for isotropic rock with the speeds along z.
  const std::array<std::array<int, 2>, 6> all = {{{a, a}, {p, p}, {q, q}, {a, p}, {a, q}, {p, q}}};
  const double modulus = c.voigt[2][2], mu = c.voigt[4][4];
  std::size_t n = 0;
  for (const auto& [i, j] : all)
    for (const int k : {a, p, q}) {
      const double taken = i == j             ? (k != a   ? 0
                                                 : i == a ? modulus
                                                          : modulus - 2 * mu)
                           : i == a && j == k ? mu
                                              : 0;
      of.missing_in_bent[n++] = Real(rho * (c(i, j, k, a) - taken));
    }
  return of;
}

template <class Real>
TiltedCells<3, Real>::TiltedCells(const Domain<3>& domain, int reach,
                                  const std::array<std::array<InterfaceStencils, 3>, 3>& stencils)
    : reach_(reach) {
  if (domain.tilted().empty()) return;
  const auto nx = domain.grid.shape[0];
  for (const auto& medium : domain.tilted_media())
    media_.push_back({{of_axis(medium, 0), of_axis(medium, 1), of_axis(medium, 2)}});
  first_cells_.assign(std::size_t(domain.grid.size() / nx) + 1, 0);
  for (const auto& of : domain.tilted()) {
    cells_.push_back({std::int32_t(of.cell % nx), of.medium});
    first_cells_[std::size_t(of.cell / nx) + 1] = std::int64_t(cells_.size());
  }
  for (std::size_t row = 1; row < first_cells_.size(); ++row)
    first_cells_[row] = std::max(first_cells_[row], first_cells_[row - 1]);
  for (int axis = 0; axis < 3; ++axis) add_endings(domain, axis, reach, stencils[std::size_t(axis)]);
}

template <class Real>
void TiltedCells<3, Real>::add_endings(const Domain<3>& domain, int axis, int reach,
                                       const std::array<InterfaceStencils, 3>& stencils) {
  const auto nx = domain.grid.shape[0];
  for (std::size_t n = 0; n < cells_.size(); ++n) {
    const auto row = domain.tilted()[n].cell / nx;
    const auto x = cells_[n].x;
    Ending ending{std::int64_t(n), reach, {}};
    bool ends = false;
    for (std::size_t pair = 0; pair < 3; ++pair) {
      const auto* found = stencils[pair].find(row, x);
      ends = ends || found;
      ending.stencils[pair] = found ? *found : whole_stencil(x, reach);
      ending.reach = std::min(ending.reach, int(ending.stencils[pair].reach));
    }
    if (ends) endings_[std::size_t(axis)].push_back(ending);
  }
}

/// Numbers of the cells of a row in these columns.
template <class Real>
IndexRange TiltedCells<3, Real>::cells_of(std::int64_t row, const IndexRange& columns) const {
  const auto begin = cells_.begin(), first = begin + first_cells_[std::size_t(row)],
             last = begin + first_cells_[std::size_t(row) + 1];
  const auto before = [](const Cell& one, std::int64_t x) { return one.x < x; };
  return {std::lower_bound(first, last, columns.first, before) - begin,
          std::lower_bound(first, last, columns.last, before) - begin};
}

template <class Real>
bool TiltedCells<3, Real>::any(std::int64_t row, const IndexRange& columns) const {
  return !empty() && !cells_of(row, columns).empty();
}

template <class Real>
std::int64_t TiltedCells<3, Real>::end_of_run(std::int64_t first, std::int64_t last) const {
  auto n = first + 1;
  while (n < last && cells_[std::size_t(n)].x - cells_[std::size_t(first)].x == n - first) ++n;
  return n;
}

/// Writes the values of cells, one behind the other, into rows; where all are of one medium that they hold
/// already nothing is to be done.
template <class Real>
template <std::size_t Count>
void TiltedCells<3, Real>::expand(std::int64_t first, std::int64_t count, int axis,
                                  const std::array<Real, Count> OfAxis::*values, Expanded<Count>& to) const {
  const auto medium_of = [&](std::int64_t k) { return cells_[std::size_t(first + k)].medium; };
  const auto of_first = medium_of(0);
  std::int64_t alike = 1;
  while (alike < count && medium_of(alike) == of_first) ++alike;
  if (alike == count && to.of == of_first && to.filled >= count) return;
  const auto row_of = [&](std::int64_t k) -> const std::array<Real, Count>& {
    return media_[std::size_t(medium_of(k))].along[std::size_t(axis)].*values;
  };
  for (std::size_t n = 0; n < Count; ++n) std::fill(to.values[n], to.values[n] + alike, row_of(0)[n]);
  for (auto k = alike; k < count; ++k) {
    const auto& of = row_of(k);
    for (std::size_t n = 0; n < Count; ++n) to.values[n][k] = of[n];
  }
  to.of = of_first, to.filled = alike;
}

/// All waves of a run of cells whose stencils are whole (theory.md (T4)): reconstruction is linear, so
/// components are reconstructed before they are turned. `at` is the place of the first.
template <class Real>
void TiltedCells<3, Real>::reconstruct_run(int axis, const IndexRange& run, const Kernels<Real>& kernels,
                                           std::int64_t stride, std::int64_t at, const Pairs& pairs,
                                           const Real* b, Real scale, OutgoingWaves<Real> outgoing) const {
  Real up[3][3][at_once], down[3][3][at_once];  // [wave][pair]
  Expanded<impedances + motions> of;
  for (auto first = run.first; first < run.last; first += at_once) {
    const auto n = std::min(at_once, run.last - first), to = at + first - run.first;
    expand(first, n, axis, &OfAxis::waves, of);
    for (const std::size_t wave : {0, 1, 2})
      for (const std::size_t p : {0, 1, 2})
        kernels.reconstruct(n, stride, pairs[p].v + to, pairs[p].s + to, of.values[wave], b + to, scale,
                            up[wave][p], down[wave][p]);
    const auto turn = [&](const Real(&waves)[3][3][at_once], Real* __restrict one, Real* __restrict two,
                          Real* __restrict three) {
      for (std::int64_t i = 0; i < n; ++i) one[i] = two[i] = three[i] = 0;
      for (std::size_t wave = 0; wave < 3; ++wave) {
        const Real* const q = of.values[impedances + 3 * wave];
        const Real* const r = of.values[impedances + 3 * wave + 1];
        const Real* const t = of.values[impedances + 3 * wave + 2];
        for (std::int64_t i = 0; i < n; ++i) {
          const Real own = q[i] * waves[wave][0][i] + r[i] * waves[wave][1][i] + t[i] * waves[wave][2][i];
          one[i] += q[i] * own, two[i] += r[i] * own, three[i] += t[i] * own;
        }
      }
    };
    turn(up, outgoing.up(0) + to, outgoing.up(1) + to, outgoing.up(2) + to);
    turn(down, outgoing.down(0) + to, outgoing.down(1) + to, outgoing.down(2) + to);
  }
}

/// The same of a bent row, whose faces have different sizes: each wave is one pair of numbers, as across the
/// rows (WavePair).
template <class Real>
void TiltedCells<3, Real>::reconstruct_bent_run(int axis, const IndexRange& run, const Kernels<Real>& kernels,
                                                std::int64_t stride, std::int64_t at, const Pairs& pairs,
                                                const Real* b, Real scale, const BentAlong<Real>& metric,
                                                OutgoingWaves<Real> outgoing) const {
  const Real sign = scale < 0 ? -1 : 1;
  const int reach = reach_;
  Real v[3][2 * max_reach + 1][at_once], s[3][2 * max_reach + 1][at_once];  // [wave][place]
  Real mean[at_once], turned[3][at_once], tractions[3][at_once];
  Real up[3][at_once], down[3][at_once];
  Expanded<impedances + motions> of;
  for (auto first = run.first; first < run.last; first += at_once) {
    const auto n = std::min(at_once, run.last - first), to = at + first - run.first;
    expand(first, n, axis, &OfAxis::waves, of);
    for (std::int64_t i = 0; i < n; ++i) {
      const Real lo = metric.half_lo[to + i], hi = metric.half_hi[to + i];
      mean[i] = lo + hi;
      for (std::size_t wave = 0; wave < 3; ++wave) turned[wave][i] = sign * of.values[wave][i] * (lo - hi);
    }
    for (int k = -reach; k <= reach; ++k) {
      const Real* const half_j = metric.half_x + to + k * metric.stride;
      const auto field = [&](const Real* from) { return from + to + k * stride; };
      for (std::size_t pair = 0; pair < 3; ++pair)
        scale_by_height(n, half_j, field(pairs[pair].s), tractions[pair]);
      for (std::size_t wave = 0; wave < 3; ++wave) {
        const auto motion = [&](std::size_t pair) { return of.values[impedances + 3 * wave + pair]; };
        combine_pairs(n, {motion(0), motion(1), motion(2)},
                      {field(pairs[0].v), field(pairs[1].v), field(pairs[2].v)},
                      {tractions[0], tractions[1], tractions[2]}, mean, turned[wave], v[wave][k + reach],
                      s[wave][k + reach]);
      }
    }
    for (std::size_t wave = 0; wave < 3; ++wave)
      kernels.reconstruct(n, at_once, v[wave][reach], s[wave][reach], of.values[wave], b + to, scale,
                          up[wave], down[wave]);
    for (std::size_t pair = 0; pair < 3; ++pair) {
      const auto sum = [&](const Real(&waves)[3][at_once], Real* __restrict result) {
        const auto motion = [&](std::size_t wave) { return of.values[impedances + 3 * wave + pair]; };
        const Real* __restrict const one = motion(0);
        const Real* __restrict const two = motion(1);
        const Real* __restrict const three = motion(2);
        for (std::int64_t i = 0; i < n; ++i)
          result[i] = one[i] * waves[0][i] + two[i] * waves[1][i] + three[i] * waves[2][i];
      };
      sum(up, outgoing.up(int(pair)) + to), sum(down, outgoing.down(int(pair)) + to);
    }
  }
}

template <class Real>
template <int Order>
void TiltedCells<3, Real>::reconstruct_ending(int axis, const Ending& ending, std::int64_t stride,
                                              std::int64_t at, const Pairs& pairs, Real b, Real scale,
                                              const BentAlong<Real>* metric,
                                              OutgoingWaves<Real> outgoing) const {
  constexpr int reach = reach_of(Order), count = 2 * reach + 1;
  const auto& of = media_[std::size_t(cells_[std::size_t(ending.cell)].medium)].along[std::size_t(axis)];
  Real v[3][count], s[3][count];
  for (const std::size_t p : {0, 1, 2})
    extended_pair(ending.stencils[p], reach, stride, pairs[p].v + at, pairs[p].s + at, pairs[p].corrections,
                  scale, v[p], s[p], metric ? metric->half_x + at : nullptr, metric ? metric->stride : 0);
  const Real sign = scale < 0 ? -1 : 1;
  Real up[3] = {0, 0, 0}, down[3] = {0, 0, 0};
  for (std::size_t wave = 0; wave < 3; ++wave) {
    const Real* const motion = of.waves.data() + impedances + 3 * wave;
    const Real z = of.waves[wave];
    Real v_of[count], s_of[count], of_up = 0, of_down = 0;
    for (int k = 0; k < count; ++k) {
      v_of[k] = motion[0] * v[0][k] + motion[1] * v[1][k] + motion[2] * v[2][k];
      s_of[k] = motion[0] * s[0][k] + motion[1] * s[1][k] + motion[2] * s[2][k];
    }
    const Real courant = sign * scale * z * b;
    if (metric) {
      Real other = 0;
      reconstruct_cell<Order>(v_of + reach, s_of + reach, 1, sign * z * (2 * metric->half_hi[at]), courant,
                              of_up, other);
      reconstruct_cell<Order>(v_of + reach, s_of + reach, 1, sign * z * (2 * metric->half_lo[at]), courant,
                              other, of_down);
    } else {
      reconstruct_cell<Order>(v_of + reach, s_of + reach, 1, sign * z, courant, of_up, of_down);
    }
    for (const int p : {0, 1, 2}) up[p] += motion[p] * of_up, down[p] += motion[p] * of_down;
  }
  for (const int p : {0, 1, 2}) outgoing.up(p)[at] = up[p], outgoing.down(p)[at] = down[p];
}

template <class Real>
void TiltedCells<3, Real>::reconstruct(int axis, std::int64_t row, const IndexRange& columns,
                                       const Kernels<Real>& kernels, std::int64_t stride, const Pairs& pairs,
                                       const Real* b, Real scale, OutgoingWaves<Real> outgoing,
                                       const BentAlong<Real>* metric) const {
  if (empty()) return;
  const auto cells = cells_of(row, columns);
  if (cells.empty()) return;
  const auto& endings = endings_[std::size_t(axis)];
  auto ending = std::lower_bound(endings.begin(), endings.end(), cells.first,
                                 [](const Ending& one, std::int64_t cell) { return one.cell < cell; });
  for (auto n = cells.first; n < cells.last;) {
    const auto at = cells_[std::size_t(n)].x - columns.first;
    if (ending != endings.end() && ending->cell == n) {
      const auto as = [&]<std::size_t... N>(std::index_sequence<N...>) {
        ((ending->reach == reach_of(orders[N])
              ? reconstruct_ending<orders[N]>(axis, *ending, stride, at, pairs, b[at], scale, metric,
                                              outgoing)
              : void()),
         ...);
      };
      as(std::make_index_sequence<std::size_t(order_count)>());
      ++ending, ++n;
      continue;
    }
    const auto last = ending != endings.end() ? std::min(ending->cell, cells.last) : cells.last;
    const auto end = end_of_run(n, last);
    if (metric)
      reconstruct_bent_run(axis, {n, end}, kernels, stride, at, pairs, b, scale, *metric, outgoing);
    else
      reconstruct_run(axis, {n, end}, kernels, stride, at, pairs, b, scale, outgoing);
    n = end;
  }
}

template <class Real>
void TiltedCells<3, Real>::impedances_beside(int axis, std::int64_t row, const IndexRange& columns,
                                             const MaterialRows<Real>& material, std::int64_t from,
                                             Expanded<symmetric>& to) const {
  const auto cells = row == none ? IndexRange{} : cells_of(row, columns);
  if (cells.count() == columns.count())
    return expand(cells.first, cells.count(), axis, &OfAxis::impedance, to);
  to.of = -1;
  for (std::int64_t k = 0; k < columns.count(); ++k) {
    const auto i = from + k;
    for (const std::size_t mixed : {1, 2, 4}) to.values[mixed][k] = 0;
    const bool mirror = material.b[i] == 0 && material.zs[i] == 0;
    to.values[0][k] = mirror ? Real(mirror_impedance) * material.zp[i] : material.zp[i];
    to.values[3][k] = material.zs[i], to.values[5][k] = material.zs2[i];
  }
  for (auto n = cells.first; n < cells.last; ++n) {
    const auto& of = cells_[std::size_t(n)];
    const auto& own = media_[std::size_t(of.medium)].along[std::size_t(axis)].impedance;
    for (std::size_t k = 0; k < symmetric; ++k) to.values[k][of.x - columns.first] = own[k];
  }
}

template <class Real>
void TiltedCells<3, Real>::solve(int axis, const Sides& sides, const IndexRange& columns,
                                 OutgoingWaves<Real> below, OutgoingWaves<Real> above,
                                 const MaterialRows<Real>& lo, const MaterialRows<Real>& hi,
                                 InterfaceStates<Real> faces, const Real* half_face) const {
  if (empty()) return;
  const auto shifted = [&](const IndexRange& of) {
    return IndexRange{of.first - sides.shift, of.last - sides.shift};
  };
  const auto found = [&](std::int64_t row, const IndexRange& of) {
    return row == none ? IndexRange{} : cells_of(row, of);
  };
  auto before = found(sides.lo, shifted(columns)), behind = found(sides.hi, columns);
  const auto face = [&](const IndexRange& cells, std::int64_t shift) {
    return cells.empty() ? columns.last : cells_[std::size_t(cells.first)].x + shift;
  };
  const auto next_face = [&] { return std::min(face(before, sides.shift), face(behind, 0)); };
  Expanded<symmetric> of_lo, of_hi;
  for (auto x = next_face(); x < columns.last; x = next_face()) {
    // Faces that follow each other beside one such cell at least.
    IndexRange run{x, x};
    while (run.count() < at_once && next_face() == run.last && run.last < columns.last) {
      if (face(before, sides.shift) == run.last) ++before.first;
      if (face(behind, 0) == run.last) ++behind.first;
      ++run.last;
    }
    const auto i = x - columns.first;
    impedances_beside(axis, sides.lo, shifted(run), lo, i, of_lo);
    impedances_beside(axis, sides.hi, run, hi, i, of_hi);
    FaceRows<Real> rows{};
    for (std::size_t n = 0; n < symmetric; ++n) rows.lo[n] = of_lo.values[n], rows.hi[n] = of_hi.values[n];
    for (const int p : {0, 1, 2}) {
      rows.up[p] = below.up(p) + i, rows.down[p] = above.down(p) + i;
      rows.v[p] = faces.v(p) + i, rows.s[p] = faces.s(p) + i;
    }
    solve_faces(run.count(), rows);
    if (!half_face) continue;
    // Impedances are J times as large as those that are kept: so are tractions, but not velocities.
    for (std::int64_t k = 0; k < run.count(); ++k) {
      const Real over = 1 / (half_face[i + k] + half_face[i + k]);
      for (const int p : {0, 1, 2}) rows.v[p][k] *= over;
    }
  }
}

template <class Real>
void TiltedCells<3, Real>::add_stress(int axis, std::int64_t row, const IndexRange& columns, Real size,
                                      const Real* b, InterfaceStates<Real> lo, InterfaceStates<Real> hi,
                                      const SweptRows<Real>& rows, Real* shear) const {
  if (empty()) return;
  const auto cells = cells_of(row, columns);
  Expanded<stresses> of;
  for (auto first = cells.first; first < cells.last;) {
    const auto end = std::min(end_of_run(first, cells.last), first + at_once), n = end - first;
    const auto i = cells_[std::size_t(first)].x - columns.first;
    expand(first, n, axis, &OfAxis::missing, of);
    Real over[3][at_once];
    for (const int p : {0, 1, 2}) {
      const Real* const from = lo.v(p) + i;
      const Real* const to = hi.v(p) + i;
      for (std::int64_t k = 0; k < n; ++k) over[p][k] = size * b[i + k] * (to[k] - from[k]);
    }
    const auto add = [&](std::size_t first_of, std::size_t one, std::size_t other, Real* stress) {
      add_share(n, of.values[first_of], over[one], of.values[first_of + 1], over[other], stress + i);
    };
    add(0, 1, 2, rows.s), add(2, 1, 2, rows.passive), add(4, 1, 2, rows.passive2);
    add(6, 0, 2, rows.st), add(8, 0, 1, rows.st2), add(10, 0, 1, shear);
    for (std::int64_t k = 0; k < n; ++k) shear[i + k] += of.values[12][k] * over[2][k];
    first = end;
  }
}

template <class Real>
void TiltedCells<3, Real>::add_bent_stress(int axis, std::int64_t row, const IndexRange& columns, Real size,
                                           const Real* b, InterfaceStates<Real> lo, InterfaceStates<Real> hi,
                                           const SweptRows<Real>& rows, Real* shear) const {
  if (empty()) return;
  const auto cells = cells_of(row, columns);
  Expanded<bent_stresses> of;
  for (auto first = cells.first; first < cells.last;) {
    const auto end = std::min(end_of_run(first, cells.last), first + at_once), n = end - first;
    const auto i = cells_[std::size_t(first)].x - columns.first;
    expand(first, n, axis, &OfAxis::missing_in_bent, of);
    Real over[3][at_once];
    for (const int p : {0, 1, 2}) {
      const Real* const from = lo.v(p) + i;
      const Real* const to = hi.v(p) + i;
      for (std::int64_t k = 0; k < n; ++k) over[p][k] = size * b[i + k] * (to[k] - from[k]);
    }
    std::size_t next = 0;
    for (Real* const stress : {rows.s, rows.passive, rows.passive2, rows.st, rows.st2, shear}) {
      const Real* __restrict const one = of.values[next];
      const Real* __restrict const two = of.values[next + 1];
      const Real* __restrict const three = of.values[next + 2];
      Real* __restrict const sum = stress + i;
      for (std::int64_t k = 0; k < n; ++k)
        sum[k] += one[k] * over[0][k] + two[k] * over[1][k] + three[k] * over[2][k];
      next += 3;
    }
    first = end;
  }
}

template <class Real>
std::int64_t TiltedCells<3, Real>::memory_bytes() const {
  std::size_t bytes = cells_.size() * sizeof(Cell) + first_cells_.size() * sizeof(std::int64_t) +
                      media_.size() * sizeof(Medium);
  for (const auto& endings : endings_) bytes += endings.size() * sizeof(Ending);
  return std::int64_t(bytes);
}

template class TiltedCells<3, float>;
template class TiltedCells<3, double>;

}  // namespace slipwave::solver
