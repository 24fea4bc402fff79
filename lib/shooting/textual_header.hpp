// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "scene/scene.hpp"

namespace slipwave {

/// What the textual header of SEG-Y says of a run: the program, the source, the scheme, and a line of each
/// command of the history.
template <int D>
std::vector<std::string> textual_header_of(const Scene<D>& scene, const std::string& history,
                                           const std::string& version);

}  // namespace slipwave
