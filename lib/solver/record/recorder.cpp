// SPDX-License-Identifier: BSD-3-Clause
#include "solver/record/recorder.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <tuple>
#include <utility>

#include "base/error.hpp"
#include "base/instantiate.hpp"
#include "scene/empty_gather.hpp"
#include "scene/gauges.hpp"
#include "solver/record/component_weights.hpp"

namespace slipwave::solver {
/// Stretches that overlap or touch stand as one, and their values follow each other, `aligned` to multiples.
Stretches::Stretches(std::vector<Stretch> stretches, std::int64_t aligned) {
  std::sort(stretches.begin(), stretches.end());
  for (const auto& one : stretches)
    if (all_.empty() || all_.back().line != one.line || all_.back().last < one.first)
      all_.push_back(one);
    else
      all_.back().last = std::max(all_.back().last, one.last);
  values_.push_back(0);
  for (const auto& one : all_)
    values_.push_back(values_.back() + (one.last - one.first + aligned - 1) / aligned * aligned);
}

std::int64_t Stretches::value_of(const Stretch& part) const {
  const auto in = std::upper_bound(all_.begin(), all_.end(), part) - all_.begin() - 1;
  return values_[std::size_t(in)] + part.first - all_[std::size_t(in)].first;
}

namespace {

/// Adds the stretches of weights in the order of their places, without the gaps.
void add_stretches(const std::vector<ValueWeight>& weights, std::vector<Stretch>& all) {
  const auto before = all.size();
  for (const auto& weight : weights) {
    const bool continues =
        all.size() > before && all.back().line == weight.line && all.back().last == weight.place;
    if (!continues) all.push_back({weight.line, weight.place, weight.place});
    ++all.back().last;
  }
}

}  // namespace

template <int D, class Real>
Recorder<D, Real>::Recorder(const Layout<D>& layout, const Domain<D>& domain, const Scene<D>& scene,
                            std::size_t shot, double unit, Ranks* ranks)
    : ranks_(ranks),
      gather_(empty_gather(scene, shot, ranks)),
      unit_(unit),
      last_(steps_needed(scene.recording, time_step_s(scene))) {
  auto weights = all_weights(layout, domain, scene, shot);
  find_spans(scene, shot);
  const auto chunks = (series() + series_together - 1) / series_together;
  history_.assign(chunks * std::size_t(kept) * series_together, 0);
  read_all(layout, std::move(weights));
  find_box(layout, domain.grid.first[D - 1]);
}

template <int D, class Real>
std::vector<std::vector<ValueWeight>> Recorder<D, Real>::all_weights(const Layout<D>& layout,
                                                                     const Domain<D>& domain,
                                                                     const Scene<D>& scene,
                                                                     std::size_t shot) {
  std::vector<std::vector<ValueWeight>> firsts, others;
  const auto receivers = scene.survey.receivers_of(shot);
  const auto owned = [&](const Point<D>& point, Side side = Side::solid) {
    return owns_point(domain, point, side);
  };
  const auto weights_at = [&](const GaugePoint<D>& point) {
    return owned(point.at_m) ? velocity_along<D>(layout, domain, point.at_m, point.weight_per_m)
                             : std::vector<ValueWeight>{};
  };
  const auto gauges =
      scene.recording.fibre ? gauges_of(scene, shot) : std::vector<std::vector<GaugePoint<D>>>{};
  for (const Component component : scene.recording.components)
    for (std::size_t n = 0; n < receivers.size(); ++n) {
      if (component == Component::das) {
        for (std::size_t point = 1; point < gauges[n].size(); ++point) {
          gauge_parts_.push_back({firsts.size(), {}});
          gauge_parts_.back().samples.reserve(std::size_t(gather_.axis.count));
          others.push_back(weights_at(gauges[n][point]));
        }
        firsts.push_back(weights_at(gauges[n].front()));
      } else {
        const auto& point_m = receivers[n].point_m;
        firsts.emplace_back();
        if (owned(point_m, component == Component::p ? Side::fluid : Side::solid))
          firsts.back() = component_weights<D>(layout, domain, point_m, component);
      }
    }
  firsts.insert(firsts.end(), others.begin(), others.end());
  return firsts;
}

template <int D, class Real>
void Recorder<D, Real>::find_spans(const Scene<D>& scene, std::size_t shot) {
  receivers_ = scene.survey.receiver_count(shot);
  for (const Component component : scene.recording.components) {
    const auto what = row_of(component).in_time;
    if (spans_.empty() || spans_.back().what != what)
      spans_.push_back(
          {spans_.empty() ? 0 : spans_.back().last, spans_.empty() ? 0 : spans_.back().last, what});
    spans_.back().last += receivers_;
    any_integral_ = any_integral_ || what == InTime::integral;
  }
  if (!gauge_parts_.empty()) spans_.push_back({gather_.traces.size(), series(), InTime::value});
  if (any_integral_) integrals_.assign(series(), 0);
}

/// Series that no rank but one has weights for are zero on the others.
template <int D, class Real>
Gather Recorder<D, Real>::take() {
  catch_up();
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
  for (const auto& [trace, samples] : gauge_parts_) {
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
  Real* const values = values_of(time.step);
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
  newest_ = time.step + 1;
  dt_s_ = time.dt_s;
  if (newest_ - weighed_ == steps_at_once || newest_ == last_) catch_up();
}

/// Makes series of the steps that have ended, and all samples whose eight steps are then there.
template <int D, class Real>
void Recorder<D, Real>::catch_up() {
  if (weighed_ == newest_) return;
  bool wanted = false;
  for (auto step = weighed_; step < newest_; ++step) wanted = wanted || wants({step, dt_s_});
  find_arrivals();
  for (std::size_t chunk = 0; chunk * series_together < series(); ++chunk) {
    const auto first = chunk * series_together, last = std::min(first + series_together, series());
    double* const before = history_.data() + chunk * kept * series_together;
    std::copy(before, before + kept * series_together, recent_.data());
    if (wanted) weigh(chunk, first, last);
    interpolate(first, last);
    const auto* const from = recent_.data() + (newest_ - weighed_) * std::int64_t(series_together);
    std::copy(from, from + kept * series_together, before);
  }
  weighed_ = newest_;
}

template <int D, class Real>
void Recorder<D, Real>::weigh(std::size_t chunk, std::size_t first, std::size_t last) {
  std::array<const Real*, steps_together> steps;
  std::array<double, steps_together> sums;
  for (auto done = weighed_; done < newest_; done += steps_together) {
    const auto count = std::min<std::int64_t>(steps_together, newest_ - done);
    for (auto piece = first_piece_[chunk]; piece < first_piece_[chunk + 1]; ++piece) {
      for (int n = 0; n < steps_together; ++n)
        steps[std::size_t(n)] = values_of(std::min(done + n, newest_ - 1)) + pieces_[piece].value;
      kernels_.bring_together(pieces_[piece].count, steps.data(),
                              together_.data() + pieces_[piece].at * steps_together);
    }
    double* const rows = recent_.data() + (done - weighed_ + kept) * std::int64_t(series_together);
    for (auto one = first; one < last; ++one) {
      // The unit is a power of two.
      kernels_.weigh(together_.data(), terms_.data() + first_term_[one], terms_.data() + first_term_[one + 1],
                     weights_.data() + first_weight_[one], 1 / unit_, sums.data());
      for (std::int64_t n = 0; n < count; ++n)
        rows[std::size_t(n) * series_together + one - first] = sums[std::size_t(n)];
    }
  }
}

/// Once an instant is there, samples up to half of `kept` before it; integrals then advance to the next step:
/// samples lie behind it.
template <int D, class Real>
void Recorder<D, Real>::find_arrivals() {
  arrivals_.clear();
  sample_weights_.clear();
  const auto times = [](TimeWeights weights, double factor) {
    for (auto& weight : weights.weights) weight *= factor;
    return weights;
  };
  for (auto newest = weighed_ + 1; newest <= newest_; ++newest) {
    const std::int64_t oldest = newest - kept + 1, before = newest - kept / 2;
    Arrival arrival{sample_weights_.size(), 0, {}, any_integral_ && before >= 0};
    for (; next_sample_ < gather_.axis.count; ++next_sample_) {
      if (steps_before(next_sample_, dt_s_) > before) break;
      const double at = steps_at(next_sample_, dt_s_);
      WeightsOfKinds weights;
      for (const auto& span : spans_) {
        auto& of_kind = weights[std::size_t(span.what)];
        if (span.what == InTime::value) of_kind = time_weights(at, oldest, newest);
        if (span.what == InTime::derivative) of_kind = times(time_slopes(at, oldest, newest), 1 / dt_s_);
        if (span.what == InTime::integral)
          of_kind = times(time_integrals(double(before), at, oldest, newest), dt_s_);
      }
      sample_weights_.push_back(weights);
    }
    arrival.last_sample = sample_weights_.size();
    if (arrival.advances)
      arrival.advance = times(time_integrals(double(before), double(before) + 1, oldest, newest), dt_s_);
    arrivals_.push_back(arrival);
  }
  new_samples_.resize(sample_weights_.size() * series_together);
}

/// Before t = 0 nothing moves: those instants count as zero.
template <int D, class Real>
void Recorder<D, Real>::combine(const TimeWeights& weights, std::size_t first, std::size_t last,
                                double* sums) const {
  std::array<const double*, kept> rows;
  std::array<double, kept> factors;
  int count = 0;
  for (int n = 0; n < weights.count; ++n) {
    const std::int64_t instant = weights.first + n;
    if (instant < 0) continue;
    rows[std::size_t(count)] =
        recent_.data() + std::size_t(instant - weighed_ + kept - 1) * series_together + first;
    factors[std::size_t(count++)] = weights.weights[std::size_t(n)];
  }
  kernels_.combine(std::int64_t(last - first), count, factors.data(), rows.data(), sums);
}

template <int D, class Real>
void Recorder<D, Real>::interpolate(std::size_t first, std::size_t last) {
  const auto of_spans = [&](auto&& act) {
    for (const auto& span : spans_) {
      const auto from = std::max(span.first, first), to = std::min(span.last, last);
      if (from < to) act(span.what, from, to);
    }
  };
  double* now = new_samples_.data();
  std::array<double, series_together> sums;
  for (const auto& arrival : arrivals_) {
    for (auto n = arrival.first_sample; n < arrival.last_sample; ++n, now += series_together)
      of_spans([&](InTime what, std::size_t from, std::size_t to) {
        combine(sample_weights_[n][std::size_t(what)], from - first, to - first, now + (from - first));
        if (what != InTime::integral) return;
        for (auto one = from; one < to; ++one) now[one - first] += integrals_[one];
      });
    if (!arrival.advances) continue;
    of_spans([&](InTime what, std::size_t from, std::size_t to) {
      if (what != InTime::integral) return;
      combine(arrival.advance, from - first, to - first, sums.data());
      for (auto one = from; one < to; ++one) integrals_[one] += sums[one - from];
    });
  }
  const auto more = sample_weights_.size();
  if (more == 0) return;
  for (auto one = first; one < last; ++one) {
    auto& samples = samples_of(one);
    const auto before = samples.size();
    samples.resize(before + more);
    double* const to = samples.data() + before;
    const double* const from = new_samples_.data() + (one - first);
    for (std::size_t n = 0; n < more; ++n) to[n] = from[n * series_together];
  }
}

template <int D, class Real>
void Recorder<D, Real>::serialize(Archive& archive, std::int64_t done) {
  catch_up();
  newest_ = weighed_ = done;
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

template <int D, class Real>
std::int64_t Recorder<D, Real>::memory_bytes() const {
  const auto doubles = weights_.size() + history_.size() + std::size_t(together_.size()) +
                       series() * std::size_t(gather_.axis.count);
  // The heap keeps what weights took when they were found.
  std::int64_t weights = 0;
  for (const auto& term : terms_) weights += term.count;
  return std::int64_t(doubles * sizeof(double) + values_.size() * sizeof(Real) +
                      terms_.size() * sizeof(SeriesTerm)) +
         weights * std::int64_t(sizeof(ValueWeight));
}

/// Finds the cells to read and where among their values those of each trace stand.
template <int D, class Real>
void Recorder<D, Real>::read_all(const Layout<D>& layout, std::vector<std::vector<ValueWeight>> of_traces) {
  std::vector<Stretch> all;
  for (auto& weights : of_traces) {
    std::stable_sort(weights.begin(), weights.end(), [](const ValueWeight& one, const ValueWeight& other) {
      return std::tie(one.line, one.place) < std::tie(other.line, other.place);
    });
    add_stretches(weights, all);
  }
  const Stretches cells(std::move(all), 1);
  values_a_step_ = cells.values();
  for (std::size_t n = 0; n < cells.all().size(); ++n) {
    const auto& [line, first, last] = cells.all()[n];
    const int row = int(first / layout.row_pitch());
    const bool same_line = starts_.size() == std::size_t(line) + 1;
    if (!same_line) starts_.resize(std::size_t(line) + 1, rows_.size());
    if (!same_line || rows_.back().row != row) rows_.push_back({row, runs_.size(), runs_.size()});
    runs_.push_back({layout.column(first), layout.column(first) + last - first, cells.value(n)});
    rows_.back().last = runs_.size();
  }
  starts_.resize(std::size_t(layout.lines()) + 1, rows_.size());
  for (std::size_t first = 0; first < of_traces.size(); first += series_together)
    add_chunk(std::span(of_traces).subspan(first, std::min(series_together, of_traces.size() - first)),
              cells);
  first_term_.push_back(terms_.size());
  first_piece_.push_back(pieces_.size());
  // Whole vectors are brought together.
  values_.assign(std::size_t(slots * values_a_step_ + values_together), 0);
}

/// Finds the values that these series need, and their weights.
template <int D, class Real>
void Recorder<D, Real>::add_chunk(std::span<const std::vector<ValueWeight>> of_series,
                                  const Stretches& cells) {
  std::vector<Stretch> all;
  for (const auto& weights : of_series) add_stretches(weights, all);
  const Stretches here(std::move(all), values_together);
  first_piece_.push_back(pieces_.size());
  for (std::size_t n = 0; n < here.all().size(); ++n)
    pieces_.push_back({cells.value_of(here.all()[n]), here.value(n + 1) - here.value(n), here.value(n)});
  if (together_.size() < here.values() * steps_together)
    together_ = Buffer<double>(here.values() * steps_together);
  for (const auto& weights : of_series) {
    first_term_.push_back(terms_.size());
    add_stretches(weights, all);
    for (const auto& stretch : all) terms_.push_back({here.value_of(stretch), stretch.last - stretch.first});
    all.clear();
    add_weights(weights);
  }
}

/// Components often have the same weights at a receiver, which then stand once.
template <int D, class Real>
void Recorder<D, Real>::add_weights(const std::vector<ValueWeight>& weights) {
  const auto one = first_weight_.size();
  const auto alike = [](const ValueWeight& weight, double other) { return weight.weight == other; };
  if (one >= receivers_) {
    const auto before = first_weight_[one - receivers_];
    const auto end = before + weights.size();
    if (end <= weights_.size() &&
        std::equal(weights.begin(), weights.end(), weights_.begin() + std::ptrdiff_t(before), alike)) {
      first_weight_.push_back(before);
      return;
    }
  }
  first_weight_.push_back(weights_.size());
  for (const auto& weight : weights) weights_.push_back(weight.weight);
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

SLIPWAVE_INSTANTIATE_D_REAL(TYPE, class Recorder);

}  // namespace slipwave::solver
