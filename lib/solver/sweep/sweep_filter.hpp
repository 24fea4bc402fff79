// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "solver/sweep/state.hpp"
#include "solver/sweep/workspace.hpp"

namespace slipwave::solver {

/// The end of time step number `step` (0-based).
struct StepTime {
  std::int64_t step = 0;
  double dt_s = 0;
  double end_s() const { return double(step + 1) * dt_s; }
};

/// How many steps rows may be apart.
inline constexpr std::int64_t most_steps_in_progress = 32;

/// The sweep that comes next, along which axis: none where that is -1.
struct NextSweep {
  int axis = -1;
  SweepTime time{};
};

/// Cells of a row that a sweep has advanced, of an effect that filters what it added.
template <int D, class Real>
struct SweptCells {
  int axis;
  Real fraction;  // of the step
  const Index<D>& row;
  IndexRange cells;
  std::span<const int> field_rows;  // that the sweep changes
  /// These four are of the first cell: `before` points to those field rows before the sweep, one after
  /// another, `now` to field row 0 now.
  const Real* before;
  std::int64_t before_pitch;
  Real* now;
  std::int64_t pitch;
  SweepTime time{};
};

/// What changes the increments that sweeps add to the fields: all that sweeps know of an effect.
template <int D, class Real>
class SweepFilter {
 public:
  virtual ~SweepFilter() = default;
  /// Cells of these whose changes by a sweep along `axis` it filters: up to two ranges in order, else empty.
  virtual std::array<IndexRange, 2> filtered(int /*axis*/, const Index<D>& /*row*/, const IndexRange&) const {
    return {};
  }
  /// Changes the increments in such a range.
  virtual void filter(const SweptCells<D, Real>&) {}
  /// The sweep before which it changes cells, when such a one over that fraction of the step has been made.
  virtual NextSweep next(const SweepTime&, Real /*fraction*/) const { return {}; }
  /// Changes those cells that it filters in the sweep to come, `swept.time`: `before` is not set.
  virtual void prepare(const SweptCells<D, Real>&) {}
};

}  // namespace slipwave::solver
