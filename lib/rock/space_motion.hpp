// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <vector>

#include "rock/plane_motion.hpp"

namespace slipwave {

// Plane waves in 3-D in rock that may be anisotropic (theory.md (A18)).

/// A wave of one direction of its front: phase speed, m/s, and the direction of its motion, a unit vector.
struct SpaceMotion {
  double speed = 0;
  Point<3> motion{};
};
/// The front moves along a unit vector, in the vertical plane whose horizontal direction is `along`. P moves
/// forward; S is the one of both S waves that moves more in that plane, towards `along` where it travels
/// down.
SpaceMotion space_motion(const Material& rock, const Point<3>& direction, const std::array<double, 2>& along,
                         bool shear);

/// The waves of a slowness along x and y that go down, or up: three in rock, one in fluid.
std::vector<LayerWave<3>> layer_waves(const Material& rock, const std::array<double, 2>& along, bool down);

}  // namespace slipwave
