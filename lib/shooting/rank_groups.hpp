// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <span>

#include "parallel/ranks.hpp"
#include "solver/simulation.hpp"

namespace slipwave {

/// The processes that shoot a survey together: groups of them, each of which shoots a shot at a time. The
/// first of all gets what was recorded and writes it.
class RankGroups {
 public:
  /// Collective. `ranks_per_shot` of them form a group; 0: as few as leave none of them without work, but at
  /// `most` so many where that is above 0; all where `one_shot_at_a_time`. Throws a usage Error where they do
  /// not divide all evenly.
  RankGroups(Ranks& all, int ranks_per_shot, std::size_t shots, bool one_shot_at_a_time, int most = 0);

  /// Whether this is the one that writes.
  bool leads() const { return all_.number() == 0; }
  /// Returns the ranks that shoot a shot with this one; null where it does so alone.
  Ranks* group() const { return group_.get(); }
  std::size_t groups() const { return groups_; }

  /// What a shot became; of a shot that became unstable the gather is what was recorded before.
  struct Outcome {
    std::size_t shot = 0;  // 0: none
    Gather gather;
    ShotReport report;
    bool stable = true;
    double sound_until_s = 0;
    std::string what;
  };
  /// Collective: each group shoots one of these shots, at most as many as there are groups, each process with
  /// what slipwave::shoot() wants of the scene. Their outcomes in that order, on the process that leads.
  /// Where a shot became unstable, it throws the Unstable of the first such on that process and
  /// EndedElsewhere on the others.
  template <int D>
  std::vector<Outcome> shoot(const Scene<D>& scene, std::span<const std::size_t> shots,
                             const Progress& progress, const SnapshotSink<D>& snapshots) const;

 private:
  Ranks& all_;
  std::unique_ptr<Ranks> group_;
  std::size_t groups_ = 1, number_ = 0;  // of groups, and of this one's
};

}  // namespace slipwave
