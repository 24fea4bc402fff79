// SPDX-License-Identifier: BSD-3-Clause
#include "plot/model_picture.hpp"

#include <algorithm>
#include <cmath>
#include <span>

#include "base/error.hpp"
#include "plot/three_slices.hpp"

namespace slipwave::plot {
namespace {

/// Quality factors from which rock is next to elastic: cells that hold a little of rock that attenuates have
/// millions, beside which all others would be of one colour.
constexpr float next_to_elastic = 1000;

/// From the least to the greatest value below a limit.
Limits range_of(std::span<const ModelSection> sections, float below) {
  Limits range{INFINITY, -INFINITY};
  for (const auto& section : sections) {
    for (const float value : section.values) {
      if (!std::isfinite(value) || value >= below) continue;
      range.low = std::min(range.low, double(value));
      range.high = std::max(range.high, double(value));
    }
  }
  return range.low > range.high ? Limits{0, 1} : range;
}

ColourBar bar_of(std::span<const ModelSection> sections, bool as_sets, const Look& look) {
  const auto& section = sections.front();
  const Limits all = range_of(sections, INFINITY);
  const bool attenuates =
      (section.property == "qp" || section.property == "qs") && all.low < double(next_to_elastic);
  const Limits range = look.colours.value_or(attenuates ? range_of(sections, next_to_elastic) : all);
  ColourBar bar{map_of(look, as_sets ? "grey" : "uniform"),
                {section.property, section.unit, range.low, range.high}};
  if (range.low == range.high) widen(bar.axis, 0);
  bar.point_beyond(all.low, all.high);
  return bar;
}

void colour_sets(Image& image, const ModelSection& section, const GridPixels& pixels) {
  if (section.fracture.empty()) return;
  const auto codes = reduced(section.fracture, pixels, Take::greatest);
  for (std::size_t n = 0; n < image.pixels.size(); ++n) {
    const float code = codes.values[n];
    if (code >= 1) image.pixels[n] = pixel_of(line_colour(std::size_t(code) - 1));
  }
}

std::vector<LegendEntry> legend_of_sets(const ModelSection& section) {
  std::vector<LegendEntry> entries;
  for (std::size_t n = 0; n < section.sets.size(); ++n) {
    const auto& name = section.sets[n].name;
    entries.push_back({.text = name.empty() ? "set " + std::to_string(n + 1) : name,
                       .colour = line_colour(n),
                       .patch = true});
  }
  return entries;
}

/// The data of a panel, and the survey over them.
void draw_section(Canvas& canvas, const Panel& panel, const ColourBar& bar, const ModelSection& section,
                  bool as_sets, const Look& look) {
  const auto pixels = pixels_of(panel, canvas.page(), section.grid());
  const auto raster = shown_values(section.values, panel, canvas.page(), Take::mean, look);
  Image image(raster.width, raster.height);
  const double low = bar.axis.low, span = bar.axis.high - low;
  for (std::size_t n = 0; n < image.pixels.size(); ++n)
    image.pixels[n] = bar.map.pixel((double(raster.values[n]) - low) / span);
  if (as_sets) colour_sets(image, section, pixels);
  canvas.image(image, panel.plot());
  if (!as_sets) draw_fractures(canvas, panel, section, pixels, image);
}

}  // namespace

Picture draw_model(const ModelSection& section, bool as_sets, const SurveyMarks& marks, const Look& look,
                   Page page) {
  const auto axes = axes_of(section.grid(), look, section.axes);
  PanelSpec spec{page.title, axes.x, axes.depth, bar_of(std::span(&section, 1), as_sets, look), {}};
  if (as_sets) spec.legend = legend_of_sets(section);
  const auto places = legend_of(marks);
  spec.legend.insert(spec.legend.end(), places.begin(), places.end());
  if (page.height_pt == 0) Panel::fit_page(page, spec, height_per_width(spec.x, spec.y));
  const Panel panel(spec, {0, 0, page.width_pt, page.height_pt}, page);
  Canvas canvas(page);
  draw_section(canvas, panel, *spec.bar, section, as_sets, look);
  panel.draw(canvas);
  draw_survey(canvas, panel, marks);
  return {canvas.finish(), canvas.words()};
}

Picture draw_model_volume(const std::vector<ModelSection>& sections, const std::vector<Slice>& planes,
                          bool as_sets, const std::vector<SurveyMarks>& marks, const Look& look, Page page) {
  const auto bar = bar_of(sections, as_sets, look);
  std::array<SlicePanel, 3> slices;
  for (std::size_t n = 0; n < slices.size(); ++n) {
    const auto axes = axes_of(sections[n].grid(), look, sections[n].axes);
    slices[n] = {planes[n], {"", axes.x, axes.depth, bar, {}}, [&, n](Canvas& canvas, const Panel& panel) {
                   draw_section(canvas, panel, bar, sections[n], as_sets, look);
                   draw_survey(canvas, panel, marks[n]);
                 }};
  }
  auto legend = as_sets ? legend_of_sets(sections.front()) : std::vector<LegendEntry>();
  const auto places = legend_of(marks.front());
  legend.insert(legend.end(), places.begin(), places.end());
  return draw_three_slices(std::move(slices), legend, std::move(page));
}

}  // namespace slipwave::plot
