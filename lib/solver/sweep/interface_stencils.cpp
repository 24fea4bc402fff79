// SPDX-License-Identifier: BSD-3-Clause
#include "solver/sweep/interface_stencils.hpp"

#include <algorithm>
#include <cstring>
#include <limits>
#include <type_traits>

#include "base/instantiate.hpp"
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

/// Marks these cells, ascending, in the line that begins with cell `first`.
void mark_these(const std::vector<std::int64_t>& cells, std::int64_t first,
                std::vector<std::int32_t>& marks) {
  const auto last = first + std::int64_t(marks.size());
  for (auto cell = std::lower_bound(cells.begin(), cells.end(), first); cell != cells.end() && *cell < last;
       ++cell)
    marks[std::size_t(*cell - first)] = 1;
}

/// Values of cells that follow each other in a row; no wider than the smallest instruction set has them.
using FloatLanes = float __attribute__((vector_size(16)));
using DoubleLanes = double __attribute__((vector_size(16)));
template <class Real>
using Lanes = std::conditional_t<std::is_same_v<Real, float>, FloatLanes, DoubleLanes>;
template <class Real>
constexpr int lane_count = 16 / sizeof(Real);
template <class Value, class Real>
Value value_at(const Real* from) {
  Value value;
  std::memcpy(&value, from, sizeof value);
  return value;
}

/// A pair as extended() reads it: of a cell, or of Lanes of cells whose stencils are alike.
template <class Real, class Value = Real>
struct ExtendedPair {
  using At = MotionAt<Value>;
  static constexpr bool splits = std::is_same_v<Value, Real>;
  PairOfLine<Real> of;

  At at(std::int64_t offset) const {
    const auto v = value_at<Value>(of.v + offset * of.stride), s = value_at<Value>(of.s + offset * of.stride);
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
  /// Adds what (E11), (E11a) and (E11d) correct.
  template <class Side>
  void correct(const Side& side, const Ghost& ghost, At& at) const {
    const auto cells = Real(2 * ghost.number + 1);
    if (side.slot < 0) {
      const auto& surface = of.corrections.beside_void[ghost.below ? 0 : 1];
      const auto n = of_void(side.slot);
      auto v = value_at<Value>(surface.v + n);
      if (surface.bend) v += value_at<Value>(surface.bend + n);
      at.v += cells * v;
      at.t += of.scale * value_at<Value>(surface.s + n);
      return;
    }
    auto v = value_at<Value>(of.corrections.v + side.slot);
    auto s = value_at<Value>(of.corrections.s + side.slot);
    if (of.corrections.v_of_step) {
      v += value_at<Value>(of.corrections.v_of_step + side.slot);
      s += value_at<Value>(of.corrections.s_of_step + side.slot) +
           mean_of_parabola(cells) * value_at<Value>(of.corrections.curvature + side.slot);
    }
    at.v += cells * v;
    at.t += (ghost.below ? 2 : -2) * (1 - Real(side.weld)) * of.scale * s;
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

/// The slot of the cell behind that of `slot` in a row, where slots follow each other as cells do.
std::int32_t next_slot(std::int32_t slot) {
  if (slot == no_slot) return no_slot;
  return slot < 0 ? slot - 1 : slot + 1;
}
bool are_alike(const InterfaceStencil& one, const InterfaceStencil& next) {
  const auto alike = [](const StencilSide<1, float>& a, const StencilSide<1, float>& b) {
    return a.cells == b.cells && a.beyond == b.beyond && a.law() == b.law() && a.weld == b.weld &&
           a.law() != Extension::split && b.slot == next_slot(a.slot);
  };
  return next.x == one.x + 1 && one.reach == next.reach && one.reach != not_carried &&
         alike(one.low, next.low) && alike(one.high, next.high);
}
/// Tells the cells of a line, ascending, how many from each on are alike.
void count_alike(InterfaceStencil* begin, InterfaceStencil* end) {
  for (; end - begin > 1; --end)
    if (are_alike(end[-2], end[-1]) && end[-1].alike < std::numeric_limits<std::int16_t>::max())
      end[-2].alike = std::int16_t(end[-1].alike + 1);
}

/// Cells of a row whose stencils, of the reach of this order, are alike: `cells` of them, whole Lanes. All
/// pointers begin with the first.
template <int Order, class Real>
void correct_alike(const InterfaceStencil& stencil, int cells, const PairOfLine<Real>& pair,
                   const Real* impedance, const Real* b, Real sign, Real* up, Real* down) {
  constexpr int reach = reach_of(Order), places = 2 * reach + 1, lanes = lane_count<Real>;
  auto moved = stencil;
  ExtendedPair<Real, Lanes<Real>> own{pair};
  for (int i = 0; i < cells; i += lanes) {
    const auto at = extended_about<reach>(moved, own);
    Real v[places * lanes], s[places * lanes];
    for (int place = 0; place < places; ++place) {
      std::memcpy(v + place * lanes, &at[std::size_t(place)].v, sizeof(Lanes<Real>));
      std::memcpy(s + place * lanes, &at[std::size_t(place)].t, sizeof(Lanes<Real>));
    }
    for (int lane = 0; lane < lanes; ++lane)
      reconstruct_cell<Order>(
          v + reach * lanes + lane, s + reach * lanes + lane, lanes, sign * impedance[i + lane],
          sign * pair.scale * (impedance[i + lane] * b[i + lane]), up[i + lane], down[i + lane]);
    own.of.v += lanes, own.of.s += lanes;
    for (auto* side : {&moved.low, &moved.high})
      for (int lane = 0; lane < lanes; ++lane) side->slot = next_slot(side->slot);
  }
}

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
    auto* const cells = list_.cells.data();
    count_alike(cells + list_.first[std::size_t(line)], cells + list_.cells.size());
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
                                     Real* up, Real* down, const CurvilinearAlong<Real>* metric) const {
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
    constexpr int lanes = lane_count<Real>;
    const auto alike = int(std::min<std::int64_t>(cell.alike, columns.last - cell.x)) / lanes * lanes;
    if (alike > 0 && !metric) {
      at_order_reaching(std::min<int>(cell.reach, reach_of(order)), [&]<int Order>() {
        correct_alike<Order>(cell, alike, own.of, impedance + i, material.b + i, sign, up + i, down + i);
      });
      n += alike - 1;
      continue;
    }
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

SLIPWAVE_INSTANTIATE_REAL(FUNCTION, extended_pair);
template InterfaceStencils::InterfaceStencils(const StencilSearch<2>&);
template InterfaceStencils::InterfaceStencils(const StencilSearch<3>&);
SLIPWAVE_INSTANTIATE_REAL(FUNCTION, InterfaceStencils::correct_line);

}  // namespace slipwave::solver
