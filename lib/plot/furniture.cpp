// SPDX-License-Identifier: BSD-3-Clause
#include "plot/furniture.hpp"

#include <algorithm>
#include <cmath>

namespace slipwave::plot {
namespace {

double key_width(double text_pt) { return 2.2 * text_pt; }
double row_height(double text_pt) { return 1.45 * text_pt; }

/// A row of colours from one to another.
Image graded(const Colour& from, const Colour& to) {
  Image image(64, 1);
  for (int n = 0; n < image.width; ++n)
    image.at(n, 0) = pixel_of(blend(from, to, double(n) / (image.width - 1)));
  return image;
}

}  // namespace

double extra_height_pt(std::size_t legend_entries) {
  constexpr std::size_t usual = 12;
  return legend_entries > usual ? double(legend_entries - usual) * 7 : 0;  // half a row: mostly two columns
}

double Legend::widest(const std::vector<LegendEntry>& entries, double text_pt) {
  double widest = 0;
  for (const auto& entry : entries) widest = std::max(widest, text_width(entry.text, text_pt));
  return widest + key_width(text_pt) + 1.5 * text_pt;
}

Legend::Legend(std::vector<LegendEntry> entries, double room_width_pt, double text_pt)
    : entries_(std::move(entries)), text_pt_(text_pt) {
  if (entries_.empty()) return;
  column_width_ = std::min(room_width_pt, widest(entries_, text_pt));
  for (auto& entry : entries_)
    entry.text = shortened(entry.text, column_width_ - key_width(text_pt) - 0.5 * text_pt, text_pt);
  columns_ = std::clamp<std::size_t>(std::size_t(room_width_pt / column_width_ + 1e-6), 1, entries_.size());
  rows_ = (entries_.size() + columns_ - 1) / columns_;
  columns_ = (entries_.size() + rows_ - 1) / rows_;
}

double Legend::height() const { return double(rows_) * row_height(text_pt_); }

void Legend::draw(Canvas& canvas, const Spot& top_left) const {
  for (std::size_t n = 0; n < entries_.size(); ++n) {
    const auto& entry = entries_[n];
    const auto column = n / rows_, row = n % rows_;
    const double x = top_left.x + double(column) * column_width_;
    const double y = top_left.y + (double(row) + 0.5) * row_height(text_pt_);
    const double key = key_width(text_pt_) - 0.5 * text_pt_;
    if (entry.patch) {
      const Rect patch{x, y - 0.4 * text_pt_, key, 0.8 * text_pt_};
      canvas.fill(patch, entry.colour);
      if (entry.graded) canvas.image(graded(entry.colour, entry.to), patch);
      canvas.frame(patch, {black, 0.4});
    }
    if (entry.line) canvas.line({x, y}, {x + key, y}, *entry.line);
    if (entry.ring) canvas.ring({x + key / 2, y}, 0.5 * text_pt_, {entry.colour, 1});
    if (entry.marker)
      canvas.marker({x + key / 2, y}, *entry.marker, 0.62 * text_pt_, entry.colour, entry.filled);
    canvas.text({x + key_width(text_pt_), y}, entry.text, {.size_pt = text_pt_, .down = Down::middle});
  }
}

double draw_title(Canvas& canvas, const std::string& title) {
  const auto& page = canvas.page();
  const double size_pt = 1.3 * page.text_pt();
  canvas.text({page.width_pt / 2, 5}, shortened(title, page.width_pt - 10, size_pt, true),
              {.size_pt = size_pt, .bold = true, .across = Across::middle, .down = Down::top});
  return 1.6 * size_pt;
}

void ColourBar::point_beyond(double low, double high) {
  const double slack = 1e-6 * (axis.high - axis.low);  // rounding is not beyond
  below = low < axis.low - slack;
  above = high > axis.high + slack;
}

Rect ColourBar::body(const Rect& rect) const {
  const double arrow = std::min(1.1 * rect.width, 0.1 * rect.height);
  const double top = above ? arrow : 0, bottom = below ? arrow : 0;
  return {rect.x, rect.y + top, rect.width, rect.height - top - bottom};
}

void draw_colour_bar(Canvas& canvas, const ColourBar& bar, const AxisMarks& marks, const Rect& whole,
                     double text_pt) {
  const Rect rect = bar.body(whole);
  const auto arrow = [&](double base, double tip, double end) {
    const Spot left{rect.x, base}, point{rect.x + rect.width / 2, tip}, right{rect.right(), base};
    canvas.polygon({left, point, right}, bar.map.at(end));
    canvas.polyline({left, point, right}, {black, frame_pt});
  };
  if (bar.above) arrow(rect.y, whole.y, 1);
  if (bar.below) arrow(rect.bottom(), whole.bottom(), 0);
  const int rows = std::max(1, int(std::lround(rect.height * canvas.page().scale())));
  Image image(1, rows);
  for (int row = 0; row < rows; ++row) image.at(0, row) = bar.map.pixel(1 - (row + 0.5) / rows);
  canvas.image(image, rect);
  canvas.frame(rect, {black, frame_pt});
  const Scale scale(bar.axis, rect.bottom(), rect.y);
  const double right = rect.right();
  for (const double value : marks.minor)
    canvas.line({right, scale.place(value)}, {right + minor_tick_pt, scale.place(value)}, {black, 0.5});
  for (std::size_t n = 0; n < marks.values.size(); ++n) {
    const double y = scale.place(marks.values[n]);
    canvas.line({right, y}, {right + tick_pt, y}, {black, frame_pt});
    canvas.text({right + tick_pt + pad_pt + marks.widest_pt, y}, marks.labels[n],
                {.size_pt = text_pt, .across = Across::end, .down = Down::middle});
  }
}

}  // namespace slipwave::plot
