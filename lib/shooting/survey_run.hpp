// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/messages.hpp"
#include "checkpoint/run_state.hpp"
#include "output/snapshot_netcdf.hpp"
#include "scene/scene.hpp"
#include "shooting/output_options.hpp"
#include "shooting/provenance.hpp"
#include "shooting/rank_groups.hpp"
#include "shooting/shot_snapshots.hpp"
#include "shooting/trace_files.hpp"
#include "solver/simulation.hpp"

namespace slipwave {

/// Simulates every shot of a scene and writes what it recorded. With a checkpoint it continues where that was
/// written.
template <int D>
class SurveyRun {
 public:
  /// Prepares the run of a checked scene. Throws an Error where the checkpoint is not one of this run. With
  /// `groups` (may be null) the scene is what this process holds of it, and the process that leads writes.
  /// All references must outlive the run.
  SurveyRun(const Scene<D>& scene, const OutputOptions& options, const Provenance& provenance,
            const Messages& messages, const RankGroups* groups);

  /// A shot that has been simulated already, of the same scene: what it recorded.
  void take(std::size_t shot, Gather recorded);
  /// Once. Where a shot becomes unstable it throws the Error that says so, after it has put what there is
  /// under other names if the options ask for that.
  void run();

 private:
  RunState::Settings state_settings(const std::string& version) const;
  std::vector<std::size_t> unfinished_shots();
  void simulate_all();
  void open_outputs(std::span<const std::size_t> some);
  std::vector<ShotReport> simulate_in_threads(std::span<const std::size_t> some);
  std::vector<ShotReport> simulate_on_ranks(std::span<const std::size_t> some);
  void finish_outputs(std::span<const std::size_t> some, const std::vector<ShotReport>& reports);
  std::vector<std::string> save_unstable(const Unstable& error);
  Progress progress_of(std::span<const std::size_t> some);
  std::size_t shots() const { return scene_.survey.sources.size(); }
  bool writes() const { return !groups_ || groups_->leads(); }
  std::string number(std::size_t shot) const { return std::to_string(options_.number_of(shot)); }

  const Scene<D>& scene_;
  const OutputOptions& options_;
  const Messages& messages_;
  const RankGroups* groups_;
  SnapshotHistory provenance_;  // but for the title
  RunState state_;
  TraceFiles traces_;
  std::size_t at_once_;  // shots
  std::size_t shots_to_do_ = 0, rounds_ = 0, round_ = 0;
  Progress progress_;                          // of all rounds
  std::optional<ShotSnapshots<D>> snapshots_;  // of the shot that is being simulated
};

}  // namespace slipwave
