// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "scene/scene.hpp"

namespace slipwave {

/// What a cell is made of and which effects of the shot are in it or within ten cells, nearest first:
/// "vp=3000 vs=1700 rho=2300, in fracture set cracks, 5 m from an interface". `at` is counted from the first
/// cell of the model that this process holds; outside the model in the layers beyond its edges, whose medium
/// is that of the edge.
template <int D>
std::string surroundings(const Scene<D>& scene, std::size_t shot, const Index<D>& at);

}  // namespace slipwave
