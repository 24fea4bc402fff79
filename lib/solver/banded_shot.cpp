// SPDX-License-Identifier: BSD-3-Clause
#include "solver/banded_shot.hpp"

#include <algorithm>
#include <numeric>

#include "base/instantiate.hpp"
#include "grid/locate.hpp"
#include "parallel/threads.hpp"
#include "scene/bands.hpp"
#include "scene/empty_gather.hpp"
#include "scene/surroundings.hpp"

namespace slipwave::solver {
namespace {

/// Up to so many threads tiles take less time than sweeps of whole grids, though the threads are left idle:
/// tiles of bands wait for each other (tests/bench/bands).
constexpr int most_threads_for_tiles = 2;

}  // namespace

template <int D, class Real>
BandedShot<D, Real>::BandedShot(const Scene<D>& scene, std::size_t shot, const SnapshotSink<D>& sink)
    : scene_(&scene), shot_(shot), sink_(sink), scenes_(scenes_of_bands(scene)) {
  for (auto& band : scenes_) band.numerics.tiling.plain |= parallel_threads() > most_threads_for_tiles;
  // The bands record snapshots, which are put together here.
  const auto nowhere = sink ? SnapshotSink<D>([](double, const FieldReader<D>&) {}) : SnapshotSink<D>();
  const auto all = in_all_bands(scenes_, shot);
  for (const auto& band : scenes_)
    parts_.push_back(std::make_unique<ShotSimulation<D, Real>>(band, shot, nowhere, nullptr, &all));
  std::vector<std::array<SharedFaces<Real>*, 2>> shared;
  for (auto& part : parts_) shared.push_back(part->sweeps().share_faces(part->domain()));
  for (std::size_t n = 1; n < parts_.size(); ++n)
    faces_.emplace_back(typename BandFace<D, Real>::Side{&parts_[n - 1]->state(), shared[n - 1][1]},
                        typename BandFace<D, Real>::Side{&parts_[n]->state(), shared[n][0]},
                        parts_[n]->domain().edges, int(parts_[n]->sweeps().reach()),
                        scenes_[n].subdomain.own_heights[0]);
  narrow_first_.resize(parts_.size());
  std::iota(narrow_first_.begin(), narrow_first_.end(), std::size_t(0));
  std::stable_sort(narrow_first_.begin(), narrow_first_.end(), [this](std::size_t one, std::size_t other) {
    return scenes_[one].model.grid().spacing_m < scenes_[other].model.grid().spacing_m;
  });
}

template <int D, class Real>
void BandedShot<D, Real>::run_to(std::int64_t last, const Progress& progress,
                                 const std::function<bool()>& pause) {
  for (auto n = done(); n < last; ++n) {
    if (pause && pause()) return;
    const StepTime time{n, parts_.front()->time_step().dt_s()};
    bool snapshot = false;
    for (auto& part : parts_) snapshot = sink_ && part->prepare_snapshot(n, n + 1);
    const auto& sweeps = parts_.front()->time_step().sweeps();
    for (std::size_t k = 1; k + 1 < sweeps.size(); ++k)
      if (sweeps[k].axis == D - 1) run_from({n, k});
    for (auto& part : parts_) part->made(n + 1);
    if (snapshot) {
      sink_(time.end_s(), [this](const FieldKey& key) { return whole_field(key); });
      for (auto& part : parts_) part->release_snapshot();
    }
    if (progress) progress(n + 1, steps());
    if ((n + 1) % StabilityCheck<D, Real>::every == 0 || n + 1 == steps()) check_stability();
  }
}

/// On the cells of the scene's own model: each has the value of the cell of a band that its centre lies in.
template <int D, class Real>
Field<D> BandedShot<D, Real>::whole_field(const FieldKey& key) const {
  std::vector<Field<D>> of_bands;
  for (const auto& part : parts_) of_bands.push_back(part->local_field(key));
  const auto& bands = scene_->numerics.bands;
  Field<D> field(scene_->model.grid());
  const auto& grid = field.grid();
  for (std::int64_t n = 0; n < grid.size(); ++n) {
    const auto at = grid.index(n);
    Point<D> centre;
    for (int axis = 0; axis < D - 1; ++axis) centre[std::size_t(axis)] = grid.centre(axis, at[axis]);
    centre[D - 1] = grid.depth(at);
    const auto below = std::upper_bound(bands.begin() + 1, bands.end(), centre[D - 1],
                                        [](double depth_m, const Band& of) { return depth_m < of.from_m; });
    const auto band = std::size_t(below - bands.begin() - 1);
    const auto& part = scenes_[band].subdomain;
    auto cell = cell_of(of_bands[band].grid(), centre);
    cell[D - 1] = std::clamp(cell[D - 1], part.first, part.last - 1);
    field[std::size_t(n)] = of_bands[band](cell);
  }
  return field;
}

template <int D, class Real>
void BandedShot<D, Real>::check_stability() const {
  for (std::size_t n = 0; n < parts_.size(); ++n) try {
      parts_[n]->check_stability();
    } catch (const DivergedFields<D>& seen) {
      throw DivergedFields<D>(
          seen.what() + std::string("; ") +
              surroundings(scenes_[n], shot_, parts_[n]->domain().from_model(seen.first().at)),
          seen.first());
    }
}

/// A sweep along the last axis in all bands, and what follows it before the next.
template <int D, class Real>
void BandedShot<D, Real>::run_from(const SweepTime& across) {
  for (std::size_t n = 0; n < faces_.size(); ++n) {
    faces_[n].fill_rows();
    for (const auto side : {n, n + 1}) {
      const auto own = parts_[side]->domain().own,
                 rows = IndexRange{0, parts_[side]->domain().grid.shape[D - 1]};
      parts_[side]->executor().rows_changed(side == n ? IndexRange{own.last, rows.last}
                                                      : IndexRange{rows.first, own.first});
    }
  }
  for (const auto band : narrow_first_) {
    parts_[band]->executor().run_from(across);
    for (std::size_t n = 0; n < faces_.size(); ++n) {
      // The row that takes these lies beside rows filled above, whose fields spread to it anyway.
      if (faces_[n].is_narrow(parts_[band]->state())) faces_[n].give_states();
    }
  }
}

template <int D, class Real>
void BandedShot<D, Real>::serialize(Archive& archive) {
  for (auto& part : parts_) part->serialize(archive);
}

/// Each band has recorded the receivers in its cells, the traces of others are zero.
template <int D, class Real>
Gather BandedShot<D, Real>::take_gather() {
  auto gather = empty_gather(*scene_, shot_);
  for (auto& trace : gather.traces) trace.samples.assign(std::size_t(gather.axis.count), 0);
  for (auto& part : parts_) {
    const auto of_band = part->take_gather();
    for (std::size_t n = 0; n < gather.traces.size(); ++n) {
      const auto& from = of_band.traces[n].samples;
      for (std::size_t i = 0; i < from.size(); ++i) gather.traces[n].samples[i] += from[i];
    }
  }
  return gather;
}

template <int D, class Real>
ShotReport BandedShot<D, Real>::report() const {
  ShotReport all;
  for (const auto& part : parts_) {
    const auto of_band = part->report();
    if (of_band.slip) {
      auto& sum = all.slip ? *all.slip : all.slip.emplace();
      sum.cells += of_band.slip->cells, sum.slipped += of_band.slip->slipped;
      sum.dissipated += of_band.slip->dissipated, sum.out_of_waves += of_band.slip->out_of_waves;
    }
    if (of_band.source_work) all.source_work = all.source_work.value_or(0) + *of_band.source_work;
    all.energy_left += of_band.energy_left;
  }
  return all;
}

template <int D, class Real>
std::vector<PlannedEntry> BandedShot<D, Real>::planned() const {
  std::vector<PlannedEntry> entries;
  double cells = 0;
  for (const auto& part : parts_) cells += double(part->domain().grid.size());
  for (const auto& part : parts_)
    for (const auto& [name, share] : part->planned()) {
      const auto same =
          std::find_if(entries.begin(), entries.end(),
                       [&name = name](const PlannedEntry& entry) { return entry.name == name; });
      auto& entry = same != entries.end() ? *same : entries.emplace_back(PlannedEntry{name, 0});
      entry.share += share * double(part->domain().grid.size()) / cells;
    }
  return entries;
}

template <int D, class Real>
template <class Of>
std::int64_t BandedShot<D, Real>::sum_of_parts(Of&& of) const {
  return std::accumulate(parts_.begin(), parts_.end(), std::int64_t(0),
                         [&](std::int64_t sum, const auto& part) { return sum + of(*part); });
}

template <int D, class Real>
std::int64_t BandedShot<D, Real>::interface_stencil_cells() const {
  return sum_of_parts([](const auto& part) { return part.interface_stencil_cells(); });
}

template <int D, class Real>
std::int64_t BandedShot<D, Real>::memory_bytes() const {
  return sum_of_parts([](const auto& part) { return part.memory_bytes(); });
}

template <int D, class Real>
std::int64_t BandedShot<D, Real>::record_bytes() const {
  return sum_of_parts([](const auto& part) { return part.record_bytes(); });
}

template <int D, class Real>
std::int64_t BandedShot<D, Real>::building_bytes() const {
  std::int64_t bytes = 0;
  for (const auto& part : parts_) bytes = std::max(bytes, part->building_bytes());
  return bytes;
}

SLIPWAVE_INSTANTIATE_D_REAL(TYPE, class BandedShot);

}  // namespace slipwave::solver
