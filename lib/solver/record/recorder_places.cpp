#include <algorithm>
#include <limits>
#include <tuple>
#include <utility>

#include "solver/record/recorder.hpp"

// What is read at the receivers, and where its values are kept.
namespace slipwave::solver {

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
  values_.assign(std::size_t(Effect::most_steps_in_progress * values_a_step_), 0);
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
      const bool goes_on = terms_.size() > first_term_.back() &&
                           terms_.back().value + terms_.back().count == value &&
                           places[std::size_t(value) - 1].second + 1 == weight.place &&
                           places[std::size_t(value) - 1].first == weight.line;
      if (!goes_on) terms_.push_back({value, 0});
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
  constexpr double far = 1e15;
  const auto first = [&](std::int64_t mine) { return smallest_of(ranks_, any ? double(mine) : far); };
  const auto last = [&](std::int64_t mine) { return largest_of(ranks_, any ? double(mine) : -far); };
  const double rows[2] = {first(box_.rows.first + rows_before), last(box_.rows.last + rows_before)};
  const double columns[2] = {first(box_.columns.first), last(box_.columns.last)};
  if (rows[0] > rows[1]) return;
  box_ = {{std::int64_t(rows[0]) - rows_before, std::int64_t(rows[1]) - rows_before},
          {std::int64_t(columns[0]), std::int64_t(columns[1])}};
}

template void Recorder<2, float>::read_all(const Layout<2>&, const std::vector<std::vector<ValueWeight>>&);
template void Recorder<2, float>::find_box(const Layout<2>&, std::int64_t);
template void Recorder<2, double>::read_all(const Layout<2>&, const std::vector<std::vector<ValueWeight>>&);
template void Recorder<2, double>::find_box(const Layout<2>&, std::int64_t);
template void Recorder<3, float>::read_all(const Layout<3>&, const std::vector<std::vector<ValueWeight>>&);
template void Recorder<3, float>::find_box(const Layout<3>&, std::int64_t);
template void Recorder<3, double>::read_all(const Layout<3>&, const std::vector<std::vector<ValueWeight>>&);
template void Recorder<3, double>::find_box(const Layout<3>&, std::int64_t);

}  // namespace slipwave::solver
