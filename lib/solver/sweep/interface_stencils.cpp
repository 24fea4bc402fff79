// SPDX-License-Identifier: BSD-3-Clause
#include "solver/sweep/interface_stencils.hpp"

#include <algorithm>

#include "solver/sweep/stencils.hpp"

namespace slipwave::solver {
namespace {

/// Marks the cells of a line that may need more than the bulk kernel: where the impedance changes
/// strongly within `reach` cells along the axis, and at the ends of the axis. Vectorised: most cells need
/// none.
template <int D>
void mark(const Field<D>& impedance, std::int64_t line, int axis, int reach,
          std::vector<std::int32_t>& marks) {
  const auto& shape = impedance.grid().shape;
  const std::int64_t nx = shape[0], first = line * nx;
  const auto at = impedance.grid().index(first);
  std::int64_t stride = 1;
  for (std::size_t a = 0; a < std::size_t(axis); ++a) stride *= shape[a];
  const float* const z = impedance.data() + first;
  // Less than any ratio that counts, whatever the rounding.
  constexpr auto plain_ratio = float(contrast_ratio * 0.99);
  const auto compare = [&](std::int64_t begin, std::int64_t end, std::int64_t one, std::int64_t other) {
    for (auto x = begin; x < end; ++x) {
      const float a = z[x + one * stride], b = z[x + other * stride];
      marks[std::size_t(x)] |= std::int32_t(a > plain_ratio * b) | std::int32_t(b > plain_ratio * a);
    }
  };
  const auto place = at[std::size_t(axis)], count = shape[std::size_t(axis)];
  const bool near_ends = axis != 0 && (place < reach || place + reach >= count);
  std::fill(marks.begin(), marks.end(), near_ends);
  if (near_ends) return;
  const std::int64_t beside = axis == 0 ? std::min<std::int64_t>(reach, nx) : 0;
  std::fill(marks.begin(), marks.begin() + beside, 1);
  std::fill(marks.end() - beside, marks.end(), 1);
  for (std::int64_t n = 1; n <= reach; ++n) {
    compare(beside, nx - beside, n - 1, n);
    compare(beside, nx - beside, 1 - n, -n);
  }
}

/// The same of these cells, ascending, in the line that begins with cell `first`.
void mark_these(const std::vector<std::int64_t>& cells, std::int64_t first,
                std::vector<std::int32_t>& marks) {
  const auto last = first + std::int64_t(marks.size());
  for (auto cell = std::lower_bound(cells.begin(), cells.end(), first); cell != cells.end() && *cell < last;
       ++cell)
    marks[std::size_t(*cell - first)] = 1;
}

/// A pair as extended() reads it.
template <class Real>
struct ExtendedPair {
  using At = MotionAt<Real>;
  static constexpr bool splits = true;
  PairOfLine<Real> of;

  At at(std::int64_t offset) const {
    const Real v = of.v[offset * of.stride], s = of.s[offset * of.stride];
    if (!of.half_j) return {v, s};
    return {v, (of.half_j[offset * of.j_stride] + of.half_j[offset * of.j_stride + 1]) * s};
  }
  template <class Side>
  void mirror(const Side& side, const Ghost&, At& at) const {
    if (side.law() == Extension::traction_free)
      at.t = -at.t;
    else
      at.v = -at.v;
  }
  template <class Side>
  void weld(const Side& side, const Ghost& ghost, At& at) const {
    const At across = this->at(ghost.across);
    const Real twice = 2 * Real(side.weld);
    at.v += twice * (across.v - at.v);
    at.t += (2 - twice) * (across.t - at.t);
  }
  /// Adds what (E11) and (E11a) correct.
  template <class Side>
  void correct(const Side& side, const Ghost& ghost, At& at) const {
    const auto cells = Real(2 * ghost.number + 1);
    if (side.slot < 0) {
      const auto& surface = of.corrections.beside_void[ghost.below ? 0 : 1];
      const auto n = of_void(side.slot);
      at.v += cells * (surface.bend ? surface.v[n] + surface.bend[n] : surface.v[n]);
      at.t += of.scale * surface.s[n];
      return;
    }
    at.v += cells * of.corrections.v[side.slot];
    at.t += (ghost.below ? 2 : -2) * (1 - Real(side.weld)) * of.scale * of.corrections.s[side.slot];
  }
  /// The extension beyond a split face (S36) from the mirror image.
  template <class Side>
  At split(const Side& side, const Ghost& ghost, const At& mirror) const {
    const auto &own = of.corrections.split[side.slot], &other = of.corrections.split[side.slot ^ 1];
    const auto cells = Real(2 * ghost.number + 1);
    const Real image = own.s + of.scale * own.swept - mirror.t, gain = cells * own.v;
    if (own.stiffness == 0) return {mirror.v + gain, image};
    const At across = at(ghost.across);
    const Real through = cells * own.stiffness / (1 + cells * own.stiffness);
    const Real welded =
        mirror.t + own.share_s * (across.t - mirror.t) + of.scale * (own.swept - other.swept) / 2;
    // What the spring remembers of the last sweep comes late for a stiff one.
    const Real spring = (1 - through) * (1 - through);
    return {mirror.v + ((1 - through) * gain + through * own.share_v * (across.v - mirror.v)),
            welded + spring * (image - welded)};
  }
};

}  // namespace

int ReachBounds::at(std::int64_t cell, int reach) const {
  const auto found = std::lower_bound(cells.begin(), cells.end(), cell);
  if (found == cells.end() || *found != cell) return reach;
  return std::min(reach, reaches[std::size_t(found - cells.begin())]);
}

template <int D>
InterfaceStencils::InterfaceStencils(const StencilSearch<D>& of) : wave_(of.waves[0]) {
  const auto& impedance = *of.impedances[0];
  const auto& grid = impedance.grid();
  const std::int64_t nx = grid.shape[0], lines = grid.size() / nx;
  std::vector<std::int32_t> marks(std::size_t(nx), 0);
  const auto share = [](const Walk<D, 1>& z, int n) {
    const double own = z.impedance(n), other = z.impedance(n + 1);
    return float(other / (own + other));
  };
  for (std::int64_t line = 0; line < lines; ++line) {
    mark(impedance, line, of.axis, of.reach, marks);
    for (const auto* cells : {&of.split.near, &of.tilted.contrasts.near, &of.bounds.cells})
      mark_these(*cells, line * nx, marks);
    for (std::int64_t x = 0; x < nx; ++x) {
      if (marks[std::size_t(x)] == 0) continue;
      const auto found = find_stencil<StencilSide<1, float>>(of, grid.index(line * nx + x), share);
      if (found) list_.cells.push_back(*found);
    }
    list_.end_line();
  }
}

template <class Real>
void extended_pair(const InterfaceStencil& stencil, int reach, const PairOfLine<Real>& pair,
                   MotionAt<Real>* at) {
  for (int k = -reach; k <= reach; ++k) at[k + reach] = extended(stencil, ExtendedPair<Real>{pair}, k);
}

template <class Real>
void InterfaceStencils::correct_line(int order, std::int64_t line, const IndexRange& columns,
                                     const PairOfLine<Real>& pair, const MaterialRows<Real>& material,
                                     Real* up, Real* down, const BentAlong<Real>* metric) const {
  const Real* const impedance = wave_ == wave_p ? material.zp : material.zs;
  const Real scale = pair.scale, sign = scale < 0 ? -1 : 1;
  for (auto n = list_.from(line, columns.first), end = list_.end(line); n < end && list_[n].x < columns.last;
       ++n) {
    const auto& cell = list_[n];
    const auto i = cell.x - columns.first;
    if (cell.reach == not_carried) {
      up[i] = down[i] = 0;
      continue;
    }
    ExtendedPair<Real> own{pair};
    own.of.v += i, own.of.s += i;
    if (metric) own.of.half_j = metric->half_x + i, own.of.j_stride = metric->stride;
    at_order_reaching(std::min<int>(cell.reach, reach_of(order)), [&]<int Order>() {
      constexpr int reach = reach_of(Order);
      const auto at = extended_about<reach>(cell, own);
      const auto reconstruct = [&](Real j, Real& to_up, Real& to_down) {
        reconstruct_cell<Order>(&at[reach].v, &at[reach].t, 2, sign * impedance[i] * j,
                                sign * scale * (impedance[i] * material.b[i]), to_up, to_down);
      };
      if (!metric) return reconstruct(1, up[i], down[i]);
      // Each face has an impedance of its own (F2).
      Real other;
      reconstruct(2 * metric->half_hi[i], up[i], other);
      reconstruct(2 * metric->half_lo[i], other, down[i]);
    });
  }
}

template void extended_pair(const InterfaceStencil&, int, const PairOfLine<float>&, MotionAt<float>*);
template void extended_pair(const InterfaceStencil&, int, const PairOfLine<double>&, MotionAt<double>*);
template InterfaceStencils::InterfaceStencils(const StencilSearch<2>&);
template InterfaceStencils::InterfaceStencils(const StencilSearch<3>&);
template void InterfaceStencils::correct_line(int, std::int64_t, const IndexRange&, const PairOfLine<float>&,
                                              const MaterialRows<float>&, float*, float*,
                                              const BentAlong<float>*) const;
template void InterfaceStencils::correct_line(int, std::int64_t, const IndexRange&, const PairOfLine<double>&,
                                              const MaterialRows<double>&, double*, double*,
                                              const BentAlong<double>*) const;

}  // namespace slipwave::solver
