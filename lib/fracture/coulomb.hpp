// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fracture/friction_policy.hpp"

namespace slipwave {

/// S = q max(-s_n, 0) + cohesion, whatever the slip so far (S2).
struct Coulomb : FrictionPolicy<Coulomb> {};

}  // namespace slipwave
