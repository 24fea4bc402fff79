// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "base/progress.hpp"
#include "scene/scene.hpp"
#include "solver/build_step.hpp"
#include "solver/record/recorder.hpp"
#include "solver/record/snapshot_recorder.hpp"
#include "solver/record/stability_check.hpp"
#include "solver/schedule/executor.hpp"
#include "solver/schedule/halo.hpp"
#include "solver/schedule/time_step.hpp"
#include "solver/simulation.hpp"

namespace slipwave::solver {

/// What grids that one shot is simulated in together have alike (BandedShot).
template <int D>
struct InAllBands {
  double unit = 1;              // of the fields
  double largest_velocity = 0;  // beyond which they have diverged, m/s
  std::optional<PlaneWaveGround<D>> ground;
};

/// For the scenes of all bands of a scene.
template <int D>
InAllBands<D> in_all_bands(const Scene<D>& scene, const std::vector<Scene<D>>& bands, std::size_t shot);

/// What all ranks report together, each of its own part; what it is given where there is one process (null).
/// Collective.
ShotReport of_all(const ShotReport& mine, Ranks* ranks);

/// Checks of fields on several ranks: each checks as often as one would alone, but they exchange their
/// findings less often, since no rank should wait for all others.
template <int D>
class SharedCheck {
 public:
  /// `ranks` (may be null) must outlive it.
  explicit SharedCheck(Ranks* ranks) : ranks_(ranks) {}
  /// Calls `check`, which throws DivergedFields, at the end of a step. Collective every `exchanged_every`
  /// steps and at the `last`: throws the earliest one that any rank has seen, on all of them.
  void operator()(const std::function<void()>& check, const StepTime& time, bool last);
  static constexpr std::int64_t exchanged_every = 10 * StabilityCheck<D, float>::every;

 private:
  Ranks* ranks_;
  std::optional<DivergedFields<D>> seen_;  // on this rank, while the others do not know yet
};

/// Everything one shot needs: the fields, their sweeps, the effects and records of its time step
/// (build_step.hpp), and what executes it.
template <int D, class Real>
class ShotSimulation {
 public:
  /// Collective where there are `ranks` (may be null), and so are run_to(), take_gather() and report(); the
  /// scene is then the subdomain of each. In bands these are the ranks that have rows of this one. Keeps
  /// references.
  ShotSimulation(const Scene<D>& scene, std::size_t shot, const SnapshotSink<D>& snapshots,
                 Ranks* ranks = nullptr, const InAllBands<D>* bands = nullptr);

  /// Advances the fields to the end of step last - 1, or less far once `pause` returns true (any thread calls
  /// it from time to time). `progress` is told of each step. Throws DivergedFields.
  void run_to(std::int64_t last, const Progress& progress = {}, const std::function<bool()>& pause = {});
  std::int64_t steps() const { return steps_; }
  /// Steps that have been made.
  std::int64_t done() const { return done_; }
  /// Throws DivergedFields where they have; between two calls of run_to(), which checks at intervals itself.
  void check_stability() const { stability_.check({done_ - 1, dt_s_}); }
  /// The same; what it throws says what lies round the place.
  void check_and_say_where() const;
  /// Writes or reads all that the remaining steps depend on; between two calls of run_to().
  void serialize(Archive& archive);
  Gather take_gather() { return recorder_.take(); }
  std::vector<PlannedEntry> planned() const;
  /// The list of its time step.
  const TimeStep<D, Real>& time_step() const { return step_; }
  /// The energy balance; for scenes that keep a diary.
  ShotReport report() const;
  const Domain<D>& domain() const { return domain_; }
  const Sweeps<D, Real>& sweeps() const { return sweeps_; }
  // For steps that are made together with those of other grids.
  Sweeps<D, Real>& sweeps() { return sweeps_; }
  State<D, Real>& state() { return state_; }
  Executor& executor() { return *executor_; }
  void made(std::int64_t steps) { done_ = steps; }
  /// Steps from done() on that may be in progress together: no step is where all fields are checked or
  /// written. `snapshot`: one is due at their end; then local_field() has it until release_snapshot().
  struct Stretch {
    std::int64_t until;
    bool snapshot;
  };
  Stretch stretch_to(std::int64_t last);
  /// Whether all fields are to be checked after the steps that have been made.
  bool check_is_due() const { return done_ % StabilityCheck<D, Real>::every == 0 || done_ == steps_; }
  /// From now on `progress` (may be null) is told of each step.
  void tell(const Progress* progress) { step_.tell(progress); }
  /// On the model's cells of this grid.
  Field<D> local_field(const FieldKey& key) const;
  void release_snapshot() { snapshots_.release(); }
  /// What it holds: while it runs all but the samples; of what it records, with them; and while it is built
  /// beside fields and effects.
  std::int64_t memory_bytes() const;
  std::int64_t record_bytes() const { return recorder_.memory_bytes() + snapshots_.memory_bytes(); }
  std::int64_t building_bytes() const;
  std::int64_t interface_stencil_cells() const { return sweeps_.interface_stencil_cells(); }
  /// Share of all cells in all steps so far that had to be computed.
  double computed_share() const;

 private:
  StepBuilder<D, Real> builder() { return {*scene_, domain_, state_, dt_s_}; }
  const Medium<D>& medium() const { return attenuating_ ? *attenuating_ : scene_->model.medium; }
  Effects<D, Real> make_effects(const InAllBands<D>* bands);
  std::vector<Record<D, Real>*> records();
  std::unique_ptr<Halo<D, Real>> make_halo();
  void check_together();
  void take_snapshot();
  Field<D> allgather_field(Field<D> mine) const;

  Ranks* ranks_;
  const Scene<D>* scene_;
  std::size_t shot_;
  double dt_s_;
  std::int64_t steps_, done_ = 0;
  double unit_;
  std::optional<Medium<D>> attenuating_;  // in place of the scene's, while domain and state are built
  Domain<D> domain_;
  State<D, Real> state_;
  Sweeps<D, Real> sweeps_;
  Effects<D, Real> effects_;
  Recorder<D, Real> recorder_;
  SnapshotSink<D> sink_;
  SnapshotRecorder<D, Real> snapshots_;
  TimeStep<D, Real> step_;
  std::unique_ptr<Halo<D, Real>> halo_;
  std::unique_ptr<Executor> executor_;
  StabilityCheck<D, Real> stability_;
  SharedCheck<D> check_;
};

}  // namespace slipwave::solver
