// SPDX-License-Identifier: BSD-3-Clause
#include "plot/typeface.hpp"

#include <cairo/cairo.h>

#include <algorithm>
#include <memory>
#include <string>

#include "base/error.hpp"
#include "base/utf8.hpp"
#include "plot/canvas.hpp"

namespace slipwave::plot {
namespace {

struct Destroy {
  void operator()(cairo_surface_t* surface) const { cairo_surface_destroy(surface); }
  void operator()(cairo_t* context) const { cairo_destroy(context); }
  void operator()(cairo_font_options_t* options) const { cairo_font_options_destroy(options); }
};

}  // namespace

void use_typeface(_cairo* drawing, double size_pt, bool bold) {
  cairo_select_font_face(drawing, "DejaVu Sans", CAIRO_FONT_SLANT_NORMAL,
                         bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
  cairo_set_font_size(drawing, size_pt);
  const std::unique_ptr<cairo_font_options_t, Destroy> options(cairo_font_options_create());
  cairo_font_options_set_antialias(options.get(), CAIRO_ANTIALIAS_GRAY);
  cairo_font_options_set_hint_style(options.get(), CAIRO_HINT_STYLE_NONE);
  cairo_font_options_set_hint_metrics(options.get(), CAIRO_HINT_METRICS_OFF);
  cairo_set_font_options(drawing, options.get());
}

double text_width(const std::string& text, double size_pt, bool bold) {
  const std::unique_ptr<cairo_surface_t, Destroy> surface(cairo_image_surface_create(CAIRO_FORMAT_A8, 1, 1));
  const std::unique_ptr<cairo_t, Destroy> drawing(cairo_create(surface.get()));
  use_typeface(drawing.get(), size_pt, bold);
  cairo_text_extents_t extents{};
  cairo_text_extents(drawing.get(), legible(text).c_str(), &extents);
  return extents.x_advance;
}

std::string shortened(const std::string& text, double width_pt, double size_pt, bool bold) {
  if (text_width(text, size_pt, bold) <= width_pt) return text;
  std::string best = text_width("\u2026", size_pt, bold) <= width_pt ? "\u2026" : "";
  for (std::size_t at = 0; at < text.size();) {
    at += std::max<std::size_t>(1, utf8_length(text, at));
    const std::string candidate = text.substr(0, at) + "\u2026";
    if (text_width(candidate, size_pt, bold) > width_pt) break;
    best = candidate;
  }
  return best;
}

std::string legible(const std::string& text) {
  std::string result;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t length = utf8_length(text, at);
    const auto first = static_cast<unsigned char>(text[at]);
    if (length == 0 || first < 0x20 || first == 0x7f)
      result += '?';
    else
      result += text.substr(at, length);
    at += std::max<std::size_t>(1, length);
  }
  return result;
}

void check_text(const std::string& text) {
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t length = utf8_length(text, at);
    const auto first = static_cast<unsigned char>(text[at]);
    if (length == 0 || first < 0x20 || first == 0x7f)
      throw Error("found byte " + std::to_string(int(first)) + " at place " + std::to_string(at + 1) +
                      ", expected UTF-8 text of one line",
                  ErrorKind::usage);
    at += length;
  }
}

}  // namespace slipwave::plot
