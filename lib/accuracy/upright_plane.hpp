// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "scene/scene.hpp"

namespace slipwave {

/// What a shot in 3-D is in the upright plane through its source and receivers that lie in one direction (and
/// its opposite) from it, within some degrees.
struct UprightPlane {
  /// Its cells, as far as the receivers and some further: x is that of the model where the plane runs along
  /// x, else counted from the source's along the plane. One source, and the part of it that moves the plane.
  Scene<2> scene;
  std::vector<Point<3>> receivers_m;  // as in the model
  bool along_x = false;
  /// The source also moves rock across the plane (SH waves), by at least a tenth of what it does along it.
  bool moves_across = false;
  /// Its motion along the plane is no part of the source.
  bool still = false;
};

/// Of at most `receivers` of them, evenly chosen. None of a plane wave.
std::vector<UprightPlane> upright_planes(const Scene<3>& scene, std::size_t shot, std::size_t receivers);

}  // namespace slipwave
