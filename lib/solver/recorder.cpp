#include "solver/recorder.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <numeric>
#include <tuple>

#include "acquisition/interpolation.hpp"
#include "base/error.hpp"
#include "grid/locate.hpp"

namespace slipwave::solver {
namespace {

template <int D>
std::array<double, 3> in_space(const Point<D>& point) {
  if constexpr (D == 2) return {point[0], 0, point[1]};
  if constexpr (D == 3) return point;
}

}  // namespace

template <int D>
std::vector<double> water_depths_m(const Medium<D>& medium, const Part& part,
                                   const std::vector<Point<D>>& points_m, Ranks* ranks) {
  const auto& grid = medium.grid();
  std::vector<double>
      found;  // of each point: cells of fluid down to the first rock, and whether there is one
  for (const auto& point : points_m) {
    Index<D> at = cell_of(grid, point);
    double fluid = 0, rock = 0;
    for (at[D - 1] = 0; at[D - 1] < grid.shape[D - 1] && rock == 0; ++at[D - 1]) {
      const auto cell = std::size_t(grid.flat(at));
      if (!part.owns(grid, at[D - 1])) continue;
      if (medium.is_solid(cell)) rock = 1;
      fluid += medium.is_fluid(cell);
    }
    found.insert(found.end(), {fluid, rock});
  }
  found = joined(ranks, found);
  std::vector<double> depths;
  for (std::size_t n = 0; n < points_m.size(); ++n) {
    double fluid = 0;
    bool rock = false;
    for (auto of_part = 2 * n; of_part < found.size() && !rock; of_part += 2 * points_m.size()) {
      fluid += found[of_part];
      rock = found[of_part + 1] != 0;
    }
    depths.push_back(fluid * grid.spacing_m);
  }
  return depths;
}

template <int D, class Real>
Recorder<D, Real>::Recorder(const Layout<D>& layout, const Domain<D>& domain, const Scene<D>& scene,
                            std::size_t shot, double unit, Ranks* ranks)
    : ranks_(ranks), unit_(unit) {
  const auto& source = scene.survey.sources[shot - 1];
  std::vector<ValueWeight> all;
  gather_.axis = {scene.recording.samples(), scene.recording.interval_s, 0};
  TraceHeader header;
  header.shot = std::int64_t(shot);
  header.source_m = in_space<D>(source.position_m);
  std::vector<Point<D>> points = {source.position_m};
  points.insert(points.end(), scene.survey.receivers_m.begin(), scene.survey.receivers_m.end());
  const auto depths = water_depths_m(scene.model.medium, scene.part, points, ranks);
  header.water_depth_source_m = depths.front();
  for (const Component component : scene.recording.components) {
    header.component = component;
    header.channel = 0;
    for (const auto& receiver : scene.survey.receivers_m) {
      ++header.channel;
      header.receiver_m = in_space<D>(receiver);
      header.water_depth_receiver_m = depths[std::size_t(header.channel)];
      gather_.traces.push_back({header, {}});
      gather_.traces.back().samples.reserve(std::size_t(gather_.axis.count));
      first_weight_.push_back(all.size());
      if (!domain.part.owns(domain.model_grid, receiver)) continue;
      for (const auto& weight : component_weights<D>(layout, domain, receiver, component))
        all.push_back(weight);
    }
  }
  first_weight_.push_back(all.size());
  history_.assign(std::size_t(kept) * gather_.traces.size(), 0);
  values_.assign(std::size_t(Pass::most_steps_under_way) * all.size(), 0);
  std::vector<std::size_t> order(all.size());
  std::iota(order.begin(), order.end(), std::size_t(0));
  std::sort(order.begin(), order.end(), [&](std::size_t one, std::size_t other) {
    const auto key = [&](std::size_t n) {
      return std::tuple(all[n].line, layout.column(all[n].place), all[n].place, n);
    };
    return key(one) < key(other);
  });
  for (const auto n : order) {
    starts_.resize(std::size_t(all[n].line) + 1, reads_.size());
    reads_.push_back({layout.column(all[n].place), all[n].place / layout.row_pitch(), n});
  }
  starts_.resize(std::size_t(layout.lines()) + 1, reads_.size());
  for (const auto& weight : all) weights_.push_back(weight.weight);
  find_box(layout, domain.grid.first[D - 1]);
}

template <int D, class Real>
void Recorder<D, Real>::find_box(const Layout<D>& layout, std::int64_t rows_before) {
  constexpr auto none = std::numeric_limits<std::int64_t>::max();
  box_ = {{none, 0}, {none, 0}};
  const auto hold = [](Columns& range, std::int64_t n) {
    range = {std::min(range.first, n), std::max(range.last, n + 1)};
  };
  for (std::int64_t line = 0; line < layout.lines(); ++line)
    for (auto n = starts_[std::size_t(line)]; n < starts_[std::size_t(line) + 1]; ++n) {
      auto at = layout.line_index(line);
      at[0] = reads_[n].column;
      hold(box_.rows, at[D - 1]);
      hold(box_.columns, at[D - 2]);
    }
  if (!ranks_) return;
  const bool any = !reads_.empty();
  constexpr double far = 1e15;
  const auto first = [&](std::int64_t mine) { return smallest_of(ranks_, any ? double(mine) : far); };
  const auto last = [&](std::int64_t mine) { return largest_of(ranks_, any ? double(mine) : -far); };
  const double rows[2] = {first(box_.rows.first + rows_before), last(box_.rows.last + rows_before)};
  const double columns[2] = {first(box_.columns.first), last(box_.columns.last)};
  if (rows[0] > rows[1]) return;
  box_ = {{std::int64_t(rows[0]) - rows_before, std::int64_t(rows[1]) - rows_before},
          {std::int64_t(columns[0]), std::int64_t(columns[1])}};
}

/// Traces that no rank but one has weights for are zero on the others.
template <int D, class Real>
Gather Recorder<D, Real>::take() {
  if (!ranks_) return std::move(gather_);
  std::vector<double> mine;  // number of the trace, samples
  for (std::size_t n = 0; n < gather_.traces.size(); ++n) {
    if (first_weight_[n] == first_weight_[n + 1]) continue;
    const auto& samples = gather_.traces[n].samples;
    mine.push_back(double(n));
    mine.push_back(double(samples.size()));
    mine.insert(mine.end(), samples.begin(), samples.end());
  }
  const auto all = joined_on_first(*ranks_, std::as_bytes(std::span<const double>(mine)));
  std::vector<double> values(all.size() / sizeof(double));
  if (!all.empty()) std::memcpy(values.data(), all.data(), all.size());
  for (std::size_t n = 0; n < values.size();) {
    auto& samples = gather_.traces[std::size_t(values[n])].samples;
    const auto count = std::size_t(values[n + 1]);
    samples.assign(values.begin() + std::ptrdiff_t(n + 2), values.begin() + std::ptrdiff_t(n + 2 + count));
    n += 2 + count;
  }
  return std::move(gather_);
}

template <int D, class Real>
std::int64_t Recorder<D, Real>::steps_needed(const Recording& recording, double dt_s) {
  const double last = double(recording.samples() - 1) * recording.interval_s;
  return std::int64_t(std::ceil(last / dt_s)) + kept / 2;
}

template <int D, class Real>
void Recorder<D, Real>::sample(const StepTime& time, std::int64_t line, const Columns& columns,
                               const Real* fields, std::int64_t pitch) {
  const auto end = reads_.begin() + std::ptrdiff_t(starts_[std::size_t(line) + 1]);
  auto read = reads_.begin() + std::ptrdiff_t(starts_[std::size_t(line)]);
  if (read == end) return;
  Real* const values = values_of(time);
  read = std::lower_bound(read, end, columns.first,
                          [](const Read& one, std::int64_t column) { return one.column < column; });
  for (; read != end && read->column < columns.last; ++read)
    values[read->weight] = fields[read->row * pitch + read->column];
}

template <int D, class Real>
void Recorder<D, Real>::finish(const StepTime& time) {
  const auto traces = gather_.traces.size();
  const std::int64_t instant = time.step + 1;
  double* const now = history_.data() + instant % kept * std::int64_t(traces);
  const Real* const values = values_of(time);
  for (std::size_t trace = 0; trace < traces; ++trace) {
    double sum = 0;
    for (auto n = first_weight_[trace]; n < first_weight_[trace + 1]; ++n)
      sum += weights_[n] * double(values[n]);
    now[trace] = sum / unit_;
  }
  interpolate(instant, time.dt_s);
}

/// All samples whose eight steps are there. Before t = 0 nothing moves: those instants count as zero.
template <int D, class Real>
void Recorder<D, Real>::interpolate(std::int64_t newest, double dt_s) {
  const auto traces = gather_.traces.size();
  for (; next_sample_ < gather_.axis.count; ++next_sample_) {
    const double position = double(next_sample_) * gather_.axis.interval_s / dt_s;
    if (std::int64_t(std::floor(position)) + kept / 2 > newest) return;
    const auto weights = time_weights(position, newest - kept + 1, newest);
    for (std::size_t trace = 0; trace < traces; ++trace) {
      double sum = 0;
      for (int n = 0; n < weights.count; ++n) {
        const std::int64_t instant = weights.first + n;
        if (instant >= 0)
          sum += weights.weights[std::size_t(n)] * history_[std::size_t(instant % kept) * traces + trace];
      }
      gather_.traces[trace].samples.push_back(sum);
    }
  }
}

template <int D, class Real>
void Recorder<D, Real>::keep(Archive& archive) {
  archive.value(next_sample_);
  archive.fixed(history_);
  for (auto& trace : gather_.traces) {
    archive.values(trace.samples);
    if (std::int64_t(trace.samples.size()) != next_sample_ || next_sample_ > gather_.axis.count)
      throw Error("found a trace of " + std::to_string(trace.samples.size()) + " samples, expected " +
                  std::to_string(next_sample_));
  }
}

template std::vector<double> water_depths_m(const Medium<2>&, const Part&, const std::vector<Point<2>>&,
                                            Ranks*);
template class Recorder<2, float>;
template class Recorder<2, double>;
template std::vector<double> water_depths_m(const Medium<3>&, const Part&, const std::vector<Point<3>>&,
                                            Ranks*);
template class Recorder<3, float>;
template class Recorder<3, double>;

}  // namespace slipwave::solver
