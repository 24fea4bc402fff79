// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>

#include "solver/kernels/reconstruction.hpp"
#include "solver/sweep/interface_stencils.hpp"

/// How stencils find their ends, and how fields are extended beyond these: of pairs in a line and of vectors
/// across curvilinear rows alike.
namespace slipwave::solver {

/// Impedances from a cell outwards along an axis.
template <int D, std::size_t Waves>
class Walk {
 public:
  Walk(const StencilSearch<D, Waves>& of, const Index<D>& from, int step)
      : of_(of), from_(from), step_(step) {}
  const StencilSearch<D, Waves>& of() const { return of_; }
  int step() const { return step_; }
  Index<D> place(int n) const {
    Index<D> at = from_;
    at[std::size_t(of_.axis)] += n * step_;
    return at;
  }
  /// The cell towards high coordinates of the face behind cell n on the way.
  Index<D> behind_face(int n) const { return place(step_ > 0 ? n + 1 : n); }
  bool leaves_grid(int n) const {
    const auto i = from_[std::size_t(of_.axis)] + n * step_;
    return i < 0 || i >= of_.impedances[0]->grid().shape[std::size_t(of_.axis)];
  }
  double impedance(int n, std::size_t wave = 0) const { return (*of_.impedances[wave])(place(n)); }
  bool carries(int n) const { return impedance(n) > 0; }
  /// Whether the impedances of cells n and n + 1 differ by more than a factor.
  bool differ(int n, double ratio) const {
    for (std::size_t wave = 0; wave < Waves; ++wave) {
      const double z = impedance(n, wave), other = impedance(n + 1, wave);
      if (z > ratio * other || other > ratio * z) return true;
    }
    return false;
  }
  /// Whether the face behind cell n is a strong interface of two media that carry the wave, where stencils
  /// end.
  bool strong_behind(int n) const { return differ(n, strong_interface_ratio) && !crossed_behind(n); }
  /// The slot of the face behind cell n where a fracture splits the rock, on this side of it, or -1.
  std::int32_t split_behind(int n) const {
    if (!of_.split.place) return no_slot;
    const auto place = of_.split.place(behind_face(n));
    return place < 0 ? no_slot : 2 * place + (step_ > 0 ? 0 : 1);
  }
  TiltedContrast tilted_contrast_behind(int n) const {
    return of_.tilted.contrasts.before ? of_.tilted.contrasts.before(behind_face(n)) : TiltedContrast::none;
  }
  bool crossed_behind(int n) const {
    return of_.tilted.crossed && of_.tilted.crossed(place(n), place(n + 1));
  }
  /// Cells that follow each other up to the first behind which `ends(n)`, or that is followed by none; at
  /// most the reach.
  template <class Ends>
  int cells_to(const Ends& ends, bool carried = true) const {
    for (int n = 0; n < of_.reach && !leaves_grid(n + 1) && (!carried || carries(n + 1)); ++n)
      if (ends(n)) return n;
    return of_.reach;
  }

 private:
  const StencilSearch<D, Waves>& of_;
  Index<D> from_;
  int step_;
};

template <class Side>
struct FoundSide {
  Side side{};
  bool inside = false;  // it ends inside the grid
  bool at_free_edge() const { return !inside && side.law() == Extension::traction_free; }
};

/// Cells from `next` on up to the next end of stencils, at most the reach.
template <int D, std::size_t Waves>
int cells_beyond(const Walk<D, Waves>& z, int next) {
  int cells = 1;
  for (; cells < z.of().reach; ++cells) {
    const int further = next + cells;
    if (z.leaves_grid(further) || !z.carries(further) || z.strong_behind(further - 1) ||
        z.split_behind(further - 1) >= 0)
      break;
  }
  return cells;
}

/// The side of a stencil that a walk leads to; weld_of(walk, n) is that of the face behind cell n.
template <class Side, int D, std::size_t Waves, class WeldOf>
FoundSide<Side> side_of(const Walk<D, Waves>& z, const WeldOf& weld_of) {
  FoundSide<Side> found;
  auto& side = found.side;
  const auto ends_inside = [&](Extension law) {
    side.laws.fill(law);
    found.inside = true;
    return found;
  };
  for (; side.cells < z.of().reach; ++side.cells) {
    const int own{side.cells}, next{own + 1}, high{z.step() > 0 ? 1 : 0};
    if (z.leaves_grid(next)) {
      for (std::size_t wave = 0; wave < Waves; ++wave)
        side.laws[wave] = extension_of(z.of().edges[z.of().axis][high], z.of().waves[wave]);
      return found;
    }
    const bool free = !z.carries(next);
    side.slot = free ? no_slot : z.split_behind(own);
    const bool split = side.slot >= 0;
    if (!free && !split && !z.strong_behind(own)) continue;
    if (!split && z.of().slot_beside) side.slot = z.of().slot_beside(z.place(own), high);
    if (free) return ends_inside(Extension::traction_free);
    side.beyond = std::int8_t(cells_beyond(z, next));
    if (split) return ends_inside(Extension::split);
    side.weld = weld_of(z, own);
    return ends_inside(Extension::interface);
  }
  return found;
}

/// Cells the reconstruction may reach between the ends of a stencil, at most `reach`. Between two strong
/// interfaces w cells allow order 2w - 1 and no more, and so does a single cell between a strong interface
/// and another end: with more, random media of single cells and a crust of one cell grew at order 5 and 7
/// (docs/theory.md).
template <class Side>
int reach_within(const Side& low, const Side& high, int reach) {
  int interfaces = 0, others = 0;
  bool ends = true;  // on both sides
  for (const auto* side : {&low, &high}) {
    const auto law = side->law();
    const bool inner = law == Extension::interface || law == Extension::split;
    if (law == Extension::traction_free) reach = reach_up_to(side->cells, most_reach_at_mirrors, reach);
    if (inner) reach = reach_up_to(side->cells, most_reach_at_contrasts, reach);
    interfaces += inner, others += side->cells;
    ends = ends && law != Extension::none;
  }
  return interfaces == 2 || (interfaces == 1 && ends && others == 0) ? std::min(reach, others) : reach;
}

/// Cells the reconstruction may reach in line with faces of tilted rock: across such a contrast higher orders
/// feed waves, and damp too little of it elsewhere.
template <int D, std::size_t Waves>
int reach_beside_tilted(const Walk<D, Waves>& z, int reach) {
  const auto& tilted = z.of().tilted;
  if (tilted.crossed && reach > most_reach_at_contrasts)
    reach = reach_up_to(
        z.cells_to([&](int n) { return z.differ(n, strong_interface_ratio) && z.crossed_behind(n); }), 1,
        reach);
  if (tilted.contrasts.before)
    reach = reach_up_to(
        z.cells_to([&](int n) { return z.tilted_contrast_behind(n) == TiltedContrast::strong; }, false), 1,
        reach);
  return reach;
}

/// The stencil of a cell; none where the bulk kernel serves.
template <class Side, int D, std::size_t Waves, class WeldOf>
std::optional<Stencil<Side>> find_stencil(const StencilSearch<D, Waves>& of, const Index<D>& at,
                                          const WeldOf& weld_of) {
  const std::array<Walk<D, Waves>, 2> walks{Walk<D, Waves>{of, at, -1}, Walk<D, Waves>{of, at, +1}};
  const int reach = of.reach;
  if (!walks[0].carries(0)) {
    for (const auto& z : walks)
      for (int n = 1; n <= reach && !z.leaves_grid(n); ++n)
        if (z.carries(n)) return Stencil<Side>{std::int32_t(at[0]), not_carried};
    return {};
  }
  const std::array<FoundSide<Side>, 2> sides{side_of<Side>(walks[0], weld_of),
                                             side_of<Side>(walks[1], weld_of)};
  // Cells with nothing but an edge of the grid near read the ghost cells beyond it.
  const bool inside = sides[0].inside || sides[1].inside;
  int within = reach;
  for (const auto& z : walks) {
    const auto contrast = [&](int n) {
      return z.differ(n, contrast_ratio) || z.tilted_contrast_behind(n) != TiltedContrast::none;
    };
    within =
        reach_up_to(z.cells_to(contrast), inside ? most_reach_at_mirrors : most_reach_at_contrasts, within);
  }
  if (inside) within = reach_within(sides[0].side, sides[1].side, within);
  for (const int n : {0, 1}) {
    const auto& found = sides[std::size_t(n)];
    const bool corrected = inside ? found.side.slot != no_slot : found.at_free_edge() && of.rises_from(at, n);
    if (corrected) within = reach_up_to(found.side.cells, most_reach_at_contrasts, within);
    within = std::min(within, reach_beside_tilted(walks[std::size_t(n)], reach));
  }
  within = of.bounds.at(of.impedances[0]->grid().flat(at), within);
  if (inside) return Stencil<Side>{std::int32_t(at[0]), std::int8_t(within), 1, sides[0].side, sides[1].side};
  if (within == reach) return {};
  return whole_stencil<Stencil<Side>>(at[0], within, reach);
}

/// A place beyond an end of a stencil.
struct Ghost {
  bool below;  // towards low coordinates
  int number;  // from the end on
  int across;  // where it lies, or the last place before it that may be read
};

template <class Side, class Line>
typename Line::At extended_beyond(const Stencil<Side>& stencil, const Line& line, int offset, bool below);
/// The motion at an offset from a cell, extended beyond the ends of its stencil ((E10), (E11), (F13)). A line
/// gives what is at a cell, and what its laws make of a mirror image.
template <class Side, class Line>
[[gnu::always_inline]] inline typename Line::At extended(const Stencil<Side>& stencil, const Line& line,
                                                         int offset) {
  const bool below = offset < -stencil.low.cells;
  return below || offset > stencil.high.cells ? extended_beyond(stencil, line, offset, below)
                                              : line.at(offset);
}
/// The motion at an offset beyond an end of the stencil, on the side of low coordinates or the other.
template <class Side, class Line>
typename Line::At extended_beyond(const Stencil<Side>& stencil, const Line& line, int offset, bool below) {
  const auto& side = below ? stencil.low : stencil.high;
  const int cells{side.cells};
  if (side.law() == Extension::constant) return line.at(below ? -cells : cells);
  // The mirror image lies nearer to the cell with each fold, so this ends.
  auto at = extended(stencil, line, below ? -2 * cells - 1 - offset : 2 * cells + 1 - offset);
  const Ghost ghost{below, below ? -cells - 1 - offset : offset - cells - 1,
                    below ? std::max(offset, -cells - side.beyond) : std::min(offset, cells + side.beyond)};
  if constexpr (Line::splits)
    if (side.law() == Extension::split) return line.split(side, ghost, at);
  if (side.law() == Extension::interface)
    line.weld(side, ghost, at);
  else
    line.mirror(side, ghost, at);
  if (side.slot != no_slot) line.correct(side, ghost, at);
  return at;
}

/// The motions at the places of a stencil.
template <int Reach, class Side, class Line>
std::array<typename Line::At, std::size_t(2 * Reach + 1)> extended_about(const Stencil<Side>& stencil,
                                                                         const Line& line) {
  std::array<typename Line::At, std::size_t(2 * Reach + 1)> at;
  for (std::size_t n = 0; n < at.size(); ++n) at[n] = extended(stencil, line, int(n) - Reach);
  return at;
}

/// Calls what.operator()<Order>() of the order whose reconstruction reaches so many cells: it grows by one
/// from order to order.
template <class What>
void at_order_reaching(int reach, const What& what) {
  [&]<std::size_t... N>(std::index_sequence<N...>) {
    ((reach == int(N) ? what.template operator()<orders[N]>() : void()), ...);
  }
  (std::make_index_sequence<std::size_t(order_count)>());
}

}  // namespace slipwave::solver
