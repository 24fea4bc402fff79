#pragma once

#include <cstdint>
#include <vector>

#include "grid/field.hpp"
#include "solver/kernels/kernels.hpp"
#include "solver/sweep/domain.hpp"
#include "solver/sweep/interface_corrections.hpp"
#include "solver/sweep/interface_stencils.hpp"

namespace slipwave::solver {

/// A cell of a bent row whose stencil across the rows would reach over a strong interface of P or S, or into
/// void: beyond, velocities and tractions are extended along and across the normal of that face by the laws
/// of P and of S (theory.md (E10), (F6)).
struct BentStencil {
  struct Side {
    std::int8_t cells = 0;   // up to the interface or edge, or the reach
    std::int8_t beyond = 0;  // interface: cells beyond it that may be read
    Extension p = Extension::none, s = Extension::none;
    float share_p = 0, share_s = 0;  // interface: Z of the other side over the sum of both
    std::int32_t slot = -1;          // of InterfaceCorrections, -1: none
  };
  std::int32_t x;
  std::int8_t reach;  // of the reconstruction used here, not_carried in void
  bool solid;
  Side low, high;
};

/// Such cells of all bent rows, for sweeps along z.
template <int D, class Real>
class BentStencils {
 public:
  BentStencils() = default;
  BentStencils(const Domain<D>& domain, int reach, const InterfaceCorrections<D, Real>& corrections);

  std::size_t size() const { return cells_.size(); }
  /// Overwrites the outgoing waves of the listed cells of these columns of a row. All pointers begin with the
  /// first of them.
  void correct(int order, std::int64_t line, const IndexRange& columns, Real scale,
               const BentFields<const Real>& fields, const MaterialRows<Real>& material,
               const BentAcross<Real>& metric, const InterfaceCorrections<D, Real>& corrections,
               OutgoingWaves<Real> outgoing) const;

 private:
  std::vector<BentStencil> cells_;    // by line, then x
  std::vector<std::int64_t> starts_;  // of each line in cells_, and the end
};

}  // namespace slipwave::solver
