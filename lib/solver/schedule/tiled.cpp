#include "solver/schedule/tiled.hpp"

#include <algorithm>
#include <atomic>

#include "parallel/threads.hpp"
#include "solver/schedule/subdomains.hpp"

namespace slipwave::solver {
namespace {

// Measured on grids from 10^4 to 10^8 cells (tests/bench, docs/performance.md).
/// Columns of a stripe: what the sweeps need of them stays in a first cache of 32 to 48 KiB.
constexpr std::int64_t usual_stripe = 256;
/// In 3-D cells of a plane of a stripe: the second cache, of 1 MiB or more, holds what the sweeps along z
/// need.
constexpr std::int64_t usual_cells_of_a_plane = 1536;
/// Rows of a band, at least. Between bands some rows leave the cache.
constexpr std::int64_t fewest_band_rows = 32;

template <int D>
std::int64_t stripe_for(const Layout<D>& layout) {
  if (D == 2) return usual_stripe;
  return std::max<std::int64_t>(4, usual_cells_of_a_plane / layout.padded_nx());
}

}  // namespace

template <int D, class Real>
TiledExecutor<D, Real>::TiledExecutor(Sweeps<D, Real>& sweeps, const State<D, Real>& state, int time_order,
                                      double dt_s, EndOfStep<Real>& end, const Tiling& tiling,
                                      std::int64_t rows_beside)
    : sweeps_(sweeps),
      layout_(state.layout),
      active_(state),
      everywhere_(tiling.everywhere),
      splitting_(splitting(D, time_order)),
      dt_s_(dt_s),
      end_(end),
      steps_per_tile_(steps_of_a_tile(tiling)),
      stripe_width_(tiling.stripe_cells > 0 ? tiling.stripe_cells : stripe_for(layout_)),
      rows_(layout_.shape()[D - 1]),
      cut_cells_(layout_.shape()[D - 2]) {
  const auto longest = stages(0, steps_per_tile_);
  longest_ = longest.back().behind + bend_rows(0);
  const auto [along_x, along_y, along_z] = counts(longest);
  // What is handed to neighbours or put right is then not what the pass behind or the one before is at.
  band_rows_ = std::max(fewest_band_rows, longest_ + std::max(std::int64_t(2) * max_reach, rows_beside));
  bands_ = std::max<std::int64_t>(1, rows_ / band_rows_);
  const int threads = parallel_threads();
  const auto most = std::int64_t(Effect::most_steps_in_progress / steps_per_tile_);
  in_progress_.resize(std::size_t(threads > 1 ? std::clamp<std::int64_t>(threads + 1, 1, most) : 1));
  const auto ring = [&](int axis) { return sweeps.make_ring(axis, 0, layout_.padded_nx()); };
  for (auto& pass : in_progress_)
    for (std::int64_t n = 0; n < along_z * (D == 2 ? 1 : cut_cells_); ++n) pass.rings.push_back(ring(D - 1));
  std::int64_t widest = layout_.padded_nx();
  if (D == 2) widest = std::min(stripe_width_ * 2 + longest.front().ahead, widest);
  for (int n = 0; n < parallel_workers(); ++n) {
    workers_.push_back(
        {sweeps.make_workspace(widest + 2 * Sweeps<D, Real>::lag),
         std::vector<StripeBoundary<Real>>(std::size_t(along_x * (D == 2 ? boundaries_per_sweep() : 1))),
         {},
         std::vector<IndexRange>(2 * longest.size())});
    for (std::int64_t m = 0; m < along_y * boundaries_per_sweep(); ++m)
      workers_.back().rings.push_back(ring(1));
  }
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
  for (const auto& pass : in_progress_)
    for (const auto& ring : pass.rings) bytes += ring.memory_bytes();
  for (const auto& worker : workers_)
    for (const auto& ring : worker.rings) bytes += ring.memory_bytes();
  return bytes;
}

/// The stages of a pass that makes these steps.
template <int D, class Real>
auto TiledExecutor<D, Real>::stages(std::int64_t first, std::int64_t last) const -> std::vector<Stage> {
  std::vector<Stage> all;
  // The last sweep of a step and the first of the next are alike: both belong to the end of a step.
  const Real end = Real(splitting_.front().fraction);
  if (first == 0) all.push_back({Stage::along_x, end, {0, dt_s_}});
  for (std::int64_t step = first; step < last; ++step) {
    for (std::size_t n = 1; n + 1 < splitting_.size(); ++n) {
      const int axis = splitting_[n].axis;
      const auto kind = axis == 0 ? Stage::along_x : axis == D - 1 ? Stage::along_z : Stage::along_y;
      all.push_back({kind, Real(splitting_[n].fraction), {step, dt_s_}});
    }
    all.push_back({Stage::end_of_step, end, {step, dt_s_}});
  }
  std::int64_t behind = 0;
  int along_x = 0, along_y = 0, along_z = 0, ends = 0;
  for (auto& stage : all) {
    stage.behind = behind;
    switch (stage.kind) {
      case Stage::along_z:
        behind += sweeps_.rows_behind();
        stage.number = along_z++;
        break;
      case Stage::along_y:
        behind += bend_rows(1);
        stage.number = along_y++;
        break;
      case Stage::along_x:
      case Stage::end_of_step:
        behind += bend_rows(0);
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
  return stage.kind == Stage::along_z ? 2 * bend_rows(D - 1) : bend_rows(0);
}

template <int D, class Real>
std::int64_t TiledExecutor<D, Real>::stripes() const {
  return std::max<std::int64_t>(1, (cut_cells_ + stripe_width_ / 2) / stripe_width_);
}

/// Lines of a band that wait for the next stripe; where there is none, nothing waits.
template <int D, class Real>
std::int64_t TiledExecutor<D, Real>::boundaries_per_sweep() const {
  return stripes() > 1 ? 2 * band_rows_ + longest_ : 1;
}

/// Where a sweep that much ahead ends in a stripe. The one before it in the pass is two blocks ahead of it,
/// or at the end of the line; in 3-D as many rows as it needs.
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
  const std::int64_t passes = (last - first + steps_per_tile_ - 1) / steps_per_tile_;
  // A pass is decided on in its first band, which comes after that of the pass before.
  std::atomic<std::int64_t> made = passes;
  parallel_passes(passes, bands_, std::int64_t(in_progress_.size()),
                  [&](std::int64_t pass, std::int64_t band, int worker) {
                    if (pause && band == 0 && pass > 0 && pass < made && pause()) made = pass;
                    if (pass >= made) return;
                    const std::int64_t begin = first + pass * steps_per_tile_;
                    run_band(pass, band, begin, std::min(begin + steps_per_tile_, last),
                             workers_[std::size_t(worker)]);
                  });
  return std::min(first + made * steps_per_tile_, last);
}

template <int D, class Real>
void TiledExecutor<D, Real>::run_band(std::int64_t number, std::int64_t band, std::int64_t first,
                                      std::int64_t last, Worker& worker) {
  auto& pass = in_progress_[std::size_t(number) % in_progress_.size()];
  if (band == 0) {
    pass.stages = stages(first, last);
    const Box all{{0, rows_}, {0, cut_cells_}}, growth = growth_of_a_step();
    for (auto& stage : pass.stages) {
      stage.needed = everywhere_ ? all : end_.needed(stage.time, growth);
      if (!halo_) continue;
      const auto right = halo_->right_after(stage.time.step - first, growth.rows);
      stage.needed.rows = {std::max(stage.needed.rows.first, right.first),
                           std::min(stage.needed.rows.last, right.last)};
    }
    for (std::int64_t step = first; step < last; ++step) end_.begin({step, dt_s_});
  }
  const bool ends = band + 1 == bands_;
  const IndexRange rows{band * band_rows_, ends ? rows_ + longest_ : (band + 1) * band_rows_};
  if (halo_)
    for (const auto& renewed : halo_->before(rows)) refresh(renewed);
  std::fill(worker.columns.begin(), worker.columns.end(), IndexRange{});
  for (std::int64_t stripe = 0; stripe < stripes(); ++stripe) {
    for (std::size_t n = 0; n < pass.stages.size(); ++n) {
      const auto& stage = pass.stages[n];
      auto* const columns = &worker.columns[2 * n];
      columns[0] = {columns[0].last, last_column(stripe, stage.ahead)};
      columns[1] = {columns[1].last, last_column(stripe, stage.ahead - 2 * Sweeps<D, Real>::lag)};
    }
    run_stripe(pass, rows, worker);
  }
  if (halo_) halo_->after(rows.first - longest_, ends ? rows_ : rows.last - longest_);
  if (ends)
    for (std::int64_t step = first; step < last; ++step) end_.finish({step, dt_s_});
}

/// Rows that came from neighbours.
template <int D, class Real>
void TiledExecutor<D, Real>::refresh(const IndexRange& rows) {
  const auto lines_a_row = layout_.lines() / rows_;
  for (auto line = rows.first * lines_a_row; line < rows.last * lines_a_row; ++line)
    mark_active(line, whole_lines());
}

template <int D, class Real>
void TiledExecutor<D, Real>::find_active_cells() {
  for (std::int64_t line = 0; line < layout_.lines(); ++line) mark_active(line, whole_lines());
}

/// By how many rows and columns (in 3-D planes and rows) the fields of a cell spread in a step at most.
template <int D, class Real>
Box TiledExecutor<D, Real>::growth_of_a_step() const {
  std::array<std::int64_t, std::size_t(D)> bends;
  for (int axis = 0; axis < D; ++axis) bends[std::size_t(axis)] = bend_rows(axis);
  const auto along = [&](int axis) { return spread_of_a_step<D>(splitting_, axis, sweeps_.reach(), bends); };
  const auto rows = along(D - 1), columns = along(D - 2);
  return {{rows, rows}, {columns, columns}};
}

template <int D, class Real>
std::int64_t TiledExecutor<D, Real>::swept_cells() const {
  std::int64_t cells = 0;
  for (const auto& worker : workers_) cells += worker.swept;
  return cells;
}

template class TiledExecutor<2, float>;
template class TiledExecutor<2, double>;
template class TiledExecutor<3, float>;
template class TiledExecutor<3, double>;

}  // namespace slipwave::solver
