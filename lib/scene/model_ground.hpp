// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "acquisition/ground.hpp"
#include "rock/medium.hpp"

namespace slipwave {

/// Looks at the rows of a medium, which are some or all of those of the ground's model, from the top down
/// until all columns are known; returns whether they are.
template <int D>
bool see(Ground<D>& ground, const Medium<D>& medium);

}  // namespace slipwave
