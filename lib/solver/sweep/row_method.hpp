// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>

#include "grid/grid.hpp"
#include "solver/kernels/kernels.hpp"
#include "solver/sweep/workspace.hpp"

namespace slipwave::solver {

/// Cells of a line that a sweep advances, and where their fields stand: in the state or in a copy.
template <int D, class Real>
struct RowPart {
  int axis;
  Index<D> at;        // of the line
  std::int64_t line;  // its number (Layout)
  IndexRange columns;
  Real* fields;        // cell 0 of field row 0
  std::int64_t pitch;  // to the next field row
  Real scale;          // fraction of the step
  bool remember;       // false of copies ahead: effects keep no memory of them

  /// A field of the first of the cells.
  Real* field(int row) const { return fields + row * pitch + columns.first; }
};

/// What the update of cells reads, beginning with the first of them: the interface states before and behind
/// them, the outgoing waves of them and their neighbours.
template <class Real>
struct RowFlux {
  InterfaceStates<Real> lo, hi;
  OutgoingWaves<Real> below, here, above;
};

/// Faces across an axis before the cells of some columns of a line.
template <int D, class Real>
struct RowFaces {
  int axis;
  std::array<Index<D>, 2> at;         // the lines of the cells before and behind them
  std::array<std::int64_t, 2> lines;  // their numbers, -1 beyond the grid
  IndexRange columns;                 // of the cells behind them
  OutgoingWaves<Real> below, above;   // of the cells before and behind the first face
  InterfaceStates<Real> states;       // of the first face
  Real scale;                         // fraction of the step

  /// Columns from the cell before a face to the one behind it.
  std::int64_t shift() const { return axis == 0 ? 1 : 0; }
};

/// The way in which a sweep takes the cells of a row and their faces: one for level rows, one for curvilinear
/// ones. Between its loops it prefetches a share of the queue.
template <int D, class Real>
class RowMethod {
 public:
  virtual ~RowMethod() = default;
  /// Writes the outgoing waves of the cells, the first of which `outgoing` points to; `stride` leads from a
  /// cell to the next one along the axis.
  virtual void reconstruct(const RowPart<D, Real>& part, std::int64_t stride, OutgoingWaves<Real> outgoing,
                           PrefetchQueue<Real>& prefetch) const = 0;
  /// Writes the interface states of faces.
  virtual void solve(const RowFaces<D, Real>& faces) const = 0;
  /// Advances the fields of the cells.
  virtual void update(const RowPart<D, Real>& part, const RowFlux<Real>& flux,
                      PrefetchQueue<Real>& prefetch) const = 0;
};

}  // namespace slipwave::solver
