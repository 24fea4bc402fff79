#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "grid/field.hpp"
#include "solver/kernels/kernels.hpp"
#include "solver/sweep/domain.hpp"
#include "solver/sweep/interface_corrections.hpp"
#include "solver/sweep/interface_stencils.hpp"
#include "solver/sweep/metric.hpp"
#include "solver/sweep/row_waves.hpp"

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

/// What replaces the laws of P and of S where a cell or its neighbour beyond an interface is anisotropic
/// (theory.md (F13)).
template <int D, class Real>
struct AnisotropicStencil {
  /// Of the velocities z, x and in 3-D y, (Z_l + Z_r)^-1 Z_r for the cell as l.
  struct Weld {
    bool holds = false;
    SmallMatrix<std::size_t(D), Real> share{};
  };
  std::array<Weld, 2> welds;
  bool own_waves = false;
  RowWaves<D, Real> waves{};
};

/// Such cells of all bent rows, for sweeps along z.
template <int D, class Real>
class BentStencils {
 public:
  BentStencils() = default;
  BentStencils(const Domain<D>& domain, int reach, const InterfaceCorrections<D, Real>& corrections,
               const Metric<D, Real>& metric);

  std::size_t size() const { return cells_.size(); }
  std::int64_t memory_bytes() const {
    return bytes_of(cells_) + bytes_of(starts_) + bytes_of(anisotropic_of_) + bytes_of(anisotropic_);
  }
  /// Overwrites the outgoing waves of the listed cells of these columns of a row. All pointers begin with the
  /// first of them.
  void correct(int order, std::int64_t line, const IndexRange& columns, Real scale,
               const BentFields<const Real>& fields, const MaterialRows<Real>& material,
               const BentAcross<Real>& metric, const InterfaceCorrections<D, Real>& corrections,
               OutgoingWaves<Real> outgoing) const;

 private:
  void find_anisotropic(const Domain<D>& domain, const Metric<D, Real>& metric);
  using Anisotropic = AnisotropicStencil<D, Real>;
  /// `of`: the metric from the cell on.
  static RowWaves<D, Real> own_waves(const Domain<D>& domain, const Index<D>& at, const BentAcross<Real>& of);
  /// Of a face with this N between two cells.
  static void find_weld(const Domain<D>& domain, const Index<D>& near, const Index<D>& beyond,
                        const RowVector<D, Real>& normal, typename Anisotropic::Weld& weld);

  std::vector<BentStencil> cells_;    // by line, then x
  std::vector<std::int64_t> starts_;  // of each line in cells_, and the end
  /// Of cells that have one, by their place in cells_; empty where nothing is anisotropic.
  std::vector<std::int32_t> anisotropic_of_;
  std::vector<Anisotropic> anisotropic_;
};

}  // namespace slipwave::solver
