#pragma once

#include <string>
#include <vector>

#include "model/model.hpp"

namespace slipwave {

/// Names of media that are hard on a scheme: strong interfaces, flat, curved and from cell to cell.
const std::vector<std::string>& medium_names();

/// One of them, `cells` x `cells` of 5 m; random ones are the same for the same seed.
Medium<2> medium_named(const std::string& name, int cells, unsigned seed = 1);

/// Uniform rock: vp 4500, vs 2250, rho 2500.
Medium<2> rock(int nx, int nz);

}  // namespace slipwave
