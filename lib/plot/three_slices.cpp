// SPDX-License-Identifier: BSD-3-Clause
#include "plot/three_slices.hpp"

#include <algorithm>
#include <cmath>

#include "base/error.hpp"

namespace slipwave::plot {
namespace {

constexpr double least_slice_pt = 1.6 * points_per_cm, highest_pt = 17 * points_per_cm;

struct Size {
  double width = 0, height = 0;
};

/// Returns the size of the room in which the data of a panel have this size, in pt.
Size room_size(const PanelSpec& spec, const Size& data, const Page& page) {
  Size room{data.width + 150, data.height + 120};
  for (int pass = 0; pass < 3; ++pass) {  // words depend on the axes' lengths
    const Rect plot = Panel(spec, {0, 0, room.width, room.height}, page).plot();
    room = {room.width + data.width - plot.width, room.height + data.height - plot.height};
  }
  return room;
}

double extent(const Axis& axis) { return axis.high - axis.low; }

/// Sizes of the data and rooms of the three panels at a scale.
struct Layout {
  std::array<Size, 3> data, rooms;
  double width() const { return std::max(rooms[1].width + rooms[0].width, rooms[2].width); }
  double height(double top_pt) const { return top_pt + rooms[2].height + rooms[1].height; }
};

Layout layout_at(const std::array<SlicePanel, 3>& slices, double points_a_metre, const Page& page) {
  Layout layout;
  for (std::size_t n = 0; n < 3; ++n) {
    const auto& spec = slices[n].spec;
    layout.data[n] = {std::max(least_slice_pt, points_a_metre * extent(spec.x)),
                      std::max(least_slice_pt, points_a_metre * extent(spec.y))};
    layout.rooms[n] = room_size(spec, layout.data[n], page);
  }
  return layout;
}

/// The largest scale at which all fits.
Layout fitted(const std::array<SlicePanel, 3>& slices, double top_pt, const Page& page) {
  const double across = extent(slices[1].spec.x) + extent(slices[0].spec.x);
  const double down = extent(slices[2].spec.y) + extent(slices[1].spec.y);
  const double height = page.height_pt > 0 ? page.height_pt : highest_pt;
  double points_a_metre = std::min(page.width_pt / across, height / down);
  Layout layout;
  for (int pass = 0; pass < 6; ++pass) {
    layout = layout_at(slices, points_a_metre, page);
    const double over =
        std::max((layout.width() - page.width_pt) / across, (layout.height(top_pt) - height) / down);
    if (over <= 0 && pass > 0) break;
    points_a_metre = std::max(points_a_metre - over, 0.1 * points_a_metre);
  }
  constexpr double rounding_pt = 2;
  if (page.height_pt > 0 &&
      (layout.width() > page.width_pt + rounding_pt || layout.height(top_pt) > page.height_pt + rounding_pt))
    throw Error("--size: three sections need " + shown(std::ceil(layout.width() / points_per_cm)) + "x" +
                    shown(std::ceil(layout.height(top_pt) / points_per_cm)) +
                    "cm here; --slice y=AT draws one",
                ErrorKind::usage);
  return layout;
}

void draw_cuts(Canvas& canvas, const Panel& panel, const SlicePanel& slice,
               const std::array<SlicePanel, 3>& slices) {
  const auto axes = axes_left(slice.plane.axis);
  const Stroke dashed{{0.15, 0.15, 0.15}, 0.6, {3, 2}};
  const Rect& plot = panel.plot();
  const double x = panel.x(slices[axes[0]].plane.at_m), y = panel.y(slices[axes[1]].plane.at_m);
  canvas.line({x, plot.y}, {x, plot.bottom()}, dashed);
  canvas.line({plot.x, y}, {plot.right(), y}, dashed);
}

}  // namespace

std::string name_of(const Slice& plane) {
  return std::string(1, axis_names<3>()[std::size_t(plane.axis)]) + " = " +
         shown(std::round(10 * plane.at_m) / 10) + " m";
}

Picture draw_three_slices(std::array<SlicePanel, 3> slices, const std::vector<LegendEntry>& legend,
                          Page page) {
  for (auto& slice : slices) slice.spec.title = name_of(slice.plane);
  const auto bar = slices[0].spec.bar;
  for (const std::size_t n : {1, 2}) slices[n].spec.bar.reset();
  // Data that share x stand above each other.
  const Size usual{4 * least_slice_pt, 2 * least_slice_pt};
  for (const std::size_t n : {1, 2}) {
    const auto room = room_size(slices[n].spec, usual, page);
    const Panel panel(slices[n].spec, {0, 0, room.width, room.height}, page);
    for (const std::size_t both : {1, 2})
      slices[both].spec.least_left_pt = std::max(slices[both].spec.least_left_pt, panel.plot().x);
  }
  const double top_pt = page.title.empty() ? 0 : 1.6 * 1.3 * page.text_pt();
  const auto layout = fitted(slices, top_pt, page);
  if (page.height_pt == 0) {
    page.width_pt = layout.width();
    page.height_pt = layout.height(top_pt);
  }
  Canvas canvas(page);
  if (!page.title.empty()) draw_title(canvas, page.title);
  const auto& rooms = layout.rooms;
  const double lower = top_pt + rooms[2].height;
  const std::array<Rect, 3> places = {Rect{rooms[1].width, lower, rooms[0].width, rooms[0].height},
                                      Rect{0, lower, rooms[1].width, rooms[1].height},
                                      Rect{0, top_pt, rooms[2].width, rooms[2].height}};
  for (std::size_t n = 0; n < 3; ++n) {
    const Panel panel(slices[n].spec, places[n], page);
    slices[n].draw(canvas, panel);
    draw_cuts(canvas, panel, slices[n], slices);
    panel.draw(canvas);
  }
  const Legend words(legend, std::max(page.width_pt - rooms[2].width - 20, 1.0), page.text_pt());
  words.draw(canvas, {rooms[2].width + 10, top_pt + 2.5 * page.text_pt()});
  return {canvas.finish(), canvas.words()};
}

}  // namespace slipwave::plot
