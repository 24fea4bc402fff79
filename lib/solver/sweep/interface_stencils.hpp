// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "grid/field.hpp"
#include "rock/coefficients.hpp"
#include "scene/edges.hpp"
#include "solver/kernels/kernels.hpp"
#include "solver/sweep/by_line.hpp"
#include "solver/sweep/state.hpp"

namespace slipwave::solver {

/// The extension of a pair (v, s) beyond a strong interface or an edge of the grid.
enum class Extension : std::uint8_t {
  none,           // there is none as far as the stencil reaches
  traction_free,  // v even, s odd (antisymmetric)
  motionless,     // v odd (antisymmetric), s even
  constant,       // the last value stays
  split,          // as the two sides of a fracture along the face have it
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

/// The sign of the image of a field row beyond an edge of an axis: velocities and tractions there by the law
/// of the edge, what else there is even.
template <int D>
constexpr int image_sign(EdgeLaw law, int axis, int row) {
  using Rows = FieldRows<D>;
  const bool velocity = row < D, of_p = row == Rows::velocity(axis) || row == Rows::normal_stress(axis);
  if (!velocity && !Rows::is_traction(axis, row)) return 1;
  const auto odd = velocity ? Extension::motionless : Extension::traction_free;
  return extension_of(law, of_p ? wave_p : wave_s) == odd ? -1 : 1;
}

/// Cells the reconstruction may reach beyond a corrected free surface, a strong interface or a contrast: with
/// three, solids between free surfaces, plates and random densities grew at Courant numbers from 0.9 on.
constexpr int most_reach_at_contrasts = 2;
/// Cells the reconstruction may reach beyond the plain mirror image at a void.
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
/// Ratio of impedances as matrices from which a face within the stencil of a cell is a contrast, where axes
/// are tilted.
constexpr double tilted_contrast_ratio = 1.05;

constexpr std::int8_t not_carried = -1;
constexpr std::int32_t no_slot = -1;
/// The slot that stands for a number of FreeSurface, and back.
constexpr std::int32_t of_void(std::int64_t number) { return std::int32_t(-2 - number); }

/// One side of a stencil that serves so many waves: where it ends, and how the fields are extended beyond.
template <std::size_t Waves, class Weld>
struct StencilSide {
  std::int8_t cells = 0;   // up to the interface or edge, or the reach
  std::int8_t beyond = 0;  // interface: cells beyond it that may be read
  std::array<Extension, Waves> laws{};
  /// At an interface R of (F13): of a pair Z of the other side over the sum of both, of vectors the place of
  /// the matrix.
  Weld weld{};
  std::int32_t slot = no_slot;  // of InterfaceCorrections or SplitFaces, or of_void()

  Extension law() const { return laws[0]; }
};
/// The stencil of a cell that would reach across a strong interface or into cells that do not carry the wave:
/// beyond that the fields are extended by the law (theory.md (E10), (E11)). Or a cell that does not carry the
/// wave beside one that does: it has no outgoing waves.
template <class Side>
struct Stencil {
  std::int32_t x;     // the cell's column
  std::int8_t reach;  // of the reconstruction used here, not_carried where the wave is not carried
  /// Cells from this one on in the row whose stencils are this one: their slots follow each other.
  std::int16_t alike = 1;
  Side low{}, high{};
};
/// The stencil of one pair.
using InterfaceStencil = Stencil<StencilSide<1, float>>;
/// A stencil of which no end is within reach.
template <class Of>
Of whole_stencil(std::int64_t x, int within, int reach) {
  Of whole{std::int32_t(x), std::int8_t(within)};
  whole.low.cells = whole.high.cells = std::int8_t(reach);
  return whole;
}

/// Whether the reach of stencils in line with a cell rises away from the edge on this side (0 low, 1 high),
/// as it does from contrasts.
template <int D>
using RisesFrom = std::function<bool(const Index<D>& at, int side)>;

/// Slot of the corrections on a side (0 low, 1 high) of a cell: of InterfaceCorrections, or beside void
/// of_void(), or -1.
template <int D>
using SlotBeside = std::function<std::int32_t(const Index<D>& at, int side)>;
/// The extension of one side of a split face (theory.md (S36)): what its mirror image gains, v over 2 j + 1,
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
  const SplitImage<Real>* split = nullptr;
  /// What both gain besides, and the second derivative of this jump by cell: null but in whole sweeps.
  const Real *v_of_step = nullptr, *s_of_step = nullptr, *curvature = nullptr;
  /// By number of FreeSurface, of the low and the high side of cells: of v over 2 j + 1, of s, and what v
  /// gains besides, null but in whole sweeps.
  struct BesideVoid {
    const Real *v, *s, *bend;
  };
  std::array<BesideVoid, 2> beside_void{};
};

/// The mean of z^2/2 over a cell of which the middle lies half as many cells from z = 0 as said.
template <class Real>
constexpr Real mean_of_parabola(Real cells) {
  return (cells * cells + Real(1) / 3) / 8;
}

/// The pair (v, s) of cells in a line; pointers begin with a cell.
template <class Real>
struct PairOfLine {
  const Real *v, *s;
  std::int64_t stride;
  const PairCorrections<Real>& corrections;
  Real scale;
  /// Half of J of the faces (CurvilinearAlong) of a curvilinear row, where the pair is (v, J s); null in
  /// level ones.
  const Real* half_j = nullptr;
  std::int64_t j_stride = 0;
};
/// What a stencil reads of one place: velocity and traction, of a pair or as vectors.
template <class Value>
struct MotionAt {
  Value v, t;
};
/// The motion of a pair at the 2 reach + 1 places about a cell, extended beyond interfaces and edges as its
/// stencil says ((E10), (E11)).
template <class Real>
void extended_pair(const InterfaceStencil& stencil, int reach, const PairOfLine<Real>& pair,
                   MotionAt<Real>* at);

/// Whether of these neighbours, both solid, one is an equivalent TTI cell (AnisotropicCells); empty: none is
/// anywhere.
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

/// The faces that stencils cross and the contrasts, where axes are tilted.
template <int D>
struct TiltedFaces {
  TiltedFace<D> crossed{};
  TiltedContrasts<D> contrasts{};
};

/// Faces of one axis that fractures split: cells within reach of them, ascending; and the place of the face
/// before a cell in the list of split faces, or -1.
template <int D>
struct SplitLine {
  std::vector<std::int64_t> near{};
  std::function<std::int32_t(const Index<D>& behind)> place{};
};

/// Cells whose reconstruction along one axis is bounded by something besides interfaces and contrasts in line
/// with them, ascending, and how many cells it may reach there.
struct ReachBounds {
  std::vector<std::int64_t> cells{};
  std::vector<int> reaches{};

  /// At most `reach`.
  int at(std::int64_t cell, int reach) const;
};

/// What the stencils of the waves of an axis end at and reach.
template <int D, std::size_t Waves = 1>
struct StencilSearch {
  std::array<const Field<D>*, Waves> impedances;  // on the computed grid, 0 where a wave is not carried
  std::array<Wave, Waves> waves;
  const EdgeLaws<D>& edges;
  int axis;
  int reach;  // cells the reconstruction reaches to each side
  RisesFrom<D> rises_from;
  SlotBeside<D> slot_beside{};
  /// Stencils do not end at faces of equivalent TTI cells, which divide what would be a strong interface.
  TiltedFaces<D> tilted{};
  SplitLine<D> split{};
  ReachBounds bounds{};
};

/// Such cells of all rows for one axis and wave; the bulk kernel runs over all cells without a branch, then
/// these are corrected.
class InterfaceStencils {
 public:
  InterfaceStencils() = default;
  template <int D>
  explicit InterfaceStencils(const StencilSearch<D>& of);
  /// Returns the stencil of a cell, null where the bulk kernel serves.
  const InterfaceStencil* find(std::int64_t line, std::int64_t x) const { return list_.find(line, x); }

  std::size_t size() const { return list_.cells.size(); }
  std::int64_t memory_bytes() const { return list_.memory_bytes(); }
  /// Whether it would correct anything of a line.
  bool in_line(std::int64_t line) const { return !list_.empty(line); }
  /// Whether it would correct anything of these columns.
  bool any(std::int64_t line, const IndexRange& columns) const {
    return in_line(line) && !list_.in(line, columns).empty();
  }
  /// Whether it corrects all of these columns.
  bool all(std::int64_t line, const IndexRange& columns) const {
    return list_.count(line) >= columns.count() && list_.in(line, columns).count() == columns.count();
  }
  /// Overwrites up and down for the listed cells of these columns of a row. All pointers begin with the
  /// first. `metric`: of a curvilinear row.
  template <class Real>
  void correct(int order, std::int64_t line, const IndexRange& columns, const PairOfLine<Real>& pair,
               const MaterialRows<Real>& material, Real* up, Real* down,
               const CurvilinearAlong<Real>* metric = nullptr) const {
    if (in_line(line)) correct_line(order, line, columns, pair, material, up, down, metric);
  }

 private:
  template <class Real>
  void correct_line(int order, std::int64_t line, const IndexRange& columns, const PairOfLine<Real>& pair,
                    const MaterialRows<Real>& material, Real* up, Real* down,
                    const CurvilinearAlong<Real>* metric) const;
  Wave wave_ = wave_p;
  ByLine<InterfaceStencil> list_;
};

}  // namespace slipwave::solver
