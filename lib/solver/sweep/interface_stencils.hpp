#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "grid/field.hpp"
#include "scene/edges.hpp"
#include "solver/kernels/kernels.hpp"

namespace slipwave::solver {

enum Wave : int { wave_p, wave_s };

/// How a pair (v, s) continues beyond an end of its span.
enum class Extension : std::uint8_t {
  none,           // the span continues as far as the stencil reaches
  traction_free,  // v evenly, s oddly
  motionless,     // v oddly, s evenly
  level,          // the last value stays
  contact,        // as both sides of a welded contact make it
};

/// The continuation an edge law means for P (v_n, s_nn) or S (v_t, s_nt).
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
  return Extension::level;
}

/// From this ratio of impedances on a contact between neighbouring cells ends the spans on both of its sides.
/// Below it stencils run across: the contrasts tried at random up to 1.5 stay stable at every order.
constexpr double strong_interface_ratio = 1.5;

/// A cell whose stencil would reach past an end of its span: the cells of a line that carry the wave without
/// a gap or a strong contact. Beyond the end the wave field continues as the law says (theory.md (E10),
/// (E11)). Or a cell that does not carry the wave beside one that does: nothing leaves it.
struct InterfaceStencil {
  std::int32_t x;         // the cell's place on its row
  std::int8_t low, high;  // cells of the span before and behind it, as far as the stencil reaches
  Extension low_law, high_law;
  std::int8_t beyond_low, beyond_high;  // contact: cells of the neighbouring span that may be read
  float share_low, share_high;          // contact: Z of the other side over the sum of both
  std::int8_t reach;  // of the reconstruction used here, nothing_leaves where the wave is not carried
};
constexpr std::int8_t nothing_leaves = -1;

/// Whether fields bend at the edge of this side (0 low, 1 high) on the line through a cell (FreeEdge).
template <int D>
using CorrectedAt = std::function<bool(const Index<D>& at, int side)>;

/// Such cells of all lines of one axis and wave; the bulk kernel runs over everything without a branch, then
/// these are refreshed.
class InterfaceStencils {
 public:
  InterfaceStencils() = default;
  /// `impedance` of the wave on the computed grid, 0 where it is not carried; laws of
  /// the grid's edges; cells the reconstruction reaches to each side.
  template <int D>
  InterfaceStencils(const Field<D>& impedance, const EdgeLaws<D>& edges, int axis, Wave wave, int reach,
                    const CorrectedAt<D>& bent);

  std::size_t size() const { return cells_.size(); }
  /// Whether it would correct anything of these columns.
  bool any(std::int64_t line, const IndexRange& columns) const {
    return starts_[std::size_t(line)] < starts_[std::size_t(line) + 1] && any_of_line(line, columns);
  }
  /// Overwrites up and down for the listed cells of these columns of a row. All pointers begin with the
  /// first.
  template <class Real>
  void correct(int order, std::int64_t line, const IndexRange& columns, std::int64_t stride, const Real* v,
               const Real* s, const MaterialRows<Real>& material, Real scale, Real* up, Real* down) const {
    if (starts_[std::size_t(line)] < starts_[std::size_t(line) + 1])
      correct_line(order, line, columns, stride, v, s, material, scale, up, down);
  }

 private:
  bool any_of_line(std::int64_t line, const IndexRange& columns) const;
  template <class Real>
  void correct_line(int order, std::int64_t line, const IndexRange& columns, std::int64_t stride,
                    const Real* v, const Real* s, const MaterialRows<Real>& material, Real scale, Real* up,
                    Real* down) const;
  Wave wave_ = wave_p;
  std::vector<InterfaceStencil> cells_;  // by line, then x
  std::vector<std::int64_t> starts_;     // of each line in cells_, and the end
};

}  // namespace slipwave::solver
