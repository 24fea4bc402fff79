// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

namespace slipwave {

/// One sweep of a time step: along `axis`, over `part` of the step, back in time where it is negative.
struct SweepFraction {
  int axis;
  double fraction;
};

/// The sweeps of a time step of that order in time (2: theory.md (E3), 4: (E18)) in the order they are made.
/// The first and the last run along x over equal parts: those of neighbouring steps may be one.
std::vector<SweepFraction> splitting(int dimension, int time_order);

}  // namespace slipwave
