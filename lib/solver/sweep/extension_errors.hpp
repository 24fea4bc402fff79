// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <vector>

#include "scene/splitting.hpp"

namespace slipwave::solver {

/// The sweeps across a face, of one pair: what it lies between, before and behind it.
struct SweepsAcross {
  int order = 1;                      // of the reconstruction
  std::array<double, 2> impedance{};  // 0: nothing, the face is a free surface
  std::array<double, 2> courant{};    // of the wave in a whole step
  int axis = 0;
  std::vector<SweepFraction> of_step{};
  bool merges =
      false;  // two sweeps along the first axis that follow each other, as they do where no force acts
  bool adjoint = false;  // of the step that forces answer to, adjoint in the energy and run back in time
};

/// A pair (v, s), by side of a face; of cells from the face on, or a slope per cell.
template <class Value>
struct PairBeside {
  std::array<Value, 2> v{}, s{};
};

/// Returns by how much pairs of cells beside a face lie off ones with these slopes, where sweeps along the
/// face take away what sweeps across add (theory.md (A23)): extensions (E10) have the mean slope of both
/// sides, (E11) none of v. `known` is the part of the slopes of v by motion along fluid that touches solid,
/// which extensions are given (E11a).
PairBeside<std::vector<double>> extension_errors(const SweepsAcross& of, const PairBeside<double>& slopes,
                                                 const std::array<double, 2>& known = {});

}  // namespace slipwave::solver
