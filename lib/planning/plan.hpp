// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "accuracy/direct_waves.hpp"
#include "base/report.hpp"
#include "solver/simulation.hpp"

namespace slipwave {

/// What waves along an interface of unlike rocks may gain of their amplitude in a step: 2.51e-5 is the most
/// that was measured (docs/theory/interfaces.md).
inline constexpr double gain_in_a_step = 2.6e-5;

/// What shoot() would do, how well, and at what cost.
template <int D>
struct Plan {
  Grid<D> computed;            // zones included
  std::vector<Grid<D>> bands;  // of a scene in bands those of each instead, without zones
  double time_step_s = 0;
  double courant = 0;  // vp_max dt/h
  std::int64_t steps = 0;
  std::vector<PlannedEntry> entries;
  std::int64_t interface_cells =
      0;  // with stencils of their own beside strong interfaces and voids, all axes and waves
  /// The memory of a shot, with the traces of all components that it records; of those traces; of the model
  /// and the program, which all shots share; and what a shot takes for a moment beside its fields, before it
  /// runs.
  std::int64_t memory_bytes = 0, trace_bytes = 0, shared_bytes = 0, building_bytes = 0;
  double highest_hz = 0;
  SlowestWave slowest;
  double cells_of_shortest_p = 0;  // a wavelength of the slowest P wave at highest_hz
  std::optional<double> cells_of_shortest_s;
  double loss_per_wavelength = 0;            // of the slowest wave's amplitude, by the scheme's own damping
  double duration_s = 0;                     // of the traces
  double computed_share = 1;                 // of all cells in all steps (expected_share)
  typename DirectWaves<D>::Error direct;     // what dispersion does to the direct waves
  std::vector<std::string> slip;             // expected_slip()
  std::vector<std::string> cell_dependence;  // cell_dependence()
  int threads = 1;
  double seconds = 0;            // of the processor, all shots: from the time that a few steps take now
  double measuring_seconds = 0;  // of the processor, about: --plan --measure
  std::string instruction_set;
};

/// Only what is derived: no error is in it but that of direct waves. Builds the first shot and runs a few of
/// its steps to see how long they take.
template <int D>
Plan<D> plan(const Scene<D>& scene);

/// Memory for the fields and the material of a shot, upper limit in bytes.
template <int D>
std::int64_t memory_of_a_shot_bytes(const Scene<D>& scene);

/// What a second of traces costs in the cells that a model has, in one line: steps, cells, processor time by
/// the usual rate, memory, and the highest frequency that cells can hold. Any source
/// will do.
template <int D>
std::string cost_of_a_second(const Scene<D>& scene);

/// Shots of a run: side by side, and those finished ones whose traces are retained.
struct ShotsHeld {
  std::size_t side_by_side = 1, retained = 0;
};

/// Memory of a run: its peak resident size, in bytes.
template <int D>
std::int64_t memory_of_run_bytes(const Plan<D>& plan, const ShotsHeld& held);

/// What a user decides by: cells, dispersion of direct waves, time, memory; where planes stick or are dry,
/// that. A line each.
template <int D>
Report summary_of(const Plan<D>& plan, const ShotsHeld& held = {});

/// All the rest, and in numbers what the summary says in words.
template <int D>
Report report_of(const Plan<D>& plan);

/// Sentences a user should read before the run: waves too short for the grid, and what that costs.
template <int D>
std::vector<std::string> warnings(const Scene<D>& scene);

}  // namespace slipwave
