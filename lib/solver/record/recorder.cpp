#include "solver/record/recorder.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

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

template <int D>
std::vector<double> water_depths_m(const Medium<D>& medium, const Subdomain& part,
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
  found = allgather(ranks, found);
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
  std::vector<std::vector<ValueWeight>> of_traces;
  gather_.axis = {scene.recording.samples(), scene.recording.interval_s, 0};
  TraceHeader header;
  header.shot = std::int64_t(shot);
  header.source_m = in_space<D>(source.position_m);
  std::vector<Point<D>> points = {source.position_m};
  points.insert(points.end(), scene.survey.receivers_m.begin(), scene.survey.receivers_m.end());
  const auto depths = water_depths_m(scene.model.medium, scene.subdomain, points, ranks);
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
      of_traces.emplace_back();
      if (domain.subdomain.owns(domain.model_grid, receiver))
        of_traces.back() = component_weights<D>(layout, domain, receiver, component);
    }
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
  std::vector<double> mine;  // number of the trace, samples
  for (std::size_t n = 0; n < gather_.traces.size(); ++n) {
    if (first_term_[n] == first_term_[n + 1]) continue;
    const auto& samples = gather_.traces[n].samples;
    mine.push_back(double(n));
    mine.push_back(double(samples.size()));
    mine.insert(mine.end(), samples.begin(), samples.end());
  }
  const auto all = gather_on_first(*ranks_, std::as_bytes(std::span<const double>(mine)));
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
void Recorder<D, Real>::sample(const StepTime& time, std::int64_t line, const IndexRange& columns,
                               const Real* fields, std::int64_t pitch) {
  if (!reads(time, line)) return;
  Real* const values = values_of(time);
  for (auto n = starts_[std::size_t(line)]; n < starts_[std::size_t(line) + 1]; ++n) {
    const auto end = runs_.begin() + std::ptrdiff_t(rows_[n].last);
    auto run = std::partition_point(runs_.begin() + std::ptrdiff_t(rows_[n].first), end,
                                    [&](const Run& one) { return one.last <= columns.first; });
    const Real* const row = fields + rows_[n].row * pitch;
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

template std::vector<double> water_depths_m(const Medium<2>&, const Subdomain&, const std::vector<Point<2>>&,
                                            Ranks*);
template class Recorder<2, float>;
template class Recorder<2, double>;
template std::vector<double> water_depths_m(const Medium<3>&, const Subdomain&, const std::vector<Point<3>>&,
                                            Ranks*);
template class Recorder<3, float>;
template class Recorder<3, double>;

}  // namespace slipwave::solver
