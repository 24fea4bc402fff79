// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "plot/gather_content.hpp"
#include "plot/panel.hpp"

namespace slipwave::plot {

struct WiggleStyle {
  double full = 1;   // a sample of this reaches 1.4 times as far as the neighbouring line, none farther
  bool fill = true;  // what is positive is filled
  Colour colour = black;
};

/// Draws a line per trace at its place, which swings out to the right of it or, of receivers above each
/// other, upwards: of every n-th trace, and says n: 1 unless lines would stand closer than 2 points.
std::size_t draw_wiggles(Canvas& canvas, const Panel& panel, const GatherContent& content,
                         const WiggleStyle& style);

}  // namespace slipwave::plot
