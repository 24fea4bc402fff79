// SPDX-License-Identifier: BSD-3-Clause
#include "plot/wiggle.hpp"

#include <algorithm>
#include <cmath>

#include "plot/raster.hpp"

namespace slipwave::plot {
namespace {

constexpr double closest_pt = 2, reach_part = 1.4;

/// A trace in points: excursion to the right over the height. Where there are more than four samples a pixel,
/// only the least and the greatest of each stay, in their order.
std::vector<Spot> line_of(const float* samples, std::int64_t count, const std::vector<double>& heights,
                          double pixel_pt, double scale, double farthest) {
  std::vector<Spot> line;
  const auto add = [&](std::int64_t n) {
    const double value = double(samples[n]);
    if (std::isfinite(value))
      line.push_back({std::clamp(value * scale, -farthest, farthest), heights[std::size_t(n)]});
  };
  const double step_pt = count > 1 ? std::fabs(heights[1] - heights[0]) : pixel_pt;
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
std::vector<Spot> lobes_of(const std::vector<Spot>& line, double x) {
  std::vector<Spot> lobes{{x, line.front().y}};
  for (std::size_t n = 0; n < line.size(); ++n) {
    if (n > 0 && line[n - 1].x * line[n].x < 0) {
      const double part = line[n - 1].x / (line[n - 1].x - line[n].x);
      lobes.push_back({x, line[n - 1].y + part * (line[n].y - line[n - 1].y)});
    }
    lobes.push_back({x + std::max(0.0, line[n].x), line[n].y});
  }
  lobes.push_back({x, line.back().y});
  return lobes;
}

}  // namespace

std::size_t draw_wiggles(Canvas& canvas, const Panel& panel, const GatherSection& section,
                         const std::vector<double>& places, const WiggleStyle& style) {
  std::vector<double> heights(std::size_t(section.axis.count));
  for (std::size_t n = 0; n < heights.size(); ++n)
    heights[n] = panel.y(section.axis.start_s + double(n) * section.axis.interval_s);
  double spacing = panel.plot().width;
  if (places.size() > 1)
    spacing = std::fabs(panel.x(places.back()) - panel.x(places.front())) / double(places.size() - 1);
  const auto every = std::max<std::size_t>(1, std::size_t(std::ceil(closest_pt / spacing - 1e-9)));
  const double reach = reach_part * spacing * double(every);
  const double pixel_pt = 1 / canvas.page().scale();
  for (std::size_t n = 0; n < places.size(); n += every) {
    const double x = panel.x(places[n]);
    if (x < panel.plot().x - reach || x > panel.plot().right() + reach) continue;
    auto line = line_of(section.trace(n), section.axis.count, heights, pixel_pt, reach / style.full, reach);
    if (line.empty()) continue;
    if (style.fill) canvas.polygon(lobes_of(line, x), style.colour);
    for (auto& spot : line) spot.x += x;
    canvas.polyline(line, {style.colour, std::clamp(spacing * double(every) / 12, 0.25, 0.6)});
  }
  return every;
}

}  // namespace slipwave::plot
