// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "solver/kernels/kernels.hpp"

namespace slipwave::solver {

/// What happens at faces that sweeps take for welded ones: a treatment changes what a sweep has left in the
/// cells before and behind each of its faces. Where rows are curvilinear there is none.
template <int D, class Real>
class FaceTreatment {
 public:
  virtual ~FaceTreatment() = default;
  /// Whether a face of its own lies between a cell of a line and one of its neighbours along the axis.
  virtual bool beside(int axis, std::int64_t line) const = 0;
  /// Changes what a sweep over `scale` of the step has left in these columns of a line, whose faces before
  /// and behind hold the welded states `lo` and `hi`. Cells are swept more than once where parts of the model
  /// overlap: what is kept for the next sweep may change only with `remember`, with the cell behind the face.
  virtual void add(int axis, std::int64_t line, const IndexRange& columns, Real scale,
                   InterfaceStates<Real> lo, InterfaceStates<Real> hi, const SweptRows<Real>& rows,
                   bool remember) = 0;
  virtual std::int64_t memory_bytes() const = 0;
};

}  // namespace slipwave::solver
