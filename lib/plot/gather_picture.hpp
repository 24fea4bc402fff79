#pragma once

#include "plot/gather_section.hpp"
#include "plot/look.hpp"
#include "plot/page.hpp"
#include "plot/picture.hpp"

namespace slipwave::plot {

struct GatherStyle {
  bool density = true;
  bool wiggle = false;
  TraceAxis axis = TraceAxis::automatic;
  double gain_power = 0;
};

/// Time down, traces side by side: as colours, as lines whose excursions to the right (positive) are filled,
/// or both. Colours and lines are full at the clip (Look); where a pixel has several samples it shows the one
/// farthest from zero, and where lines would touch each other only some are drawn.
Picture draw_gather(GatherSection section, const GatherStyle& style, const Look& look, Page page);

}  // namespace slipwave::plot
