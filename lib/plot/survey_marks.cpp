#include "plot/survey_marks.hpp"

#include <cmath>
#include <set>

#include "base/error.hpp"
#include "grid/slice.hpp"
#include "segy/reader.hpp"

namespace slipwave::plot {
namespace {

constexpr Colour source_colour{0.80, 0.10, 0.10}, receiver_colour{0.10, 0.10, 0.10};
constexpr double source_pt = 9, receiver_pt = 5.5;

void draw_marks(Canvas& canvas, const Panel& panel, const std::vector<Point<2>>& places, Marker shape,
                double size_pt, const Colour& colour) {
  const Rect& plot = panel.plot();
  Spot last{-1e9, -1e9};
  for (const auto& place : places) {
    const Spot at{panel.x(place[0]), panel.y(place[1])};
    if (at.x < plot.x - 0.01 || at.x > plot.right() + 0.01 || at.y < plot.y - 0.01 ||
        at.y > plot.bottom() + 0.01)
      continue;
    if (std::hypot(at.x - last.x, at.y - last.y) < 0.9 * size_pt) continue;
    canvas.marker(at, shape, size_pt, colour, true);
    last = at;
  }
}

}  // namespace

SurveyMarks read_survey(segy::Reader& reader, int axis) {
  const auto [across, down] = axes_left(axis);
  std::set<Point<2>> sources, receivers;
  segy::Trace trace;
  while (reader.next(trace)) {
    const auto header = reader.si_header(trace);
    sources.insert({header.source_m[across], header.source_m[down]});
    receivers.insert({header.receiver_m[across], header.receiver_m[down]});
  }
  if (sources.empty()) throw Error(reader.name() + ": has no traces, expected at least one");
  return {{sources.begin(), sources.end()}, {receivers.begin(), receivers.end()}};
}

void draw_survey(Canvas& canvas, const Panel& panel, const SurveyMarks& marks) {
  draw_marks(canvas, panel, marks.receivers, Marker::triangle_down, receiver_pt, receiver_colour);
  draw_marks(canvas, panel, marks.sources, Marker::star, source_pt, source_colour);
}

std::vector<LegendEntry> legend_of(const SurveyMarks& marks) {
  std::vector<LegendEntry> entries;
  const auto add = [&](const char* one, const char* many, std::size_t count, Marker shape,
                       const Colour& colour) {
    if (count > 0) entries.push_back({.text = count == 1 ? one : many, .colour = colour, .marker = shape});
  };
  add("source", "sources", marks.sources.size(), Marker::star, source_colour);
  add("receiver", "receivers", marks.receivers.size(), Marker::triangle_down, receiver_colour);
  return entries;
}

}  // namespace slipwave::plot
