// SPDX-License-Identifier: BSD-3-Clause
#include "solver/banded_shot.hpp"

#include <algorithm>
#include <atomic>
#include <limits>
#include <numeric>

#include "base/instantiate.hpp"
#include "grid/locate.hpp"
#include "parallel/threads.hpp"
#include "scene/bands.hpp"
#include "scene/empty_gather.hpp"
#include "scene/subdomains.hpp"
#include "solver/schedule/tiled.hpp"

namespace slipwave::solver {
namespace {

/// Up to so many threads for each that tiles keep at work they take less time than sweeps of whole grids
/// (tests/bench/bands).
constexpr int threads_for_tiles = 2;

/// Threads that tiles of bands keep at work: each is two pieces behind the one before it.
template <int D>
std::int64_t served_by_tiles(const std::vector<Scene<D>>& bands) {
  std::int64_t pieces = 0;
  for (const auto& band : bands)
    pieces += std::max<std::int64_t>(1, band.model.grid().shape[D - 1] / fewest_rows_of_a_piece);
  return (pieces + 1) / 2;
}

}  // namespace

template <int D, class Real>
BandedShot<D, Real>::BandedShot(const Scene<D>& scene, std::size_t shot, const SnapshotSink<D>& sink,
                                Ranks* ranks)
    : scene_(&scene),
      shot_(shot),
      sink_(sink),
      ranks_(ranks),
      scenes_(scenes_of_bands(scene)),
      check_(ranks) {
  const auto all = in_all_bands(scene, scenes_, shot);
  take_share();
  narrow_first_.resize(scenes_.size());
  std::iota(narrow_first_.begin(), narrow_first_.end(), std::size_t(0));
  std::stable_sort(narrow_first_.begin(), narrow_first_.end(), [this](std::size_t one, std::size_t other) {
    return scenes_[one].model.grid().spacing_m < scenes_[other].model.grid().spacing_m;
  });
  const auto served = wider_downwards() ? served_by_tiles(scenes_) : 1;
  for (auto& band : scenes_) band.numerics.tiling.plain |= parallel_threads() > threads_for_tiles * served;
  // The bands record snapshots, which are put together here.
  const auto nowhere = sink ? SnapshotSink<D>([](double, const FieldReader<D>&) {}) : SnapshotSink<D>();
  for (std::size_t n = 0; n < scenes_.size(); ++n)
    parts_.push_back(
        std::make_unique<ShotSimulation<D, Real>>(scenes_[n], shot, nowhere, groups_[n].get(), &all));
  std::vector<std::array<SharedFaces<Real>*, 2>> shared;
  for (auto& part : parts_) shared.push_back(part->sweeps().share_faces(part->domain()));
  for (std::size_t n = 1; n < parts_.size(); ++n)
    faces_.emplace_back(typename BandFace<D, Real>::Side{&parts_[n - 1]->state(), shared[n - 1][1]},
                        typename BandFace<D, Real>::Side{&parts_[n]->state(), shared[n][0]},
                        parts_[n]->domain().edges, int(parts_[n]->sweeps().reach()),
                        scenes_[n].subdomain.own_heights[0]);
}

/// Leaves of the scenes of all bands what this process has. Those that have rows of a band are a group of
/// their own: within it each band is simulated as a grid on several processes is.
template <int D, class Real>
void BandedShot<D, Real>::take_share() {
  const int count = ranks_ ? ranks_->count() : 1;
  const auto shares = subdomains_for(*scene_, scenes_, ranks_ ? ranks_->number() : 0, count);
  std::vector<Scene<D>> own;
  for (std::size_t n = 0; n < scenes_.size(); ++n) {
    const auto& part = shares[n];
    auto group = count > 1 ? ranks_->split(part.is_empty() ? 0 : 1) : nullptr;
    if (part.is_empty()) continue;
    if (own.empty()) first_band_ = n;
    own.push_back(cut_to(std::move(scenes_[n]), part));
    groups_.push_back(group && group->count() > 1 ? std::move(group) : nullptr);
  }
  scenes_ = std::move(own);
}

template <int D, class Real>
void BandedShot<D, Real>::run_to(std::int64_t last, const Progress& progress,
                                 const std::function<bool()>& pause) {
  auto& last_swept = *parts_[narrow_first_.back()];
  last_swept.tell(&progress);
  for (bool paused = false; done() < last && !paused; paused = pause && pause()) {
    typename ShotSimulation<D, Real>::Stretch stretch{};
    for (auto& part : parts_) stretch = part->stretch_to(last);
    const auto made = run_from(done(), stretch.until, pause);
    for (auto& part : parts_) part->made(made);
    if (stretch.snapshot && made == stretch.until) {
      const StepTime time{made - 1, last_swept.time_step().dt_s()};
      sink_(time.end_s(), [this](const FieldKey& key) { return whole_field(key); });
      for (auto& part : parts_) part->release_snapshot();
    }
    if (last_swept.check_is_due())
      check_([this] { check_stability(); }, {made - 1, last_swept.time_step().dt_s()}, made == steps());
  }
  last_swept.tell(nullptr);
}

/// On the cells of the scene's own model: each has the value of the cell of a band that its centre lies in.
/// The first process has those of all, others their own.
template <int D, class Real>
Field<D> BandedShot<D, Real>::whole_field(const FieldKey& key) const {
  std::vector<Field<D>> of_bands;
  for (const auto& part : parts_) of_bands.push_back(part->local_field(key));
  const auto& bands = scene_->numerics.bands;
  Field<D> field(scene_->model.grid());
  const auto& grid = field.grid();
  // What others send of their cells: first cell and count of those that follow each other, and values.
  std::vector<std::int64_t> runs;
  std::vector<float> values;
  for (std::int64_t n = 0; n < grid.size(); ++n) {
    const auto at = grid.index(n);
    Point<D> centre;
    for (int axis = 0; axis < D - 1; ++axis) centre[std::size_t(axis)] = grid.centre(axis, at[axis]);
    centre[D - 1] = grid.depth(at);
    const auto below = std::upper_bound(bands.begin() + 1, bands.end(), centre[D - 1],
                                        [](double depth_m, const Band& of) { return depth_m < of.from_m; });
    const auto band = std::size_t(below - bands.begin() - 1) - first_band_;
    if (band >= of_bands.size()) continue;
    const auto& part = scenes_[band].subdomain;
    const auto& held = of_bands[band].grid();
    auto cell = cell_of(part.whole(held), centre);
    cell[D - 1] = std::clamp(cell[D - 1], part.face(0), part.face(1) - 1);
    if (cell[D - 1] < part.first || cell[D - 1] >= part.last) continue;
    cell[D - 1] -= held.first[D - 1];
    field[std::size_t(n)] = of_bands[band](cell);
    if (!ranks_ || ranks_->number() == 0) continue;
    if (runs.empty() || *(runs.end() - 2) + runs.back() != n) runs.insert(runs.end(), {n, 0});
    ++runs.back();
    values.push_back(field[std::size_t(n)]);
  }
  if (ranks_) runs = gather_on_first(*ranks_, runs), values = gather_on_first(*ranks_, values);
  auto next = values.begin();
  for (std::size_t n = 0; n < runs.size(); n += 2) {
    std::copy_n(next, runs[n + 1], field.begin() + runs[n]);
    next += runs[n + 1];
  }
  return field;
}

template <int D, class Real>
void BandedShot<D, Real>::check_stability() const {
  for (const auto& part : parts_) part->check_and_say_where();
}

/// The rows beyond a face that each grid reads.
template <int D, class Real>
void BandedShot<D, Real>::fill_rows(std::size_t face) {
  faces_[face].fill_rows();
  for (const auto side : {face, face + 1}) {
    const auto own = parts_[side]->domain().own;
    const IndexRange above{0, own.first}, below{own.last, parts_[side]->domain().grid.shape[D - 1]};
    parts_[side]->executor().rows_changed(side == face ? below : above);
  }
}

/// Gives the wide grid the states of a face. Its columns that take some may lie farther from what moves than
/// sweeps read: the filter of (B1) reaches farther.
template <int D, class Real>
void BandedShot<D, Real>::give_states(std::size_t face) {
  faces_[face].give_states();
  const bool narrow_above = faces_[face].is_narrow(parts_[face]->state());
  auto& wide = *parts_[narrow_above ? face + 1 : face];
  const auto row = narrow_above ? wide.domain().own.first : wide.domain().own.last;
  wide.executor().rows_changed({row - 1, row + 1});
}

/// Sweeps along the last axis in all bands, each with what follows it before the next, as parallel_tiles()
/// makes tiles: the pieces of the grid that is swept first, then those of the next. Where that is from top to
/// bottom, a face lies between two pieces that follow each other, so the next sweep may begin at the top
/// before this one has ended. Returns the first step that was not made.
template <int D, class Real>
std::int64_t BandedShot<D, Real>::run_from(std::int64_t first, std::int64_t last,
                                           const std::function<bool()>& pause) {
  std::vector<SweepTime> across;
  const auto& sweeps = parts_.front()->time_step().sweeps();
  for (auto n = first; n < last; ++n)
    for (std::size_t k = 1; k + 1 < sweeps.size(); ++k)
      if (sweeps[k].axis == D - 1) across.push_back({n, k});
  // Of a grid.
  struct Piece {
    std::size_t band;
    std::int64_t number;
    bool last;
  };
  std::vector<Piece> pieces;
  auto at_once = wider_downwards() ? std::numeric_limits<std::int64_t>::max() : 1;
  for (const auto band : narrow_first_) {
    const auto& executor = parts_[band]->executor();
    at_once = std::min(at_once, executor.most_at_once());
    for (std::int64_t n = 0; n < executor.pieces(); ++n)
      pieces.push_back({band, n, n + 1 == executor.pieces()});
  }
  // Whether a step is made is decided in its first piece, which comes after that of the step before.
  std::atomic<std::int64_t> made = last;
  const auto sweep = [&](std::int64_t number, std::int64_t piece, int worker) {
    const auto& time = across[std::size_t(number)];
    const auto& [band, of_band, ends] = pieces[std::size_t(piece)];
    const bool begins_step = piece == 0 && (number == 0 || across[std::size_t(number - 1)].step < time.step);
    if (begins_step && time.step > first && time.step < made && pause && pause()) made = time.step;
    if (time.step >= made) return;
    // Before either grid beside a face changes what the other reads; the narrow one is swept first.
    for (std::size_t face = 0; face < faces_.size(); ++face) {
      const bool narrow_above = faces_[face].is_narrow(parts_[face]->state());
      if (narrow_above ? band == face && ends : band == face + 1 && of_band == 0) fill_rows(face);
    }
    parts_[band]->executor().run_from(time, number, of_band, worker);
    for (std::size_t face = 0; face < faces_.size(); ++face)
      if (ends && faces_[face].is_narrow(parts_[band]->state())) give_states(face);
  };
  parallel_tiles(std::int64_t(across.size()), std::int64_t(pieces.size()), at_once, sweep);
  return made;
}

template <int D, class Real>
void BandedShot<D, Real>::serialize(Archive& archive) {
  for (auto& part : parts_) part->serialize(archive);
}

/// Each band has recorded the receivers in its cells, the traces of others are zero. The first process adds
/// those of all bands in their order.
template <int D, class Real>
Gather BandedShot<D, Real>::take_gather() {
  auto gather = empty_gather(*scene_, shot_);
  for (auto& trace : gather.traces) trace.samples.assign(std::size_t(gather.axis.count), 0);
  const auto a_trace = std::size_t(gather.axis.count), a_band = gather.traces.size() * a_trace;
  std::vector<double> samples;  // of all traces, band by band
  const auto add = [&] {
    for (std::size_t n = 0; n < samples.size(); ++n)
      gather.traces[n % a_band / a_trace].samples[n % a_trace] += samples[n];
    samples.clear();
  };
  for (std::size_t n = 0; n < parts_.size(); ++n) {
    auto of_band = parts_[n]->take_gather();
    for (auto& trace : of_band.traces) {
      trace.samples.resize(a_trace);
      if (leads(n)) samples.insert(samples.end(), trace.samples.begin(), trace.samples.end());
    }
    if (!ranks_) add();
  }
  if (ranks_) samples = gather_on_first(*ranks_, samples);
  add();
  return gather;
}

template <int D, class Real>
ShotReport BandedShot<D, Real>::report() const {
  ShotReport all;
  for (std::size_t n = 0; n < parts_.size(); ++n) {
    const auto of_band = parts_[n]->report();
    if (!leads(n)) continue;
    if (of_band.slip) {
      auto& sum = all.slip ? *all.slip : all.slip.emplace();
      sum.cells += of_band.slip->cells, sum.slipped += of_band.slip->slipped;
      sum.dissipated += of_band.slip->dissipated, sum.out_of_waves += of_band.slip->out_of_waves;
    }
    if (of_band.source_work) all.source_work = all.source_work.value_or(0) + *of_band.source_work;
    all.energy_left += of_band.energy_left;
  }
  return of_all(all, ranks_);
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
