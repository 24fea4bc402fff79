// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "plot/gather_section.hpp"
#include "plot/panel.hpp"

namespace slipwave::plot {

struct WiggleStyle {
  double full = 1;   // a sample of this reaches 1.4 times as far as the neighbouring line, none farther
  bool fill = true;  // what lies to the right of the place is filled
  Colour colour = black;
};

/// Draws a line per trace at its place on x: of every n-th trace, and says n: 1 unless lines would stand
/// closer than 2 points.
std::size_t draw_wiggles(Canvas& canvas, const Panel& panel, const GatherSection& section,
                         const std::vector<double>& places, const WiggleStyle& style);

}  // namespace slipwave::plot
