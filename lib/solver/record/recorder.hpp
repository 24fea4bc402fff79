// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <span>
#include <tuple>
#include <vector>

#include "acquisition/interpolation.hpp"
#include "base/archive.hpp"
#include "parallel/ranks.hpp"
#include "scene/scene.hpp"
#include "solver/kernels/series_kernels.hpp"
#include "solver/record/record.hpp"
#include "solver/sweep/point_weights.hpp"

namespace slipwave::solver {

/// Values next to each other on a line: places first <= n < last.
struct Stretch {
  std::int64_t line, first, last;
  bool operator<(const Stretch& other) const {
    return std::tie(line, first) < std::tie(other.line, other.first);
  }
};

/// Stretches in their order, without overlaps, and where their values stand when they follow each other.
class Stretches {
 public:
  /// Each begins at a multiple of `aligned`.
  Stretches(std::vector<Stretch> stretches, std::int64_t aligned);
  const std::vector<Stretch>& all() const { return all_; }
  std::int64_t value(std::size_t n) const { return values_[n]; }
  std::int64_t values() const { return values_.back(); }
  /// Returns where the first value of a part of one of them stands.
  std::int64_t value_of(const Stretch& part) const;

 private:
  std::vector<Stretch> all_;
  std::vector<std::int64_t> values_;  // and the end
};

/// Samples the fields at the receivers at the end of every step and interpolates the traces to their own
/// sampling interval by eight steps round each sample, whatever the time step (theory.md (A3)); integrals and
/// derivatives in time are those of the same polynomials (A9). Values are made series of some steps at a
/// time, so that weights are read once for all of them and samples of a trace are written together.
template <int D, class Real>
class Recorder : public Record<D, Real> {
 public:
  /// `shot` is the 1-based number traces carry, `unit` the unit of the fields (ShotSimulation). Collective
  /// where there are `ranks` (may be null): each records the receivers in the cells it owns.
  Recorder(const Layout<D>& layout, const Domain<D>& domain, const Scene<D>& scene, std::size_t shot,
           double unit, Ranks* ranks = nullptr);

  /// Whether it reads anything of a line at the end of that step.
  bool reads(const StepTime& time, std::int64_t line) const override {
    return starts_[std::size_t(line)] < starts_[std::size_t(line) + 1] && wants(time);
  }
  Box box() const override { return box_; }
  void read(const StepTime& time, const RowFields<const Real>& fields, const IndexRange& cells) override;
  void finish(const StepTime& time) override;
  std::int64_t cells() const { return std::int64_t(weights_.size()); }
  /// Weights and values, and the samples once all are there.
  std::int64_t memory_bytes() const;
  /// Writes or reads what it retains when so many steps are done and none is in progress: the samples so far
  /// and the steps that the next ones are interpolated from.
  void serialize(Archive& archive, std::int64_t done);

  /// Steps after which every sample is known.
  static std::int64_t steps_needed(const Recording& recording, double dt_s);
  /// Component by component, each in the order of the receivers. Call once, after the last step. Collective
  /// where there are ranks: the first of them gets what all have recorded.
  Gather take();

 private:
  static constexpr std::int64_t kept = 8;  // steps the interpolation uses
  static constexpr std::int64_t steps_at_once = std::int64_t{4} * steps_together;
  static constexpr std::size_t series_together = 64;
  /// Steps whose values are still to be made series, and those that are in progress.
  static constexpr std::int64_t slots = most_steps_in_progress + steps_at_once;
  /// Weights of the first series of each trace, and of further ones where a trace is the sum of several.
  std::vector<std::vector<ValueWeight>> all_weights(const Layout<D>& layout, const Domain<D>& domain,
                                                    const Scene<D>& scene, std::size_t shot);
  void find_spans(const Scene<D>& scene, std::size_t shot);
  void read_all(const Layout<D>& layout, std::vector<std::vector<ValueWeight>> of_traces);
  void add_chunk(std::span<const std::vector<ValueWeight>> of_series, const Stretches& cells);
  void add_weights(const std::vector<ValueWeight>& weights);
  void find_box(const Layout<D>& layout, std::int64_t rows_before);
  /// Whether any sample is interpolated from the end of that step.
  bool wants(const StepTime& time) const;
  /// Returns when a sample is taken, in steps; steps_before() returns the last step that has ended before.
  double steps_at(std::int64_t sample, double dt_s) const {
    return double(sample) * gather_.axis.interval_s / dt_s;
  }
  std::int64_t steps_before(std::int64_t sample, double dt_s) const {
    return std::int64_t(std::floor(steps_at(sample, dt_s)));
  }
  void catch_up();
  void find_arrivals();
  void weigh(std::size_t chunk, std::size_t first, std::size_t last);
  void interpolate(std::size_t first, std::size_t last);
  void combine(const TimeWeights& weights, std::size_t first, std::size_t last, double* sums) const;
  /// The samples of a series: those of its trace, or kept beside it until all points of a gauge are known.
  std::vector<double>& samples_of(std::size_t series) {
    const auto traces = gather_.traces.size();
    return series < traces ? gather_.traces[series].samples : gauge_parts_[series - traces].samples;
  }
  std::size_t series() const { return gather_.traces.size() + gauge_parts_.size(); }
  Real* values_of(std::int64_t step) { return values_.data() + step % slots * values_a_step_; }

  /// Neighbouring cells of a row that any trace reads, once however many traces do.
  struct Run {
    std::int64_t first, last;  // columns
    std::int64_t value;        // place of the first among those of a step
  };
  /// The runs of one row of a line.
  struct RowRuns {
    int row;
    std::size_t first, last;  // in runs_
  };
  /// Values that a chunk of series needs: among those of a step, in together_.
  struct Piece {
    std::int64_t value, count, at;
  };
  /// What samples and integrals are made of once an instant is there, by what is recorded.
  struct Arrival {
    std::size_t first_sample, last_sample;  // in sample_weights_
    TimeWeights advance;                    // of integrals over a step
    bool advances;
  };
  using WeightsOfKinds = std::array<TimeWeights, 3>;
  /// Series that follow each other of which the same is recorded.
  struct Span {
    std::size_t first, last;
    InTime what;
  };
  /// What one more point of a gauge takes part with: a series that is added to a trace when all are known,
  /// since another rank may own that point.
  struct GaugePart {
    std::size_t trace;
    std::vector<double> samples;
  };
  Ranks* ranks_;
  Gather gather_;
  std::vector<GaugePart> gauge_parts_;
  std::vector<Span> spans_;    // of all series: traces, then other points of gauges
  bool any_integral_ = false;  // then every step is read
  std::vector<double>
      integrals_;  // of each series, times 1/s, up to half of `kept` before the newest instant
  double unit_;
  std::int64_t last_;  // instant
  const SeriesKernels<Real>& kernels_ = series_kernels<Real>();
  std::size_t receivers_ = 0;
  std::vector<double> weights_;            // series alike share them
  std::vector<std::size_t> first_weight_;  // of each series
  std::vector<SeriesTerm> terms_;          // of all series
  std::vector<std::size_t> first_term_;    // of each series, and the end
  std::vector<Run> runs_;                  // by line, row, column
  std::vector<RowRuns> rows_;              // by line, row
  std::vector<std::size_t> starts_;        // of each line in rows_, and the end
  Box box_;
  std::int64_t values_a_step_ = 0;
  std::vector<Real> values_;              // [step modulo slots][value]
  std::vector<Piece> pieces_;             // by chunk of series
  std::vector<std::size_t> first_piece_;  // of each chunk, and the end
  Buffer<double> together_;               // [value][step], those of a chunk
  std::vector<double> history_;           // [chunk][last instants][series], of the instants that samples need
  std::array<double, std::size_t(kept + steps_at_once) * series_together>
      recent_{};                   // and those since, of a chunk
  std::vector<Arrival> arrivals_;  // of the instants that are made series
  std::vector<WeightsOfKinds> sample_weights_;
  std::vector<double> new_samples_;        // [sample][series of those together]
  std::int64_t newest_ = 0, weighed_ = 0;  // last instants: that has ended, that is in history_
  double dt_s_ = 0;
  std::int64_t next_sample_ = 0;
};

}  // namespace slipwave::solver
