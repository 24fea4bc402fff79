#include <algorithm>

#include "solver/schedule/tiled.hpp"

// The end of a step where fractures take half sweeps along x and the rest of the line one sweep.
namespace slipwave::solver {
namespace {

IndexRange common(const IndexRange& one, const IndexRange& other) {
  return {std::max(one.first, other.first), std::min(one.last, other.last)};
}

}  // namespace

template <int D, class Real>
void TiledExecutor<D, Real>::use(const Patches<D>* patches) {
  patches_ = patches && !patches->empty() ? patches : nullptr;
  if (!patches_) return;
  const auto ends = std::size_t(steps_per_tile_) * std::size_t(D == 2 ? boundaries_per_sweep() : 1);
  for (auto& worker : workers_) {
    worker.strip_pitch = worker.work.pitch() + 2 * PatchBoundary<Real>::width;
    worker.strip = Buffer<Real>(worker.strip_pitch * FieldRows<D>::count);
    std::fill(worker.strip.data(), worker.strip.data() + worker.strip.size(), Real(0));
    worker.patches.resize(ends);
    for (auto& boundary : worker.patches)
      boundary.fields.resize(std::size_t(FieldRows<D>::count * PatchBoundary<Real>::width));
  }
}

/// Brings the fields of the patches of a line, in a copy, to the end of the step and into the next one. As on
/// lines that take half sweeps as a whole, the second of them stays behind the first. Returns cell 0 of row 0
/// of the copy, null where nothing moves.
template <int D, class Real>
const Real* TiledExecutor<D, Real>::work_on_patches(const Stage& stage, std::int64_t line,
                                                    const IndexRange& first, const IndexRange& second,
                                                    PatchBoundary<Real>& boundary, Worker& worker) {
  using Kept = PatchBoundary<Real>;
  constexpr auto margin = Patches<D>::margin, beyond = Patches<D>::beyond;
  const std::int64_t pitch = worker.strip_pitch, nx = layout_.shape()[0];
  const std::int64_t origin = second.first - Kept::behind - margin;
  Real* const copy = worker.strip.data() + margin - origin;
  const Real* const state = sweeps_.fields_of(line);
  const auto each_row = [](auto&& what) {
    for (int row = 0; row < FieldRows<D>::count; ++row) what(row);
  };
  const auto patches = patches_->of(line);
  // Whether any patch has to do with these columns.
  const auto wanted = [&](const IndexRange& columns) {
    return std::any_of(patches.begin(), patches.end(), [&](const Patch& patch) {
      return patch.blocks.first - margin - beyond < columns.last &&
             patch.blocks.last + margin + beyond > columns.first;
    });
  };
  if (!wanted({second.first, first.last + beyond})) return nullptr;
  const auto at = layout_.line_index(line);
  const bool looks = end_.looks(stage.time, line);
  const auto look = [&](const Patch& patch, const Real* fields, std::int64_t way) {
    if (const auto seen = common(patch.cells, first); looks && !seen.empty())
      end_.look(stage.time, line, seen, fields, way);
  };
  if (is_quiet({at[D - 1], at[D - 1] + 1}, {at[D - 2], at[D - 2] + 1},
               {second.first - Kept::behind, first.last + beyond})) {
    for (const auto& patch : patches) look(patch, state, layout_.row_pitch());
    // The next stripe begins with zeros as well as it would go on from them.
    boundary.line = -1;
    return nullptr;
  }
  const bool begins = boundary.line != line || boundary.step != stage.time.step ||
                      boundary.next != second.first || second.first == 0;
  if (!begins)
    each_row([&](int row) {
      const Real* const kept = boundary.fields.data() + row * Kept::width;
      std::copy(kept, kept + first.first - second.first + Kept::behind,
                copy + row * pitch + second.first - Kept::behind);
    });
  // What no sweep of this stage has changed yet.
  const IndexRange unchanged{begins ? std::max<std::int64_t>(origin, 0) : first.first,
                             std::min(first.last + beyond, nx)};
  for (const auto& patch : patches) {
    const auto read =
        common({patch.blocks.first - margin - beyond, patch.blocks.last + margin + beyond}, unchanged);
    if (!read.empty())
      each_row([&](int row) {
        std::copy(state + row * layout_.row_pitch() + read.first,
                  state + row * layout_.row_pitch() + read.last, copy + row * pitch + read.first);
      });
  }
  for (const auto& patch : patches) {
    const auto sweep = [&](const IndexRange& all, const IndexRange& now, StripeBoundary<Real>& of_sweep) {
      const auto columns = common(all, now);
      if (!columns.empty())
        sweeps_.along_copy(line, {copy, pitch}, columns, begins || columns.first == all.first, stage.fraction,
                           of_sweep, worker.work);
      return columns;
    };
    const auto slipping =
        sweep({patch.blocks.first - margin, patch.blocks.last + margin}, first, boundary.first);
    if (!slipping.empty()) {
      end_.run_patch(stage.time, line, slipping, copy, pitch);
      look(patch, copy, pitch);
      end_.run_patch_after(stage.time, line, slipping, copy, pitch);
    }
    sweep(patch.blocks, second, boundary.second);
  }
  boundary.line = line;
  boundary.step = stage.time.step;
  boundary.next = second.last;
  if (second.last < nx && wanted({second.last, nx}))
    each_row([&](int row) {
      const Real* const from = copy + row * pitch + second.last - Kept::behind;
      std::copy(from, from + first.last - second.last + Kept::behind,
                boundary.fields.data() + row * Kept::width);
    });
  return copy;
}

/// One sweep of these columns. Blocks that are nothing but a patch are left as they were where that saves
/// work.
template <int D, class Real>
void TiledExecutor<D, Real>::sweep_beside_patches(std::int64_t line, const IndexRange& columns, Real part,
                                                  StripeBoundary<Real>& boundary, Worker& worker) {
  constexpr auto block = Layout<D>::block, least = 4 * block;
  std::int64_t first = columns.first;
  bool begins = false;
  for (const auto& patch : patches_->of(line)) {
    const IndexRange left = {(patch.cells.first + block - 1) / block * block,
                             patch.cells.last / block * block};
    if (left.count() < least || left.last < first || left.first >= columns.last) continue;
    if (first < left.first) along_x(line, {first, left.first}, part, boundary, worker, begins);
    first = std::min(left.last, columns.last);
    begins = true;
  }
  if (first < columns.last) along_x(line, {first, columns.last}, part, boundary, worker, begins);
}

/// Puts what became of the patches in these columns into the line.
template <int D, class Real>
void TiledExecutor<D, Real>::put_patches(std::int64_t line, const IndexRange& columns, const Real* copy,
                                         std::int64_t pitch) {
  for (const auto& patch : patches_->of(line)) {
    const auto here = common(patch.cells, columns);
    if (here.empty()) continue;
    sweeps_.put(line, here, copy, pitch);
    mark_active(line, here);
  }
}

/// Shows those of these columns of a line that are in no patch.
template <int D, class Real>
void TiledExecutor<D, Real>::look_beside_patches(const Stage& stage, std::int64_t line,
                                                 const IndexRange& columns, const Real* fields,
                                                 std::int64_t pitch) {
  std::int64_t first = columns.first;
  const auto show = [&](std::int64_t last) {
    if (first < last) end_.look(stage.time, line, {first, last}, fields, pitch);
  };
  if (patches_)
    for (const auto& patch : patches_->of(line)) {
      show(std::min(patch.cells.first, columns.last));
      first = std::max(first, patch.cells.last);
    }
  show(columns.last);
}

template void TiledExecutor<2, float>::use(const Patches<2>*);
template const float* TiledExecutor<2, float>::work_on_patches(const Stage&, std::int64_t, const IndexRange&,
                                                               const IndexRange&, PatchBoundary<float>&,
                                                               Worker&);
template void TiledExecutor<2, float>::sweep_beside_patches(std::int64_t, const IndexRange&, float,
                                                            StripeBoundary<float>&, Worker&);
template void TiledExecutor<2, float>::put_patches(std::int64_t, const IndexRange&, const float*,
                                                   std::int64_t);
template void TiledExecutor<2, float>::look_beside_patches(const Stage&, std::int64_t, const IndexRange&,
                                                           const float*, std::int64_t);
template void TiledExecutor<2, double>::use(const Patches<2>*);
template const double* TiledExecutor<2, double>::work_on_patches(const Stage&, std::int64_t,
                                                                 const IndexRange&, const IndexRange&,
                                                                 PatchBoundary<double>&, Worker&);
template void TiledExecutor<2, double>::sweep_beside_patches(std::int64_t, const IndexRange&, double,
                                                             StripeBoundary<double>&, Worker&);
template void TiledExecutor<2, double>::put_patches(std::int64_t, const IndexRange&, const double*,
                                                    std::int64_t);
template void TiledExecutor<2, double>::look_beside_patches(const Stage&, std::int64_t, const IndexRange&,
                                                            const double*, std::int64_t);
template void TiledExecutor<3, float>::use(const Patches<3>*);
template const float* TiledExecutor<3, float>::work_on_patches(const Stage&, std::int64_t, const IndexRange&,
                                                               const IndexRange&, PatchBoundary<float>&,
                                                               Worker&);
template void TiledExecutor<3, float>::sweep_beside_patches(std::int64_t, const IndexRange&, float,
                                                            StripeBoundary<float>&, Worker&);
template void TiledExecutor<3, float>::put_patches(std::int64_t, const IndexRange&, const float*,
                                                   std::int64_t);
template void TiledExecutor<3, float>::look_beside_patches(const Stage&, std::int64_t, const IndexRange&,
                                                           const float*, std::int64_t);
template void TiledExecutor<3, double>::use(const Patches<3>*);
template const double* TiledExecutor<3, double>::work_on_patches(const Stage&, std::int64_t,
                                                                 const IndexRange&, const IndexRange&,
                                                                 PatchBoundary<double>&, Worker&);
template void TiledExecutor<3, double>::sweep_beside_patches(std::int64_t, const IndexRange&, double,
                                                             StripeBoundary<double>&, Worker&);
template void TiledExecutor<3, double>::put_patches(std::int64_t, const IndexRange&, const double*,
                                                    std::int64_t);
template void TiledExecutor<3, double>::look_beside_patches(const Stage&, std::int64_t, const IndexRange&,
                                                            const double*, std::int64_t);

}  // namespace slipwave::solver
