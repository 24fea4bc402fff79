// SPDX-License-Identifier: BSD-3-Clause
#include "solver/schedule/tiled.hpp"

#include <algorithm>
#include <atomic>

#include "base/instantiate.hpp"
#include "parallel/threads.hpp"
#include "scene/subdomains.hpp"

namespace slipwave::solver {
namespace {

// Measured on grids from 10^4 to 10^8 cells (tests/bench, docs/performance.md).
/// Columns of a stripe: their data stays in a first cache of 32 to 48 KiB. Where all is fluid it is half as
/// much.
constexpr std::int64_t usual_stripe = 256, stripe_in_fluid = 512;
/// In 3-D cells of a plane of a stripe: the second cache, of 1 MiB or more, holds what the sweeps along z
/// need.
constexpr std::int64_t usual_cells_of_a_plane = 1536;
/// Planes that a sweep does at once: a sweep along z then finds most of what it reads in a near cache.
constexpr std::int64_t usual_planes = 4;
/// Cache lines of the next planes that are fetched at a time, while a row of a sweep across is swept.
constexpr int fetched_together = 24;

IndexRange common(const IndexRange& one, const IndexRange& other) {
  return {std::max(one.first, other.first), std::min(one.last, other.last)};
}

template <int D>
std::int64_t stripe_for(const Layout<D>& layout) {
  if (D == 2) return layout.rows() < FieldRows<D>::count ? stripe_in_fluid : usual_stripe;
  return std::max<std::int64_t>(4, usual_cells_of_a_plane / layout.padded_nx());
}

}  // namespace

template <int D, class Real>
TiledExecutor<D, Real>::TiledExecutor(Sweeps<D, Real>& sweeps, State<D, Real>& state, TimeStep<D, Real>& step,
                                      const Tiling& tiling, std::int64_t rows_beside)
    : sweeps_(sweeps),
      state_(state),
      layout_(state.layout),
      active_(state),
      everywhere_(tiling.everywhere),
      step_(step),
      steps_per_tile_(steps_of_a_tile(tiling)),
      stripe_width_(tiling.stripe_cells > 0 ? tiling.stripe_cells : stripe_for(layout_)),
      together_(D == 2 ? 1 : usual_planes),
      rows_(layout_.shape()[D - 1]),
      cut_cells_(layout_.shape()[D - 2]) {
  for (int axis = 0; axis < D; ++axis)
    surface_rows_[std::size_t(axis)] = sweeps.corrects_surface(axis) ? free_surface_reach : 0;
  const auto longest_tile = stages(0, steps_per_tile_);
  longest_ = longest(longest_tile);
  for (std::size_t n = 1; n < step.sweeps().size(); ++n)
    if (step.sweeps()[n].axis == D - 1) longest_ = std::max(longest_, longest(stages_from({0, n})));
  const auto [along_x, along_y, along_z] = counts(longest_tile);
  // Rows that are sent to neighbours or refreshed are then not in use by the next tile or the one before.
  band_rows_ =
      std::max(fewest_rows_of_a_piece, longest_ + std::max(std::int64_t(2) * max_reach, rows_beside));
  bands_ = std::max<std::int64_t>(1, rows_ / band_rows_);
  const int threads = parallel_threads();
  const auto most = std::int64_t(most_steps_in_progress / steps_per_tile_);
  in_progress_.resize(std::size_t(threads > 1 ? std::clamp<std::int64_t>(threads + 1, 1, most) : 1));
  const auto ring = [&](int axis) { return sweeps.make_ring(axis, 0, layout_.padded_nx()); };
  for (auto& tile : in_progress_)
    for (std::int64_t n = 0; n < along_z * (D == 2 ? 1 : cut_cells_); ++n) tile.rings.push_back(ring(D - 1));
  std::int64_t widest = layout_.padded_nx();
  if (D == 2) widest = std::min(stripe_width_ * 2 + longest_tile.front().ahead, widest);
  for (int n = 0; n < parallel_workers(); ++n) {
    workers_.push_back(
        {sweeps.make_workspace(widest + 2 * Sweeps<D, Real>::lag),
         std::vector<StripeBoundary<Real>>(std::size_t(along_x * (D == 2 ? boundaries_per_sweep() : 1))),
         {},
         std::vector<IndexRange>(2 * longest_tile.size())});
    for (std::int64_t m = 0; m < along_y * boundaries_per_sweep(); ++m)
      workers_.back().rings.push_back(ring(1));
  }
  if (!step_.patches().empty()) make_patch_memory();
}

/// Rows from the first to the last of these stages.
template <int D, class Real>
std::int64_t TiledExecutor<D, Real>::longest(const std::vector<Stage>& stages) const {
  const auto& last = stages.back();
  return last.behind + surface_rows(last.kind == Stage::along_y ? 1 : 0);
}

template <int D, class Real>
auto TiledExecutor<D, Real>::counts(const std::vector<Stage>& stages) -> Counts {
  Counts counts;
  for (const auto& stage : stages) {
    counts.along_x += stage.kind == Stage::along_x ? 1 : stage.kind == Stage::end_of_step ? 2 : 0;
    counts.along_y += stage.kind == Stage::along_y;
    counts.along_z += stage.kind == Stage::along_z;
  }
  return counts;
}

template <int D, class Real>
std::int64_t TiledExecutor<D, Real>::memory_bytes() const {
  std::int64_t bytes = active_.memory_bytes();
  for (const auto& tile : in_progress_)
    for (const auto& ring : tile.rings) bytes += ring.memory_bytes();
  for (const auto& worker : workers_)
    for (const auto& ring : worker.rings) bytes += ring.memory_bytes();
  return bytes;
}

/// The stages of a time tile of these steps.
template <int D, class Real>
auto TiledExecutor<D, Real>::stages(std::int64_t first, std::int64_t last) const -> std::vector<Stage> {
  std::vector<Stage> all;
  // The last sweep of a step and the first of the next are alike: both belong to the end of a step.
  if (first == 0) all.push_back(stage_of({0, 0}));
  for (std::int64_t step = first; step < last; ++step)
    for (std::size_t n = 1; n < step_.sweeps().size(); ++n) all.push_back(stage_of({step, n}));
  return arranged(std::move(all));
}

/// The stages of run_from(): rows that other grids own are left alone, and all others affect what is recorded
/// there.
template <int D, class Real>
auto TiledExecutor<D, Real>::stages_from(const SweepTime& across) const -> std::vector<Stage> {
  std::vector<Stage> all;
  for (const auto& sweep : step_.from_across(across)) {
    all.push_back(stage_of(sweep));
    all.back().needed = {sweeps_.own_rows(), {0, cut_cells_}};
  }
  return arranged(std::move(all));
}

template <int D, class Real>
auto TiledExecutor<D, Real>::stage_of(const SweepTime& sweep) const -> Stage {
  const auto& [axis, fraction] = step_.sweeps()[sweep.sweep];
  const auto kind = step_.is_last(sweep) ? Stage::end_of_step
                    : axis == 0          ? Stage::along_x
                    : axis == D - 1      ? Stage::along_z
                                         : Stage::along_y;
  Stage stage{kind, Real(fraction), {sweep.step, step_.dt_s()}};
  stage.sweep = sweep.sweep;
  return stage;
}

/// Gives each stage of a tile its distance from the first and the last one.
template <int D, class Real>
auto TiledExecutor<D, Real>::arranged(std::vector<Stage> all) const -> std::vector<Stage> {
  std::int64_t behind = 0, next_along_y = 0;
  int along_x = 0, along_y = 0, along_z = 0, ends = 0;
  for (auto& stage : all) {
    // Not before the last sweep along y has read what this one copies its velocities over (Sweeps::retain()).
    if (stage.kind == Stage::along_y) behind = std::max(behind, next_along_y);
    stage.behind = behind;
    switch (stage.kind) {
      case Stage::along_z:
        behind += sweeps_.rows_behind();
        stage.number = along_z++;
        break;
      case Stage::along_y:
        next_along_y = behind + 2 * surface_rows(1);
        behind += surface_rows(1);
        stage.number = along_y++;
        break;
      case Stage::along_x:
      case Stage::end_of_step:
        behind += surface_rows(0);
        stage.number = along_x;
        along_x += stage.kind == Stage::end_of_step ? 2 : 1;
        if (stage.kind == Stage::end_of_step) stage.end = ends++;
    }
  }
  std::int64_t ahead = 0;
  for (auto stage = all.rbegin(); stage != all.rend(); ++stage) {
    if (D == 2 && stage->kind == Stage::end_of_step) ahead += columns_behind(*stage);
    stage->ahead = ahead;
    ahead += columns_behind(*stage);
  }
  return all;
}

/// Columns (in 3-D rows of a plane) that a stage needs of the one before it beyond its own.
template <int D, class Real>
std::int64_t TiledExecutor<D, Real>::columns_behind(const Stage& stage) const {
  if (D == 2) return 2 * Sweeps<D, Real>::lag;
  if (stage.kind == Stage::along_y) return sweeps_.rows_behind();
  return stage.kind == Stage::along_z ? 2 * surface_rows(D - 1) : surface_rows(0);
}

template <int D, class Real>
std::int64_t TiledExecutor<D, Real>::stripes() const {
  return std::max<std::int64_t>(1, (cut_cells_ + stripe_width_ / 2) / stripe_width_);
}

/// Rows of a band that wait for the next stripe; with one stripe none does.
template <int D, class Real>
std::int64_t TiledExecutor<D, Real>::boundaries_per_sweep() const {
  return stripes() > 1 ? 2 * band_rows_ + longest_ : 1;
}

/// Returns where a sweep that much ahead ends in a stripe. The one before it in the tile is two blocks ahead
/// of it, or at the end of the row; in 3-D as many rows as it needs.
template <int D, class Real>
std::int64_t TiledExecutor<D, Real>::last_column(std::int64_t stripe, std::int64_t ahead) const {
  constexpr std::int64_t block = D == 2 ? Layout<D>::block : 1, least = D == 2 ? 2 * Sweeps<D, Real>::lag : 0;
  const std::int64_t count = stripes();
  const std::int64_t nominal =
      stripe + 1 == count ? cut_cells_ : (stripe + 1) * cut_cells_ / count / block * block;
  return nominal + ahead + least >= cut_cells_ ? cut_cells_ : nominal + ahead;
}

template <int D, class Real>
std::int64_t TiledExecutor<D, Real>::run(std::int64_t first, std::int64_t last,
                                         const std::function<bool()>& pause) {
  const std::int64_t tiles = (last - first + steps_per_tile_ - 1) / steps_per_tile_;
  // Whether a tile is made is decided in its first band, which comes after that of the tile before.
  std::atomic<std::int64_t> made = tiles;
  parallel_tiles(tiles, bands_, std::int64_t(in_progress_.size()),
                 [&](std::int64_t tile, std::int64_t band, int worker) {
                   if (pause && band == 0 && tile > 0 && tile < made && pause()) made = tile;
                   if (tile >= made) return;
                   const std::int64_t begin = first + tile * steps_per_tile_;
                   run_band(tile, band, begin, std::min(begin + steps_per_tile_, last),
                            workers_[std::size_t(worker)]);
                 });
  return std::min(first + made * steps_per_tile_, last);
}

template <int D, class Real>
void TiledExecutor<D, Real>::run_band(std::int64_t number, std::int64_t band, std::int64_t first,
                                      std::int64_t last, Worker& worker) {
  auto& tile = in_progress_[std::size_t(number) % in_progress_.size()];
  if (band == 0) {
    tile.stages = stages(first, last);
    for (auto& ring : tile.rings) ring.begin();
    const Box all{{0, rows_}, {0, cut_cells_}}, growth = growth_of_a_step();
    for (auto& stage : tile.stages) {
      stage.needed = everywhere_ ? all : step_.needed(stage.time, growth);
      if (!halo_) continue;
      const auto right = halo_->valid_rows(stage.time.step - first, growth.rows);
      stage.needed.rows = {std::max(stage.needed.rows.first, right.first),
                           std::min(stage.needed.rows.last, right.last)};
    }
    for (std::int64_t step = first; step < last; ++step) step_.begin({step, step_.dt_s()});
  }
  run_band(tile, band, worker);
  if (band + 1 == bands_)
    for (std::int64_t step = first; step < last; ++step) step_.finish({step, step_.dt_s()});
}

template <int D, class Real>
void TiledExecutor<D, Real>::run_from(const SweepTime& across, std::int64_t number, std::int64_t piece,
                                      int worker) {
  auto& tile = in_progress_[std::size_t(number) % in_progress_.size()];
  if (piece == 0) {
    tile.stages = stages_from(across);
    for (auto& ring : tile.rings) ring.begin();
    for (const auto& stage : tile.stages) step_.begin_once(stage.time.step);
  }
  run_band(tile, piece, workers_[std::size_t(worker)]);
  for (const auto& stage : piece + 1 == bands_ ? tile.stages : std::vector<Stage>())
    if (stage.kind == Stage::end_of_step) step_.finish(stage.time);
}

/// Makes all stages of a tile on a band of rows.
template <int D, class Real>
void TiledExecutor<D, Real>::run_band(TileInProgress& tile, std::int64_t band, Worker& worker) {
  const bool ends = band + 1 == bands_;
  const IndexRange rows{band * band_rows_, ends ? rows_ + longest_ : (band + 1) * band_rows_};
  if (halo_)
    for (const auto& refreshed : halo_->before(rows)) rows_changed(refreshed);
  std::fill(worker.columns.begin(), worker.columns.end(), IndexRange{});
  for (std::int64_t stripe = 0; stripe < stripes(); ++stripe) {
    for (std::size_t n = 0; n < tile.stages.size(); ++n) {
      const auto& stage = tile.stages[n];
      auto* const columns = &worker.columns[2 * n];
      columns[0] = {columns[0].last, last_column(stripe, stage.ahead)};
      columns[1] = {columns[1].last, last_column(stripe, stage.ahead - 2 * Sweeps<D, Real>::lag)};
    }
    run_stripe(tile, rows, worker);
  }
  if (halo_) halo_->after(rows.first - longest_, ends ? rows_ : rows.last - longest_);
}

template <int D, class Real>
void TiledExecutor<D, Real>::rows_changed(const IndexRange& rows) {
  const auto lines_a_row = layout_.lines() / rows_;
  for (auto line = rows.first * lines_a_row; line < rows.last * lines_a_row; ++line)
    mark_active(line, whole_lines());
}

template <int D, class Real>
void TiledExecutor<D, Real>::fields_changed() {
  for (std::int64_t line = 0; line < layout_.lines(); ++line) mark_active(line, whole_lines());
}

/// By how many rows and columns (in 3-D planes and rows) the fields of a cell spread in a step at most.
template <int D, class Real>
Box TiledExecutor<D, Real>::growth_of_a_step() const {
  std::array<std::int64_t, std::size_t(D)> surface_reach;
  for (int axis = 0; axis < D; ++axis) surface_reach[std::size_t(axis)] = surface_rows(axis);
  const auto along = [&](int axis) {
    return spread_of_a_step<D>(step_.sweeps(), axis, sweeps_.reach(), surface_reach);
  };
  const auto rows = along(D - 1), columns = along(D - 2);
  return {{rows, rows}, {columns, columns}};
}

template <int D, class Real>
std::int64_t TiledExecutor<D, Real>::swept_cells() const {
  std::int64_t cells = 0;
  for (const auto& worker : workers_) cells += worker.swept;
  return cells;
}

namespace {

/// Rows that are prefetched ahead of the first sweep.
constexpr std::int64_t rows_ahead = 1;

}  // namespace

/// Some cache lines into the second cache.
template <int D, class Real>
void TiledExecutor<D, Real>::Ahead::fetch() {
  constexpr int cache_line = 64;
  for (int n = 0; n < fetched_together && next < parts.size(); ++n) {
    auto& [first, last] = parts[next];
    __builtin_prefetch(first, 1, 2);
    first += cache_line;
    if (first >= last) ++next;
  }
}

/// Finds what the first stage reads of these planes: their lines follow each other in memory.
template <int D, class Real>
void TiledExecutor<D, Real>::look_ahead(const TileInProgress& tile, const IndexRange& planes,
                                        Worker& worker) const {
  worker.ahead.clear();
  if (D == 2) return;
  const auto& columns = worker.columns.front();
  const std::int64_t beyond = tile.stages.front().kind == Stage::along_y ? sweeps_.rows_behind() : 0;
  const IndexRange lines{columns.first == 0 ? 0 : columns.first + beyond,
                         std::min(columns.last + beyond, cut_cells_)};
  for (auto plane = planes.first; plane < std::min(planes.last, rows_) && !lines.empty(); ++plane) {
    const auto at = layout_.line_index(line_of(plane, lines.first));
    worker.ahead.add(state_.field_row(at, 0), lines.count() * layout_.stride(1));
    if (!state_.uniform_run(line_of(plane, lines.first), 0, layout_.shape()[0]))
      worker.ahead.add(state_.material_row(at, 0), lines.count() * state_.material_layout.stride(1));
  }
}

template <int D, class Real>
void TiledExecutor<D, Real>::run_stripe(TileInProgress& tile, const IndexRange& rows, Worker& worker) {
  for (std::int64_t first = rows.first; first < rows.last; first += together_) {
    const IndexRange arriving{first, std::min(first + together_, rows.last)};
    if (D == 2 && first + rows_ahead < rows_)
      sweeps_.queue_prefetch(first + rows_ahead, worker.columns.front(), worker.work.prefetch());
    look_ahead(tile, {arriving.last, std::min(arriving.last + together_, rows.last)}, worker);
    for (std::size_t n = 0; n < tile.stages.size(); ++n) {
      const auto& stage = tile.stages[n];
      const auto* const columns = &worker.columns[2 * n];
      const IndexRange here{arriving.first - stage.behind, arriving.last - stage.behind};
      if (stage.kind == Stage::along_z) {
        if (!columns->empty()) along_z(stage, here, *columns, tile, worker);
        continue;
      }
      for (auto row = here.first; row < here.last; ++row) {
        const std::int64_t in_band = stripes() > 1 ? row + stage.behind - rows.first : 0;
        if (stage.kind != Stage::along_y)
          sweep_rows(stage, row, in_band, columns, worker);
        else if (!columns->empty())
          sweep_plane(stage, row, *columns,
                      worker.rings[std::size_t(stage.number * boundaries_per_sweep() + in_band)], worker);
      }
    }
  }
}

/// A sweep along x or the end of a step, of all lines of a row (in 3-D of a plane).
template <int D, class Real>
void TiledExecutor<D, Real>::sweep_rows(const Stage& stage, std::int64_t row, std::int64_t in_band,
                                        const IndexRange* columns, Worker& worker) {
  const bool ends = stage.kind == Stage::end_of_step;
  const auto side_rows = surface_rows(0);
  if (side_rows > 0 && row >= 0 && row < rows_ && !columns->empty()) {
    if (D == 2) {
      sweeps_.retain(0, row, *columns);
    } else {
      const std::int64_t first = columns->first == 0 ? 0 : columns->first + side_rows;
      for (auto y = first; y < std::min(columns->last + side_rows, cut_cells_); ++y)
        sweeps_.retain(0, line_of(row, y), whole_lines());
    }
  }
  row -= side_rows;
  // The first cells of the next stripe depend on the boundary of this one, too.
  const std::int64_t left = D == 2 ? Sweeps<D, Real>::lag + 1 : 0;
  if (row < 0 || row >= rows_ ||
      !stage.needed.meets({row, row + 1}, {columns[D == 2 && ends ? 1 : 0].first, columns->last + left}))
    return;
  const auto boundary = [&](int sweep) -> StripeBoundary<Real>& {
    const auto number = stage.number + sweep;
    return worker.boundaries[std::size_t(D == 2 ? number * boundaries_per_sweep() + in_band : number)];
  };
  PatchBoundary<Real>* patches = nullptr;
  if (ends && !step_.patches().empty())
    patches = &worker.patches[std::size_t(D == 2 ? stage.end * boundaries_per_sweep() + in_band : stage.end)];
  const auto line = [&](std::int64_t number, const IndexRange& first, const IndexRange& second) {
    if (!first.empty()) sweeps_.correct_side_surfaces(number, first);
    if (ends)
      end_of_step(stage, number, first, second, boundary(0), boundary(1), patches, worker);
    else if (!first.empty())
      along_x(stage.time, number, first, stage.fraction, boundary(0), worker);
  };
  worker.work.time() = {stage.time.step, stage.sweep};
  if (D == 2) line(row, columns[0], columns[1]);
  for (auto y = columns->first; D == 3 && y < columns->last; ++y)
    line(line_of(row, y), whole_lines(), whole_lines());
}

/// A sweep along y of these lines of a plane.
template <int D, class Real>
void TiledExecutor<D, Real>::sweep_plane(const Stage& stage, std::int64_t row, const IndexRange& lines,
                                         Ring<Real>& ring, Worker& worker) {
  if constexpr (D == 3) {
    if (lines.first == 0) ring.begin();
    const auto behind = sweeps_.rows_behind(), flank_rows = surface_rows(1);
    const IndexRange steps{lines.first == 0 ? 0 : lines.first + behind, lines.last + behind};
    // What is beyond the last line is read some steps before that line is advanced.
    const bool high = steps.first <= cut_cells_ && steps.last > cut_cells_;
    if (flank_rows > 0 && row >= 0 && row < rows_) {
      for (auto y = steps.first; y < std::min(steps.last, cut_cells_); ++y)
        sweeps_.retain(1, line_of(row, y), whole_lines());
      if (high) sweeps_.retain(1, line_of(row, cut_cells_ - 1), whole_lines());
    }
    row -= flank_rows;
    if (row < 0 || row >= rows_ || !stage.needed.meets({row, row + 1}, {lines.first, steps.last + 1})) return;
    if (reached(stage.time, {row - flank_rows, row + flank_rows + 1},
                {steps.first - behind - 1 - sweeps_.reach(), steps.last}, whole_lines())
            .empty())
      return;
    sweeps_.correct_flank_surfaces(row, steps);
    worker.work.time() = {stage.time.step, stage.sweep};
    march(
        stage, {0, 0, row}, steps, ring, worker,
        [&](const IndexRange& lines_read) {
          return reached(stage.time, {row - flank_rows, row + flank_rows + 1}, lines_read, whole_lines());
        },
        [](std::int64_t) {},
        [&](std::int64_t step, const IndexRange& swept) {
          const auto done = step - behind;
          if (done >= 0 && done < cut_cells_) mark_active(line_of(row, done), swept);
        });
  }
}

/// Steps of a sweep across of the cells reached(rows read), which it may change: `begin` is called before
/// each that has any, `end` after it.
template <int D, class Real>
template <class Reached, class Begin, class End>
void TiledExecutor<D, Real>::march(const Stage& stage, const Index<D>& at, const IndexRange& steps,
                                   Ring<Real>& ring, Worker& worker, Reached&& reached, Begin&& begin,
                                   End&& end) {
  const int axis = stage.kind == Stage::along_z ? D - 1 : 1;
  // While nothing is swept what was zero stays so: only what each step reads anew is looked at.
  auto zero_to = std::numeric_limits<std::int64_t>::min();
  for (auto step = steps.first; step < steps.last; ++step) {
    // All that a row depends on, also rows that have been advanced since.
    const auto first = step - sweeps_.rows_behind() - 1 - sweeps_.reach();
    const auto swept = reached({std::max(first, zero_to), step + 1});
    if (swept.empty()) {
      zero_to = step + 1;
      continue;
    }
    zero_to = std::numeric_limits<std::int64_t>::min();
    const auto reach = sweeps_.reach();
    ring.take(step - reach, swept,
              [&](std::int64_t row, const IndexRange& zeros) { sweeps_.skip(row + reach, zeros, ring); });
    worker.ahead.fetch();
    begin(step);
    sweeps_.across(axis, at, step, swept, stage.fraction, ring, worker.work);
    end(step, swept);
  }
}

/// Returns the part of some cells, in whole blocks, that a sweep may change which reads these rows, in 3-D
/// these lines of each plane: cells farther from any that is not zero stay so.
template <int D, class Real>
IndexRange TiledExecutor<D, Real>::reached(const StepTime& time, const IndexRange& rows,
                                           const IndexRange& lines, const IndexRange& cells) const {
  if (everywhere_) return cells;
  const auto within = [](const IndexRange& some, std::int64_t cells) {
    return IndexRange{std::max<std::int64_t>(some.first, 0), std::min(some.last, cells)};
  };
  const IndexRange all = D == 2 ? IndexRange{0, 1} : within(lines, cut_cells_), of = within(rows, rows_);
  const IndexRange read{cells.first - read_beside, cells.last + read_beside};
  IndexRange active{cells.last, cells.first};
  for (auto row = of.first; row < of.last; ++row) {
    const auto first = line_of(row, all.first);
    const auto here = active_.among({first, first + all.count()}, read);
    if (!here.empty())
      active = {std::min(active.first, here.first - read_beside),
                std::max(active.last, here.last + read_beside)};
    if (active.first <= cells.first && active.last >= cells.last) return cells;
    for (auto y = all.first; step_.any_enters() && y < all.last; ++y)
      if (step_.enters(time, line_of(row, y), read)) return cells;
  }
  return common(active, cells);
}

template <int D, class Real>
void TiledExecutor<D, Real>::mark_active(std::int64_t line, const IndexRange& columns) {
  if (!everywhere_) active_.mark(line, columns, sweeps_);
}

/// Some steps of a sweep along z, of these columns or, in 3-D, lines.
template <int D, class Real>
void TiledExecutor<D, Real>::along_z(const Stage& stage, const IndexRange& steps, const IndexRange& columns,
                                     TileInProgress& tile, Worker& worker) {
  constexpr auto lag = Sweeps<D, Real>::lag;
  const auto behind = sweeps_.rows_behind(), beside = D == 2 ? lag : free_surface_reach;
  auto needed = common(steps, sweeps_.steps_of_own_rows());
  const auto is_needed = [&](std::int64_t step) {
    return stage.needed.meets({step - behind, step + 1}, columns);
  };
  while (!needed.empty() && !is_needed(needed.first)) ++needed.first;
  while (!needed.empty() && !is_needed(needed.last - 1)) --needed.last;
  const auto correct = [&](std::int64_t step) {
    sweeps_.correct_end_surfaces(step,
                                 {columns.first == 0 ? 0 : columns.first + beside, columns.last + beside});
  };
  worker.work.time() = {stage.time.step, stage.sweep};
  // The first rows read beyond surfaces and interfaces of those passed over before them, too; rows of steps
  // before these have their corrections, and may have been advanced.
  for (auto step = std::max<std::int64_t>({0, steps.first, needed.first - sweeps_.reach()});
       step < std::min(needed.first, needed.last); ++step)
    correct(step);
  if constexpr (D == 2) {
    march(
        stage, {}, needed, tile.rings[std::size_t(stage.number)], worker,
        [&](const IndexRange& rows_read) {
          // What corrects the first columns of the next stripe is due, too, and reads beyond them.
          const auto with_next = reached(stage.time, rows_read, {}, {columns.first, columns.last + beside});
          if (with_next.empty()) return with_next;
          return IndexRange{std::min(with_next.first, std::max(columns.first, columns.last - beside)),
                            std::min(with_next.last, columns.last)};
        },
        correct,
        [&](std::int64_t step, const IndexRange& swept) { end_across_z(stage, step, 0, swept, worker); });
  } else {
    const auto beyond = 2 * free_surface_reach;  // of corrections of lines beside these
    if (reached(stage.time, {needed.first - behind - 1 - sweeps_.reach(), needed.last},
                {columns.first - beyond, columns.last + beyond}, whole_lines())
            .empty())
      return;
    // All of these rows are as they were before the sweep, whatever has been swept below them.
    for (auto step = needed.first; step < needed.last; ++step) correct(step);
    for (auto y = columns.first; y < columns.last; ++y) {
      auto& ring = tile.rings[std::size_t(stage.number * cut_cells_ + y)];
      march(
          stage, {0, y, 0}, needed, ring, worker,
          [&](const IndexRange& rows_read) {
            return reached(stage.time, rows_read, with_surface_rows(D - 1, {y, y + 1}), whole_lines());
          },
          [](std::int64_t) {},
          [&](std::int64_t step, const IndexRange& swept) { end_across_z(stage, step, y, swept, worker); });
    }
  }
}

/// After a step of a sweep along z of these cells, in 3-D of lines y.
template <int D, class Real>
void TiledExecutor<D, Real>::end_across_z(const Stage& stage, std::int64_t step, std::int64_t y,
                                          const IndexRange& cells, Worker& worker) {
  const std::int64_t done = step - sweeps_.rows_behind();
  if (done < sweeps_.own_rows().first || done >= sweeps_.own_rows().last) return;
  const auto line = line_of(done, y);
  if (step_.acts_after_sweep(stage.sweep))
    step_.apply_after_sweep(stage.sweep, stage.time, state_.row_fields(line), cells);
  mark_active(line, cells);
  worker.swept += cells.count();
}

template <int D, class Real>
void TiledExecutor<D, Real>::along_x(const StepTime& time, std::int64_t line, const IndexRange& columns,
                                     Real fraction, StripeBoundary<Real>& boundary, Worker& worker,
                                     bool begins) {
  // In 2-D the next stripe continues what is found of the cells before it.
  constexpr auto more = D == 2 ? Sweeps<D, Real>::lag : 0;
  const auto at = layout_.line_index(line);
  const auto row = at[D - 1], y = at[D - 2];
  auto swept = reached(time, with_surface_rows(0, {row, row + 1}), with_surface_rows(0, {y, y + 1}),
                       {columns.first - more, columns.last + more});
  if (swept.empty()) {
    if (columns.count() < layout_.shape()[0]) boundary = {};  // nothing continues a whole line
    return;
  }
  if (D == 2) swept = columns;
  sweeps_.along_x(line, swept, fraction, boundary, worker.work, begins || swept.first > columns.first);
  mark_active(line, swept);
}

template <int D, class Real>
void TiledExecutor<D, Real>::end_of_step(const Stage& stage, std::int64_t line, const IndexRange& first,
                                         const IndexRange& second, StripeBoundary<Real>& boundary,
                                         StripeBoundary<Real>& second_boundary, PatchBoundary<Real>* patches,
                                         Worker& worker) {
  using Cells = typename TimeStep<D, Real>::Cells;
  const StepTime& time = stage.time;
  worker.work.time() = {time.step, stage.sweep};
  const auto at = layout_.line_index(line);
  const auto fields = state_.row_fields(line);
  const auto effects = [&](auto&& apply) {
    const bool injects = step_.injects(time, line);
    // They do nothing in rock at rest.
    if (!injects && reached(time, {at[D - 1], at[D - 1] + 1}, {at[D - 2], at[D - 2] + 1}, first).empty())
      return;
    apply();
    if (injects) mark_active(line, first);
  };
  if (step_.splits(time, line)) {
    if (!first.empty()) {
      along_x(time, line, first, stage.fraction, boundary, worker);
      effects([&] { step_.apply(time, Cells::split, fields, first); });
      step_.read(time, fields, first);
      effects([&] { step_.apply_after_record(time, Cells::split, fields, first); });
    }
    worker.work.time() = {time.step + 1, 0};
    if (!second.empty()) along_x(time, line, second, stage.fraction, second_boundary, worker);
    return;
  }
  const bool patched = patches && !step_.patches().of(line).empty();
  const auto copy = patched ? advance_patches(stage, line, first, second, *patches, worker) : std::nullopt;
  if (!first.empty()) {
    if (step_.reads(time, line)) {
      constexpr auto lag = Sweeps<D, Real>::lag;
      const IndexRange seen{first.first == 0 ? 0 : first.first + lag,
                            first.last == layout_.shape()[0] ? first.last : first.last + lag};
      read_beside_patches(stage, seen, sweeps_.ahead_along_x(line, seen, stage.fraction, worker.work));
    }
    if (copy)
      sweep_beside_patches(time, line, first, 2 * stage.fraction, boundary, worker);
    else
      along_x(time, line, first, 2 * stage.fraction, boundary, worker);
  }
  if (copy) put_patches(second, *copy);
}

template <int D, class Real>
void TiledExecutor<D, Real>::make_patch_memory() {
  const auto ends = std::size_t(steps_per_tile_) * std::size_t(D == 2 ? boundaries_per_sweep() : 1);
  for (auto& worker : workers_) {
    worker.strip_pitch = worker.work.pitch() + 2 * PatchBoundary<Real>::width;
    worker.strip = Buffer<Real>(worker.strip_pitch * layout_.rows());
    std::fill(worker.strip.data(), worker.strip.data() + worker.strip.size(), Real(0));
    worker.patches.resize(ends);
    for (auto& boundary : worker.patches)
      boundary.fields.resize(std::size_t(layout_.rows() * PatchBoundary<Real>::width));
  }
}

/// Whether any patch of a row reads or changes these columns.
template <int D, class Real>
bool TiledExecutor<D, Real>::patches_reach(std::int64_t line, const IndexRange& columns) const {
  constexpr auto reach = Patches<D>::margin + Patches<D>::beyond;
  const auto patches = step_.patches().of(line);
  return std::any_of(patches.begin(), patches.end(), [&](const Patch& patch) {
    return patch.blocks.first - reach < columns.last && patch.blocks.last + reach > columns.first;
  });
}

/// Advances the fields of the patches of a row, in a copy, to the end of the step and into the next one. As
/// on split rows, the second half sweep stays behind the first. Returns the copy, nothing where all is at
/// rest.
template <int D, class Real>
std::optional<RowFields<Real>> TiledExecutor<D, Real>::advance_patches(const Stage& stage, std::int64_t line,
                                                                       const IndexRange& first,
                                                                       const IndexRange& second,
                                                                       PatchBoundary<Real>& boundary,
                                                                       Worker& worker) {
  constexpr auto behind = PatchBoundary<Real>::behind, beyond = Patches<D>::beyond;
  const std::int64_t pitch = worker.strip_pitch, nx = layout_.shape()[0];
  if (!patches_reach(line, {second.first, first.last + beyond})) return std::nullopt;
  const auto patches = step_.patches().of(line);
  const auto at = layout_.line_index(line);
  if (reached(stage.time, {at[D - 1], at[D - 1] + 1}, {at[D - 2], at[D - 2] + 1},
              {second.first - behind, first.last + beyond})
          .empty()) {
    const auto fields = state_.row_fields(line);
    for (const auto& patch : patches) read_patch(stage, patch, first, fields);
    // The next stripe may begin anew: it would continue from zeros.
    boundary.line = -1;
    return std::nullopt;
  }
  // Cell 0 of the copy would be here.
  const RowFields<Real> strip{
      line, worker.strip.data() + Patches<D>::margin - (second.first - behind - Patches<D>::margin), pitch};
  const bool begins = boundary.line != line || boundary.step != stage.time.step ||
                      boundary.next != second.first || second.first == 0;
  load_patches(strip, first, second, begins, boundary);
  for (const auto& patch : patches)
    advance_patch(stage, patch, strip, first, second, begins, boundary, worker);
  boundary.line = line;
  boundary.step = stage.time.step;
  boundary.next = second.last;
  if (second.last < nx && patches_reach(line, {second.last, nx}))
    for (int row = 0; row < layout_.rows(); ++row) {
      const Real* const from = strip.field(row) + second.last - behind;
      std::copy(from, from + first.last - second.last + behind,
                boundary.fields.data() + row * PatchBoundary<Real>::width);
    }
  return strip;
}

/// Fills the copy with the values that the stripe before stored for the patches, and with those that no sweep
/// of this stage has changed.
template <int D, class Real>
void TiledExecutor<D, Real>::load_patches(const RowFields<Real>& strip, const IndexRange& first,
                                          const IndexRange& second, bool begins,
                                          const PatchBoundary<Real>& boundary) {
  using Boundary = PatchBoundary<Real>;
  constexpr auto margin = Patches<D>::margin, beyond = Patches<D>::beyond;
  const auto fields = state_.row_fields(strip.row);
  for (int row = 0; row < layout_.rows() && !begins; ++row) {
    const Real* const left = boundary.fields.data() + row * Boundary::width;
    std::copy(left, left + first.first - second.first + Boundary::behind,
              strip.field(row) + second.first - Boundary::behind);
  }
  const std::int64_t origin = second.first - Boundary::behind - margin;
  const IndexRange unchanged{begins ? std::max<std::int64_t>(origin, 0) : first.first,
                             std::min(first.last + beyond, layout_.shape()[0])};
  for (const auto& patch : step_.patches().of(strip.row)) {
    const auto needed =
        common({patch.blocks.first - margin - beyond, patch.blocks.last + margin + beyond}, unchanged);
    for (int row = 0; row < layout_.rows() && !needed.empty(); ++row)
      std::copy(fields.field(row) + needed.first, fields.field(row) + needed.last,
                strip.field(row) + needed.first);
  }
}

/// Half a sweep, effects and records at the end of the step, half a sweep of the next.
template <int D, class Real>
void TiledExecutor<D, Real>::advance_patch(const Stage& stage, const Patch& patch,
                                           const RowFields<Real>& strip, const IndexRange& first,
                                           const IndexRange& second, bool begins,
                                           PatchBoundary<Real>& boundary, Worker& worker) {
  using Cells = typename TimeStep<D, Real>::Cells;
  constexpr auto margin = Patches<D>::margin;
  const auto sweep = [&](const IndexRange& all, const IndexRange& now, StripeBoundary<Real>& of_sweep) {
    const auto columns = common(all, now);
    if (!columns.empty())
      sweeps_.along_copy(strip, columns, begins || columns.first == all.first, stage.fraction, of_sweep,
                         worker.work);
    return columns;
  };
  const auto ended = sweep({patch.blocks.first - margin, patch.blocks.last + margin}, first, boundary.first);
  if (!ended.empty()) {
    step_.apply(stage.time, Cells::patch, strip, ended);
    read_patch(stage, patch, first, strip);
    step_.apply_after_record(stage.time, Cells::patch, strip, ended);
  }
  sweep(patch.blocks, second, boundary.second);
}

/// Records read those of these columns that are in the patch.
template <int D, class Real>
void TiledExecutor<D, Real>::read_patch(const Stage& stage, const Patch& patch, const IndexRange& columns,
                                        const RowFields<Real>& fields) {
  const auto seen = common(patch.cells, columns);
  if (!seen.empty() && step_.reads(stage.time, fields.row)) step_.read(stage.time, fields, seen);
}

/// One sweep of these columns. Blocks that are nothing but a patch are left as they were where that saves
/// work.
template <int D, class Real>
void TiledExecutor<D, Real>::sweep_beside_patches(const StepTime& time, std::int64_t line,
                                                  const IndexRange& columns, Real fraction,
                                                  StripeBoundary<Real>& boundary, Worker& worker) {
  constexpr auto block = Layout<D>::block, least = 4 * block;
  std::int64_t first = columns.first;
  bool begins = false;
  for (const auto& patch : step_.patches().of(line)) {
    const IndexRange left = {(patch.cells.first + block - 1) / block * block,
                             patch.cells.last / block * block};
    if (left.count() < least || left.last < first || left.first >= columns.last) continue;
    if (first < left.first) along_x(time, line, {first, left.first}, fraction, boundary, worker, begins);
    first = std::min(left.last, columns.last);
    begins = true;
  }
  if (first < columns.last) along_x(time, line, {first, columns.last}, fraction, boundary, worker, begins);
}

/// Writes the patches in these columns back into the row.
template <int D, class Real>
void TiledExecutor<D, Real>::put_patches(const IndexRange& columns, const RowFields<Real>& copy) {
  for (const auto& patch : step_.patches().of(copy.row)) {
    const auto here = common(patch.cells, columns);
    if (here.empty()) continue;
    sweeps_.put(copy, here);
    mark_active(copy.row, here);
  }
}

/// Records read those of these columns of a row that are in no patch.
template <int D, class Real>
void TiledExecutor<D, Real>::read_beside_patches(const Stage& stage, const IndexRange& columns,
                                                 const RowFields<Real>& fields) {
  std::int64_t first = columns.first;
  const auto read = [&](std::int64_t last) {
    if (first < last) step_.read(stage.time, fields, {first, last});
  };
  for (const auto& patch : step_.patches().of(fields.row)) {
    read(std::min(patch.cells.first, columns.last));
    first = std::max(first, patch.cells.last);
  }
  read(columns.last);
}

SLIPWAVE_INSTANTIATE_D_REAL(TYPE, class TiledExecutor);

}  // namespace slipwave::solver
