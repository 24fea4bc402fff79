#include <algorithm>

#include "solver/schedule/tiled.hpp"

// What a pass does to the rows of a stripe (in 3-D to planes) as they come.
namespace slipwave::solver {
namespace {

/// Rows that are asked for before the first sweep comes to them.
constexpr std::int64_t rows_ahead = 1;

}  // namespace

template <int D, class Real>
void TiledExecutor<D, Real>::run_stripe(TileInProgress& pass, const IndexRange& rows, Worker& worker) {
  for (std::int64_t arriving = rows.first; arriving < rows.last; ++arriving) {
    if (D == 2 && arriving + rows_ahead < rows_)
      sweeps_.expect(arriving + rows_ahead, worker.columns.front(), worker.work.coming());
    const std::int64_t in_band = stripes() > 1 ? arriving - rows.first : 0;
    for (std::size_t n = 0; n < pass.stages.size(); ++n) {
      const auto& stage = pass.stages[n];
      const auto* const columns = &worker.columns[2 * n];
      const std::int64_t row = arriving - stage.behind;
      if (stage.kind == Stage::along_z) {
        if (row >= 0 && row < rows_ + sweeps_.rows_behind() && !columns->empty())
          along_z(stage, row, *columns, pass, worker);
      } else if (stage.kind == Stage::along_y) {
        if (!columns->empty())
          sweep_plane(stage, row, *columns,
                      worker.rings[std::size_t(stage.number * boundaries_per_sweep() + in_band)], worker);
      } else {
        sweep_rows(stage, row, in_band, columns, worker);
      }
    }
  }
}

/// A sweep along x or the end of a step, of all lines of a row (in 3-D of a plane).
template <int D, class Real>
void TiledExecutor<D, Real>::sweep_rows(const Stage& stage, std::int64_t row, std::int64_t in_band,
                                        const IndexRange* columns, Worker& worker) {
  const bool ends = stage.kind == Stage::end_of_step;
  const auto side_rows = bend_rows(0);
  if (side_rows > 0 && row >= 0 && row < rows_ && !columns->empty()) {
    if (D == 2) {
      sweeps_.keep(0, row, *columns);
    } else {
      const std::int64_t first = columns->first == 0 ? 0 : columns->first + side_rows;
      for (auto y = first; y < std::min(columns->last + side_rows, cut_cells_); ++y)
        sweeps_.keep(0, line_of(row, y), whole_lines());
    }
  }
  row -= side_rows;
  // The first cells of the next stripe come of what this one leaves, too.
  const std::int64_t left = D == 2 ? Sweeps<D, Real>::lag + 1 : 0;
  if (row < 0 || row >= rows_ ||
      !stage.needed.meets({row, row + 1}, {columns[D == 2 && ends ? 1 : 0].first, columns->last + left}))
    return;
  const auto boundary = [&](int sweep) -> StripeBoundary<Real>& {
    const auto number = stage.number + sweep;
    return worker.boundaries[std::size_t(D == 2 ? number * boundaries_per_sweep() + in_band : number)];
  };
  PatchBoundary<Real>* patches = nullptr;
  if (ends && patches_)
    patches = &worker.patches[std::size_t(D == 2 ? stage.end * boundaries_per_sweep() + in_band : stage.end)];
  const auto line = [&](std::int64_t number, const IndexRange& first, const IndexRange& second) {
    if (!first.empty()) sweeps_.measure_side_surfaces(number);
    if (ends)
      end_of_step(stage, number, first, second, boundary(0), boundary(1), patches, worker);
    else if (!first.empty())
      along_x(number, first, stage.fraction, boundary(0), worker);
  };
  if (D == 2) line(row, columns[0], columns[1]);
  for (auto y = columns->first; D == 3 && y < columns->last; ++y)
    line(line_of(row, y), whole_lines(), whole_lines());
}

/// A sweep along y of these lines of a plane.
template <int D, class Real>
void TiledExecutor<D, Real>::sweep_plane(const Stage& stage, std::int64_t row, const IndexRange& lines,
                                         Ring<Real>& ring, Worker& worker) {
  if constexpr (D == 3) {
    const auto behind = sweeps_.rows_behind(), flank_rows = bend_rows(1);
    const IndexRange steps{lines.first == 0 ? 0 : lines.first + behind, lines.last + behind};
    // What is beyond the last line is read some steps before that line is brought forward.
    const bool low = lines.first == 0, high = steps.first <= cut_cells_ && steps.last > cut_cells_;
    if (flank_rows > 0 && row >= 0 && row < rows_) {
      if (low) sweeps_.keep(1, line_of(row, 0), whole_lines());
      if (high) sweeps_.keep(1, line_of(row, cut_cells_ - 1), whole_lines());
    }
    row -= flank_rows;
    if (row < 0 || row >= rows_ || !stage.needed.meets({row, row + 1}, {lines.first, steps.last + 1})) return;
    if (low || high) sweeps_.measure_flank_surfaces(row);
    for (auto step = steps.first; step < steps.last; ++step) {
      const auto done = step - behind;
      if (is_quiet({row - flank_rows, row + flank_rows + 1}, {done - 1 - sweeps_.reach(), step + 1},
                   whole_lines())) {
        sweeps_.pass_over(step, whole_lines(), ring);
        continue;
      }
      sweeps_.across(1, {0, 0, row}, step, whole_lines(), stage.fraction, ring, worker.work);
      if (done >= 0 && done < cut_cells_) mark_active(line_of(row, done), whole_lines());
    }
  }
}

/// Whether all cells of these lines are zero; lines: in 3-D those of each of the rows.
template <int D, class Real>
bool TiledExecutor<D, Real>::is_quiet(const IndexRange& rows, const IndexRange& lines,
                                      const IndexRange& columns) const {
  if (everywhere_) return false;
  const auto within = [](const IndexRange& some, std::int64_t cells) {
    return IndexRange{std::max<std::int64_t>(some.first, 0), std::min(some.last, cells)};
  };
  const IndexRange all = D == 2 ? IndexRange{0, 1} : within(lines, cut_cells_), of = within(rows, rows_);
  for (auto row = of.first; row < of.last; ++row)
    for (auto y = all.first; y < all.last; ++y)
      if (!active_.is_quiet(line_of(row, y), columns)) return false;
  return true;
}

template <int D, class Real>
void TiledExecutor<D, Real>::mark_active(std::int64_t line, const IndexRange& columns) {
  if (!everywhere_) active_.look(line, columns);
}

/// A sweep along z, of these columns or, in 3-D, lines.
template <int D, class Real>
void TiledExecutor<D, Real>::along_z(const Stage& stage, std::int64_t step, const IndexRange& columns,
                                     TileInProgress& pass, Worker& worker) {
  constexpr auto lag = Sweeps<D, Real>::lag;
  const std::int64_t done = step - sweeps_.rows_behind(), beside = D == 2 ? lag : FreeSurface<D, Real>::reach;
  if (!stage.needed.meets({done, step + 1}, columns)) return;
  // All that row `done` comes of, also rows that have been brought forward since.
  const IndexRange rows{done - 1 - sweeps_.reach(), step + 1};
  const auto measure = [&] {
    sweeps_.measure_end_surfaces(step,
                                 {columns.first == 0 ? 0 : columns.first + beside, columns.last + beside});
  };
  const auto sweep = [&](const Index<D>& at, const IndexRange& across, Ring<Real>& ring) {
    sweeps_.across(D - 1, at, step, across, stage.fraction, ring, worker.work);
    if (done < 0 || done >= rows_) return;
    mark_active(line_of(done, at[D - 2]), across);
    worker.swept += across.count();
  };
  if constexpr (D == 2) {
    auto& ring = pass.rings[std::size_t(stage.number)];
    // Free edges read some cells of the columns beside these.
    if (is_quiet(rows, {}, {columns.first - lag, columns.last + lag})) {
      sweeps_.pass_over(step, columns, ring);
      return;
    }
    measure();
    sweep({}, columns, ring);
  } else {
    measure();
    for (auto y = columns.first; y < columns.last; ++y) {
      auto& ring = pass.rings[std::size_t(stage.number * cut_cells_ + y)];
      if (is_quiet(rows, with_bends(D - 1, {y, y + 1}), whole_lines()))
        sweeps_.pass_over(step, whole_lines(), ring);
      else
        sweep({0, y, 0}, whole_lines(), ring);
    }
  }
}

template <int D, class Real>
void TiledExecutor<D, Real>::along_x(std::int64_t line, const IndexRange& columns, Real part,
                                     StripeBoundary<Real>& boundary, Worker& worker, bool begins) {
  constexpr auto reach = 2 * Sweeps<D, Real>::lag;
  const auto at = layout_.line_index(line);
  const auto row = at[D - 1], y = at[D - 2];
  if (is_quiet(with_bends(0, {row, row + 1}), with_bends(0, {y, y + 1}),
               {columns.first - reach, columns.last + reach})) {
    boundary = {};
    return;
  }
  sweeps_.along_x(line, columns, part, boundary, worker.work, begins);
  mark_active(line, columns);
}

template <int D, class Real>
void TiledExecutor<D, Real>::end_of_step(const Stage& stage, std::int64_t line, const IndexRange& first,
                                         const IndexRange& second, StripeBoundary<Real>& boundary,
                                         StripeBoundary<Real>& second_carry, PatchBoundary<Real>* patches,
                                         Worker& worker) {
  const StepTime& time = stage.time;
  const auto at = layout_.line_index(line);
  const auto passes = [&](auto&& what) {
    const bool injects = end_.injects(time, line);
    // They make nothing of rock at rest.
    if (!injects && is_quiet({at[D - 1], at[D - 1] + 1}, {at[D - 2], at[D - 2] + 1}, first)) return;
    what();
    if (injects) mark_active(line, first);
  };
  if (end_.whole(time, line)) {
    if (!first.empty()) {
      along_x(line, first, stage.fraction, boundary, worker);
      passes([&] { end_.run(time, line, first); });
      end_.look(time, line, first, sweeps_.fields_of(line), layout_.row_pitch());
      passes([&] { end_.run_after_record(time, line, first); });
    }
    if (!second.empty()) along_x(line, second, stage.fraction, second_carry, worker);
    return;
  }
  const bool patched = patches && !patches_->of(line).empty();
  const Real* const patch = patched ? work_on_patches(stage, line, first, second, *patches, worker) : nullptr;
  if (first.empty()) {
    if (patch) put_patches(line, second, patch, worker.strip_pitch);
    return;
  }
  if (end_.looks(time, line)) {
    constexpr auto lag = Sweeps<D, Real>::lag;
    const IndexRange seen{first.first == 0 ? 0 : first.first + lag,
                          first.last == layout_.shape()[0] ? first.last : first.last + lag};
    look_beside_patches(stage, line, seen, sweeps_.ahead_along_x(line, seen, stage.fraction, worker.work),
                        worker.work.pitch());
  }
  if (patch)
    sweep_beside_patches(line, first, 2 * stage.fraction, boundary, worker);
  else
    along_x(line, first, 2 * stage.fraction, boundary, worker);
  if (end_.acts_between_steps())
    passes([&] {
      end_.run(time, line, first);
      end_.run_after_record(time, line, first);
    });
  if (patch) put_patches(line, second, patch, worker.strip_pitch);
}

template void TiledExecutor<2, float>::run_stripe(TileInProgress&, const IndexRange&, Worker&);
template bool TiledExecutor<2, float>::is_quiet(const IndexRange&, const IndexRange&,
                                                const IndexRange&) const;
template void TiledExecutor<2, float>::along_x(std::int64_t, const IndexRange&, float, StripeBoundary<float>&,
                                               Worker&, bool);
template void TiledExecutor<2, float>::mark_active(std::int64_t, const IndexRange&);
template void TiledExecutor<2, double>::run_stripe(TileInProgress&, const IndexRange&, Worker&);
template bool TiledExecutor<2, double>::is_quiet(const IndexRange&, const IndexRange&,
                                                 const IndexRange&) const;
template void TiledExecutor<2, double>::along_x(std::int64_t, const IndexRange&, double,
                                                StripeBoundary<double>&, Worker&, bool);
template void TiledExecutor<2, double>::mark_active(std::int64_t, const IndexRange&);
template void TiledExecutor<3, float>::run_stripe(TileInProgress&, const IndexRange&, Worker&);
template bool TiledExecutor<3, float>::is_quiet(const IndexRange&, const IndexRange&,
                                                const IndexRange&) const;
template void TiledExecutor<3, float>::along_x(std::int64_t, const IndexRange&, float, StripeBoundary<float>&,
                                               Worker&, bool);
template void TiledExecutor<3, float>::mark_active(std::int64_t, const IndexRange&);
template void TiledExecutor<3, double>::run_stripe(TileInProgress&, const IndexRange&, Worker&);
template bool TiledExecutor<3, double>::is_quiet(const IndexRange&, const IndexRange&,
                                                 const IndexRange&) const;
template void TiledExecutor<3, double>::along_x(std::int64_t, const IndexRange&, double,
                                                StripeBoundary<double>&, Worker&, bool);
template void TiledExecutor<3, double>::mark_active(std::int64_t, const IndexRange&);

}  // namespace slipwave::solver
