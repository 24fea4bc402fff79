// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>

#include "base/archive.hpp"
#include "solver/kernels/kernels.hpp"
#include "solver/sweep/sweep_filter.hpp"

namespace slipwave::solver {

/// Executes the list of a TimeStep, step after step. All executors give the same bits of fields and records.
class Executor {
 public:
  virtual ~Executor() = default;
  /// Advances by the steps first <= n < last, which begin where the last call ended, from 0 on. Any thread
  /// calls `pause` (may be empty) from time to time; once it returns true, no further step begins. Returns
  /// the first step that was not made.
  virtual std::int64_t run(std::int64_t first, std::int64_t last, const std::function<bool()>& pause) = 0;
  std::int64_t run(std::int64_t first, std::int64_t last) { return run(first, last, {}); }
  /// For grids that advance together (BandedShot), in place of run(): makes one sweep along the last axis and
  /// all that follows before the next along that axis, which may be one of the next step, in the `piece` of
  /// pieces(). Those of one sweep are called one after the other; a piece of the next sweep may be called
  /// once the piece after it is done, and sweep `number` once number - most_at_once() is. All fields must be
  /// zero before the first step.
  virtual void run_from(const SweepTime& across, std::int64_t number, std::int64_t piece, int worker) = 0;
  /// Pieces of a grid, each some rows from low to high.
  virtual std::int64_t pieces() const { return 1; }
  virtual std::int64_t most_at_once() const { return 1; }
  /// To be called when rows beside those that the grid owns have been set from outside.
  virtual void rows_changed(const IndexRange&) {}
  /// To be called when fields have been set from outside.
  virtual void fields_changed() {}
  /// Writes or reads what it retains between two calls of run().
  virtual void serialize(Archive& archive) = 0;
  virtual std::int64_t memory_bytes() const { return 0; }
  /// Cells advanced along z, all sweeps together.
  virtual std::int64_t swept_cells() const = 0;
};

}  // namespace slipwave::solver
