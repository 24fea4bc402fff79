// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

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
  // of several gathers
  bool overlay = false;        // lines in one panel, a colour each
  bool difference = false;     // of two: a panel more with the first less the second
  double difference_gain = 1;  // which is multiplied by this
};

/// A gather and what it is called beside others: its file.
struct NamedGather {
  std::string name;
  GatherSection section;
};

/// Time down, traces side by side: as colours, as lines whose excursions to the right (positive) are filled,
/// or both. Traces by the depth of their receivers stand above each other instead, time to the right. Colours
/// and lines are full at the clip (Look); where a pixel has several samples it shows the one farthest from
/// zero, and where lines would touch each other only some are drawn. Shots, and lines of receivers of a
/// single shot, are separated and labelled where traces stand by number.
///
/// Several gathers stand side by side, each under its name or, where they differ, its component; those of one
/// unit on one scale. Throws Error when for a difference sampling or geometry differ, a usage Error for the
/// difference of any number but two of a component, and for lines of different units in one panel.
Picture draw_gathers(std::vector<NamedGather> gathers, const GatherStyle& style, const Look& look, Page page);

/// Draws one gather.
Picture draw_gather(GatherSection section, const GatherStyle& style, const Look& look, Page page);

}  // namespace slipwave::plot
