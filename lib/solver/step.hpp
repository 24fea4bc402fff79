#pragma once

#include <memory>
#include <vector>

#include "scene/scene.hpp"
#include "scene/splitting.hpp"
#include "solver/background.hpp"
#include "solver/recorder.hpp"
#include "solver/simulation.hpp"
#include "solver/sweeps.hpp"

namespace slipwave::solver {

/// Everything one shot needs, and the list of passes that make a time step. build_step alone knows the order.
template <int D, class Real>
class Step {
 public:
  Step(const Scene<D>& scene, std::size_t shot, const SnapshotSink<D>& snapshots);

  /// Brings the fields from the end of step - 1 to the end of `step`. Steps must follow each other from 0 on.
  void run(std::int64_t step);
  std::int64_t steps() const { return steps_; }
  Gather take_gather() { return recorder_->take(); }
  std::vector<PlannedPass> planned() const;
  const Domain<D>& domain() const { return domain_; }
  const Sweeps<D, Real>& sweeps() const { return sweeps_; }
  std::int64_t memory_bytes() const;

 private:
  void build_step(const Scene<D>& scene, std::size_t shot);
  void find_whole_lines(const StepTime& time);
  bool snapshot_due(const StepTime& time) const;
  void read_ahead(std::span<const std::int64_t> lines);

  double dt_s_;
  std::vector<SweepPart> splitting_;
  Domain<D> domain_;
  State<D, Real> state_;
  Sweeps<D, Real> sweeps_;
  std::unique_ptr<Background<D, Real>> background_;
  std::unique_ptr<MatchedLayer<D, Real>> layer_;
  std::vector<std::unique_ptr<Pass>> passes_;  // at the end of a step, in order
  std::vector<char> whole_;                    // lines whose sweep along x ends with the step
  std::vector<char> acting_;                   // which passes `whole_` was made for
  std::vector<std::int64_t> fracture_lines_;
  // Lines that are not whole are read from a copy half a sweep ahead: looking on changes nothing.
  std::vector<Buffer<Real>> ahead_;
  std::vector<std::int64_t> reading_, all_lines_;
  std::unique_ptr<Recorder<D, Real>> recorder_;
  std::optional<double> snapshot_every_s_;
  double duration_s_;
  SnapshotSink<D> snapshots_;
  std::int64_t steps_;
};

}  // namespace slipwave::solver
