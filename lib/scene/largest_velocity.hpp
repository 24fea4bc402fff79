// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "parallel/ranks.hpp"
#include "scene/scene.hpp"

namespace slipwave {

/// No cell of a shot can move faster, m/s, with a factor of 100 to spare: all energy there is, in one cell of
/// the lightest material. With V = h^D, w the wavelet and I the integral of |w| over the run,
///   force F:           |F|^2 I^2/(2 rho V),   as dE/dt = F.v w <= |F w| (2 E/(rho V))^1/2
///   moment rate M':    |M'|^2 I^2/(2 rho c^2 V),   c the slowest wave of the source's cell
///   plane wave:        rho A^2 w^2 V in each cell, and as much again through the edges in each step
///   prestress:         |s|^2 V/(2 rho vs^2) in each cell of a fracture
/// v^2 = 2 E/(rho_min V). Collective where there are ranks (may be null).
template <int D>
double largest_velocity(const Scene<D>& scene, std::size_t shot, Ranks* ranks = nullptr);

}  // namespace slipwave
