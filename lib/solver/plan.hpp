#pragma once

#include "base/report.hpp"
#include "solver/simulation.hpp"

namespace slipwave {

/// What shoot() would do.
template <int D>
struct Plan {
  Grid<D> computed;  // zones included
  double time_step_s = 0;
  double courant = 0;  // vp_max dt/h
  std::int64_t steps = 0;
  std::vector<PlannedPass> passes;
  std::int64_t span_ends = 0;  // cells beside contacts, voids and span ends, all directions and waves
  std::int64_t memory_bytes = 0;
  double highest_hz = 0;
  SlowestWave slowest;
  double points_per_wavelength = 0;  // of the slowest wave at highest_hz
  double loss_per_wavelength = 0;    // of its amplitude, by the scheme's own damping along an axis
  std::string instruction_set;
};

template <int D>
Plan<D> plan(const Scene<D>& scene);

template <int D>
Report report_of(const Plan<D>& plan);

/// Sentences a user should read before the run: waves too short for the grid, and what that costs.
template <int D>
std::vector<std::string> warnings(const Scene<D>& scene);

}  // namespace slipwave
