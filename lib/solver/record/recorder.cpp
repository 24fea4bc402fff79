#include "solver/record/recorder.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <tuple>
#include <utility>

#include "acquisition/interpolation.hpp"
#include "base/error.hpp"
#include "scene/empty_gather.hpp"

namespace slipwave::solver {
namespace {

/// A sum of products as four sums that do not wait for each other.
class SideBySide {
 public:
  template <class Real>
  void add(const double* weights, const Real* values, std::int64_t count) {
    std::int64_t n = 0;
    for (; n + width <= count; n += width)
      for (int i = 0; i < width; ++i) sums_[i] += weights[n + i] * double(values[n + i]);
    for (; n < count; ++n) sums_[0] += weights[n] * double(values[n]);
  }
  double total() const { return (sums_[0] + sums_[1]) + (sums_[2] + sums_[3]); }

 private:
  static constexpr int width = 4;
  double sums_[width] = {};
};

}  // namespace

template <int D, class Real>
Recorder<D, Real>::Recorder(const Layout<D>& layout, const Domain<D>& domain, const Scene<D>& scene,
                            std::size_t shot, double unit, Ranks* ranks)
    : ranks_(ranks), gather_(empty_gather(scene, shot, ranks)), unit_(unit) {
  std::vector<std::vector<ValueWeight>> of_traces;
  const auto receivers = scene.survey.receivers_of(shot);
  for (const Component component : scene.recording.components)
    for (const auto& receiver : receivers) {
      of_traces.emplace_back();
      if (domain.subdomain.owns(domain.model_grid, receiver.point_m))
        of_traces.back() = component_weights<D>(layout, domain, receiver.point_m, component);
    }
  history_.assign(std::size_t(kept) * gather_.traces.size(), 0);
  sums_.resize(gather_.traces.size());
  read_all(layout, of_traces);
  find_box(layout, domain.grid.first[D - 1]);
}

/// Traces that no rank but one has weights for are zero on the others.
template <int D, class Real>
Gather Recorder<D, Real>::take() {
  if (!ranks_) return std::move(gather_);
  std::vector<std::int64_t> mine;  // number of a trace, its samples
  std::vector<double> samples;
  for (std::size_t n = 0; n < gather_.traces.size(); ++n) {
    if (first_term_[n] == first_term_[n + 1]) continue;
    const auto& of_trace = gather_.traces[n].samples;
    mine.insert(mine.end(), {std::int64_t(n), std::int64_t(of_trace.size())});
    samples.insert(samples.end(), of_trace.begin(), of_trace.end());
  }
  const auto traces = gather_on_first(*ranks_, mine);
  samples = gather_on_first(*ranks_, samples);
  auto next = samples.begin();
  for (std::size_t n = 0; n < traces.size(); n += 2) {
    const auto end = next + std::ptrdiff_t(traces[n + 1]);
    gather_.traces[std::size_t(traces[n])].samples.assign(next, end);
    next = end;
  }
  return std::move(gather_);
}

template <int D, class Real>
std::int64_t Recorder<D, Real>::steps_needed(const Recording& recording, double dt_s) {
  const double last = double(recording.samples() - 1) * recording.interval_s;
  return std::int64_t(std::ceil(last / dt_s)) + kept / 2;
}

template <int D, class Real>
bool Recorder<D, Real>::wants(const StepTime& time) const {
  const std::int64_t instant = time.step + 1;
  // The first sample that may still need it, or one before it.
  constexpr std::int64_t half = kept / 2;
  const double first = double(instant - half) * time.dt_s / gather_.axis.interval_s;
  for (auto n = std::max<std::int64_t>(0, std::int64_t(std::floor(first)) - 1); n < gather_.axis.count; ++n) {
    const auto before = steps_before(n, time.dt_s);
    if (before - half + 1 > instant) return false;
    if (before + half >= instant) return true;
  }
  return false;
}

template <int D, class Real>
void Recorder<D, Real>::read(const StepTime& time, const RowFields<const Real>& fields,
                             const IndexRange& columns) {
  const auto line = fields.row;
  if (!reads(time, line)) return;
  Real* const values = values_of(time);
  for (auto n = starts_[std::size_t(line)]; n < starts_[std::size_t(line) + 1]; ++n) {
    const auto end = runs_.begin() + std::ptrdiff_t(rows_[n].last);
    auto run = std::partition_point(runs_.begin() + std::ptrdiff_t(rows_[n].first), end,
                                    [&](const Run& one) { return one.last <= columns.first; });
    const Real* const row = fields.field(rows_[n].row);
    for (; run != end && run->first < columns.last; ++run) {
      const auto first = std::max(run->first, columns.first), last = std::min(run->last, columns.last);
      std::copy(row + first, row + last, values + run->value + first - run->first);
    }
  }
}

template <int D, class Real>
void Recorder<D, Real>::finish(const StepTime& time) {
  const auto traces = gather_.traces.size();
  const std::int64_t instant = time.step + 1;
  if (wants(time)) {
    double* const now = history_.data() + instant % kept * std::int64_t(traces);
    const Real* const values = values_of(time);
    const double* weights = weights_.data();
    for (std::size_t trace = 0; trace < traces; ++trace) {
      SideBySide sum;
      for (auto n = first_term_[trace]; n < first_term_[trace + 1]; ++n) {
        sum.add(weights, values + terms_[n].value, terms_[n].count);
        weights += terms_[n].count;
      }
      now[trace] = sum.total() / unit_;
    }
  }
  interpolate(instant, time.dt_s);
}

/// All samples whose eight steps are there. Before t = 0 nothing moves: those instants count as zero.
template <int D, class Real>
void Recorder<D, Real>::interpolate(std::int64_t newest, double dt_s) {
  const auto traces = gather_.traces.size();
  for (; next_sample_ < gather_.axis.count; ++next_sample_) {
    if (steps_before(next_sample_, dt_s) + kept / 2 > newest) return;
    const auto weights = time_weights(steps_at(next_sample_, dt_s), newest - kept + 1, newest);
    std::fill(sums_.begin(), sums_.end(), 0.);
    for (int n = 0; n < weights.count; ++n) {
      const std::int64_t instant = weights.first + n;
      if (instant < 0) continue;
      const double weight = weights.weights[std::size_t(n)];
      const double* const then = history_.data() + instant % kept * std::int64_t(traces);
      for (std::size_t trace = 0; trace < traces; ++trace) sums_[trace] += weight * then[trace];
    }
    for (std::size_t trace = 0; trace < traces; ++trace)
      gather_.traces[trace].samples.push_back(sums_[trace]);
  }
}

template <int D, class Real>
void Recorder<D, Real>::serialize(Archive& archive) {
  archive.value(next_sample_);
  archive.fixed(history_);
  for (auto& trace : gather_.traces) {
    archive.values(trace.samples);
    if (std::int64_t(trace.samples.size()) != next_sample_ || next_sample_ > gather_.axis.count)
      throw Error("found a trace of " + std::to_string(trace.samples.size()) + " samples, expected " +
                  std::to_string(next_sample_));
  }
}

/// Finds the cells to read and where among their values those of each trace stand.
template <int D, class Real>
void Recorder<D, Real>::read_all(const Layout<D>& layout,
                                 const std::vector<std::vector<ValueWeight>>& of_traces) {
  std::vector<std::pair<std::int64_t, std::int64_t>> places;  // line, place on it
  for (const auto& weights : of_traces)
    for (const auto& weight : weights) places.emplace_back(weight.line, weight.place);
  std::sort(places.begin(), places.end());
  places.erase(std::unique(places.begin(), places.end()), places.end());
  values_a_step_ = std::int64_t(places.size());
  values_.assign(std::size_t(Effect<D, Real>::most_steps_in_progress * values_a_step_), 0);
  for (std::size_t n = 0; n < places.size(); ++n) {
    const auto [line, place] = places[n];
    const auto column = layout.column(place);
    const int row = int(place / layout.row_pitch());
    const bool same_line = starts_.size() == std::size_t(line) + 1;
    if (!same_line) starts_.resize(std::size_t(line) + 1, rows_.size());
    if (!same_line || rows_.back().row != row) rows_.push_back({row, runs_.size(), runs_.size()});
    if (rows_.back().first == runs_.size() || runs_.back().last != column) {
      runs_.push_back({column, column, std::int64_t(n)});
      rows_.back().last = runs_.size();
    }
    ++runs_.back().last;
  }
  starts_.resize(std::size_t(layout.lines()) + 1, rows_.size());

  for (auto weights : of_traces) {
    first_term_.push_back(terms_.size());
    std::stable_sort(weights.begin(), weights.end(), [](const ValueWeight& one, const ValueWeight& other) {
      return std::tie(one.line, one.place) < std::tie(other.line, other.place);
    });
    for (const auto& weight : weights) {
      const auto at = std::pair(weight.line, weight.place);
      const auto value = std::lower_bound(places.begin(), places.end(), at) - places.begin();
      weights_.push_back(weight.weight);
      const bool continues = terms_.size() > first_term_.back() &&
                             terms_.back().value + terms_.back().count == value &&
                             places[std::size_t(value) - 1].second + 1 == weight.place &&
                             places[std::size_t(value) - 1].first == weight.line;
      if (!continues) terms_.push_back({value, 0});
      ++terms_.back().count;
    }
  }
  first_term_.push_back(terms_.size());
}

template <int D, class Real>
void Recorder<D, Real>::find_box(const Layout<D>& layout, std::int64_t rows_before) {
  constexpr auto none = std::numeric_limits<std::int64_t>::max();
  box_ = {{none, 0}, {none, 0}};
  const auto hold = [](IndexRange& range, std::int64_t n) {
    range = {std::min(range.first, n), std::max(range.last, n + 1)};
  };
  for (std::int64_t line = 0; line < layout.lines(); ++line)
    for (auto row = starts_[std::size_t(line)]; row < starts_[std::size_t(line) + 1]; ++row)
      for (auto n = rows_[row].first; n < rows_[row].last; ++n)
        for (const auto column : {runs_[n].first, runs_[n].last - 1}) {
          auto at = layout.line_index(line);
          at[0] = column;
          hold(box_.rows, at[D - 1]);
          hold(box_.columns, at[D - 2]);
        }
  if (!ranks_) return;
  const bool any = !runs_.empty();
  constexpr std::int64_t far = std::int64_t(1) << 60;
  const auto whole = [&](const IndexRange& mine, std::int64_t before) {
    return IndexRange{smallest_of(ranks_, any ? mine.first + before : far) - before,
                      largest_of(ranks_, any ? mine.last + before : -far) - before};
  };
  const Box read{whole(box_.rows, rows_before), whole(box_.columns, 0)};
  if (!read.rows.empty()) box_ = read;
}

template class Recorder<2, float>;
template class Recorder<2, double>;
template class Recorder<3, float>;
template class Recorder<3, double>;

}  // namespace slipwave::solver
