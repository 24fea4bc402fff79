// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <vector>

#include "scene/scene.hpp"

namespace slipwave {

/// The gauges of the scene's fibre at the receivers of a shot, in their order.
template <int D>
std::vector<std::vector<GaugePoint<D>>> gauges_of(const Scene<D>& scene, std::size_t shot);

/// Calls `see` with every point of every gauge, its shot and receiver (from 1). What shots have in common is
/// seen once.
template <int D>
void each_gauge_point(const Scene<D>& scene,
                      const std::function<void(const Point<D>&, std::size_t shot, std::size_t number)>& see);

}  // namespace slipwave
