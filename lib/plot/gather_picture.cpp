#include "plot/gather_picture.hpp"

#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "plot/magnitudes.hpp"
#include "plot/panel.hpp"
#include "plot/raster.hpp"
#include "plot/ticks.hpp"
#include "plot/wiggle.hpp"

namespace slipwave::plot {
namespace {

Axis axis_of(const TracePlaces& traces, const std::vector<double>& edges) {
  Axis axis;
  switch (traces.axis) {
    case TraceAxis::x:
      axis = {"receiver x", "m"};
      break;
    case TraceAxis::midpoint:
      axis = {"midpoint x", "m"};
      break;
    case TraceAxis::offset:
      axis = {"offset", "m"};
      break;
    case TraceAxis::depth:
      axis = {"receiver depth", "m"};
      break;
    default:
      axis = {"trace", "", 0, 1, false, true};
      break;
  }
  axis.low = edges.front();
  axis.high = edges.back();
  return axis;
}

/// What colours stand for. A gain of t^2 turns m/s into m/s s^2.
Axis value_axis(const GatherSection& section, double gain_power) {
  const std::string name = section.component == Component::other ? "amplitude" : name_of(section.component);
  const std::string unit = typeset_unit(unit_of(section.component));
  if (gain_power == 0) return {name, unit};
  const std::string power = gain_power == 1 ? "" : raised(shown(gain_power));
  return {name + " t" + power, unit.empty() ? "s" + power : unit + " s" + power};
}

void draw_density(Canvas& canvas, const Panel& panel, const GatherSection& section,
                  const std::vector<double>& edges, const ColourBar& bar) {
  const Rect& plot = panel.plot();
  const int width = pixels_along(plot.width, canvas.page()),
            height = pixels_along(plot.height, canvas.page());
  const auto columns = cells_of_pixels(panel.x_scale(), plot.x, plot.right(), width, edges);
  const auto rows = cells_of_pixels(panel.y_scale(), plot.y, plot.bottom(), height,
                                    even_edges(section.axis.start_s - section.axis.interval_s / 2,
                                               section.axis.interval_s, section.axis.count));
  // Samples of a trace lie side by side: the raster is made lying on its side.
  const auto raster = reduced<float>([&](std::int64_t n) { return section.trace(std::size_t(n)); }, rows,
                                     columns, Take::extreme);
  Image image(width, height);
  const double low = bar.axis.low, span = bar.axis.high - bar.axis.low;
  for (int column = 0; column < width; ++column) {
    for (int row = 0; row < height; ++row) {
      const double value = double(raster.at(row, column));
      if (!std::isnan(value)) image.at(column, row) = bar.map.pixel((value - low) / span);
    }
  }
  canvas.image(image, plot);
}

}  // namespace

Picture draw_gather(GatherSection section, const GatherStyle& style, const Look& look, Page page) {
  Picture picture;
  const auto traces = order_traces(section, style.axis);
  apply_gain(section, style.gain_power);
  Magnitudes magnitudes;
  magnitudes.add(section.samples);
  double full = magnitudes.percentile(look.clip_percent);
  if (full == 0) full = 1;  // silence
  const auto edges = edges_between(traces.places);

  PanelSpec spec{page.title, axis_of(traces, edges), {"time", "s"}, {}, {}};
  spec.y.low = section.axis.start_s;
  spec.y.high = section.axis.start_s + double(section.axis.count - 1) * section.axis.interval_s;
  spec.y.upwards = false;
  if (section.axis.count == 1) widen(spec.y, 0);
  narrow(spec.x, look.x, "--x");
  narrow(spec.y, look.y, "--y");
  ColourBar bar{map_of(look, "blue-red"), value_axis(section, style.gain_power)};
  bar.axis.low = look.colours ? look.colours->low : -full;
  bar.axis.high = look.colours ? look.colours->high : full;
  if (style.density) spec.bar = bar;
  if (page.height_pt == 0) page.height_pt = 12 * points_per_cm;

  const Panel panel(spec, {0, 0, page.width_pt, page.height_pt}, page);
  Canvas canvas(page);
  canvas.within(panel.plot(), [&] {
    if (style.density) draw_density(canvas, panel, section, edges, bar);
    if (!style.wiggle) return;
    const double most = look.colours ? std::max(std::fabs(bar.axis.low), std::fabs(bar.axis.high)) : full;
    const auto every = draw_wiggles(canvas, panel, section, traces.places, most, !style.density);
    if (every > 1)
      picture.notes.push_back("lines would touch each other: one in " + std::to_string(every) +
                              " traces is drawn");
  });
  panel.draw(canvas);
  if (section.other_components)
    picture.notes.push_back("the file holds other components, too; this is " +
                            std::string(name_of(section.component)));
  picture.bytes = canvas.finish();
  picture.words = canvas.words();
  return picture;
}

}  // namespace slipwave::plot
