// SPDX-License-Identifier: BSD-3-Clause
#include "plot/survey_marks.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "base/error.hpp"
#include "base/parse.hpp"
#include "grid/slice.hpp"
#include "segy/reader.hpp"

namespace slipwave::plot {
namespace {

constexpr Colour source_colour{0.80, 0.10, 0.10}, receiver_colour{0.10, 0.10, 0.10};
constexpr double source_pt = 9, least_source_pt = 3, receiver_pt = 5.5;

void draw_marks(Canvas& canvas, const Panel& panel, const std::vector<Point<2>>& places, Marker shape,
                double size_pt, double apart_pt, const Colour& colour) {
  const Rect& plot = panel.plot();
  Spot last{-1e9, -1e9};
  for (const auto& place : places) {
    const Spot at{panel.x(place[0]), panel.y(place[1])};
    if (at.x < plot.x - 0.01 || at.x > plot.right() + 0.01 || at.y < plot.y - 0.01 ||
        at.y > plot.bottom() + 0.01)
      continue;
    if (std::hypot(at.x - last.x, at.y - last.y) < apart_pt) continue;
    canvas.marker(at, shape, size_pt, colour, true);
    last = at;
  }
}

/// So small that neighbours do not hide each other.
double star_size(const Panel& panel, const std::vector<Point<2>>& places) {
  double closest = source_pt;
  for (std::size_t n = 1; n < places.size(); ++n)
    closest = std::min(closest, std::hypot(panel.x(places[n][0]) - panel.x(places[n - 1][0]),
                                           panel.y(places[n][1]) - panel.y(places[n - 1][1])));
  return std::clamp(closest / 0.9, least_source_pt, source_pt);
}

/// The angle of "plane:10" in the commands of a textual header.
std::optional<double> plane_angle(const std::string& text) {
  const std::string word = "plane:";
  const auto at = text.find(word);
  if (at == std::string::npos) return std::nullopt;
  const auto end = text.find_first_not_of("+-.0123456789", at + word.size());
  try {
    return parse_number(text.substr(at + word.size(), end - at - word.size()));
  } catch (const Error&) {
    return std::nullopt;
  }
}

void draw_front(Canvas& canvas, const Panel& panel, const Point<2>& at, double angle_deg) {
  const double angle = angle_deg * std::numbers::pi / 180, size_pt = 0.12 * panel.plot().height;
  const Spot from{panel.x(at[0]), panel.y(at[1])};
  const double dx = std::sin(angle), dy = std::cos(angle);
  const Spot tip{from.x + size_pt * dx, from.y + size_pt * dy};
  const Stroke thick{source_colour, 1.6};
  canvas.line({from.x - 2 * size_pt * dy, from.y + 2 * size_pt * dx},
              {from.x + 2 * size_pt * dy, from.y - 2 * size_pt * dx}, thick);
  canvas.line(from, tip, thick);
  const double barb = 0.35 * size_pt;
  canvas.polygon({{tip.x + barb * dx, tip.y + barb * dy},
                  {tip.x - 0.6 * barb * dy, tip.y + 0.6 * barb * dx},
                  {tip.x + 0.6 * barb * dy, tip.y - 0.6 * barb * dx}},
                 source_colour);
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
  SurveyMarks marks{{sources.begin(), sources.end()}, {receivers.begin(), receivers.end()}};
  const auto& text = reader.header().text;  // where sw-shoot writes what the source was
  if (!reader.header().su && text.find("source: plane") != std::string::npos) {
    marks.plane_wave = true;
    marks.plane_angle_deg = plane_angle(text);
  }
  return marks;
}

Point<3> first_source(segy::Reader& reader) {
  segy::Trace trace;
  if (!reader.next(trace)) throw Error(reader.name() + ": has no traces, expected at least one");
  return reader.si_header(trace).source_m;
}

void draw_survey(Canvas& canvas, const Panel& panel, const SurveyMarks& marks) {
  draw_marks(canvas, panel, marks.receivers, Marker::triangle_down, receiver_pt, 0.9 * receiver_pt,
             receiver_colour);
  if (marks.plane_wave) {
    canvas.within(panel.plot(), [&] {
      for (const auto& at : marks.sources)
        if (marks.plane_angle_deg) draw_front(canvas, panel, at, *marks.plane_angle_deg);
    });
    return;
  }
  draw_marks(canvas, panel, marks.sources, Marker::star, star_size(panel, marks.sources),
             1 / canvas.page().scale(), source_colour);
}

std::vector<LegendEntry> legend_of(const SurveyMarks& marks) {
  std::vector<LegendEntry> entries;
  const auto add = [&](const char* one, const char* many, std::size_t count, Marker shape,
                       const Colour& colour) {
    if (count > 0) entries.push_back({.text = count == 1 ? one : many, .colour = colour, .marker = shape});
  };
  if (marks.plane_wave) {
    entries.push_back({.text = "plane wave", .colour = source_colour});
    if (marks.plane_angle_deg) entries.back().line = Stroke{source_colour, 1.6};
  } else {
    add("source", "sources", marks.sources.size(), Marker::star, source_colour);
  }
  add("receiver", "receivers", marks.receivers.size(), Marker::triangle_down, receiver_colour);
  return entries;
}

}  // namespace slipwave::plot
