// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "plot/look.hpp"
#include "plot/picture.hpp"
#include "plot/section.hpp"
#include "plot/survey_marks.hpp"

namespace slipwave::plot {

/// A model's property in colours, void in grey, fractures hatched along their planes, and the survey's
/// places. `as_sets`: the property in grey and every fracture set in a colour of its own, named in the
/// legend. A pixel takes the mean of its cells. Both axes have one scale unless the page has a given size or
/// the section is too long for that.
Picture draw_model(const ModelSection& section, bool as_sets, const SurveyMarks& marks, const Look& look,
                   Page page);

/// A volume on three planes (three_planes), each with its marks.
Picture draw_model_volume(const std::vector<ModelSection>& sections, const std::vector<Slice>& planes,
                          bool as_sets, const std::vector<SurveyMarks>& marks, const Look& look, Page page);

}  // namespace slipwave::plot
