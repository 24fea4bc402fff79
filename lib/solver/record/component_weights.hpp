// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "gather/component.hpp"
#include "solver/sweep/point_weights.hpp"

namespace slipwave::solver {

/// Weights of a component of a gather at a point: the mean or sum of its terms (gather/component.hpp), to
/// which its `in_time` is still to be applied.
template <int D>
std::vector<ValueWeight> component_weights(const Layout<D>& layout, const Domain<D>& domain,
                                           const Point<D>& point_m, Component component);

/// Weights of the velocity at a point along a vector, times its length.
template <int D>
std::vector<ValueWeight> velocity_along(const Layout<D>& layout, const Domain<D>& domain,
                                        const Point<D>& point_m, const Point<D>& vector);

}  // namespace slipwave::solver
