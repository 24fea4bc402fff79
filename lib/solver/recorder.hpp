#pragma once

#include <functional>
#include <vector>

#include "scene/scene.hpp"
#include "solver/pass.hpp"
#include "solver/point_access.hpp"

namespace slipwave::solver {

/// Where the fields of a line stand whole at the end of a step: cell 0 of row 0.
template <class Real>
using WholeLine = std::function<const Real*(std::int64_t line)>;

/// Samples the fields at the receivers at the end of every step and interpolates the traces to their own
/// sampling interval by eight steps round each sample, whatever the time step (theory.md (A3)).
template <int D, class Real>
class Recorder {
 public:
  /// `shot` is the 1-based number traces carry.
  Recorder(const Layout<D>& layout, const Domain<D>& domain, const Scene<D>& scene, std::size_t shot);

  void run(const StepTime& time, const WholeLine<Real>& whole_line);
  /// Lines it reads.
  std::span<const std::int64_t> lines() const { return lines_; }
  std::int64_t cells() const { return std::int64_t(weights_.size()); }

  /// Steps after which every sample is known.
  static std::int64_t steps_needed(const Recording& recording, double dt_s);
  /// Component by component, each in the order of the receivers. Call once, after the last step.
  Gather take() { return std::move(gather_); }

 private:
  static constexpr std::int64_t kept = 8;  // steps the interpolation uses
  void interpolate(std::int64_t newest, double dt_s);

  Gather gather_;
  std::vector<ValueWeight> weights_;       // of all traces; `line` is an index into lines_
  std::vector<std::size_t> first_weight_;  // of each trace, and the end
  std::vector<double> history_;            // [instant modulo kept][trace]
  std::vector<std::int64_t> lines_;
  std::int64_t next_sample_ = 0;
};

/// Depth of the fluid above the first rock below a point of the model, m; 0 where the column begins with
/// rock.
template <int D>
double water_depth_m(const Medium<D>& medium, const Point<D>& point_m);

}  // namespace slipwave::solver
