// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "measure.hpp"
#include "scenes.hpp"

namespace slipwave::bench {

/// A shot that is run step by step.
class Shot {
 public:
  explicit Shot(const Case& what);
  ~Shot();
  void run(std::int64_t steps);
  std::int64_t memory_bytes() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Floating-point operations, counted by hand (run.cpp): on a cell in one sweep, of one pair of fields, for
/// its outgoing waves; and on a cell in a step of second order in time.
int flops_of_leaving(int order, bool uniform);
int flops_a_cell_step(int order, bool uniform, bool fluid);
/// Bytes of a cell that a step must move: fields read and written, material read unless it is uniform.
int bytes_a_cell_step(const Case& what);

/// Registers whole steps of this case by this name, with the counters cell_steps_per_s (cells of the model)
/// and flops and bytes per cell-step.
void register_run(const std::string& name, const Case& what);

}  // namespace slipwave::bench
