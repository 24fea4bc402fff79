// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "scene/scene.hpp"

namespace slipwave {

/// Sentences about what the record of a checked scene is too short for: traces that no wave can have reached
/// at its end, by the straight way at the fastest speed of the model.
template <int D>
std::vector<std::string> timing_warnings(const Scene<D>& scene);

}  // namespace slipwave
