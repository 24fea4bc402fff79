#pragma once

#include <vector>

#include "grid/grid.hpp"
#include "plot/panel.hpp"

namespace slipwave::segy {
class Reader;
}

namespace slipwave::plot {

/// Where a survey shot and listened, each place once.
struct SurveyMarks {
  std::vector<Point<2>> sources, receivers;  // across and down
};

/// Of all traces of a file, as a section across this axis shows them.
SurveyMarks read_survey(segy::Reader& reader, int axis = 1);

/// Stars for sources, triangles for receivers; of marks that would hide each other only some are drawn.
void draw_survey(Canvas& canvas, const Panel& panel, const SurveyMarks& marks);

/// What the marks mean.
std::vector<LegendEntry> legend_of(const SurveyMarks& marks);

}  // namespace slipwave::plot
