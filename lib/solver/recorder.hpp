#pragma once

#include <vector>

#include "base/archive.hpp"
#include "base/ranks.hpp"
#include "scene/scene.hpp"
#include "solver/pass.hpp"
#include "solver/point_access.hpp"

namespace slipwave::solver {

/// Samples the fields at the receivers at the end of every step and interpolates the traces to their own
/// sampling interval by eight steps round each sample, whatever the time step (theory.md (A3)).
template <int D, class Real>
class Recorder {
 public:
  /// `shot` is the 1-based number traces carry, `unit` what fields are multiples of (Step). Collective where
  /// there are `ranks` (may be null): each records the receivers in the cells it answers for.
  Recorder(const Layout<D>& layout, const Domain<D>& domain, const Scene<D>& scene, std::size_t shot,
           double unit, Ranks* ranks = nullptr);

  /// Whether it reads anything of a line.
  bool reads(std::int64_t line) const { return starts_[std::size_t(line)] < starts_[std::size_t(line) + 1]; }
  /// The rows and columns of all that is read, in 3-D the planes and their rows; on all ranks.
  const Box& box() const { return box_; }
  /// Takes what it needs of these columns of a line from the fields whole at the end of the step; `fields` is
  /// where cell 0 of row 0 stands or would stand, rows `pitch` apart. Several steps may be under way.
  void sample(const StepTime& time, std::int64_t line, const Columns& columns, const Real* fields,
              std::int64_t pitch);
  /// Step after step, when all columns of all lines have been taken.
  void finish(const StepTime& time);
  std::int64_t cells() const { return std::int64_t(weights_.size()); }
  /// Hands over what it remembers when no step is under way: the samples so far and the steps the next ones
  /// are made of.
  void keep(Archive& archive);

  /// Steps after which every sample is known.
  static std::int64_t steps_needed(const Recording& recording, double dt_s);
  /// Component by component, each in the order of the receivers. Call once, after the last step. Collective
  /// where there are ranks: the first of them gets what all have recorded.
  Gather take();

 private:
  static constexpr std::int64_t kept = 8;  // steps the interpolation uses
  void find_box(const Layout<D>& layout, std::int64_t rows_before);
  void interpolate(std::int64_t newest, double dt_s);
  Real* values_of(const StepTime& time) {
    return values_.data() + time.step % Pass::most_steps_under_way * std::int64_t(reads_.size());
  }

  /// A value that is read: where, and which of the weights it belongs to.
  struct Read {
    std::int64_t column, row;
    std::size_t weight;
  };
  Ranks* ranks_;
  Gather gather_;
  double unit_;
  std::vector<double> weights_;            // of all traces
  std::vector<std::size_t> first_weight_;  // of each trace, and the end
  std::vector<Read> reads_;                // by line, then column
  std::vector<std::size_t> starts_;        // of each line in reads_, and the end
  Box box_;
  std::vector<Real> values_;     // [step modulo those under way][weight]
  std::vector<double> history_;  // [instant modulo kept][trace]
  std::int64_t next_sample_ = 0;
};

/// Depths of the fluid above the first rock below these points of the model, m; 0 where the column begins
/// with rock. Collective where there are ranks (may be null) that hold parts of it.
template <int D>
std::vector<double> water_depths_m(const Medium<D>& medium, const Part& part,
                                   const std::vector<Point<D>>& points_m, Ranks* ranks = nullptr);

}  // namespace slipwave::solver
