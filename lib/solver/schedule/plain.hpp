// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "solver/schedule/executor.hpp"
#include "solver/schedule/halo.hpp"
#include "solver/schedule/time_step.hpp"
#include "solver/sweep/sweeps.hpp"

namespace slipwave::solver {

/// The reference: each entry of the time step on the whole grid, one entry after the other. Slow and short:
/// run() and end() show what a time step is. run() is of one process only.
template <int D, class Real>
class PlainExecutor : public Executor {
 public:
  /// Keeps references.
  PlainExecutor(Sweeps<D, Real>& sweeps, State<D, Real>& state, TimeStep<D, Real>& step);
  /// From now on run_from() has rows of neighbours refreshed; it must outlive this. To be called before the
  /// first step.
  void use(Halo<D, Real>* halo) { halo_ = halo; }
  using Executor::run;
  std::int64_t run(std::int64_t first, std::int64_t last, const std::function<bool()>& pause) override;
  void run_from(const SweepTime& across, std::int64_t number, std::int64_t piece, int worker) override;
  void serialize(Archive& archive) override;
  std::int64_t swept_cells() const override { return swept_; }

 private:
  /// What a thread works with: a row's copy as well.
  struct Worker {
    Workspace<Real> work;
    Buffer<Real> copy;
  };
  void sweep(std::size_t number, const StepTime& time);
  void end(const StepTime& time);
  void after_sweep(std::size_t sweep, const StepTime& time);
  void split_row(const StepTime& time, std::int64_t row, Worker& worker);
  void merged_row(const StepTime& time, std::int64_t row, Worker& worker);

  Sweeps<D, Real>& sweeps_;
  State<D, Real>& state_;
  TimeStep<D, Real>& step_;
  Halo<D, Real>* halo_ = nullptr;
  Real half_;  // fraction of the half sweeps along x
  std::vector<Worker> workers_;
  std::int64_t copy_pitch_, swept_ = 0;
};

}  // namespace slipwave::solver
