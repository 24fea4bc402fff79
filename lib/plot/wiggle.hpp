#pragma once

#include <vector>

#include "plot/gather_section.hpp"
#include "plot/panel.hpp"

namespace slipwave::plot {

/// Draws a line per trace at its place on x; a sample of `full` reaches 1.4 times as far as the neighbouring
/// line, and none farther than that. `fill`: what lies to the right of the place is filled. Draws every n-th
/// trace and says n: 1 unless lines would stand closer than 2 points.
std::size_t draw_wiggles(Canvas& canvas, const Panel& panel, const GatherSection& section,
                         const std::vector<double>& places, double full, bool fill);

}  // namespace slipwave::plot
