// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "base/memory.hpp"
#include "grid/field.hpp"
#include "model/coefficients.hpp"
#include "scene/edges.hpp"
#include "solver/kernels/kernels.hpp"

namespace slipwave::solver {

/// The extension of a pair (v, s) beyond a strong interface or an edge of the grid.
enum class Extension : std::uint8_t {
  none,           // there is none as far as the stencil reaches
  traction_free,  // v even, s odd (antisymmetric)
  motionless,     // v odd (antisymmetric), s even
  constant,       // the last value stays
  parted,         // as the two sides of a fracture along the face have it
  interface,      // as the two sides of a welded interface couple them
};

/// The extension of an edge law for P (v_n, s_nn) or S (v_t, s_nt).
constexpr Extension extension_of(EdgeLaw law, Wave wave) {
  switch (law) {
    case EdgeLaw::free:
      return Extension::traction_free;
    case EdgeLaw::rigid:
      return Extension::motionless;
    case EdgeLaw::mirror:
      return wave == wave_s ? Extension::traction_free : Extension::motionless;
    case EdgeLaw::absorbing:
      break;
  }
  return Extension::constant;
}

/// Cells the reconstruction may reach beyond a corrected free surface, a strong interface or a contrast: with
/// three, solids between free surfaces, plates and random densities grew at Courant numbers from 0.9 on.
constexpr int most_reach_at_contrasts = 2;
/// The same beyond the plain mirror image at a void.
constexpr int most_reach_at_mirrors = 3;
/// In cells of a cluster that carry next to no stress, where more of it fed motion between contrasts
/// (theory/fractures.md).
constexpr int most_reach_in_soft_cells = 1;
/// Along a fracture with a spring, in the cells next to it: with more, springs fed waves from order 9 on
/// (theory/fractures.md).
constexpr int most_reach_along_springs = 2;
/// Cells the reconstruction may reach in a cell with `cells` others up to what it may reach `beyond` cells
/// across: the order rises away from it, since it may always reach up to it.
constexpr int reach_up_to(int cells, int beyond, int reach) {
  return std::min(reach, std::max(cells, beyond));
}
/// Ratio of impedances from which a face within the stencil of a cell is a contrast.
constexpr double contrast_ratio = 1.2;
/// The same of impedances as matrices, where axes are tilted.
constexpr double tilted_contrast_ratio = 1.05;
/// Cells the reconstruction may reach where a stencil ends at so many strong interfaces, the nearest after
/// `nearest` cells, `others` cells beside its own lie between its ends, and `ends`: it ends on both sides.
/// Between two strong interfaces w cells allow order 2w - 1 and no more, and so does a single cell between a
/// strong interface and another end: with more, random media of single cells and a crust of one cell grew at
/// order 5 and 7 (docs/theory.md).
int reach_within(int interfaces, int nearest, bool ends, int others, int reach);

/// The stencil of a cell that would reach across a strong interface or into cells that do not carry the wave:
/// beyond that the fields are extended by the law (theory.md (E10), (E11)). Or a cell that does not carry the
/// wave beside one that does: it has no outgoing waves.
struct InterfaceStencil {
  std::int32_t x;         // the cell's column
  std::int8_t low, high;  // cells before and behind it up to the interface or edge, or the reach
  Extension low_law, high_law;
  std::int8_t beyond_low, beyond_high;  // interface: cells beyond it that may be read
  float share_low, share_high;          // interface: Z of the other side over the sum of both
  std::int8_t reach;  // of the reconstruction used here, not_carried where the wave is not carried
  std::int32_t slot_low = -1, slot_high = -1;  // of InterfaceCorrections, -1: none, less: of_void()
};
/// The slot that stands for a number of FreeSurface, and back.
constexpr std::int32_t of_void(std::int64_t number) { return std::int32_t(-2 - number); }
constexpr std::int8_t not_carried = -1;
/// One of which no end is within reach.
constexpr InterfaceStencil whole_stencil(std::int32_t x, int reach) {
  constexpr auto on = Extension::none;
  const auto cells = std::int8_t(reach);
  return {x, cells, cells, on, on, 0, 0, 0, 0, cells};
}

/// Whether the reach of stencils in line with a cell rises away from the edge on this side (0 low, 1 high),
/// as it does from contrasts.
template <int D>
using RisesFrom = std::function<bool(const Index<D>& at, int side)>;

/// Slot of the corrections on a side (0 low, 1 high) of a cell: of InterfaceCorrections, or beside void
/// of_void(), or -1.
template <int D>
using SlotBeside = std::function<std::int32_t(const Index<D>& at, int side)>;
/// The extension of one side of a parted face (theory.md (S36)): what its mirror image gains, v over 2 j + 1,
/// s at the beginning of a sweep and besides in one over a whole step; and how stiff the fracture is for
/// waves of half a cell. The other side is the slot that differs in the last bit.
template <class Real>
struct SplitImage {
  Real v = 0, s = 0, swept = 0;
  Real stiffness = 0;             // 0: open
  Real share_v = 0, share_s = 0;  // of what is read across it, were it welded (E10)
};
/// By slot, of one pair: the correction of v over 2 j + 1, and the jump of s in a sweep over a whole step.
template <class Real>
struct PairCorrections {
  const Real *v, *s;
  const SplitImage<Real>* parted = nullptr;
  /// By number of FreeSurface, of the low and the high side of cells: of v over 2 j + 1, of s, and what v
  /// gains besides, null but in whole sweeps.
  struct BesideVoid {
    const Real *v, *s, *bend;
  };
  std::array<BesideVoid, 2> beside_void{};
};

/// v and s of a pair at the 2 reach + 1 places about a cell, extended beyond interfaces and edges as its
/// stencil says ((E10), (E11)); `v` and `s` point at the cell, and so does `half_j` (BentAlong) of a bent
/// row, where the pair is (v, J s).
template <class Real>
void extended_pair(const InterfaceStencil& stencil, int reach, std::int64_t stride, const Real* v,
                   const Real* s, const PairCorrections<Real>& corrections, Real scale, Real* v_at,
                   Real* s_at, const Real* half_j = nullptr, std::int64_t j_stride = 0);

/// Whether of these neighbours, both solid, one is a tilted mean (TiltedCells); empty: none is anywhere.
template <int D>
using TiltedFace = std::function<bool(const Index<D>& at, const Index<D>& beside)>;

/// How much the impedances on both sides of a face differ, as matrices, where axes are tilted (theory.md
/// (T6)).
enum class TiltedContrast : std::uint8_t { none, weak, strong };
/// Faces of one axis with such a contrast: cells within reach of them, ascending; and that of the face before
/// a cell.
template <int D>
struct TiltedContrasts {
  std::vector<std::int64_t> near{};
  std::function<TiltedContrast(const Index<D>& behind)> before{};
};

/// Where axes are tilted: faces that stencils cross, and contrasts.
template <int D>
struct TiltedFaces {
  TiltedFace<D> crossed{};
  TiltedContrasts<D> contrasts{};
};

/// Faces of one axis where fractures part the rock: cells within reach of them, ascending; and the slot of
/// the side (0 before, 1 behind) of the face before a cell, or -1.
template <int D>
struct PartedLine {
  std::vector<std::int64_t> near{};
  std::function<std::int32_t(const Index<D>& behind)> slot{};
};

/// Cells whose reconstruction along one axis is bounded by something besides interfaces and contrasts in line
/// with them, ascending, and how many cells it may reach there.
struct ReachBounds {
  std::vector<std::int64_t> cells{};
  std::vector<int> reaches{};

  /// At most `reach`.
  int at(std::int64_t cell, int reach) const;
};

/// Such cells of all rows for one axis and wave; the bulk kernel runs over all cells without a branch, then
/// these are corrected.
class InterfaceStencils {
 public:
  InterfaceStencils() = default;
  /// `impedance` of the wave on the computed grid, 0 where it is not carried; laws of
  /// the grid's edges; cells the reconstruction reaches to each side. Stencils do not end at faces of
  /// tilted means, which part what would be a strong interface in two.
  template <int D>
  InterfaceStencils(const Field<D>& impedance, const EdgeLaws<D>& edges, int axis, Wave wave, int reach,
                    const RisesFrom<D>& rises_from, const SlotBeside<D>& slot_beside,
                    const TiltedFaces<D>& tilted = {}, const PartedLine<D>& parted = {},
                    const ReachBounds& bounds = {});
  /// That of a cell, null where the bulk kernel serves.
  const InterfaceStencil* find(std::int64_t line, std::int64_t x) const;

  std::size_t size() const { return cells_.size(); }
  std::int64_t memory_bytes() const { return bytes_of(cells_) + bytes_of(starts_); }
  /// Whether it would correct anything of these columns.
  bool any(std::int64_t line, const IndexRange& columns) const {
    return starts_[std::size_t(line)] < starts_[std::size_t(line) + 1] && any_of_line(line, columns);
  }
  /// Overwrites up and down for the listed cells of these columns of a row. All pointers begin with the
  /// first. `metric`: of a bent row, the pair is then (v, J s).
  template <class Real>
  void correct(int order, std::int64_t line, const IndexRange& columns, std::int64_t stride, const Real* v,
               const Real* s, const MaterialRows<Real>& material, Real scale, Real* up, Real* down,
               const PairCorrections<Real>& corrections, const BentAlong<Real>* metric = nullptr) const {
    if (starts_[std::size_t(line)] < starts_[std::size_t(line) + 1])
      correct_line(order, line, columns, stride, v, s, material, scale, up, down, corrections, metric);
  }

 private:
  bool any_of_line(std::int64_t line, const IndexRange& columns) const;
  template <class Real>
  void correct_line(int order, std::int64_t line, const IndexRange& columns, std::int64_t stride,
                    const Real* v, const Real* s, const MaterialRows<Real>& material, Real scale, Real* up,
                    Real* down, const PairCorrections<Real>& corrections,
                    const BentAlong<Real>* metric) const;
  Wave wave_ = wave_p;
  std::vector<InterfaceStencil> cells_;  // by line, then x
  std::vector<std::int64_t> starts_;     // of each line in cells_, and the end
};

}  // namespace slipwave::solver
