// SPDX-License-Identifier: BSD-3-Clause
#include "solver/sweep/interface_stencils.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

#include "solver/kernels/reconstruction.hpp"

namespace slipwave::solver {
namespace {

bool strong(double z, double other) {
  return z > strong_interface_ratio * other || other > strong_interface_ratio * z;
}

/// One side of a cell: the cells up to the next strong interface or edge, at most `reach`, and its law.
struct Side {
  int cells = 0;
  Extension law = Extension::none;
  int beyond = 0;
  double share = 0;
  bool inside = false;  // the interface is inside the grid
  std::int32_t parted = -1;
  bool at_edge() const { return !inside && law == Extension::traction_free; }
};

/// Impedances from a cell outwards along one axis.
template <int D>
class Walk {
 public:
  Walk(const Field<D>& impedance, const TiltedFaces<D>& tilted, const PartedLine<D>& parted,
       const Index<D>& from, int axis, int step)
      : impedance_(impedance), tilted_(tilted), parted_(parted), at_(from), axis_(axis), step_(step) {}
  bool leaves_grid(int n) const {
    const auto i = at_[std::size_t(axis_)] + n * step_;
    return i < 0 || i >= impedance_.grid().shape[std::size_t(axis_)];
  }
  double operator()(int n) const { return impedance_(place(n)); }
  /// Whether the face behind cell n is a strong interface of two media that carry the wave, where stencils
  /// end.
  bool strong_behind(int n) const { return strong((*this)(n), (*this)(n + 1)) && !parted_by_mean(n); }
  /// The slot of the face behind cell n where a fracture parts the rock, on this side of it, or -1.
  std::int32_t parted_behind(int n) const {
    if (!parted_.slot) return -1;
    const auto slot = parted_.slot(face_behind(n));
    return slot < 0 ? slot : 2 * slot + (step_ > 0 ? 0 : 1);
  }
  /// Cells up to the next strong interface at a tilted mean, which stencils cross; at most `reach`.
  int cells_to_tilted(int reach) const {
    if (!tilted_.crossed) return reach;
    for (int n = 0; n < reach && !leaves_grid(n + 1) && (*this)(n + 1) > 0; ++n)
      if (strong((*this)(n), (*this)(n + 1)) && parted_by_mean(n)) return n;
    return reach;
  }
  /// Of the face behind cell n.
  TiltedContrast contrast_behind(int n) const {
    return tilted_.contrasts.before ? tilted_.contrasts.before(face_behind(n)) : TiltedContrast::none;
  }
  /// Cells up to the next strong contrast of tilted rock, at most `reach`.
  int cells_to_turned(int reach) const {
    if (!tilted_.contrasts.before) return reach;
    for (int n = 0; n < reach && !leaves_grid(n + 1); ++n)
      if (contrast_behind(n) == TiltedContrast::strong) return n;
    return reach;
  }

 private:
  bool parted_by_mean(int n) const { return tilted_.crossed && tilted_.crossed(place(n), place(n + 1)); }
  /// The cell behind the face that is behind cell n on the way.
  Index<D> face_behind(int n) const { return place(step_ > 0 ? n + 1 : n); }
  Index<D> place(int n) const {
    Index<D> at = at_;
    at[std::size_t(axis_)] += n * step_;
    return at;
  }
  const Field<D>& impedance_;
  const TiltedFaces<D>& tilted_;
  const PartedLine<D>& parted_;
  Index<D> at_;
  int axis_, step_;
};

/// Cells from `next` on up to the next end of stencils, at most `reach`.
template <int D>
int cells_beyond(const Walk<D>& z, int next, int reach) {
  int cells = 1;
  for (; cells < reach; ++cells) {
    const int further = next + cells;
    if (z.leaves_grid(further) || z(further) == 0 || z.strong_behind(further - 1) ||
        z.parted_behind(further - 1) >= 0)
      break;
  }
  return cells;
}

template <int D>
Side side_of(const Walk<D>& z, Extension edge, int reach) {
  Side side;
  for (; side.cells < reach; ++side.cells) {
    const int next = side.cells + 1;
    if (z.leaves_grid(next)) {
      side.law = edge;
      return side;
    }
    const double own = z(side.cells), other = z(next);
    if (other == 0) {
      side.law = Extension::traction_free;
      side.inside = true;
      return side;
    }
    if (const auto slot = z.parted_behind(side.cells); slot >= 0) {
      side.law = Extension::parted;
      side.inside = true;
      side.parted = slot;
      side.beyond = cells_beyond(z, next, reach);
      return side;
    }
    if (z.strong_behind(side.cells)) {
      side.law = Extension::interface;
      side.share = other / (own + other);
      side.inside = true;
      side.beyond = cells_beyond(z, next, reach);
      return side;
    }
  }
  return side;
}

/// Cells to one side up to the next contrast, at most `reach`.
template <int D>
int cells_to_contrast(const Walk<D>& z, int reach) {
  for (int n = 1; n <= reach && !z.leaves_grid(n) && z(n) > 0; ++n)
    if (z(n) > contrast_ratio * z(n - 1) || z(n - 1) > contrast_ratio * z(n) ||
        z.contrast_behind(n - 1) != TiltedContrast::none)
      return n - 1;
  return reach;
}

/// Whether a cell up to `reach` cells to one side carries the wave.
template <int D>
bool carried_near(const Walk<D>& z, int reach) {
  for (int n = 1; n <= reach && !z.leaves_grid(n); ++n)
    if (z(n) > 0) return true;
  return false;
}

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

/// Cells of the sides that end at `law`: the fewest, or `reach`.
int fewest_cells_to(Extension law, const Side& low, const Side& high, int reach) {
  if (low.law == law) reach = std::min(reach, low.cells);
  return high.law == law ? std::min(reach, high.cells) : reach;
}

int reach_within(const Side& low, const Side& high, int reach) {
  const auto inner = [](const Side& side) {
    return side.law == Extension::interface || side.law == Extension::parted;
  };
  const int interfaces = inner(low) + inner(high);
  const int to_void = fewest_cells_to(Extension::traction_free, low, high, reach);
  const int nearest = std::min(fewest_cells_to(Extension::interface, low, high, reach),
                               fewest_cells_to(Extension::parted, low, high, reach));
  return solver::reach_within(interfaces, nearest, low.law != Extension::none && high.law != Extension::none,
                              low.cells + high.cells, reach_up_to(to_void, most_reach_at_mirrors, reach));
}

/// The pair (v, s) of cells in a line, with half of J of the faces along x of a bent row (v, J s).
template <class Real>
struct PairOfLine {
  const Real *v_, *s_, *half_j_;
  std::int64_t stride, j_stride;
  PairCorrections<Real> corrections;
  Real scale;
  Real v(std::int64_t offset) const { return v_[offset * stride]; }
  Real s(std::int64_t offset) const {
    if (!half_j_) return s_[offset * stride];
    return (half_j_[offset * j_stride] + half_j_[offset * j_stride + 1]) * s_[offset * stride];
  }
};

/// Turns the mirror image into the extension beyond a parted face (S36).
template <class Real>
void extend_across_fracture(const InterfaceStencil& stencil, int offset, const PairOfLine<Real>& pair,
                            Real& v_at, Real& s_at) {
  const bool below = offset < -stencil.low;
  const auto slot = below ? stencil.slot_low : stencil.slot_high;
  const auto &own = pair.corrections.parted[slot], &other = pair.corrections.parted[slot ^ 1];
  const int ghost = below ? -stencil.low - 1 - offset : offset - stencil.high - 1;
  const auto cells = Real(2 * ghost + 1);
  const Real image = own.s + pair.scale * own.swept - s_at, gain = cells * own.v;
  if (own.stiffness == 0) {
    v_at += gain;
    s_at = image;
    return;
  }
  const std::int64_t across = below ? std::max(offset, -stencil.low - stencil.beyond_low)
                                    : std::min(offset, stencil.high + stencil.beyond_high);
  const Real through = cells * own.stiffness / (1 + cells * own.stiffness);
  const Real welded =
      s_at + own.share_s * (pair.s(across) - s_at) + pair.scale * (own.swept - other.swept) / 2;
  v_at += (1 - through) * gain + through * own.share_v * (pair.v(across) - v_at);
  // What the spring remembers of the last sweep comes late for a stiff one.
  const Real spring = (1 - through) * (1 - through);
  s_at = welded + spring * (image - welded);
}

/// Value of the pair at a stencil offset, extended beyond the strong interfaces or edges (E10), (E11).
template <class Real>
void extend(const InterfaceStencil& stencil, int offset, const PairOfLine<Real>& pair, Real& v_at,
            Real& s_at) {
  const bool below = offset < -stencil.low;
  if (!below && offset <= stencil.high) {
    v_at = pair.v(offset);
    s_at = pair.s(offset);
    return;
  }
  const Extension law = below ? stencil.low_law : stencil.high_law;
  if (law == Extension::constant) {
    const std::int64_t last = below ? -stencil.low : stencil.high;
    v_at = pair.v(last);
    s_at = pair.s(last);
    return;
  }
  // The mirror image lies nearer to the cell with each fold, so this ends.
  const int mirrored = below ? -2 * stencil.low - 1 - offset : 2 * stencil.high + 1 - offset;
  extend(stencil, mirrored, pair, v_at, s_at);
  const auto slot = below ? stencil.slot_low : stencil.slot_high;
  const Real share =
      law == Extension::interface ? Real(below ? stencil.share_low : stencil.share_high) : Real(0);
  if (law == Extension::parted) return extend_across_fracture(stencil, offset, pair, v_at, s_at);
  if (law == Extension::traction_free) {
    s_at = -s_at;
  } else if (law == Extension::motionless) {
    v_at = -v_at;
  } else {
    const std::int64_t across = below ? std::max(offset, -stencil.low - stencil.beyond_low)
                                      : std::min(offset, stencil.high + stencil.beyond_high);
    const Real twice = 2 * share;
    v_at += twice * (pair.v(across) - v_at);
    s_at += (2 - twice) * (pair.s(across) - s_at);
  }
  if (slot == -1) return;
  const int ghost = below ? -stencil.low - 1 - offset : offset - stencil.high - 1;
  if (slot < 0) {
    const auto& surface = pair.corrections.beside_void[below ? 0 : 1];
    const auto n = of_void(slot);
    v_at += Real(2 * ghost + 1) * (surface.bend ? surface.v[n] + surface.bend[n] : surface.v[n]);
    s_at += pair.scale * surface.s[n];
    return;
  }
  v_at += Real(2 * ghost + 1) * pair.corrections.v[slot];
  s_at += (below ? 2 : -2) * (1 - share) * pair.scale * pair.corrections.s[slot];
}

template <int Order, class Real>
void correct_cell(const InterfaceStencil& stencil, const PairOfLine<Real>& pair, Real impedance, Real b,
                  Real scale, Real j_lo, Real j_hi, Real& up, Real& down) {
  constexpr int reach = reach_of(Order);
  Real v_stencil[2 * reach + 1], s_stencil[2 * reach + 1];
  for (int k = -reach; k <= reach; ++k) extend(stencil, k, pair, v_stencil[k + reach], s_stencil[k + reach]);
  const Real sign = scale < 0 ? -1 : 1;
  const Real courant = sign * scale * (impedance * b);
  if (!pair.half_j_)
    return reconstruct_cell<Order>(v_stencil + reach, s_stencil + reach, 1, sign * impedance, courant, up,
                                   down);
  // Each face has an impedance of its own (F2).
  Real other;
  reconstruct_cell<Order>(v_stencil + reach, s_stencil + reach, 1, sign * impedance * j_hi, courant, up,
                          other);
  reconstruct_cell<Order>(v_stencil + reach, s_stencil + reach, 1, sign * impedance * j_lo, courant, other,
                          down);
}

template <class Real>
using CorrectCell = void(const InterfaceStencil&, const PairOfLine<Real>&, Real, Real, Real, Real, Real,
                         Real&, Real&);
/// correct_cell() by the reach of the reconstruction, which grows by one from order to order.
template <class Real, int... N>
constexpr std::array<CorrectCell<Real>*, sizeof...(N)> correctors(std::integer_sequence<int, N...>) {
  return {correct_cell<orders[N], Real>...};
}

}  // namespace

int reach_within(int interfaces, int nearest, bool ends, int others, int reach) {
  if (interfaces > 0) reach = reach_up_to(nearest, most_reach_at_contrasts, reach);
  return interfaces == 2 || (interfaces == 1 && ends && others == 0) ? std::min(reach, others) : reach;
}

/// Cells the reconstruction may reach in line with faces of tilted cells: across such a contrast higher
/// orders feed waves, and damp too little of it elsewhere.
template <int D>
static int reach_beside_tilted(const Walk<D>& down, const Walk<D>& up, int reach) {
  const int to_tilted = std::min(down.cells_to_tilted(reach), up.cells_to_tilted(reach));
  const int to_turned = std::min(down.cells_to_turned(reach), up.cells_to_turned(reach));
  return std::min(reach > most_reach_at_contrasts ? reach_up_to(to_tilted, 1, reach) : reach,
                  reach_up_to(to_turned, 1, reach));
}

int ReachBounds::at(std::int64_t cell, int reach) const {
  const auto found = std::lower_bound(cells.begin(), cells.end(), cell);
  if (found == cells.end() || *found != cell) return reach;
  return std::min(reach, reaches[std::size_t(found - cells.begin())]);
}

template <int D>
InterfaceStencils::InterfaceStencils(const Field<D>& impedance, const EdgeLaws<D>& edges, int axis, Wave wave,
                                     int reach, const RisesFrom<D>& rises_from,
                                     const SlotBeside<D>& slot_beside, const TiltedFaces<D>& tilted,
                                     const PartedLine<D>& parted, const ReachBounds& bounds)
    : wave_(wave) {
  const auto& grid = impedance.grid();
  const std::int64_t nx = grid.shape[0], lines = grid.size() / nx;
  starts_.assign(1, 0);
  std::vector<std::int32_t> marks(std::size_t(nx), 0);
  for (std::int64_t line = 0; line < lines; ++line) {
    mark(impedance, line, axis, reach, marks);
    for (const auto* cells : {&parted.near, &tilted.contrasts.near, &bounds.cells})
      mark_these(*cells, line * nx, marks);
    for (std::int64_t x = 0; x < nx; ++x) {
      if (marks[std::size_t(x)] == 0) continue;
      const auto at = grid.index(line * nx + x);
      const Walk<D> down(impedance, tilted, parted, at, axis, -1),
          up(impedance, tilted, parted, at, axis, +1);
      constexpr auto on = Extension::none;
      if (impedance(at) == 0) {
        if (carried_near(down, reach) || carried_near(up, reach))
          cells_.push_back({std::int32_t(x), 0, 0, on, on, 0, 0, 0, 0, not_carried});
        continue;
      }
      const Side low = side_of(down, extension_of(edges[axis][0], wave), reach);
      const Side high = side_of(up, extension_of(edges[axis][1], wave), reach);
      const int to_contrast = std::min(cells_to_contrast(down, reach), cells_to_contrast(up, reach));
      const int at_most = bounds.at(line * nx + x, reach_beside_tilted(down, up, reach));
      // Cells with nothing but an edge of the grid near read the ghost cells beyond it.
      if (low.inside || high.inside) {
        const auto slot = [&](const Side& of, int side) {
          Index<D> last = at;
          last[std::size_t(axis)] += side ? of.cells : -of.cells;
          if (of.parted >= 0) return of.parted;
          return of.inside && slot_beside ? slot_beside(last, side) : -1;
        };
        const auto slot_low = slot(low, 0), slot_high = slot(high, 1);
        int within = reach_within(low, high, reach_up_to(to_contrast, most_reach_at_mirrors, reach));
        if (slot_low != -1) within = reach_up_to(low.cells, most_reach_at_contrasts, within);
        if (slot_high != -1) within = reach_up_to(high.cells, most_reach_at_contrasts, within);
        within = std::min(within, at_most);
        cells_.push_back({std::int32_t(x), std::int8_t(low.cells), std::int8_t(high.cells), low.law, high.law,
                          std::int8_t(low.beyond), std::int8_t(high.beyond), float(low.share),
                          float(high.share), std::int8_t(within), slot_low, slot_high});
        continue;
      }
      int within = reach_up_to(to_contrast, most_reach_at_contrasts, reach);
      if (low.at_edge() && rises_from(at, 0))
        within = reach_up_to(low.cells, most_reach_at_contrasts, within);
      if (high.at_edge() && rises_from(at, 1))
        within = reach_up_to(high.cells, most_reach_at_contrasts, within);
      within = std::min(within, at_most);
      if (within < reach)
        cells_.push_back({std::int32_t(x), std::int8_t(reach), std::int8_t(reach), on, on, 0, 0, 0, 0,
                          std::int8_t(within)});
    }
    starts_.push_back(std::int64_t(cells_.size()));
  }
}

bool InterfaceStencils::any_of_line(std::int64_t line, const IndexRange& columns) const {
  const auto stop = cells_.begin() + starts_[std::size_t(line) + 1];
  const auto cell =
      std::lower_bound(cells_.begin() + starts_[std::size_t(line)], stop, columns.first,
                       [](const InterfaceStencil& stencil, std::int64_t x) { return stencil.x < x; });
  return cell != stop && cell->x < columns.last;
}

const InterfaceStencil* InterfaceStencils::find(std::int64_t line, std::int64_t x) const {
  const auto stop = cells_.begin() + starts_[std::size_t(line) + 1];
  const auto cell =
      std::lower_bound(cells_.begin() + starts_[std::size_t(line)], stop, x,
                       [](const InterfaceStencil& stencil, std::int64_t at) { return stencil.x < at; });
  return cell != stop && cell->x == x ? &*cell : nullptr;
}

template <class Real>
void extended_pair(const InterfaceStencil& stencil, int reach, std::int64_t stride, const Real* v,
                   const Real* s, const PairCorrections<Real>& corrections, Real scale, Real* v_at,
                   Real* s_at, const Real* half_j, std::int64_t j_stride) {
  const PairOfLine<Real> pair{v, s, half_j, stride, j_stride, corrections, scale};
  for (int k = -reach; k <= reach; ++k) extend(stencil, k, pair, v_at[k + reach], s_at[k + reach]);
}

template <class Real>
void InterfaceStencils::correct_line(int order, std::int64_t line, const IndexRange& columns,
                                     std::int64_t stride, const Real* v, const Real* s,
                                     const MaterialRows<Real>& material, Real scale, Real* up, Real* down,
                                     const PairCorrections<Real>& corrections,
                                     const BentAlong<Real>* metric) const {
  const auto stop = cells_.begin() + starts_[std::size_t(line) + 1];
  auto cell = cells_.begin() + starts_[std::size_t(line)];
  static constexpr auto correct_as = correctors<Real>(std::make_integer_sequence<int, order_count>());
  const Real* const impedance = wave_ == wave_p ? material.zp : material.zs;
  if (columns.first > 0)
    cell = std::lower_bound(cell, stop, columns.first,
                            [](const InterfaceStencil& stencil, std::int64_t x) { return stencil.x < x; });
  for (; cell != stop && cell->x < columns.last; ++cell) {
    const auto i = cell->x - columns.first;
    if (cell->reach == not_carried)
      up[i] = down[i] = 0;
    else
      correct_as[std::size_t(std::min<int>(cell->reach, reach_of(order)))](
          *cell,
          {v + i, s + i, metric ? metric->half_x + i : nullptr, stride, metric ? metric->stride : 0,
           corrections, scale},
          impedance[i], material.b[i], scale, metric ? 2 * metric->half_lo[i] : 1,
          metric ? 2 * metric->half_hi[i] : 1, up[i], down[i]);
  }
}

template void extended_pair(const InterfaceStencil&, int, std::int64_t, const float*, const float*,
                            const PairCorrections<float>&, float, float*, float*, const float*, std::int64_t);
template void extended_pair(const InterfaceStencil&, int, std::int64_t, const double*, const double*,
                            const PairCorrections<double>&, double, double*, double*, const double*,
                            std::int64_t);
template InterfaceStencils::InterfaceStencils(const Field<2>&, const EdgeLaws<2>&, int, Wave, int,
                                              const RisesFrom<2>&, const SlotBeside<2>&,
                                              const TiltedFaces<2>&, const PartedLine<2>&,
                                              const ReachBounds&);
template InterfaceStencils::InterfaceStencils(const Field<3>&, const EdgeLaws<3>&, int, Wave, int,
                                              const RisesFrom<3>&, const SlotBeside<3>&,
                                              const TiltedFaces<3>&, const PartedLine<3>&,
                                              const ReachBounds&);
template void InterfaceStencils::correct_line(int, std::int64_t, const IndexRange&, std::int64_t,
                                              const float*, const float*, const MaterialRows<float>&, float,
                                              float*, float*, const PairCorrections<float>&,
                                              const BentAlong<float>*) const;
template void InterfaceStencils::correct_line(int, std::int64_t, const IndexRange&, std::int64_t,
                                              const double*, const double*, const MaterialRows<double>&,
                                              double, double*, double*, const PairCorrections<double>&,
                                              const BentAlong<double>*) const;

}  // namespace slipwave::solver
