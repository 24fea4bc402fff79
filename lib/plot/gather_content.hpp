// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "plot/gather_section.hpp"
#include "plot/look.hpp"
#include "plot/panel.hpp"
#include "plot/raster.hpp"

namespace slipwave::plot {

/// What one panel of a gather shows: traces in the order of their axis, with its gain.
struct GatherContent {
  std::string title;
  GatherSection section;
  TracePlaces traces;
  PlaceCells cells;  // round the places

  GatherContent(std::string title, GatherSection section, TraceAxis axis, double gain_power);

  /// Depth of receivers runs down and time to the right; else traces stand side by side and time runs down.
  bool upright() const { return traces.axis == TraceAxis::depth; }
  const Scale& place_scale(const Panel& panel) const { return upright() ? panel.y_scale() : panel.x_scale(); }
  const Scale& time_scale(const Panel& panel) const { return upright() ? panel.x_scale() : panel.y_scale(); }
};

/// Title, axes and bands.
PanelSpec spec_of(const GatherContent& content, const Look& look);

/// Samples as colours. Where traces or samples are wider than pixels, they are interpolated linearly unless
/// `look` says otherwise, but not across gaps, shots and lines of receivers; gaps stay blank, grey as what
/// has no value.
void draw_density(Canvas& canvas, const Panel& panel, const GatherContent& content, const ColourBar& bar,
                  const Look& look);

}  // namespace slipwave::plot
