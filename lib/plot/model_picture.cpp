#include "plot/model_picture.hpp"

#include <algorithm>
#include <cmath>

#include "base/error.hpp"

namespace slipwave::plot {
namespace {

/// From the least to the greatest value.
Limits range_of(const Field<2>& field) {
  Limits range{INFINITY, -INFINITY};
  for (const float value : field) {
    if (!std::isfinite(value)) continue;
    range.low = std::min(range.low, double(value));
    range.high = std::max(range.high, double(value));
  }
  return range.low > range.high ? Limits{0, 1} : range;
}

ColourBar bar_of(const ModelSection& section, bool as_sets, const Look& look) {
  const Limits all = range_of(section.values), range = look.colours.value_or(all);
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

}  // namespace

Picture draw_model(const ModelSection& section, bool as_sets, const SurveyMarks& marks, const Look& look,
                   Page page) {
  const auto axes = axes_of(section.grid(), look, section.axes);
  PanelSpec spec{page.title, axes.x, axes.depth, bar_of(section, as_sets, look), {}};
  if (as_sets) spec.legend = legend_of_sets(section);
  const auto places = legend_of(marks);
  spec.legend.insert(spec.legend.end(), places.begin(), places.end());
  if (page.height_pt == 0) Panel::fit_page(page, spec, height_per_width(spec.x, spec.y));
  const Panel panel(spec, {0, 0, page.width_pt, page.height_pt}, page);

  const auto pixels = pixels_of(panel, page, section.grid());
  const auto raster = shown_values(section.values, panel, page, Take::mean, look);
  Image image(raster.width, raster.height);
  const double low = spec.bar->axis.low, span = spec.bar->axis.high - low;
  for (std::size_t n = 0; n < image.pixels.size(); ++n)
    image.pixels[n] = spec.bar->map.pixel((double(raster.values[n]) - low) / span);
  if (as_sets) colour_sets(image, section, pixels);

  Canvas canvas(page);
  canvas.image(image, panel.plot());
  if (!as_sets) draw_fractures(canvas, panel, section, pixels, image);
  panel.draw(canvas);
  draw_survey(canvas, panel, marks);
  return {canvas.finish(), canvas.words()};
}

}  // namespace slipwave::plot
