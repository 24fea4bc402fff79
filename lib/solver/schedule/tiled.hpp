#pragma once

#include <functional>
#include <vector>

#include "scene/scene.hpp"
#include "scene/splitting.hpp"
#include "solver/effect/effect.hpp"
#include "solver/schedule/active_cells.hpp"
#include "solver/schedule/halo.hpp"
#include "solver/schedule/patches.hpp"
#include "solver/sweep/sweeps.hpp"

namespace slipwave::solver {

/// What happens to a line at the end of a step, between the sweeps along x of that step and the next.
template <class Real>
class EndOfStep {
 public:
  virtual ~EndOfStep() = default;
  /// Before the first line of a step, step after step.
  virtual void begin(const StepTime& time) = 0;
  /// Whether the line's last sweep along x ends with the step. Otherwise it is one with the first of the
  /// next.
  virtual bool whole(const StepTime& time, std::int64_t line) const = 0;
  /// Whether run() and run_after() do anything to lines that are not whole.
  virtual bool acts_between_steps() const = 0;
  /// Whether the fields of a line that is not whole are looked at.
  virtual bool looks(const StepTime& time, std::int64_t line) const = 0;
  /// Shows the fields as they are at the end of the step: cell 0 of row 0 and the way to the next row.
  virtual void look(const StepTime& time, std::int64_t line, const IndexRange& columns, const Real* fields,
                    std::int64_t pitch) = 0;
  /// Whether run() or run_after() may make something of a line that is zero.
  virtual bool injects(const StepTime& time, std::int64_t line) const = 0;
  /// What of the fields at the end of the step is looked at then or later, or anything later looked at comes
  /// of. `growth`: by how much a step spreads along each axis at most. Boxes are of the last two axes.
  virtual Box needed(const StepTime& time, const Box& growth) const = 0;
  /// Passes before and after looking.
  virtual void run(const StepTime& time, std::int64_t line, const IndexRange& columns) = 0;
  virtual void run_after_record(const StepTime& time, std::int64_t line, const IndexRange& columns) = 0;
  /// What of them happens to the patches of a line that is not whole, in a copy.
  virtual void run_patch(const StepTime&, std::int64_t, const IndexRange&, Real*, std::int64_t) {}
  virtual void run_patch_after(const StepTime&, std::int64_t, const IndexRange&, Real*, std::int64_t) {}
  /// When all lines have come to the end of the step, step after step.
  virtual void finish(const StepTime& time) = 0;
};

/// Takes the fields through time in passes through memory. A pass makes one or several steps: row after row
/// comes to the first sweep, and each following sweep works some rows behind the one before it, so that what
/// it needs is still in the cache. Rows are cut into stripes of columns that fit the first cache; a sweep
/// stays some columns behind the one before it, too. In 3-D what comes are planes, cut along y into stripes
/// of whole rows that fit the second cache: planes are the rows of 2-D, their rows the columns. Threads work
/// on different passes at once, each on a band of rows some bands behind the pass before. Everything is
/// computed once and in an order of its own whatever the number of threads, so results do not depend on it.
template <int D, class Real>
class TiledExecutor {
 public:
  /// Keeps references. `rows_beside`: of neighbours, held on either side at most.
  TiledExecutor(Sweeps<D, Real>& sweeps, const State<D, Real>& state, int time_order, double dt_s,
                EndOfStep<Real>& end, const Tiling& tiling, std::int64_t rows_beside = 0);
  /// From now on rows of neighbours are put right before each pass (null: there are none); it must outlive
  /// this. To be called before the first step.
  void use(Halo<D, Real>* halo) { halo_ = halo; }
  /// From now on these columns end with the step, too (null: none); they must outlive this.
  void use(const Patches<D>* patches);
  /// To be called when fields have been set from outside.
  void find_active_cells();
  /// Makes steps first <= n < last, which begin where the last call ended, from 0 on. `pause` is asked before
  /// each pass but the first, by any thread; where it says so, that pass and all later ones are not begun.
  /// Returns the first step that was not made.
  std::int64_t run(std::int64_t first, std::int64_t last, const std::function<bool()>& pause = {});
  /// Hands over what it remembers between two calls of run().
  void serialize(Archive& archive) { active_.serialize(archive); }
  std::int64_t memory_bytes() const;
  /// Cells brought forward along z, all sweeps together: what was not left out.
  std::int64_t swept_cells() const;

 private:
  /// What is done to every row (plane) in turn. A sweep along an axis or the end of a step: two sweeps along
  /// x with all that happens between them.
  struct Stage {
    enum Kind { along_x, along_y, along_z, end_of_step } kind;
    Real fraction;            // of the step, of each of the two sweeps at its end
    StepTime time;            // whose end it is, or which it is in
    std::int64_t behind = 0;  // rows that come to the first stage before this one gets its first
    std::int64_t ahead = 0;   // columns that its (first) sweep must be ahead of the last stage
    int number = 0;           // among those of its kind; of the sweeps along x the first one's
    int end = 0;              // the same of the ends of steps
    Box needed{};             // elsewhere nobody will see what it does
  };
  struct TileInProgress {
    std::vector<Stage> stages;
    std::vector<Ring<Real>> rings;  // of the sweeps along z, in 3-D by y
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
  };
  /// How many stages of a pass are of a kind; ends of steps count as two sweeps along x.
  struct Counts {
    std::int64_t along_x = 0, along_y = 0, along_z = 0;
  };
  static Counts counts(const std::vector<Stage>& stages);
  std::vector<Stage> stages(std::int64_t first, std::int64_t last) const;
  void run_band(std::int64_t pass, std::int64_t band, std::int64_t first, std::int64_t last, Worker& worker);
  void run_stripe(TileInProgress& pass, const IndexRange& rows, Worker& worker);
  void sweep_rows(const Stage& stage, std::int64_t row, std::int64_t in_band, const IndexRange* columns,
                  Worker& worker);
  void sweep_plane(const Stage& stage, std::int64_t row, const IndexRange& lines, Ring<Real>& ring,
                   Worker& worker);
  void along_x(std::int64_t line, const IndexRange& columns, Real part, StripeBoundary<Real>& boundary,
               Worker& worker, bool begins = false);
  void along_z(const Stage& stage, std::int64_t step, const IndexRange& columns, TileInProgress& pass,
               Worker& worker);
  void refresh(const IndexRange& rows);
  bool is_quiet(const IndexRange& rows, const IndexRange& lines, const IndexRange& columns) const;
  void mark_active(std::int64_t line, const IndexRange& columns);
  std::int64_t boundaries_per_sweep() const;
  void end_of_step(const Stage& stage, std::int64_t line, const IndexRange& first, const IndexRange& second,
                   StripeBoundary<Real>& boundary, StripeBoundary<Real>& second_carry,
                   PatchBoundary<Real>* patches, Worker& worker);
  const Real* work_on_patches(const Stage& stage, std::int64_t line, const IndexRange& first,
                              const IndexRange& second, PatchBoundary<Real>& boundary, Worker& worker);
  void sweep_beside_patches(std::int64_t line, const IndexRange& columns, Real part,
                            StripeBoundary<Real>& boundary, Worker& worker);
  void put_patches(std::int64_t line, const IndexRange& columns, const Real* copy, std::int64_t pitch);
  void look_beside_patches(const Stage& stage, std::int64_t line, const IndexRange& columns,
                           const Real* fields, std::int64_t pitch);
  std::int64_t last_column(std::int64_t stripe, std::int64_t ahead) const;
  std::int64_t stripes() const;
  Box growth_of_a_step() const;
  std::int64_t columns_behind(const Stage& stage) const;
  /// Lines of a row: one; in 3-D those of a plane, by y.
  std::int64_t line_of(std::int64_t row, std::int64_t y) const { return D == 2 ? row : row * cut_cells_ + y; }
  IndexRange whole_lines() const { return {0, layout_.shape()[0]}; }
  /// How far sweeps along an axis must stay behind what its free edges read.
  std::int64_t bend_rows(int axis) const { return sweeps_.bends(axis) ? FreeSurface<D, Real>::reach : 0; }
  /// The same rows (in 3-D of a plane) and those beside them that free edges of an axis read.
  IndexRange with_bends(int axis, const IndexRange& rows) const {
    return {rows.first - bend_rows(axis), rows.last + bend_rows(axis)};
  }

  Sweeps<D, Real>& sweeps_;
  const Layout<D>& layout_;
  ActiveCells<D, Real> active_;
  const Patches<D>* patches_ = nullptr;
  Halo<D, Real>* halo_ = nullptr;
  bool everywhere_;
  std::vector<SweepFraction> splitting_;
  double dt_s_;
  EndOfStep<Real>& end_;
  int steps_per_tile_;
  std::int64_t stripe_width_;
  std::int64_t rows_, cut_cells_;  // along the last axis and the one before it
  std::int64_t longest_;           // rows from the first to the last stage of a pass
  std::int64_t band_rows_, bands_;
  std::vector<TileInProgress> in_progress_;
  std::vector<Worker> workers_;
};

}  // namespace slipwave::solver
