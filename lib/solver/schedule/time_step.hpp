// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <variant>
#include <vector>

#include "base/progress.hpp"
#include "scene/splitting.hpp"
#include "solver/effect/effect.hpp"
#include "solver/record/record.hpp"
#include "solver/schedule/patches.hpp"

namespace slipwave::solver {

/// A sweep of all cells along an axis over a fraction of the time step (theory.md (E3)-(E9)), and the effects
/// that filter what it adds.
template <int D, class Real>
struct Sweep {
  int axis;
  double fraction;
  std::vector<Effect<D, Real>*> filters;
};
/// An effect on the fields at the end of the step.
template <int D, class Real>
struct Apply {
  Effect<D, Real>* effect;
  bool after_record;  // what the next step begins with
};
/// Reading the fields at the end of the step.
template <int D, class Real>
struct Read {
  Record<D, Real>* record;
};
/// An effect inside the step, after a sweep along the last axis.
template <int D, class Real>
struct Between {
  Effect<D, Real>* effect;
};
template <int D, class Real>
using Entry = std::variant<Sweep<D, Real>, Apply<D, Real>, Read<D, Real>, Between<D, Real>>;

/// One time step as a list of sweeps, effects and records in order, and the rules by which executors may
/// execute it. Built once from the scene (StepBuilder), independent of how it is executed.
///
/// The first and the last sweep run along x over half a step. Where no effect acts at the end of the step,
/// its last sweep and the first of the next are merged into one over the whole step, and records read a copy
/// that took the first half only. They stay apart where an effect needs the end of the step: on whole rows
/// (splits()), and in patches of other rows: fracture cells and those whose second half sweep reads them.
/// That choice is part of the numerics: a sweep over a step is not two over half of it, to the last digits.
template <int D, class Real>
class TimeStep {
 public:
  TimeStep(const Layout<D>& layout, double dt_s, std::vector<Entry<D, Real>> entries, Patches<D> patches,
           bool all_needed, std::int64_t steps);

  const std::vector<Entry<D, Real>>& entries() const { return entries_; }
  /// The sweeps alone. The first and the last are the half sweeps along x.
  const std::vector<SweepFraction>& sweeps() const { return sweeps_; }
  double dt_s() const { return dt_s_; }
  /// The list as text, one line per entry: "sweep along x, 0.5 (PML)", "slip, second order".
  std::vector<std::string> text() const;

  /// Before the first row of a step, step after step.
  void begin(const StepTime& time);
  /// Does nothing where that step has begun.
  void begin_once(std::int64_t step) {
    if (step > begun_) begin({step, dt_s_});
  }
  /// A sweep along the last axis and those that follow it before the next along that axis. The last of a step
  /// stands for the end of it, the first of the next step included.
  std::vector<SweepTime> from_across(const SweepTime& across) const;
  bool is_last(const SweepTime& time) const { return time.sweep + 1 == sweeps_.size(); }
  /// Whether the half sweeps round the end of that step stay apart on all of a row.
  bool splits(const StepTime& time, std::int64_t row) const {
    return split_rows_[std::size_t(time.step % most_in_progress)][std::size_t(row)];
  }
  const Patches<D>& patches() const { return patches_; }

  /// The kind of cells for the effects at the end of a step: of a row whose half sweeps stay apart, of a
  /// patch of one where they are merged.
  enum class Cells { split, patch };
  /// The effects before the records, in order.
  void apply(const StepTime& time, Cells of, const RowFields<Real>& fields, const IndexRange& cells) const {
    for (auto* effect : acting_[0][std::size_t(of)]) effect->apply(time, fields, cells);
  }
  /// Whether an effect acts between that sweep, one of sweeps(), and the next.
  bool acts_after_sweep(std::size_t sweep) const { return !between_[sweep].empty(); }
  /// Applies the effects that act after that sweep.
  void apply_after_sweep(std::size_t sweep, const StepTime& time, const RowFields<Real>& fields,
                         const IndexRange& cells) const {
    for (auto* effect : between_[sweep]) effect->apply_between(time, fields, cells);
  }
  void read(const StepTime& time, const RowFields<const Real>& fields, const IndexRange& cells) const;
  /// The effects after the records.
  void apply_after_record(const StepTime& time, Cells of, const RowFields<Real>& fields,
                          const IndexRange& cells) const {
    for (auto* effect : acting_[1][std::size_t(of)]) effect->apply_after_record(time, fields, cells);
  }
  /// Ends a step, when all rows have reached its end; called step after step.
  void finish(const StepTime& time);
  /// From now on `progress` (may be null) is called after each finished step.
  void tell(const Progress* progress) { progress_ = progress; }

  /// Whether a record reads anything of the row.
  bool reads(const StepTime& time, std::int64_t row) const;
  /// Whether an effect may change a row whose fields are zero.
  bool injects(const StepTime& time, std::int64_t row) const;
  /// Whether any filter may change cells that are zero; whether one may those of a row.
  bool any_enters() const { return !entering_.empty(); }
  bool enters(const StepTime& time, std::int64_t row, const IndexRange& columns) const {
    for (const auto* effect : entering_)
      if (effect->enters(time, row, columns)) return true;
    return false;
  }
  /// The fields at the end of the step that are read then or later, or that anything read later depends on.
  /// `growth`: by how many rows and columns fields spread in a step at most.
  Box needed(const StepTime& time, const Box& growth) const;

 private:
  static constexpr std::int64_t most_in_progress = most_steps_in_progress;
  static bool acts_on(ActsOn where, Cells cells);

  std::int64_t rows_;
  Index<D> shape_;
  double dt_s_;
  std::vector<Entry<D, Real>> entries_;
  std::vector<SweepFraction> sweeps_;
  std::vector<std::vector<Effect<D, Real>*>> between_;  // [sweep before them]
  std::vector<Effect<D, Real>*> effects_;               // that act at the end of a step
  std::vector<Effect<D, Real>*> entering_;              // filters that do
  std::vector<Record<D, Real>*> records_;
  Patches<D> patches_;
  bool all_needed_;
  std::int64_t steps_, begun_ = -1;
  const Progress* progress_ = nullptr;
  std::array<std::array<std::vector<Effect<D, Real>*>, 2>, 2> acting_;  // [after recording][Cells], in order
  std::array<std::vector<char>, std::size_t(most_in_progress)> split_rows_;  // [step in progress][row]
};

}  // namespace slipwave::solver
