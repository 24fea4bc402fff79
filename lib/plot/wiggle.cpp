// SPDX-License-Identifier: BSD-3-Clause
#include "plot/wiggle.hpp"

#include <algorithm>
#include <cmath>

#include "plot/raster.hpp"

namespace slipwave::plot {
namespace {

constexpr double closest_pt = 2, reach_part = 1.4;

/// A trace in points: excursion (x) over the place of its time (y). Where there are more than four samples a
/// pixel, only the least and the greatest of each stay, in their order.
std::vector<Spot> line_of(const float* samples, std::int64_t count, const std::vector<double>& times,
                          double pixel_pt, double scale, double farthest) {
  std::vector<Spot> line;
  const auto add = [&](std::int64_t n) {
    const double value = double(samples[n]);
    if (std::isfinite(value))
      line.push_back({std::clamp(value * scale, -farthest, farthest), times[std::size_t(n)]});
  };
  const double step_pt = count > 1 ? std::fabs(times[1] - times[0]) : pixel_pt;
  const auto together = std::max<std::int64_t>(1, std::int64_t(pixel_pt / step_pt));
  if (together < 4) {
    for (std::int64_t n = 0; n < count; ++n) add(n);
    return line;
  }
  for (std::int64_t from = 0; from < count; from += together) {
    const auto end = std::min(count, from + together);
    const auto [low, high] = std::minmax_element(samples + from, samples + end);
    add(std::min(low - samples, high - samples));
    add(std::max(low - samples, high - samples));
  }
  return line;
}

/// The part of a line with positive excursions, closed along the place of the trace.
std::vector<Spot> lobes_of(const std::vector<Spot>& line) {
  std::vector<Spot> lobes{{0, line.front().y}};
  for (std::size_t n = 0; n < line.size(); ++n) {
    if (n > 0 && line[n - 1].x * line[n].x < 0) {
      const double part = line[n - 1].x / (line[n - 1].x - line[n].x);
      lobes.push_back({0, line[n - 1].y + part * (line[n].y - line[n - 1].y)});
    }
    lobes.push_back({std::max(0.0, line[n].x), line[n].y});
  }
  lobes.push_back({0, line.back().y});
  return lobes;
}

/// The distance of most traces to their next one, in points: gaps do not count.
double usual_spacing(const std::vector<double>& places, const Scale& scale, double alone_pt) {
  auto usual = usual_distances(places);
  if (usual.empty()) return alone_pt;
  const auto middle = usual.begin() + std::ptrdiff_t((usual.size() - 1) / 2);
  std::nth_element(usual.begin(), middle, usual.end());
  return std::fabs(scale.place(places.front() + *middle) - scale.place(places.front()));
}

}  // namespace

std::size_t draw_wiggles(Canvas& canvas, const Panel& panel, const GatherContent& content,
                         const WiggleStyle& style) {
  const auto& section = content.section;
  const auto& places = content.traces.places;
  const auto& scale = content.place_scale(panel);
  const bool upright = content.upright();
  std::vector<double> times(std::size_t(section.axis.count));
  for (std::size_t n = 0; n < times.size(); ++n)
    times[n] = content.time_scale(panel).place(section.axis.start_s + double(n) * section.axis.interval_s);
  const double spacing = usual_spacing(places, scale, upright ? panel.plot().height : panel.plot().width);
  const auto every = std::max<std::size_t>(1, std::size_t(std::ceil(closest_pt / spacing - 1e-9)));
  const double reach = reach_part * spacing * double(every);
  const double pixel_pt = 1 / canvas.page().scale();
  const double first = upright ? panel.plot().y : panel.plot().x;
  const double last = upright ? panel.plot().bottom() : panel.plot().right();
  const auto on_page = [&](std::vector<Spot> line, double place) {
    for (auto& spot : line) spot = upright ? Spot{spot.y, place - spot.x} : Spot{place + spot.x, spot.y};
    return line;
  };
  for (std::size_t n = 0; n < places.size(); n += every) {
    const double place = scale.place(places[n]);
    if (place < first - reach || place > last + reach) continue;
    const auto line =
        line_of(section.trace(n), section.axis.count, times, pixel_pt, reach / style.full, reach);
    if (line.empty()) continue;
    if (style.fill) canvas.polygon(on_page(lobes_of(line), place), style.colour);
    canvas.polyline(on_page(line, place),
                    {style.colour, std::clamp(spacing * double(every) / 12, 0.25, 0.6)});
  }
  return every;
}

}  // namespace slipwave::plot
