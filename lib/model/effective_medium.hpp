// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "model/fracture.hpp"
#include "rock/anisotropy.hpp"

namespace slipwave {

/// Stiffness of a rock full of planes that give way, each level or upright: compliances of rock and planes
/// add up (Schoenberg & Sayers 1995, eq. 5; theory.md (S26)). Waves much longer than the spacing feel nothing
/// else. Throws a usage Error where planes slide, have dashpots, do not give way or are neither level nor
/// upright.
Elasticity<2> effective_elasticity(const Elasticity<2>& rock, const std::vector<SlipSystem<2>>& systems);

/// Gives the solid cells whose centres are inside, in true depth, the effective medium of their rock and
/// these planes, which may dip: all along the beds of the rock, or in isotropic rock of the first of them, or
/// across these. Cells of fracture sets stay in them. Throws a usage Error as above, of planes at other
/// angles, and as find_solid_cells().
FractureCount make_effective(Model<2>& model, const std::vector<SlipSystem<2>>& systems,
                             const std::function<bool(const Point<2>&)>& inside);

}  // namespace slipwave
