// SPDX-License-Identifier: BSD-3-Clause
#include "plot/panel.hpp"

#include <algorithm>
#include <cmath>

#include "base/error.hpp"

namespace slipwave::plot {
namespace {

constexpr double edge_pt = 5;                       // free at the edges of a room
constexpr double least_pt = 0.8 * points_per_cm;    // for the data
constexpr double bar_part = 0.9, bar_gap_part = 1;  // width of a colour bar and what is before it, in text

double title_pt(double text_pt) { return 1.15 * text_pt; }

/// `middle`, moved so that a text of that length round it stays between the ends.
double kept_inside(double middle, double length, double low, double high) {
  return std::max(low + length / 2, std::min(middle, high - length / 2));
}

}  // namespace

Panel::Panel(const PanelSpec& spec, const Rect& room, const Page& page)
    : spec_(spec), room_(room), text_pt_(page.text_pt()), scale_(page.scale()) {
  lay_out(room);
  if (plot_.width < least_pt || plot_.height < least_pt)
    throw Error("--size leaves " + shown(std::round(std::max(0.0, plot_.width) / points_per_cm * 10) / 10) +
                    " x " + shown(std::round(std::max(0.0, plot_.height) / points_per_cm * 10) / 10) +
                    " cm for the data beside axes and words, expected 0.8 x 0.8 cm or more",
                ErrorKind::usage);
}

void Panel::fit_page(Page& page, const PanelSpec& spec, double height_per_width) {
  page.height_pt = 12 * points_per_cm;
  for (int pass = 0; pass < 4; ++pass) {  // words take room, and their sizes depend on the page's
    const Panel panel(spec, {0, 0, page.width_pt, page.height_pt}, page);
    const double beside = page.width_pt - panel.plot_.width, above = page.height_pt - panel.plot_.height;
    const double width = std::min(16 * points_per_cm - beside, 11 * points_per_cm / height_per_width);
    page.width_pt = std::max(width, 2.4 * points_per_cm) + beside;
    page.height_pt = std::clamp(width * height_per_width, 2.4 * points_per_cm, 11 * points_per_cm) + above;
  }
}

std::vector<std::string> Panel::title_lines(double width_pt) const {
  std::vector<std::string> lines;
  std::string line, rest = spec_.title;
  while (!rest.empty()) {
    const auto blank = rest.find(' ');
    const std::string word = rest.substr(0, blank);
    rest = blank == std::string::npos ? "" : rest.substr(blank + 1);
    const std::string longer = line.empty() ? word : line + " " + word;
    if (line.empty() || text_width(longer, title_pt(text_pt_), true) <= width_pt) {
      line = longer;
    } else if (lines.size() == 2) {
      line = longer + " " + rest;  // three lines at most
      break;
    } else {
      lines.push_back(line);
      line = word;
    }
  }
  if (!line.empty()) lines.push_back(line);
  for (auto& one : lines) one = shortened(one, width_pt, title_pt(text_pt_), true);
  return lines;
}

/// Beside the data where the room is wide and the legend narrow, else below.
bool Panel::legend_right(const Rect& room) const {
  return !spec_.bar && room.width > 1.35 * room.height &&
         Legend::widest(spec_.legend, text_pt_) < 0.36 * room.width &&
         double(spec_.legend.size()) * 1.45 * text_pt_ < 0.8 * room.height;
}

/// What must be free round the data, as the marks are now.
Panel::Margins Panel::margins() const {
  const double half_text = cap_height * text_pt_ / 2;
  Margins free;
  free.left = edge_pt + tick_pt + pad_pt + y_marks_.widest_pt;
  if (!y_marks_.caption.empty()) free.left += line_height * text_pt_ + 1.5 * pad_pt;
  free.bottom = edge_pt + tick_pt + pad_pt + line_height * text_pt_;
  if (!x_marks_.caption.empty()) free.bottom += line_height * text_pt_;
  free.top = edge_pt + half_text;
  if (!title_.empty()) free.top += double(title_.size()) * line_height * title_pt(text_pt_) + 0.4 * text_pt_;
  if (!spec_.bands.labels.empty()) free.top += line_height * text_pt_;
  free.right = edge_pt;
  if (spec_.bar) {
    free.right += (bar_gap_part + bar_part) * text_pt_ + tick_pt + pad_pt + bar_marks_.widest_pt;
    if (!bar_marks_.caption.empty()) free.right += line_height * text_pt_ + 2 * pad_pt;
  }
  if (legend_) {
    if (legend_right_)
      free.right += legend_->width() + 0.6 * text_pt_;
    else
      free.bottom += legend_->height() + 0.5 * text_pt_;
  }
  free.top = std::max(free.top, spec_.least_top_pt);
  free.left = std::max(free.left, spec_.least_left_pt);
  free.right = std::max(free.right, spec_.least_right_pt);
  // Labels of x stand out to the sides.
  for (std::size_t n = 0; n < x_marks_.values.size(); ++n) {
    const double half = text_width(x_marks_.labels[n], text_pt_) / 2;
    const double at = x_scale_.place(x_marks_.values[n]);
    free.left = std::max(free.left, edge_pt + half - (at - plot_.x));
    free.right = std::max(free.right, edge_pt + half - (plot_.right() - at));
  }
  return free;
}

void Panel::lay_out(const Rect& room) {
  const auto snapped = [&](double value) { return std::round(value * scale_) / scale_; };
  legend_right_ = !spec_.legend.empty() && legend_right(room);
  if (!spec_.legend.empty()) {
    const double width = room.width - 2 * edge_pt;
    legend_.emplace(spec_.legend, legend_right_ ? Legend::widest(spec_.legend, text_pt_) : width, text_pt_);
  }
  plot_ = {room.x + 0.15 * room.width, room.y + 0.1 * room.height, 0.7 * room.width, 0.75 * room.height};
  for (int pass = 0; pass < 4; ++pass) {
    const double width = std::max(plot_.width, 1.0), height = std::max(plot_.height, 1.0);
    x_scale_ = Scale(spec_.x, plot_.x, plot_.right());
    y_scale_ =
        spec_.y.upwards ? Scale(spec_.y, plot_.bottom(), plot_.y) : Scale(spec_.y, plot_.y, plot_.bottom());
    if (pass == 3) break;
    x_marks_ = marks_of(spec_.x, width, text_pt_, true);
    y_marks_ = marks_of(spec_.y, height, text_pt_, false);
    if (spec_.bar) {
      const Rect body = spec_.bar->body({0, 0, bar_part * text_pt_, height});
      bar_marks_ = marks_of(spec_.bar->axis, body.height, text_pt_, false);
    }
    title_ = title_lines(room.width - 2 * edge_pt);
    const auto free = margins();
    const double left = snapped(room.x + free.left), right = snapped(room.right() - free.right);
    const double top = snapped(room.y + free.top), bottom = snapped(room.bottom() - free.bottom);
    plot_ = {left, top, right - left, bottom - top};
  }
}

/// Returns where words turned upwards beside the data may begin, in pt: below the title.
double Panel::highest_word_pt() const {
  return room_.y + edge_pt + double(title_.size()) * line_height * title_pt(text_pt_);
}

void Panel::draw_grid(Canvas& canvas) const {
  const Stroke thin{{0.88, 0.88, 0.88}, 0.5};
  for (const double value : x_marks_.values)
    canvas.line({x(value), plot_.y}, {x(value), plot_.bottom()}, thin);
  for (const double value : y_marks_.values)
    canvas.line({plot_.x, y(value)}, {plot_.right(), y(value)}, thin);
}

void Panel::draw_axes(Canvas& canvas) const {
  const Stroke fine{black, 0.5}, plain{black, frame_pt};
  const double bottom = plot_.bottom(), left = plot_.x;
  for (const double value : x_marks_.minor)
    canvas.line({x(value), bottom}, {x(value), bottom + minor_tick_pt}, fine);
  for (const double value : y_marks_.minor)
    canvas.line({left, y(value)}, {left - minor_tick_pt, y(value)}, fine);
  for (std::size_t n = 0; n < x_marks_.values.size(); ++n) {
    const double at = x(x_marks_.values[n]);
    canvas.line({at, bottom}, {at, bottom + tick_pt}, plain);
    canvas.text({at, bottom + tick_pt + pad_pt}, x_marks_.labels[n],
                {.size_pt = text_pt_, .across = Across::middle, .down = Down::top});
  }
  for (std::size_t n = 0; n < y_marks_.values.size(); ++n) {
    const double at = y(y_marks_.values[n]);
    canvas.line({left, at}, {left - tick_pt, at}, plain);
    canvas.text({left - tick_pt - pad_pt, at}, y_marks_.labels[n],
                {.size_pt = text_pt_, .across = Across::end, .down = Down::middle});
  }
  const auto below = shortened(x_marks_.caption, room_.width - 2 * edge_pt, text_pt_);
  canvas.text({kept_inside(left + plot_.width / 2, text_width(below, text_pt_), room_.x + edge_pt,
                           room_.right() - edge_pt),
               bottom + tick_pt + pad_pt + line_height * text_pt_},
              below, {.size_pt = text_pt_, .across = Across::middle, .down = Down::top});
  const double lowest = room_.bottom() - edge_pt;
  const auto beside = shortened(y_marks_.caption, lowest - highest_word_pt(), text_pt_);
  canvas.text(
      {left - tick_pt - 2 * pad_pt - y_marks_.widest_pt,
       kept_inside(plot_.y + plot_.height / 2, text_width(beside, text_pt_), highest_word_pt(), lowest)},
      beside, {.size_pt = text_pt_, .across = Across::middle, .down = Down::bottom, .upwards = true});
}

/// Lines between bands that stand apart, and the names of as many as have room, each n-th.
void Panel::draw_bands(Canvas& canvas) const {
  const auto& bands = spec_.bands;
  if (bands.labels.empty()) return;
  constexpr double least_apart_pt = 4;
  const auto lines = [&](const std::vector<double>& values, const Stroke& stroke) {
    double last = plot_.x;
    for (const double value : values) {
      const double at = x(value);
      if (at - last < least_apart_pt || plot_.right() - at < least_apart_pt) continue;
      canvas.line({at, plot_.y}, {at, plot_.bottom()}, stroke);
      last = at;
    }
  };
  lines(bands.minor, {{0.45, 0.45, 0.45}, 0.4});
  lines(bands.edges, {black, 0.8});
  double widest = 0, narrowest = plot_.width;
  for (std::size_t n = 0; n < bands.labels.size(); ++n) {
    widest = std::max(widest, text_width(bands.labels[n], text_pt_) + 0.8 * text_pt_);
    narrowest = std::min(narrowest, x(bands.edges[n + 1]) - x(bands.edges[n]));
  }
  const auto every = std::size_t(std::max(1.0, std::ceil(widest / std::max(narrowest, 0.01))));
  const double line = plot_.y - 0.65 * text_pt_;  // clear of the labels of y
  for (std::size_t n = 0; n < bands.labels.size(); n += every) {
    const double from = std::max(x(bands.edges[n]), plot_.x);
    const double to = std::min(x(bands.edges[n + 1]), plot_.right()), middle = (from + to) / 2;
    const double half = text_width(bands.labels[n], text_pt_) / 2;
    if (to <= from || middle - half < plot_.x - 2 || middle + half > plot_.right() + edge_pt) continue;
    canvas.text({middle, line}, bands.labels[n], {.size_pt = text_pt_, .across = Across::middle});
  }
  canvas.text({plot_.x - tick_pt - pad_pt, line}, bands.name, {.size_pt = text_pt_, .across = Across::end});
}

void Panel::draw(Canvas& canvas) const {
  draw_bands(canvas);
  canvas.frame(plot_, {black, frame_pt});
  draw_axes(canvas);
  double line = room_.y + edge_pt;
  for (const auto& text : title_) {
    const double at = kept_inside(plot_.x + plot_.width / 2, text_width(text, title_pt(text_pt_), true),
                                  room_.x + edge_pt, room_.right() - edge_pt);
    canvas.text({at, line}, text,
                {.size_pt = title_pt(text_pt_), .bold = true, .across = Across::middle, .down = Down::top});
    line += line_height * title_pt(text_pt_);
  }
  if (spec_.bar) {
    const Rect bar{plot_.right() + bar_gap_part * text_pt_, plot_.y, bar_part * text_pt_, plot_.height};
    draw_colour_bar(canvas, *spec_.bar, bar_marks_, bar, text_pt_);
    const double lowest = plot_.bottom() + tick_pt + pad_pt + text_pt_;  // beside the labels of x
    const auto beside = shortened(bar_marks_.caption, lowest - highest_word_pt(), text_pt_);
    canvas.text(
        {bar.right() + tick_pt + 3 * pad_pt + bar_marks_.widest_pt,
         kept_inside(plot_.y + plot_.height / 2, text_width(beside, text_pt_), highest_word_pt(), lowest)},
        beside, {.size_pt = text_pt_, .across = Across::middle, .down = Down::top, .upwards = true});
  }
  if (legend_ && legend_right_)
    legend_->draw(canvas, {room_.right() - edge_pt - legend_->width(), plot_.y});
  else if (legend_)
    legend_->draw(canvas, {room_.x + (room_.width - legend_->width()) / 2,
                           room_.bottom() - edge_pt - legend_->height()});
}

}  // namespace slipwave::plot
