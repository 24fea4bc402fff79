// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "parallel/ranks.hpp"
#include "scene/scene.hpp"

namespace slipwave {

/// Throws a usage Error where an amplitude of a checked scene makes velocities (largest_velocity()) or
/// stresses, impedance times velocity, that floats, in which traces are written, hold with less than their
/// precision or not at all. Collective where there are ranks (may be null).
template <int D>
void check_magnitudes(const Scene<D>& scene, Ranks* ranks = nullptr);

}  // namespace slipwave
