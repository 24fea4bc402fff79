#include "solver/record/recorder.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <tuple>
#include <utility>

#include "base/error.hpp"
#include "scene/empty_gather.hpp"
#include "solver/record/component_weights.hpp"

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
  const auto weights = all_weights(layout, domain, scene, shot);
  find_spans(scene, shot);
  history_.assign(std::size_t(kept) * series(), 0);
  sums_.resize(series());
  read_all(layout, weights);
  find_box(layout, domain.grid.first[D - 1]);
}

template <int D, class Real>
std::vector<std::vector<ValueWeight>> Recorder<D, Real>::all_weights(const Layout<D>& layout,
                                                                     const Domain<D>& domain,
                                                                     const Scene<D>& scene,
                                                                     std::size_t shot) {
  std::vector<std::vector<ValueWeight>> firsts, seconds;
  const auto receivers = scene.survey.receivers_of(shot);
  const auto owned = [&](const Point<D>& point) { return domain.subdomain.owns(domain.model_grid, point); };
  // The mean strain rate is the difference of the velocities at both ends, along the fibre, over its length.
  const auto end_weights = [&](const Point<D>& end, double sign) {
    auto vector = direction_of<D>(*scene.recording.fibre);
    for (auto& part : vector) part *= sign / scene.recording.fibre->gauge_m;
    return owned(end) ? velocity_along<D>(layout, domain, end, vector) : std::vector<ValueWeight>{};
  };
  for (const Component component : scene.recording.components)
    for (const auto& receiver : receivers) {
      const auto& point_m = receiver.point_m;
      if (component == Component::das) {
        const auto ends = gauge_ends<D>(*scene.recording.fibre, point_m);
        second_ends_.push_back({firsts.size(), {}});
        second_ends_.back().samples.reserve(std::size_t(gather_.axis.count));
        seconds.push_back(end_weights(ends[0], -1));
        firsts.push_back(end_weights(ends[1], 1));
      } else {
        firsts.emplace_back();
        if (owned(point_m)) firsts.back() = component_weights<D>(layout, domain, point_m, component);
      }
    }
  firsts.insert(firsts.end(), seconds.begin(), seconds.end());
  return firsts;
}

template <int D, class Real>
void Recorder<D, Real>::find_spans(const Scene<D>& scene, std::size_t shot) {
  const auto receivers = scene.survey.receiver_count(shot);
  for (const Component component : scene.recording.components) {
    const auto what = row_of(component).in_time;
    if (spans_.empty() || spans_.back().what != what)
      spans_.push_back(
          {spans_.empty() ? 0 : spans_.back().last, spans_.empty() ? 0 : spans_.back().last, what});
    spans_.back().last += receivers;
    any_integral_ = any_integral_ || what == InTime::integral;
  }
  if (!second_ends_.empty()) spans_.push_back({gather_.traces.size(), series(), InTime::value});
  if (any_integral_) integrals_.assign(series(), 0);
}

/// Series that no rank but one has weights for are zero on the others.
template <int D, class Real>
Gather Recorder<D, Real>::take() {
  if (ranks_) {
    std::vector<std::int64_t> mine;  // number of a series, its samples
    std::vector<double> samples;
    for (std::size_t n = 0; n < series(); ++n) {
      if (first_term_[n] == first_term_[n + 1]) continue;
      const auto& of_series = samples_of(n);
      mine.insert(mine.end(), {std::int64_t(n), std::int64_t(of_series.size())});
      samples.insert(samples.end(), of_series.begin(), of_series.end());
    }
    const auto all = gather_on_first(*ranks_, mine);
    samples = gather_on_first(*ranks_, samples);
    auto next = samples.begin();
    for (std::size_t n = 0; n < all.size(); n += 2) {
      const auto end = next + std::ptrdiff_t(all[n + 1]);
      samples_of(std::size_t(all[n])).assign(next, end);
      next = end;
    }
  }
  for (const auto& [trace, samples] : second_ends_) {
    auto& sum = gather_.traces[trace].samples;
    for (std::size_t n = 0; n < sum.size(); ++n) sum[n] += samples[n];
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
  if (any_integral_) return true;
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
  const std::int64_t instant = time.step + 1;
  if (wants(time)) {
    double* const now = history_.data() + instant % kept * std::int64_t(series());
    const Real* const values = values_of(time);
    const double* weights = weights_.data();
    for (std::size_t one = 0; one < series(); ++one) {
      SideBySide sum;
      for (auto n = first_term_[one]; n < first_term_[one + 1]; ++n) {
        sum.add(weights, values + terms_[n].value, terms_[n].count);
        weights += terms_[n].count;
      }
      now[one] = sum.total() / unit_;
    }
  }
  interpolate(instant, time.dt_s);
}

/// Before t = 0 nothing moves: those instants count as zero.
template <int D, class Real>
void Recorder<D, Real>::add_to_sums(const TimeWeights& weights, double factor, std::size_t first,
                                    std::size_t last) {
  for (int n = 0; n < weights.count; ++n) {
    const std::int64_t instant = weights.first + n;
    if (instant < 0) continue;
    const double weight = weights.weights[std::size_t(n)] * factor;
    const double* const then = history_.data() + instant % kept * std::int64_t(series());
    for (std::size_t one = first; one < last; ++one) sums_[one] += weight * then[one];
  }
}

/// All samples whose eight steps are there. Integrals then advance to the next step: samples lie behind it.
template <int D, class Real>
void Recorder<D, Real>::interpolate(std::int64_t newest, double dt_s) {
  const std::int64_t oldest = newest - kept + 1, before = newest - kept / 2;
  for (; next_sample_ < gather_.axis.count; ++next_sample_) {
    if (steps_before(next_sample_, dt_s) > before) break;
    const double at = steps_at(next_sample_, dt_s);
    std::fill(sums_.begin(), sums_.end(), 0.);
    for (const auto& [first, last, what] : spans_) {
      if (what == InTime::value) add_to_sums(time_weights(at, oldest, newest), 1, first, last);
      if (what == InTime::derivative) add_to_sums(time_slopes(at, oldest, newest), 1 / dt_s, first, last);
      if (what != InTime::integral) continue;
      add_to_sums(time_integrals(double(before), at, oldest, newest), dt_s, first, last);
      for (std::size_t one = first; one < last; ++one) sums_[one] += integrals_[one];
    }
    for (std::size_t one = 0; one < series(); ++one) samples_of(one).push_back(sums_[one]);
  }
  if (!any_integral_ || before < 0) return;
  std::fill(sums_.begin(), sums_.end(), 0.);
  for (const auto& [first, last, what] : spans_) {
    if (what != InTime::integral) continue;
    add_to_sums(time_integrals(double(before), double(before) + 1, oldest, newest), dt_s, first, last);
    for (std::size_t one = first; one < last; ++one) integrals_[one] += sums_[one];
  }
}

template <int D, class Real>
void Recorder<D, Real>::serialize(Archive& archive) {
  archive.value(next_sample_);
  archive.fixed(history_);
  if (any_integral_) archive.fixed(integrals_);
  for (std::size_t one = 0; one < series(); ++one) {
    auto& samples = samples_of(one);
    archive.values(samples);
    if (std::int64_t(samples.size()) != next_sample_ || next_sample_ > gather_.axis.count)
      throw Error("found a trace of " + std::to_string(samples.size()) + " samples, expected " +
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
