// SPDX-License-Identifier: BSD-3-Clause
#include "solver/schedule/plain.hpp"

#include <algorithm>

#include "base/instantiate.hpp"
#include "parallel/threads.hpp"
#include "solver/schedule/active_cells.hpp"

namespace slipwave::solver {

template <int D, class Real>
PlainExecutor<D, Real>::PlainExecutor(Sweeps<D, Real>& sweeps, State<D, Real>& state, TimeStep<D, Real>& step)
    : sweeps_(sweeps),
      state_(state),
      step_(step),
      half_(Real(step.sweeps().front().fraction)),
      copy_pitch_(state.layout.row_pitch()) {
  for (int n = 0; n < parallel_workers(); ++n)
    workers_.push_back(
        {sweeps.make_workspace(state.layout.padded_nx()), Buffer<Real>(copy_pitch_ * state.layout.rows())});
}

/// A step is its list of sweeps but the last, along x, then end(), which contains that last half
/// sweep and the first one of the next step. The very first half sweep comes before all steps.
template <int D, class Real>
std::int64_t PlainExecutor<D, Real>::run(std::int64_t first, std::int64_t last,
                                         const std::function<bool()>& pause) {
  const auto& sweeps = step_.sweeps();
  if (first == 0) sweeps_.along(0, half_);
  for (auto n = first; n < last; ++n) {
    if (n > first && pause && pause()) return n;
    const StepTime time{n, step_.dt_s()};
    step_.begin(time);
    for (std::size_t k = 1; k + 1 < sweeps.size(); ++k) sweep(k, time);
    end(time);
  }
  return last;
}

template <int D, class Real>
void PlainExecutor<D, Real>::run_from(const SweepTime& across, std::int64_t, std::int64_t, int) {
  const auto rows = state_.layout.shape()[D - 1];
  if (halo_) halo_->before({0, rows});
  for (const auto& at : step_.from_across(across)) {
    const StepTime time{at.step, step_.dt_s()};
    step_.begin_once(at.step);
    step_.is_last(at) ? end(time) : sweep(at.sweep, time);
  }
  if (halo_) halo_->after(0, rows);
}

template <int D, class Real>
void PlainExecutor<D, Real>::sweep(std::size_t number, const StepTime& time) {
  const auto& [axis, fraction] = step_.sweeps()[number];
  sweeps_.along(axis, Real(fraction), {time.step, number});
  after_sweep(number, time);
  if (axis == D - 1) swept_ += state_.layout.shape()[0] * sweeps_.own_lines().count();
}

template <int D, class Real>
void PlainExecutor<D, Real>::after_sweep(std::size_t sweep, const StepTime& time) {
  if (!step_.acts_after_sweep(sweep)) return;
  for (auto row = sweeps_.own_lines().first; row < sweeps_.own_lines().last; ++row)
    step_.apply_after_sweep(sweep, time, state_.row_fields(row), {0, state_.layout.shape()[0]});
}

/// Rows along x do not depend on each other, except for the velocities that corrections at free sides read.
template <int D, class Real>
void PlainExecutor<D, Real>::end(const StepTime& time) {
  const auto rows = sweeps_.own_lines();
  const IndexRange all{0, state_.layout.shape()[0]};
  if (sweeps_.corrects_surface(0))
    for (std::int64_t row = 0; row < state_.layout.lines(); ++row) sweeps_.retain(0, row, all);
  parallel_for(rows.count(), 4, [&](std::int64_t begin, std::int64_t end, int worker) {
    for (auto row = rows.first + begin; row < rows.first + end; ++row) {
      sweeps_.correct_side_surfaces(row, all);
      if (step_.splits(time, row))
        split_row(time, row, workers_[std::size_t(worker)]);
      else
        merged_row(time, row, workers_[std::size_t(worker)]);
    }
  });
  step_.finish(time);
}

/// Two half sweeps, and between them the effects and records at the end of the step.
template <int D, class Real>
void PlainExecutor<D, Real>::split_row(const StepTime& time, std::int64_t row, Worker& worker) {
  auto& work = worker.work;
  using Cells = typename TimeStep<D, Real>::Cells;
  const IndexRange all{0, state_.layout.shape()[0]};
  const auto fields = state_.row_fields(row);
  StripeBoundary<Real> none{};
  work.time() = {time.step, step_.sweeps().size() - 1};
  sweeps_.along_x(row, all, half_, none, work);
  step_.apply(time, Cells::split, fields, all);
  step_.read(time, fields, all);
  step_.apply_after_record(time, Cells::split, fields, all);
  work.time() = {time.step + 1, 0};
  sweeps_.along_x(row, all, half_, none, work);
}

/// Both half sweeps as one. A copy makes them one after the other: records read the copy, and patches, where
/// effects act between both, are written back from it.
template <int D, class Real>
void PlainExecutor<D, Real>::merged_row(const StepTime& time, std::int64_t row, Worker& worker) {
  auto& work = worker.work;
  using Cells = typename TimeStep<D, Real>::Cells;
  const IndexRange all{0, state_.layout.shape()[0]};
  const auto patches = step_.patches().of(row);
  const RowFields<Real> copy{row, worker.copy.data() + Layout<D>::lead, copy_pitch_};
  StripeBoundary<Real> none{};
  work.time() = {time.step, step_.sweeps().size() - 1};
  sweeps_.copy_ahead(all, half_, copy, work);
  for (const auto& patch : patches) step_.apply(time, Cells::patch, copy, patch.blocks);
  step_.read(time, copy, all);
  for (const auto& patch : patches) step_.apply_after_record(time, Cells::patch, copy, patch.blocks);
  for (const auto& patch : patches) sweeps_.along_copy(copy, patch.blocks, true, half_, none, work);

  sweeps_.along_x(row, all, 2 * half_, none, work);
  for (const auto& patch : patches) sweeps_.put(copy, patch.cells);
}

/// Serializes as the tiled executor does, which stores where fields may be other than zero: here they may be
/// everywhere.
template <int D, class Real>
void PlainExecutor<D, Real>::serialize(Archive& archive) {
  std::vector<char> active(std::size_t(state_.layout.lines() * state_.layout.padded_nx() / Layout<D>::block),
                           1);
  archive.fixed(active);
}

SLIPWAVE_INSTANTIATE_D_REAL(TYPE, class PlainExecutor);

}  // namespace slipwave::solver
