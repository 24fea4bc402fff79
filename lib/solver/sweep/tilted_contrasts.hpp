// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "solver/sweep/domain.hpp"
#include "solver/sweep/interface_stencils.hpp"

namespace slipwave::solver {

/// Contrasts across an axis between solid cells of which one is rock whose axes are tilted (theory.md (T6)):
/// pairs alone do not show them, since the same rock with another tilt moves otherwise.
template <int D>
TiltedContrasts<D> tilted_contrasts(const Domain<D>& domain, int axis, int reach);

}  // namespace slipwave::solver
