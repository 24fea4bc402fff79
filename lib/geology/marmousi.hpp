// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>

#include "geology/fit.hpp"
#include "rock/medium.hpp"

namespace slipwave {

/// What a Marmousi-like geology is made of. Every property of it at a point is a function of these and the
/// point, and of no grid.
struct MarmousiSettings {
  std::uint64_t seed = 1;
  double water_m = 450;              // depth of the sea; 0: land
  double scale = 1;                  // all lengths but the water's are this many times Marmousi's
  std::optional<double> vp_over_vs;  // of all rock; by lithology where absent
};

/// Lets rows of a regular grid follow the sea floor, which is level, where it lies on no face of them
/// (fit_grid()). Throws as marmousi_medium().
Fit<2> fit_marmousi(const Grid<2>& regular, const MarmousiSettings& settings, const FitChoice& choice);

/// The medium of a regular grid or of one of fit_marmousi(). A cell is fluid or solid as its centre; where
/// bodies of rock meet in a cell its material is the mean over 4 x 8 points of it that are of that kind
/// (theory.md M1, M2), elsewhere, or with `average` = false everywhere, that of the centre. Runs on the
/// threads of parallel_for. Throws a usage Error for settings that make no sense.
Medium<2> marmousi_medium(const Grid<2>& grid, const MarmousiSettings& settings, bool average = true);

}  // namespace slipwave
