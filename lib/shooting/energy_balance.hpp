// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "solver/simulation.hpp"

namespace slipwave {

/// "64 of 800 fractured cells slipped (8 %); of 1.2e+09 J/m that the source gave the waves slip took 3.2 %,
/// 40 % are left, 57 % left by the edges or were lost on the grid": what sw-shoot --balance says of a shot.
std::string sentence_of(const ShotReport& report, int dimension);

}  // namespace slipwave
