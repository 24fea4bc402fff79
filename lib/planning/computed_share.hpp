// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "scene/scene.hpp"

namespace slipwave {

/// What of all cells in all steps has to be computed: those that something has come to and that something may
/// still come back from (docs/theory/elastic-step.md). Expected from first arrivals of P waves on a coarse
/// grid of the model and the mean of all shots. In 3-D lines along x are computed whole or not at all. 1 for
/// scenes in which waves are everywhere from the beginning.
template <int D>
double expected_share(const Scene<D>& scene, const Grid<D>& computed);

}  // namespace slipwave
