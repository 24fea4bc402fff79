// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <functional>
#include <memory>
#include <vector>

#include "base/progress.hpp"
#include "scene/scene.hpp"
#include "solver/schedule/band_face.hpp"
#include "solver/shot_simulation.hpp"

namespace slipwave::solver {

/// A shot in bands of cells (Numerics::bands): a simulation of each, which make every sweep together and
/// exchange what they share (theory.md (B4)). It is used as a ShotSimulation is. Each of several processes
/// has the bands, or parts of them, that subdomains_for() gives it.
template <int D, class Real>
class BandedShot {
 public:
  /// Throws as scenes_of_bands() and subdomains_for(). Collective where there are `ranks` (may be null), and
  /// so are run_to(), take_gather() and report(); the scene is the whole one on each. Keeps references.
  BandedShot(const Scene<D>& scene, std::size_t shot, const SnapshotSink<D>& snapshots = {},
             Ranks* ranks = nullptr);

  void run_to(std::int64_t last, const Progress& progress = {}, const std::function<bool()>& pause = {});
  std::int64_t steps() const { return parts_.front()->steps(); }
  std::int64_t done() const { return parts_.front()->done(); }
  void serialize(Archive& archive);
  Gather take_gather();
  ShotReport report() const;
  /// These figures are of all bands of this process together: the shares of entries are means weighted by the
  /// cells of the bands, cells and bytes are sums, and building_bytes() is the largest of any band.
  std::vector<PlannedEntry> planned() const;
  std::int64_t interface_stencil_cells() const;
  std::int64_t memory_bytes() const;
  std::int64_t record_bytes() const;
  std::int64_t building_bytes() const;
  /// The scenes of the bands that this process has rows of and what simulates them, top to bottom.
  const std::vector<Scene<D>>& scenes() const { return scenes_; }
  ShotSimulation<D, Real>& part(std::size_t band) { return *parts_[band]; }

 private:
  template <class Of>
  std::int64_t sum_of_parts(Of&& of) const;
  std::int64_t run_from(std::int64_t first, std::int64_t last, const std::function<bool()>& pause);
  void fill_rows(std::size_t face);
  void give_states(std::size_t face);
  bool wider_downwards() const { return std::is_sorted(narrow_first_.begin(), narrow_first_.end()); }
  void take_share();
  bool leads(std::size_t part) const { return !groups_[part] || groups_[part]->number() == 0; }
  void check_stability() const;
  Field<D> whole_field(const FieldKey& key) const;

  const Scene<D>* scene_;
  std::size_t shot_;
  SnapshotSink<D> sink_;
  Ranks* ranks_;
  std::vector<Scene<D>> scenes_;
  std::size_t first_band_ = 0;                  // its own, of the scene's
  std::vector<std::unique_ptr<Ranks>> groups_;  // that share each band; null where one process has all of it
  SharedCheck<D> check_;
  std::vector<std::unique_ptr<ShotSimulation<D, Real>>> parts_;
  std::vector<BandFace<D, Real>> faces_;   // below each band but the last
  std::vector<std::size_t> narrow_first_;  // bands, in the order in which they are swept
};

}  // namespace slipwave::solver
