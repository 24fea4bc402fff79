// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <functional>
#include <string>
#include <vector>

#include "model/model.hpp"
#include "rock/anisotropy.hpp"

namespace slipwave {

/// Names of media that are hard on a scheme: strong interfaces, flat, curved and from cell to cell.
const std::vector<std::string>& medium_names();

/// One of them, `cells` x `cells` of 5 m; random ones are the same for the same seed.
Medium<2> medium_named(const std::string& name, int cells, unsigned seed = 1);

/// A square of as many cells, each of the rock there.
Medium<2> of_rocks(int cells, const std::function<Material(int i, int k)>& rock_at);
/// Any VTI rock with a positive stiffness; draws are uniform in 0 .. 1.
Material random_anisotropic(const std::function<double()>& random);

/// Three draws, uniform in 0 .. 1, that are always the same for a place and a seed.
std::array<double, 3> draws_of(int column, int row, unsigned seed);

/// Uniform rock: vp 4500, vs 2250, rho 2500.
Medium<2> rock(int nx, int nz);

}  // namespace slipwave
