// SPDX-License-Identifier: BSD-3-Clause
#include "plot/snapshot_picture.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>
#include <span>

#include "plot/three_slices.hpp"

namespace slipwave::plot {
namespace {

/// Models as a faint ground on one scale: greys too light to be taken for a wave.
class Ground {
 public:
  explicit Ground(std::span<const ModelSection> models) : models_(models), range_(range_of(models).shown) {}

  Image image(std::size_t model, const Panel& panel, const Page& page, const Look& look) const {
    const auto raster = shown_values(models_[model].values, panel, page, Take::mean, look);
    Image image(raster.width, raster.height);
    for (std::size_t n = 0; n < image.pixels.size(); ++n)
      image.pixels[n] = pixel_of(std::isnan(raster.values[n]) ? no_data : colour(double(raster.values[n])));
    return image;
  }
  /// What the greys mean.
  LegendEntry key() const {
    return {.text = range_in_words(models_.front(), range_),
            .colour = colour(range_.low),
            .patch = true,
            .to = colour(range_.high),
            .graded = true};
  }
  const ModelSection& model(std::size_t n) const { return models_[n]; }

 private:
  Colour colour(double value) const {
    const double number = range_.high > range_.low ? (value - range_.low) / (range_.high - range_.low) : 0.8;
    const double light = 0.70 + 0.30 * std::clamp(number, 0.0, 1.0);
    return {light, light, light};
  }

  std::span<const ModelSection> models_;
  Limits range_;
};

Colour colour_of_pixel(std::uint32_t pixel) {
  const auto part = [&](int shift) { return double(pixel >> shift & 0xff) / 255; };
  return {part(16), part(8), part(0)};
}

/// The wave over its ground: strong parts hide it, weak ones tint it.
std::uint32_t over(std::uint32_t ground, double value, const ColourBar& bar) {
  const double middle = (bar.axis.low + bar.axis.high) / 2, half = (bar.axis.high - bar.axis.low) / 2;
  const double strength = std::clamp((value - middle) / half, -1.0, 1.0);
  const double tone = std::copysign(std::max(std::fabs(strength), 0.4), strength);
  return pixel_of(
      blend(colour_of_pixel(ground), bar.map.at((1 + tone) / 2), std::pow(std::fabs(strength), 0.7)));
}

std::string title_of(const Snapshot& snapshot, const std::string& title) {
  char time[40];
  // Milliseconds as a rule, so that the titles of a film do not move; more where they would be nothing.
  std::snprintf(time, sizeof time, std::fabs(snapshot.time_s) < 0.02 ? "t = %.3g s" : "t = %.3f s",
                snapshot.time_s);
  return title.empty() ? time : title + ", " + time;
}

ColourBar bar_of(const Snapshot& snapshot, double full, const Look& look) {
  const Limits limits = look.colours.value_or(Limits{-full, full});
  ColourBar bar{map_of(look, "blue-red"), {snapshot.name, snapshot.unit, limits.low, limits.high}};
  bar.point_beyond(snapshot.extent.low, snapshot.extent.high);
  return bar;
}

/// The data of a panel; `section`: of the ground, where there is one.
void draw_field(Canvas& canvas, const Panel& panel, const ColourBar& bar, const Snapshot& snapshot,
                const std::optional<Ground>& ground, std::size_t section, const Look& look) {
  const auto& page = canvas.page();
  const auto pixels = pixels_of(panel, page, snapshot.values.grid());
  const auto raster = shown_values(snapshot.values, panel, page, Take::extreme, look);
  Image image = ground ? ground->image(section, panel, page, look) : Image(raster.width, raster.height);
  const double low = bar.axis.low, span = bar.axis.high - bar.axis.low;
  for (std::size_t n = 0; n < image.pixels.size(); ++n) {
    const double value = double(raster.values[n]);
    if (std::isnan(value)) {
      if (!ground && pixels.within(n)) image.pixels[n] = pixel_of(no_data);  // no cells in this depth
      continue;
    }
    image.pixels[n] = ground ? over(image.pixels[n], value, bar) : bar.map.pixel((value - low) / span);
  }
  canvas.image(image, panel.plot());
  if (!ground) return;
  const auto& model = ground->model(section);
  draw_fractures(canvas, panel, model, pixels_of(panel, page, model.grid()), image, false);
}

std::vector<LegendEntry> legend_of(const std::optional<Ground>& ground, const SurveyMarks& marks) {
  std::vector<LegendEntry> entries;
  if (ground) entries.push_back(ground->key());
  const auto places = legend_of(marks);
  entries.insert(entries.end(), places.begin(), places.end());
  return entries;
}

}  // namespace

std::string shown_unit(const std::string& file_unit) {
  if (file_unit == "m s-1") return "m/s";
  return file_unit == "s-1" ? "1/s" : file_unit;
}

Picture draw_snapshot(const Snapshot& snapshot, double full, const std::optional<ModelSection>& model,
                      const SurveyMarks& marks, const Look& look, Page page) {
  const auto axes = axes_of(snapshot.values.grid(), look, snapshot.axes);
  const auto ground = model ? std::optional(Ground(std::span(&*model, 1))) : std::nullopt;
  const PanelSpec spec{title_of(snapshot, page.title), axes.x, axes.depth, bar_of(snapshot, full, look),
                       legend_of(ground, marks)};
  if (page.height_pt == 0) Panel::fit_page(page, spec, height_per_width(spec.x, spec.y));
  const Panel panel(spec, {0, 0, page.width_pt, page.height_pt}, page);
  Canvas canvas(page);
  draw_field(canvas, panel, *spec.bar, snapshot, ground, 0, look);
  panel.draw(canvas);
  draw_survey(canvas, panel, marks);
  return {canvas.finish(), canvas.words()};
}

Picture draw_snapshot_volume(const SnapshotVolume& volume, double full,
                             const std::vector<ModelSection>& models, const std::vector<SurveyMarks>& marks,
                             const Look& look, Page page) {
  const auto bar = bar_of(volume.snapshots.front(), full, look);
  const auto ground = models.empty() ? std::nullopt : std::optional(Ground(models));
  std::array<SlicePanel, 3> slices;
  for (std::size_t n = 0; n < slices.size(); ++n) {
    const auto& snapshot = volume.snapshots[n];
    const auto axes = axes_of(snapshot.values.grid(), look, snapshot.axes);
    slices[n] = {
        volume.planes[n], {"", axes.x, axes.depth, bar, {}}, [&, n](Canvas& canvas, const Panel& panel) {
          draw_field(canvas, panel, bar, volume.snapshots[n], ground, n, look);
          draw_survey(canvas, panel, marks[n]);
        }};
  }
  page.title = title_of(volume.snapshots.front(), page.title);
  return draw_three_slices(std::move(slices), legend_of(ground, marks.front()), std::move(page));
}

}  // namespace slipwave::plot
