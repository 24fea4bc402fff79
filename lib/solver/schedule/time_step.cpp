// SPDX-License-Identifier: BSD-3-Clause
#include "solver/schedule/time_step.hpp"

#include <algorithm>
#include <utility>

#include "base/instantiate.hpp"
#include "grid/grid.hpp"

namespace slipwave::solver {

template <int D, class Real>
TimeStep<D, Real>::TimeStep(const Layout<D>& layout, double dt_s, std::vector<Entry<D, Real>> entries,
                            Patches<D> patches, bool all_needed, std::int64_t steps)
    : rows_(layout.lines()),
      shape_(layout.shape()),
      dt_s_(dt_s),
      entries_(std::move(entries)),
      patches_(std::move(patches)),
      all_needed_(all_needed),
      steps_(steps) {
  for (const auto& entry : entries_) {
    if (const auto* sweep = std::get_if<Sweep<D, Real>>(&entry)) {
      sweeps_.push_back({sweep->axis, sweep->fraction});
      for (auto* filter : sweep->filters)
        if (sweeps_.size() == 1 && filter->declaration().enters_sweeps) entering_.push_back(filter);
      between_.emplace_back();
    }
    if (const auto* between = std::get_if<Between<D, Real>>(&entry))
      between_.back().push_back(between->effect);
    if (const auto* read = std::get_if<Read<D, Real>>(&entry)) records_.push_back(read->record);
    if (const auto* apply = std::get_if<Apply<D, Real>>(&entry); apply && !apply->after_record)
      effects_.push_back(apply->effect);
  }
  for (const auto& entry : entries_)
    if (const auto* apply = std::get_if<Apply<D, Real>>(&entry))
      for (const auto cells : {Cells::split, Cells::patch})
        if (acts_on(apply->effect->declaration().acts_on, cells))
          acting_[apply->after_record][std::size_t(cells)].push_back(apply->effect);
}

template <int D, class Real>
bool TimeStep<D, Real>::acts_on(ActsOn where, Cells cells) {
  return cells == Cells::split ? where != ActsOn::nothing : where == ActsOn::fracture_cells;
}

template <int D, class Real>
std::vector<std::string> TimeStep<D, Real>::text() const {
  std::vector<std::string> lines;
  for (const auto& entry : entries_) {
    if (const auto* sweep = std::get_if<Sweep<D, Real>>(&entry)) {
      lines.push_back("sweep along " + std::string(1, axis_names<D>()[std::size_t(sweep->axis)]) + ", " +
                      shown(sweep->fraction));
      for (const auto* filter : sweep->filters) lines.back() += " (" + filter->name() + ")";
    }
    if (const auto* apply = std::get_if<Apply<D, Real>>(&entry))
      lines.push_back(apply->effect->name() + (apply->after_record ? ", after recording" : ""));
    if (std::holds_alternative<Read<D, Real>>(entry)) lines.emplace_back("record");
    if (const auto* between = std::get_if<Between<D, Real>>(&entry)) lines.push_back(between->effect->name());
  }
  return lines;
}

template <int D, class Real>
std::vector<SweepTime> TimeStep<D, Real>::from_across(const SweepTime& across) const {
  std::vector<SweepTime> part = {across};
  for (SweepTime next = across;;) {
    if (is_last(next))
      next = {next.step + 1, 1};
    else
      ++next.sweep;
    if (next.step == steps_ || sweeps_[next.sweep].axis == D - 1) return part;
    part.push_back(next);
  }
}

template <int D, class Real>
void TimeStep<D, Real>::begin(const StepTime& time) {
  begun_ = time.step;
  auto& split = split_rows_[std::size_t(time.step % most_in_progress)];
  split.assign(std::size_t(rows_), 0);
  for (const auto row : patches_.whole_lines()) split[std::size_t(row)] = 1;
  for (auto* filter : entering_) filter->begin(time);
  for (auto* effect : effects_) {
    effect->begin(time);
    if (!effect->active(time)) continue;
    for (const auto row : effect->rows()) split[std::size_t(row)] = 1;
  }
}

template <int D, class Real>
void TimeStep<D, Real>::read(const StepTime& time, const RowFields<const Real>& fields,
                             const IndexRange& cells) const {
  for (auto* record : records_) record->read(time, fields, cells);
}

template <int D, class Real>
void TimeStep<D, Real>::finish(const StepTime& time) {
  for (auto* record : records_) record->finish(time);
  if (progress_ && *progress_) (*progress_)(time.step + 1, steps_);
}

template <int D, class Real>
bool TimeStep<D, Real>::reads(const StepTime& time, std::int64_t row) const {
  return std::any_of(records_.begin(), records_.end(),
                     [&](const auto* record) { return record->reads(time, row); });
}

template <int D, class Real>
bool TimeStep<D, Real>::injects(const StepTime& time, std::int64_t row) const {
  return std::any_of(effects_.begin(), effects_.end(),
                     [&](const auto* effect) { return effect->injects(time, row); });
}

template <int D, class Real>
Box TimeStep<D, Real>::needed(const StepTime& time, const Box& growth) const {
  const Box all{{0, shape_[D - 1]}, {0, shape_[D - 2]}};
  if (all_needed_ || records_.empty()) return all;
  // The sweep along x that the first step begins with is one more.
  const auto steps = steps_ - time.step + 1;
  const auto spread = [steps](const IndexRange& read, const IndexRange& by) {
    return IndexRange{read.first - steps * by.first, read.last + steps * by.last};
  };
  const Box read = records_.front()->box();
  return {spread(read.rows, growth.rows), spread(read.columns, growth.columns)};
}

SLIPWAVE_INSTANTIATE_D_REAL(TYPE, class TimeStep);

}  // namespace slipwave::solver
