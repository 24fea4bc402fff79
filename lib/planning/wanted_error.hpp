// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>

#include "planning/measured_error.hpp"

namespace slipwave {

/// Throws a usage Error of --error on what is no share between 0 and 1, as percent.
void check_wanted_error(double share);

/// What the search for a setting may use.
struct SearchLimits {
  double memory_bytes = 0;  // of a shot
  double seconds = 0;       // of the processor, for every run of the search together; 0: no limit
};

/// The setting that a search came to.
struct ReachedError {
  MeasuredError measured;
  bool good = false;    // the measured error is at most what was wanted
  std::string reason;   // why the search ended where it is not
  double search_s = 0;  // processor time of all runs but that of the setting itself
};

/// Finds the cheapest setting whose measured error is at most `wanted`. It begins with what dispersion does
/// to the direct waves (DirectWaves), runs what that chooses in cells of one and a half times the size and of
/// that again, chooses anew by what those show, widens edges where they matter, runs the setting, and
/// measures it; where its error is larger than wanted it takes smaller cells. It comes back with the
/// least error it has measured, whatever that is. `say` hears of each step.
template <int D>
ReachedError reach_error(SceneRuns<D>& runs, double wanted, const SearchLimits& limits,
                         const std::function<void(const std::string&)>& say);

}  // namespace slipwave
