// SPDX-License-Identifier: BSD-3-Clause
#include "plot/model_picture.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>

#include "base/error.hpp"
#include "plot/three_slices.hpp"

namespace slipwave::plot {
namespace {

ColourBar bar_of(std::span<const ModelSection> sections, bool as_sets, const Look& look) {
  const auto& section = sections.front();
  const auto found = range_of(sections);
  const Limits range = look.colours.value_or(found.shown);
  ColourBar bar{map_of(look, as_sets ? "grey" : "uniform"),
                {section.property, section.unit, range.low, range.high}};
  if (range.low == range.high) {  // in the middle of its colours; sets stand on a light grey
    widen(bar.axis, 0);
    if (as_sets) bar.axis.low -= 3 * (bar.axis.high - bar.axis.low);
  }
  bar.point_beyond(found.all.low, found.all.high);
  return bar;
}

/// A colour that stands for one value alone needs no bar, but a word.
std::vector<LegendEntry> take_needless_bar(std::optional<ColourBar>& bar,
                                           std::span<const ModelSection> sections, const Look& look) {
  const auto range = range_of(sections).all;
  if (look.colours || range.low < range.high) return {};
  const auto& axis = bar->axis;
  const auto colour = bar->map.at((range.low - axis.low) / (axis.high - axis.low));
  bar.reset();
  return {{.text = range_in_words(sections.front(), range), .colour = colour, .patch = true}};
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
  const auto bar = *spec.bar;
  spec.legend = take_needless_bar(spec.bar, std::span(&section, 1), look);
  for (const auto& entries :
       {as_sets ? legend_of_sets(section) : std::vector<LegendEntry>(), legend_of(marks)})
    spec.legend.insert(spec.legend.end(), entries.begin(), entries.end());
  if (page.height_pt == 0) Panel::fit_page(page, spec, height_per_width(spec.x, spec.y));
  const Panel panel(spec, {0, 0, page.width_pt, page.height_pt}, page);
  Canvas canvas(page);
  draw_section(canvas, panel, bar, section, as_sets, look);
  panel.draw(canvas);
  draw_survey(canvas, panel, marks);
  return {canvas.finish(), canvas.words()};
}

Picture draw_model_volume(const std::vector<ModelSection>& sections, const std::vector<Slice>& planes,
                          bool as_sets, const std::vector<SurveyMarks>& marks, const Look& look, Page page) {
  const auto bar = bar_of(sections, as_sets, look);
  std::optional<ColourBar> shown_bar = bar;
  auto legend = take_needless_bar(shown_bar, sections, look);
  std::array<SlicePanel, 3> slices;
  for (std::size_t n = 0; n < slices.size(); ++n) {
    const auto axes = axes_of(sections[n].grid(), look, sections[n].axes);
    slices[n] = {
        planes[n], {"", axes.x, axes.depth, shown_bar, {}}, [&, n](Canvas& canvas, const Panel& panel) {
          draw_section(canvas, panel, bar, sections[n], as_sets, look);
          draw_survey(canvas, panel, marks[n]);
        }};
  }
  for (const auto& entries :
       {as_sets ? legend_of_sets(sections.front()) : std::vector<LegendEntry>(), legend_of(marks.front())})
    legend.insert(legend.end(), entries.begin(), entries.end());
  return draw_three_slices(std::move(slices), legend, std::move(page));
}

}  // namespace slipwave::plot
