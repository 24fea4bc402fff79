#pragma once

#include <memory>
#include <vector>

#include "base/progress.hpp"
#include "scene/scene.hpp"
#include "solver/effect/incident_wave.hpp"
#include "solver/effect/point_source.hpp"
#include "solver/effect/slip.hpp"
#include "solver/record/recorder.hpp"
#include "solver/record/stability_check.hpp"
#include "solver/schedule/tiled.hpp"
#include "solver/simulation.hpp"
#include "solver/sweep/sweeps.hpp"

namespace slipwave::solver {

/// Everything one shot needs, and the list of passes that make a time step. build_step alone knows the order.
template <int D, class Real>
class ShotSimulation : private EndOfStep<Real> {
 public:
  /// Collective where there are `ranks` (may be null), and so are run_to(), take_gather() and report(); the
  /// scene is then the part of each.
  ShotSimulation(const Scene<D>& scene, std::size_t shot, const SnapshotSink<D>& snapshots,
                 Ranks* ranks = nullptr);

  /// Brings the fields to the end of step last - 1, from where they are, or to where a pass through memory
  /// ends once `pause` says so (it is asked before each, by any thread). `progress` is told of each step.
  void run_to(std::int64_t last, const Progress& progress = {}, const std::function<bool()>& pause = {});
  std::int64_t steps() const { return steps_; }
  /// Steps that have been made.
  std::int64_t done() const { return done_; }
  /// Throws UnsoundFields where they are; between two calls of run_to(), which looks now and then itself.
  void look() const { monitor_.look({done_ - 1, dt_s_}); }
  /// Ranks look as often, but ask each other less often what they saw: nobody must wait for all for that.
  static constexpr std::int64_t asked_every = 10 * StabilityCheck<D, Real>::every;
  /// Hands over all that the steps to come depend on; between two calls of run_to().
  void serialize(Archive& archive);
  Gather take_gather() { return recorder_->take(); }
  std::vector<PlannedEntry> planned() const;
  /// What became of the energy; scenes that keep a diary.
  ShotReport report() const;
  const Domain<D>& domain() const { return domain_; }
  const Sweeps<D, Real>& sweeps() const { return sweeps_; }
  std::int64_t memory_bytes() const;
  /// What of all cells in all steps so far had to be computed.
  double computed_share() const;

 private:
  void build_step(const Scene<D>& scene, std::size_t shot);
  void check_together();
  void use_halo();
  Field<D> joined_field(Field<D> mine) const;
  bool snapshot_due(const StepTime& time) const;
  void take_snapshot(const StepTime& time);

  void begin(const StepTime& time) override;
  bool whole(const StepTime& time, std::int64_t line) const override {
    return whole_[std::size_t(time.step % Effect::most_steps_in_progress)][std::size_t(line)];
  }
  bool acts_between_steps() const override { return works_beside_; }
  bool looks(const StepTime& time, std::int64_t line) const override {
    return time.step == snapshot_step_ || recorder_->reads(time, line);
  }
  bool injects(const StepTime& time, std::int64_t line) const override;
  Box needed(const StepTime& time, const Box& growth) const override;
  void look(const StepTime& time, std::int64_t line, const IndexRange& columns, const Real* fields,
            std::int64_t pitch) override;
  void run(const StepTime& time, std::int64_t line, const IndexRange& columns) override;
  void run_after_record(const StepTime& time, std::int64_t line, const IndexRange& columns) override;
  void run_patch(const StepTime& time, std::int64_t line, const IndexRange& columns, Real* fields,
                 std::int64_t pitch) override;
  void run_patch_after(const StepTime& time, std::int64_t line, const IndexRange& columns, Real* fields,
                       std::int64_t pitch) override;
  void finish(const StepTime& time) override;

  Ranks* ranks_;
  double dt_s_;
  int time_order_;
  const Scene<D>* scene_;
  std::size_t shot_;
  double unit_;
  Domain<D> domain_;
  State<D, Real> state_;
  Sweeps<D, Real> sweeps_;
  TiledExecutor<D, Real> pipeline_;
  std::unique_ptr<IncidentWave<D, Real>> background_;
  std::unique_ptr<Pml<D, Real>> layer_;
  std::vector<std::unique_ptr<Effect>> passes_;  // at the end of a step, in order
  PointSource<D, Real>* source_ = nullptr;       // one of them, null: no point source
  Slip<D, Real>* slip_ = nullptr;                // the one of them, null: nothing slips
  std::vector<std::vector<char>> whole_;  // [step under way][line]: its last sweep along x ends with the step
  bool works_beside_ = false;
  Patches<D> patches_;
  std::unique_ptr<Halo<D, Real>> halo_;
  StabilityCheck<D, Real> monitor_;
  std::unique_ptr<Recorder<D, Real>> recorder_;
  Buffer<Real> snapshot_;  // all fields as they stand whole, laid out as the state
  std::int64_t snapshot_step_ = -1;
  std::optional<double> snapshot_every_s_;
  bool keeps_diary_;
  double duration_s_;
  SnapshotSink<D> snapshots_;
  std::int64_t steps_, done_ = 0;
  std::optional<DivergedFields<D>> seen_;  // by this rank, while the others do not know yet
  const Progress* progress_ = nullptr;
};

}  // namespace slipwave::solver
