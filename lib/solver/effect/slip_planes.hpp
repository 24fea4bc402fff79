// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <vector>

#include "model/model.hpp"
#include "solver/kernels/slip_kernels.hpp"

namespace slipwave::solver {

/// Unit vectors along planes with this normal, at right angles to each other.
template <int D>
std::array<Point<D>, std::size_t(D - 1)> tangents_of(const Point<D>& normal);

/// The constants of kernels for up to three systems of a set; their shear traction is that of the first.
/// Stress is `unit` times Pa.
template <int D, class Real>
SlipPlanes<Real> planes_of(const std::vector<SlipSystem<D>>& systems, double unit = 1);

/// Compliances of one family of planes of a cell. Below friction planes softer than a thousand times the rock
/// count as that: what follows slip would else be rounding.
template <int D>
CellCompliance compliance_of(const SlipSystem<D>& system, bool below_friction, double lambda, double mu);

}  // namespace slipwave::solver
