// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "scene/splitting.hpp"

namespace slipwave::solver {

/// The sweeps across a free surface of a solid, of one pair.
struct SurfaceSweeps {
  int order = 1;       // of the reconstruction
  double courant = 0;  // of the pair's wave in a whole step
  int axis = 0;
  std::vector<SweepFraction> of_step{};
};

/// Returns, for the first cells below a free surface, how far the motion across a sweep that keeps the plain
/// mirror image lies from one with slope 1 per cell, in the same unit, where sweeps along the surface take
/// away what that slope loads (theory.md (A23)): the transposed scheme, which forces answer to, has no
/// correction of velocity.
std::vector<double> extension_errors(const SurfaceSweeps& of);

}  // namespace slipwave::solver
