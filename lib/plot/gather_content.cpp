// SPDX-License-Identifier: BSD-3-Clause
#include "plot/gather_content.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace slipwave::plot {
namespace {

Axis axis_of(const GatherContent& content) {
  const auto named = [&]() -> Axis {
    switch (content.traces.axis) {
      case TraceAxis::x:
        return {"receiver x", "m"};
      case TraceAxis::y:
        return {"receiver y", "m"};
      case TraceAxis::midpoint:
        return {"midpoint x", "m"};
      case TraceAxis::offset:
        return {"offset", "m"};
      case TraceAxis::azimuth:
        return {"azimuth of the receiver, from +x towards +y", "degrees"};
      case TraceAxis::depth:
        return {"receiver depth", "m"};
      default:
        return {"trace", "", 0, 1, false, true};
    }
  };
  Axis axis = named();
  const auto& each = content.traces.in_each_run;
  if (!each.empty())
    axis.name += " (" + each + " in each " + (content.traces.run_name == "shot" ? "shot" : "line") + ")";
  axis.low = content.cells.edges.front();
  axis.high = content.cells.edges.back();
  axis.upwards = false;
  return axis;
}

Bands bands_of(const GatherContent& content) {
  const auto& edges = content.cells.edges;  // traces by number have no gaps: a cell each
  Bands bands{content.traces.run_name, {}, {}, {}};
  for (const auto& run : content.traces.runs) {
    bands.edges.push_back(edges[run.first]);
    bands.labels.push_back(run.label);
  }
  if (!bands.edges.empty()) bands.edges.push_back(edges.back());
  for (const auto first : content.traces.line_starts) bands.minor.push_back(edges[first]);
  return bands;
}

/// Is there a gap, or another shot or line of receivers, between a cell and the next one?
bool apart(const GatherContent& content, std::int64_t cell) {
  if (content.cells.is_gap(cell) || content.cells.is_gap(cell + 1)) return true;
  const auto begins = [&](std::size_t first) { return std::int64_t(first) == cell + 1; };
  const auto& traces = content.traces;
  return std::any_of(traces.runs.begin(), traces.runs.end(),
                     [&](const auto& run) { return begins(run.first); }) ||
         std::any_of(traces.line_starts.begin(), traces.line_starts.end(), begins);
}

/// A row of pixels along an edge of the panel, in pt.
struct Pixels {
  double begin_pt = 0, end_pt = 0;
  int count = 0;
};

std::vector<Mix> mixes_of_traces(const GatherContent& content, const Scale& scale, const Pixels& pixels) {
  const auto& cells = content.cells;
  const auto own = cells_of_pixels(scale, pixels.begin_pt, pixels.end_pt, pixels.count, cells.edges);
  auto mixes =
      mixes_of_pixels(scale, pixels.begin_pt, pixels.end_pt, pixels.count, cells.edges, cells.middles);
  for (std::size_t n = 0; n < mixes.size(); ++n)
    if (mixes[n].share && apart(content, mixes[n].cells.first)) mixes[n] = {own[n], {}};
  return mixes;
}

/// A row for each pixel along the axis of traces, a column for each along time.
Raster raster_of(const GatherContent& content, const Panel& panel, const Page& page, const Look& look) {
  const auto& section = content.section;
  const Rect& plot = panel.plot();
  Pixels across{plot.x, plot.right(), pixels_along(plot.width, page)};
  Pixels down{plot.y, plot.bottom(), pixels_along(plot.height, page)};
  if (content.upright()) std::swap(across, down);
  const auto& times = content.time_scale(panel);
  const auto edges = even_edges(section.axis.start_s - section.axis.interval_s / 2, section.axis.interval_s,
                                section.axis.count);
  const std::vector<float> nothing(std::size_t(section.axis.count), std::numeric_limits<float>::quiet_NaN());
  const auto row = [&](std::int64_t cell) {
    return content.cells.is_gap(cell) ? nothing.data()
                                      : section.trace(std::size_t(content.cells.place[std::size_t(cell)]));
  };
  if (look.interpolate.value_or(true))
    return interpolated(
        row, mixes_of_pixels(times, down.begin_pt, down.end_pt, down.count, edges, middles_of(edges)),
        mixes_of_traces(content, content.place_scale(panel), across), Take::extreme);
  return reduced<float>(row, cells_of_pixels(times, down.begin_pt, down.end_pt, down.count, edges),
                        cells_of_pixels(content.place_scale(panel), across.begin_pt, across.end_pt,
                                        across.count, content.cells.edges),
                        Take::extreme);
}

}  // namespace

GatherContent::GatherContent(std::string name, GatherSection of, TraceAxis axis, double gain_power)
    : title(std::move(name)),
      section(std::move(of)),
      traces(order_traces(section, axis)),
      cells(cells_round(traces.places)) {
  apply_gain(section, gain_power);
}

PanelSpec spec_of(const GatherContent& content, const Look& look) {
  const auto& axis = content.section.axis;
  Axis time{"time", "s", axis.start_s, axis.start_s + double(axis.count - 1) * axis.interval_s};
  if (axis.count == 1) widen(time, 0);
  time.upwards = false;
  PanelSpec spec{content.title, axis_of(content), time, {}, {}};
  if (content.upright()) std::swap(spec.x, spec.y);
  narrow(spec.x, look.x, "--x");
  narrow(spec.y, look.y, "--y");
  spec.bands = bands_of(content);
  return spec;
}

void draw_density(Canvas& canvas, const Panel& panel, const GatherContent& content, const ColourBar& bar,
                  const Look& look) {
  const auto raster = raster_of(content, panel, canvas.page(), look);
  const bool upright = content.upright();
  Image image(upright ? raster.width : raster.height, upright ? raster.height : raster.width);
  const double low = bar.axis.low, span = bar.axis.high - bar.axis.low;
  for (int column = 0; column < image.width; ++column) {
    for (int row = 0; row < image.height; ++row) {
      const double value = double(upright ? raster.at(column, row) : raster.at(row, column));
      image.at(column, row) = bar.map.pixel((value - low) / span);
    }
  }
  canvas.image(image, panel.plot());
}

}  // namespace slipwave::plot
