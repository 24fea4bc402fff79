// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include "scene/scene.hpp"
#include "solver/schedule/active_cells.hpp"
#include "solver/schedule/executor.hpp"
#include "solver/schedule/halo.hpp"
#include "solver/schedule/time_step.hpp"
#include "solver/sweep/sweeps.hpp"

namespace slipwave::solver {

/// Rows of a band that one thread works on, at least. Between bands some rows leave the cache.
inline constexpr std::int64_t fewest_rows_of_a_piece = 32;

/// The values that the patches of a row store for its next stripe.
template <class Real>
struct PatchBoundary {
  static constexpr std::int64_t behind = 32, width = behind + 80;
  std::int64_t line = -1, step = -1, next = 0;  // the stripe begins there
  StripeBoundary<Real> first, second;           // of both half sweeps
  std::vector<Real> fields;                     // rows of `width`, from `behind` cells before the next on
};

/// Executes time steps in time tiles of one or several steps. The first sweep works row after row, and each
/// following sweep some rows behind the one before it, so that its data is still in the cache. Rows are cut
/// into stripes of columns that fit the first cache; a sweep stays some columns behind the one before it,
/// too. In 3-D planes, cut along y into stripes of whole rows that fit the second cache, take the place of
/// rows, and their rows that of columns. Threads work on different tiles at once, each on a band of rows some
/// bands behind the tile before. Every cell is computed once and in the same order whatever the number of
/// threads, so results do not depend on it.
template <int D, class Real>
class TiledExecutor : public Executor {
 public:
  /// Keeps references. `rows_beside`: those that neighbours share, held on either side at most.
  TiledExecutor(Sweeps<D, Real>& sweeps, State<D, Real>& state, TimeStep<D, Real>& step, const Tiling& tiling,
                std::int64_t rows_beside = 0);
  /// From now on rows of neighbours are refreshed before each tile; it must outlive this. To be called before
  /// the first step.
  void use(Halo<D, Real>* halo) { halo_ = halo; }
  using Executor::run;
  /// `pause` is called before each tile but the first.
  std::int64_t run(std::int64_t first, std::int64_t last, const std::function<bool()>& pause) override;
  void run_from(const SweepTime& across, std::int64_t number, std::int64_t piece, int worker) override;
  std::int64_t pieces() const override { return bands_; }
  std::int64_t most_at_once() const override { return std::int64_t(in_progress_.size()); }
  void rows_changed(const IndexRange& rows) override;
  void fields_changed() override;
  void serialize(Archive& archive) override { active_.serialize(archive); }
  std::int64_t memory_bytes() const override;
  std::int64_t swept_cells() const override;

 private:
  /// What a tile does to every row (plane) in turn: a sweep along an axis, or the end of a step, which is two
  /// sweeps along x with the effects and records between them.
  struct Stage {
    enum Kind { along_x, along_y, along_z, end_of_step } kind;
    Real fraction;            // of the step, of each of the two sweeps at its end
    StepTime time;            // whose end it is, or which it is in
    std::int64_t behind = 0;  // rows by which it is behind the first stage
    std::int64_t ahead = 0;   // columns that its (first) sweep must be ahead of the last stage
    int number = 0;           // among those of its kind; of the sweeps along x the first one's
    int end = 0;              // the same of the ends of steps
    std::size_t sweep = 0;    // which of the step's sweeps it is, or begins with
    Box needed{};             // what it does elsewhere affects no record
  };
  struct TileInProgress {
    std::vector<Stage> stages;
    std::vector<Ring<Real>> rings;  // of the sweeps along z, in 3-D by y
  };
  /// Memory that the first stage will read next, in 3-D: fetched piece by piece while the others work.
  struct Ahead {
    std::vector<std::pair<const char*, const char*>> parts{};
    std::size_t next = 0;
    void clear() { parts.clear(), next = 0; }
    void add(const Real* first, std::int64_t count) {
      const auto* const bytes = reinterpret_cast<const char*>(first);
      parts.emplace_back(bytes, bytes + count * std::int64_t(sizeof(Real)));
    }
    void fetch();
  };
  struct Worker {
    Workspace<Real> work;
    std::vector<StripeBoundary<Real>> boundaries;  // [sweep along x][row of the band]
    std::vector<Ring<Real>> rings;                 // [sweep along y][plane of the band]
    std::vector<IndexRange> columns;               // of each stage; the end of a step has two
    std::vector<PatchBoundary<Real>> patches{};    // [end of a step][row of the band]
    Buffer<Real> strip{};                          // copies of patches, rows strip_pitch apart
    std::int64_t strip_pitch = 0;
    std::int64_t swept = 0;  // cells, along z
    Ahead ahead{};
  };
  /// How many stages of a tile are of a kind; ends of steps count as two sweeps along x.
  struct Counts {
    std::int64_t along_x = 0, along_y = 0, along_z = 0;
  };
  static Counts counts(const std::vector<Stage>& stages);
  std::vector<Stage> stages(std::int64_t first, std::int64_t last) const;
  std::vector<Stage> stages_from(const SweepTime& across) const;
  Stage stage_of(const SweepTime& sweep) const;
  std::vector<Stage> arranged(std::vector<Stage> stages) const;
  std::int64_t longest(const std::vector<Stage>& stages) const;
  void run_band(std::int64_t tile, std::int64_t band, std::int64_t first, std::int64_t last, Worker& worker);
  void run_band(TileInProgress& tile, std::int64_t band, Worker& worker);
  void look_ahead(const TileInProgress& tile, const IndexRange& planes, Worker& worker) const;
  void run_stripe(TileInProgress& tile, const IndexRange& rows, Worker& worker);
  void sweep_rows(const Stage& stage, std::int64_t row, std::int64_t in_band, const IndexRange* columns,
                  Worker& worker);
  void sweep_plane(const Stage& stage, std::int64_t row, const IndexRange& lines, Ring<Real>& ring,
                   Worker& worker);
  void along_x(const StepTime& time, std::int64_t line, const IndexRange& columns, Real fraction,
               StripeBoundary<Real>& boundary, Worker& worker, bool begins = false);
  void along_z(const Stage& stage, const IndexRange& steps, const IndexRange& columns, TileInProgress& tile,
               Worker& worker);
  void end_across_z(const Stage& stage, std::int64_t step, std::int64_t y, const IndexRange& cells,
                    Worker& worker);
  template <class Reached, class Begin, class End>
  void march(const Stage& stage, const Index<D>& at, const IndexRange& steps, Ring<Real>& ring,
             Worker& worker, Reached&& reached, Begin&& begin, End&& end);
  IndexRange reached(const StepTime& time, const IndexRange& rows, const IndexRange& lines,
                     const IndexRange& cells) const;
  void mark_active(std::int64_t line, const IndexRange& columns);
  std::int64_t boundaries_per_sweep() const;
  void end_of_step(const Stage& stage, std::int64_t line, const IndexRange& first, const IndexRange& second,
                   StripeBoundary<Real>& boundary, StripeBoundary<Real>& second_boundary,
                   PatchBoundary<Real>* patches, Worker& worker);
  void make_patch_memory();
  bool patches_reach(std::int64_t line, const IndexRange& columns) const;
  std::optional<RowFields<Real>> advance_patches(const Stage& stage, std::int64_t line,
                                                 const IndexRange& first, const IndexRange& second,
                                                 PatchBoundary<Real>& boundary, Worker& worker);
  void load_patches(const RowFields<Real>& strip, const IndexRange& first, const IndexRange& second,
                    bool begins, const PatchBoundary<Real>& boundary);
  void advance_patch(const Stage& stage, const Patch& patch, const RowFields<Real>& strip,
                     const IndexRange& first, const IndexRange& second, bool begins,
                     PatchBoundary<Real>& boundary, Worker& worker);
  void read_patch(const Stage& stage, const Patch& patch, const IndexRange& columns,
                  const RowFields<Real>& fields);
  void sweep_beside_patches(const StepTime& time, std::int64_t line, const IndexRange& columns, Real fraction,
                            StripeBoundary<Real>& boundary, Worker& worker);
  void put_patches(const IndexRange& columns, const RowFields<Real>& copy);
  void read_beside_patches(const Stage& stage, const IndexRange& columns, const RowFields<Real>& fields);
  std::int64_t last_column(std::int64_t stripe, std::int64_t ahead) const;
  std::int64_t stripes() const;
  Box growth_of_a_step() const;
  std::int64_t columns_behind(const Stage& stage) const;
  /// Lines of a row: one; in 3-D those of a plane, by y.
  std::int64_t line_of(std::int64_t row, std::int64_t y) const { return D == 2 ? row : row * cut_cells_ + y; }
  IndexRange whole_lines() const { return {0, layout_.shape()[0]}; }
  /// The number of cells beside its own that a sweep reads, corrections of free surfaces included: at most a
  /// block.
  static constexpr std::int64_t read_beside = Layout<D>::block;
  static_assert(max_reach + 1 + free_surface_reach <= read_beside);
  /// How far sweeps along an axis must stay behind what its free surfaces read.
  std::int64_t surface_rows(int axis) const { return surface_rows_[std::size_t(axis)]; }
  /// Returns these rows (in 3-D of a plane) and those beside them that free surfaces of an axis read.
  IndexRange with_surface_rows(int axis, const IndexRange& rows) const {
    return {rows.first - surface_rows(axis), rows.last + surface_rows(axis)};
  }

  Sweeps<D, Real>& sweeps_;
  State<D, Real>& state_;
  const Layout<D>& layout_;
  ActiveCells<D, Real> active_;
  Halo<D, Real>* halo_ = nullptr;
  bool everywhere_;
  TimeStep<D, Real>& step_;
  int steps_per_tile_;
  std::int64_t stripe_width_;      // columns; in 3-D rows of a plane
  std::int64_t together_;          // rows that a stage does before the next
  std::int64_t rows_, cut_cells_;  // along the last axis and the one before it
  std::array<std::int64_t, std::size_t(D)> surface_rows_;
  std::int64_t longest_;  // rows from the first to the last stage of a tile
  std::int64_t band_rows_, bands_;
  std::vector<TileInProgress> in_progress_;
  std::vector<Worker> workers_;
};

}  // namespace slipwave::solver
