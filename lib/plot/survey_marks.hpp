// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "grid/grid.hpp"
#include "plot/panel.hpp"

namespace slipwave::segy {
class Reader;
}

namespace slipwave::plot {

/// The places where a survey shot and recorded, each once.
struct SurveyMarks {
  std::vector<Point<2>> sources, receivers;  // across and down
  /// The sources are points that plane waves pass at time zero.
  bool plane_wave = false;
  std::optional<double> plane_angle_deg = {};  // from straight down towards +x, where the file tells it
};

/// Returns the marks of all traces of a file, as a section across this axis shows them.
SurveyMarks read_survey(segy::Reader& reader, int axis = 1);

/// x, y, z of the source of the first trace.
Point<3> first_source(segy::Reader& reader);

/// Stars for sources, smaller where they stand close, triangles for receivers, of which only some are drawn
/// where they would hide each other. Of a plane wave no star, but its front and an arrow along its way, where
/// that is known.
void draw_survey(Canvas& canvas, const Panel& panel, const SurveyMarks& marks);

/// What the marks mean.
std::vector<LegendEntry> legend_of(const SurveyMarks& marks);

}  // namespace slipwave::plot
