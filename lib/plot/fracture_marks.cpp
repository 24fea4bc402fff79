// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <numbers>

#include "plot/section.hpp"

namespace slipwave::plot {
namespace {

constexpr double hatch_every_pt = 4.5, line_pt = 0.8, trace_pt = 1.2;

/// How light a pixel is to the eye, 0 to 1.
double lightness(std::uint32_t pixel) {
  const auto part = [&](int shift) { return double(pixel >> shift & 0xff) / 255; };
  return 0.30 * part(16) + 0.59 * part(8) + 0.11 * part(0);
}

/// A family of parallel lines on the page.
struct Hatch {
  double nx = 0, ny = 0;  // unit normal, in pixels
  bool on(int column, int row, double scale) const {
    const double every = hatch_every_pt * scale;
    const double phase = (nx * (column + 0.5) + ny * (row + 0.5)) / every;
    return (phase - std::floor(phase)) * every < line_pt * scale;
  }
};

/// Planes of a slip system as they lie on the page, whose axes may differ in scale.
Hatch hatch_of(const SlipSystem<2>& system, const Panel& panel) {
  const double sx = panel.x(1) - panel.x(0), sz = panel.y(1) - panel.y(0);
  const double nx = system.normal[0] / sx, ny = system.normal[1] / sz;
  const double length = std::hypot(nx, ny);
  return {nx / length, ny / length};
}

}  // namespace

void draw_fractures(Canvas& canvas, const Panel& panel, const ModelSection& section, const GridPixels& pixels,
                    const Image& below, bool hatched) {
  if (section.fracture.empty()) return;
  const auto codes = reduced(section.fracture, pixels, Take::greatest);
  const auto code_at = [&](int column, int row) {
    if (column < 0 || row < 0 || column >= codes.width || row >= codes.height) return 0;
    const float code = codes.at(column, row);
    return std::isnan(code) ? 0 : int(code);
  };
  // Lines are black on what is light and white on what is dark, the same for the whole of a set.
  std::vector<double> light(section.sets.size() + 1, 0), count(section.sets.size() + 1, 0);
  for (int row = 0; row < codes.height; ++row) {
    for (int column = 0; column < codes.width; ++column) {
      const auto code = std::size_t(code_at(column, row));
      light[code] +=
          lightness(below.pixels[std::size_t(row) * std::size_t(below.width) + std::size_t(column)]);
      count[code] += 1;
    }
  }
  std::vector<std::vector<Hatch>> hatches(section.sets.size() + 1);
  for (std::size_t set = 0; hatched && set < section.sets.size(); ++set) {
    if (!section.sets[set].is_cluster()) continue;
    for (const auto& system : section.sets[set].systems) hatches[set + 1].push_back(hatch_of(system, panel));
  }
  const double scale = canvas.page().scale();
  const int thick = std::max(1, int(std::lround(line_pt * scale)));
  Image marks(codes.width, codes.height);
  for (int row = 0; row < codes.height; ++row) {
    for (int column = 0; column < codes.width; ++column) {
      const int code = code_at(column, row);
      if (code == 0 || !section.sets[std::size_t(code) - 1].is_cluster()) continue;
      bool on = false;
      for (const auto& hatch : hatches[std::size_t(code)]) on = on || hatch.on(column, row, scale);
      for (const int off : {-thick, thick})
        on = on || code_at(column + off, row) != code || code_at(column, row + off) != code;
      const bool dark = light[std::size_t(code)] < 0.5 * count[std::size_t(code)];
      if (on) marks.at(column, row) = pixel_of(dark ? white : black);
    }
  }
  canvas.image(marks, panel.plot());
  for (std::size_t set = 0; set < section.sets.size(); ++set)
    for (const auto& trace : section.sets[set].traces) {
      std::vector<Spot> spots;
      for (const auto& vertex : trace) spots.push_back({panel.x(vertex[0]), panel.y(vertex[1])});
      const bool dark = light[set + 1] < 0.5 * count[set + 1];
      if (!spots.empty()) canvas.polyline(spots, {dark ? white : black, trace_pt});
    }
}

}  // namespace slipwave::plot
