// SPDX-License-Identifier: BSD-3-Clause
#include "plot/error_picture.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/error.hpp"
#include "plot/error_series.hpp"
#include "plot/panel.hpp"
#include "plot/point_labels.hpp"

namespace slipwave::plot {
namespace {

constexpr double marker_pt = 6, ring_pt = 6.5;
constexpr Colour wanted_colour{0.75, 0.1, 0.1}, chosen_colour{0.75, 0.1, 0.1};

/// A series with how it is drawn.
struct Curve {
  ErrorSeries series;
  Colour colour;
  Marker marker;
};

/// Everything in one panel.
struct Content {
  std::string title;
  std::vector<Curve> curves;
  std::vector<double> wanted_percent;
};

Marker marker_of(std::size_t index) {
  constexpr Marker shapes[] = {Marker::circle, Marker::square, Marker::triangle, Marker::diamond,
                               Marker::triangle_down};
  return shapes[index % std::size(shapes)];
}

std::vector<Spot> line_of(const Panel& panel, const ErrorSeries& series) {
  std::vector<Spot> line;
  for (const auto& point : series.points) line.push_back({panel.x(point.seconds), panel.y(point.error)});
  return line;
}

void draw_content(Canvas& canvas, const Panel& panel, const Content& content) {
  const double text_pt = 0.85 * canvas.page().text_pt();
  PointLabels labels(panel.plot(), text_pt);
  for (const double wanted : content.wanted_percent) {
    const Spot from{panel.plot().x, panel.y(wanted)}, to{panel.plot().right(), panel.y(wanted)};
    canvas.line(from, to, {wanted_colour, 0.9, {5, 2.5}});
    labels.keep_off(from, to);
  }
  for (const auto& curve : content.curves) {
    const auto line = line_of(panel, curve.series);
    canvas.polyline(line, {curve.colour, 1.2});
    for (std::size_t n = 0; n < line.size(); ++n) {
      labels.keep_clear(line[n], marker_pt);
      if (n > 0) labels.keep_off(line[n - 1], line[n]);
    }
  }
  for (const auto& curve : content.curves)
    for (const auto& spot : line_of(panel, curve.series))
      canvas.marker(spot, curve.marker, marker_pt, curve.colour, true);
  for (const auto& curve : content.curves) {
    for (const auto& point : curve.series.points) {
      const Spot spot{panel.x(point.seconds), panel.y(point.error)};
      if (point.chosen) canvas.ring(spot, ring_pt, {chosen_colour, 1.4});
      if (point.spacing_m > 0)  // known
        labels.label(canvas, spot, point.chosen ? 2 * ring_pt : marker_pt, shown(point.spacing_m) + " m",
                     curve.colour);
    }
  }
}

std::vector<LegendEntry> legend_of(const std::vector<Curve>& curves, const std::vector<std::string>& names,
                                   const std::vector<double>& wanted) {
  std::vector<LegendEntry> entries;
  bool any_chosen = false;
  for (std::size_t n = 0; n < curves.size(); ++n) {
    entries.push_back({names[n], curves[n].colour, Stroke{curves[n].colour, 1.2}, curves[n].marker});
    for (const auto& point : curves[n].series.points) any_chosen = any_chosen || point.chosen;
  }
  for (const double percent : wanted)
    entries.push_back(
        {"wanted: " + shown(percent) + " %", wanted_colour, Stroke{wanted_colour, 0.9, {5, 2.5}}});
  if (any_chosen) entries.push_back({.text = "chosen", .colour = chosen_colour, .ring = true});
  return entries;
}

/// Round ends for everything that is drawn.
void set_axes(PanelSpec& spec, const std::vector<Content>& contents) {
  Limits x{INFINITY, 0}, y{INFINITY, 0};
  const auto see = [](Limits& limits, double value) {
    limits.low = std::min(limits.low, value);
    limits.high = std::max(limits.high, value);
  };
  for (const auto& content : contents) {
    for (const auto& curve : content.curves)
      for (const auto& point : curve.series.points) see(x, point.seconds), see(y, point.error);
    if (x.high > 0) {
      for (const double wanted : content.wanted_percent) see(y, wanted);
    }
  }
  if (!(x.high > 0)) throw Error("no setting has both an error and a time, expected at least one");
  // A little more than the points, so that markers and their words have room.
  spec.x = {"processor time", "s", x.low / 1.25, x.high * 1.25, true};
  spec.y = {"relative L2 error", "%", y.low / 1.25, y.high * 1.25, true};
  widen(spec.x, 0);
  widen(spec.y, 0);
}

struct ErrorDrawing {
  std::vector<Content> panels;
  std::vector<LegendEntry> legend;
};

/// Returns the place of `value` among `known`, at whose end it is put when it is new.
template <class Value>
std::size_t index_in(std::vector<Value>& known, const Value& value) {
  const auto at = std::size_t(std::find(known.begin(), known.end(), value) - known.begin());
  if (at == known.size()) known.push_back(value);
  return at;
}

ErrorDrawing arrange(const std::vector<AccuracyTable>& tables, bool overlay) {
  ErrorDrawing drawing;
  std::vector<Method> methods;
  std::vector<std::vector<ErrorSeries>> series;
  for (const auto& table : tables) {
    series.push_back(series_of(table));
    for (const auto& one : series.back()) index_in(methods, one.method);
  }
  // Colours tell orders, shapes the rest.
  std::vector<int> orders;
  std::vector<std::pair<std::size_t, Method>> variants;
  std::vector<Curve> listed;
  std::vector<std::string> names;
  std::vector<double> wanted;
  if (overlay) drawing.panels.resize(1);
  for (std::size_t t = 0; t < tables.size(); ++t) {
    if (!overlay) drawing.panels.push_back({tables[t].title, {}, {}});
    auto& panel = drawing.panels.back();
    for (auto& one : series[t]) {
      const bool apart = overlay && tables.size() > 1;
      const Method variant{0, one.method.time_order, one.method.slip_order, one.method.courant,
                           one.method.monotone};
      const Curve curve{one, line_colour(index_in(orders, one.method.order)),
                        marker_of(index_in(variants, std::pair(apart ? t : 0, variant)))};
      panel.curves.push_back(curve);
      const std::string name = (apart ? tables[t].title + ": " : "") + name_of(one.method, methods);
      const auto known = std::find(names.begin(), names.end(), name);
      if (known == names.end()) {
        names.push_back(name);
        listed.push_back(curve);
      } else {  // what its points have decides what the legend explains
        auto& points = listed[std::size_t(known - names.begin())].series.points;
        points.insert(points.end(), one.points.begin(), one.points.end());
      }
    }
    if (const auto& error = tables[t].wanted_error) {
      const double percent = 100 * *error;
      if (std::find(wanted.begin(), wanted.end(), percent) == wanted.end()) wanted.push_back(percent);
      panel.wanted_percent.push_back(percent);
    }
  }
  drawing.legend = legend_of(listed, names, wanted);
  return drawing;
}

}  // namespace

Picture draw_error(const std::vector<AccuracyTable>& tables, bool overlay, const Look& look, Page page) {
  const auto drawing = arrange(tables, overlay);
  PanelSpec spec;
  set_axes(spec, drawing.panels);
  narrow(spec.x, look.x, "--x");
  narrow(spec.y, look.y, "--y");
  const auto count = double(drawing.panels.size());
  if (page.height_pt == 0) {
    page.width_pt = std::min(16 + 7 * (count - 1), 40.0) * points_per_cm;
    page.height_pt = 11 * points_per_cm + extra_height_pt(drawing.legend.size());
  }
  Canvas canvas(page);
  const bool alone = drawing.panels.size() == 1;
  double legend_pt = 0;
  std::optional<Legend> below;
  if (alone) {
    spec.legend = drawing.legend;
  } else {
    below.emplace(drawing.legend, page.width_pt - 10, page.text_pt());
    legend_pt = below->height() + 5;
  }
  double title_pt = 0;
  if (!alone && !page.title.empty()) title_pt = draw_title(canvas, page.title);
  for (std::size_t n = 0; n < drawing.panels.size(); ++n) {
    spec.title = alone && !page.title.empty() ? page.title : drawing.panels[n].title;
    const double width = page.width_pt / count;
    const Panel panel(spec, {double(n) * width, title_pt, width, page.height_pt - title_pt - legend_pt},
                      page);
    panel.draw_grid(canvas);
    canvas.within(panel.plot(), [&] { draw_content(canvas, panel, drawing.panels[n]); });
    panel.draw(canvas);
  }
  if (below) below->draw(canvas, {(page.width_pt - below->width()) / 2, page.height_pt - legend_pt});
  return {canvas.finish(), canvas.words()};
}

}  // namespace slipwave::plot
