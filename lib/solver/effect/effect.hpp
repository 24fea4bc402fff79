// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "base/archive.hpp"
#include "scene/scene.hpp"
#include "solver/sweep/shot_report.hpp"
#include "solver/sweep/sweep_filter.hpp"

namespace slipwave::solver {

/// The values say where an effect acts on the fields at the end of a step.
enum class ActsOn {
  nothing,         // it acts within sweeps, or not at all
  fracture_cells,  // there the two half sweeps along x round the end of a step stay apart
  rows,            // all cells of rows(): there, too
};

/// What an effect does in a time step: all that executors know of it. Fields are sets of
/// field rows (FieldRows), one bit each; an effect reads and writes no other cell than the one it acts on.
struct EffectDeclaration {
  ActsOn acts_on = ActsOn::nothing;
  bool filters_sweeps = false;  // changes what sweeps add to the fields
  unsigned reads = 0, writes = 0;
  bool retains = false;         // has memory from one step to the next
  bool between_sweeps = false;  // acts inside the step (apply_between())
  bool enters_sweeps = false;   // as a filter it may change cells that are zero (enters())
};
template <int D>
constexpr unsigned all_velocities = (1U << D) - 1;
template <int D>
constexpr unsigned all_fields = (1U << FieldRows<D>::count) - 1;
template <int D>
constexpr unsigned all_stresses = all_fields<D> & ~all_velocities<D>;

/// A change of the wave field besides the sweeps. It exists only in scenes that need it.
/// Rows of cells along x are numbered as the lines of Layout; an effect is given one row, or part of it, at a
/// time, in any order and by any thread, but never the same row by two.
template <int D, class Real>
class Effect : public SweepFilter<D, Real> {
 public:
  // What it declares.
  virtual EffectDeclaration declaration() const = 0;
  virtual std::string name() const = 0;
  /// Cells it works on.
  virtual std::int64_t cells() const = 0;
  /// Returns the name of each of its components and the number of cells that it works on.
  virtual std::vector<EffectShare> shares() const { return {{name(), cells()}}; }
  /// Rows of ActsOn::rows, ascending.
  virtual std::span<const std::int64_t> rows() const { return {}; }
  /// Whether it does anything at the end of that step.
  virtual bool active(const StepTime&) const { return true; }
  /// Whether it may change a row whose fields are zero.
  virtual bool injects(const StepTime&, std::int64_t /*row*/) const { return false; }

  // What it does.
  /// Sets the fields at t = 0; returns whether it did.
  virtual bool initialize(State<D, Real>&) { return false; }
  /// Before the first row of each step, step after step. What it prepares for a step must last until
  /// most_steps_in_progress steps after it have begun: rows may be some steps apart.
  virtual void begin(const StepTime&) {}
  /// Acts on these cells at the end of the step, before they are recorded.
  virtual void apply(const StepTime&, const RowFields<Real>&, const IndexRange&) {}
  /// Acts on them after recording: the next step begins with this.
  virtual void apply_after_record(const StepTime&, const RowFields<Real>&, const IndexRange&) {}

  /// Acts on them inside the step, after a sweep along the last axis.
  virtual void apply_between(const StepTime&, const RowFields<Real>&, const IndexRange&) {}

  // What it does within sweeps, where it declares so: filtered() and filter() of SweepFilter.
  /// Whether in a sweep of that step (or the one that the next begins with) it may change cells of these
  /// columns of a row while they and their neighbours are zero.
  virtual bool enters(const StepTime&, std::int64_t /*row*/, const IndexRange& /*columns*/) const {
    return false;
  }
  // What it retains.
  /// Writes or reads all that it retains from one step to the next.
  virtual void serialize(Archive&) {}
  /// Gives access to what it retains of these rows of the last axis (in 3-D planes), for neighbouring
  /// subdomains.
  virtual void exchange(const IndexRange&, const std::function<void(Real* values, std::int64_t count)>&) {}
  virtual std::int64_t memory_bytes() const { return 0; }

  // What it reports.
  /// Adds its results in this subdomain to the report of the shot.
  virtual void report(ShotReport&) const {}
  /// Fills in such a result on the model's grid; false where it has none.
  virtual bool fill(SlipField, Field<D>&) const { return false; }
};

}  // namespace slipwave::solver
