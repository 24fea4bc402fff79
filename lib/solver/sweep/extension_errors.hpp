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
  int along = 1;  // the axis of the sweeps along it that count
  std::vector<SweepFraction> of_step{};
  bool merges =
      false;  // two sweeps along the first axis that follow each other, as they do where no force acts
  bool beside_void = false;  // where extensions are given all of the traction, not a part of it (E11a)
  bool adjoint = false;      // of the step that forces answer to, adjoint in the energy and run back in time
};

/// Slopes of a pair (v, s) per cell, by side of a face.
struct SlopesBeside {
  std::array<double, 2> v{}, s{};
};

/// How far pairs of cells lie off, by side of a face, from it on: as they are recorded or as they answer; and
/// their velocities as sweeps along the face find them, in the mean.
struct ExtensionErrors {
  std::array<std::vector<double>, 2> v{}, s{}, v_found{};
};

/// Returns by how much pairs of cells beside a face lie off ones with these slopes, where sweeps along the
/// face, along one axis, take away what sweeps across add (theory.md (A23)): extensions (E10) have the mean
/// slope of both sides, (E11) none of v. `known` is the part of the slopes of v by motion along fluid that
/// touches solid, which extensions are given (E11a).
ExtensionErrors extension_errors(const SweepsAcross& of, const SlopesBeside& slopes,
                                 const std::array<double, 2>& known = {});

}  // namespace slipwave::solver
