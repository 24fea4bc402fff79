// SPDX-License-Identifier: BSD-3-Clause
#include "plot/typeface.hpp"

#include <sys/mman.h>

#include <pango/pangocairo.h>

#include <algorithm>
#include <atomic>
#include <memory>
#include <new>
#include <string>

#include "base/error.hpp"
#include "base/utf8.hpp"
#include "plot/canvas.hpp"

namespace slipwave::plot {
namespace {

struct Release {
  void operator()(cairo_font_options_t* options) const { cairo_font_options_destroy(options); }
  void operator()(PangoFontDescription* typeface) const { pango_font_description_free(typeface); }
  void operator()(PangoContext* context) const { g_object_unref(context); }
  void operator()(PangoLayout* layout) const { g_object_unref(layout); }
};
template <class Thing>
using Owned = std::unique_ptr<Thing, Release>;

/// The text as one line of shaped glyphs.
Owned<PangoLayout> layout_of(const std::string& text, double size_pt, bool bold) {
  expect_room();
  const Owned<PangoContext> context(pango_font_map_create_context(pango_cairo_font_map_get_default()));
  const Owned<cairo_font_options_t> options(cairo_font_options_create());
  cairo_font_options_set_antialias(options.get(), CAIRO_ANTIALIAS_GRAY);
  cairo_font_options_set_hint_style(options.get(), CAIRO_HINT_STYLE_NONE);
  cairo_font_options_set_hint_metrics(options.get(), CAIRO_HINT_METRICS_OFF);
  pango_cairo_context_set_font_options(context.get(), options.get());
  pango_context_set_round_glyph_positions(context.get(), FALSE);
  const Owned<PangoFontDescription> typeface(pango_font_description_new());
  pango_font_description_set_family_static(typeface.get(), typeface_name);
  pango_font_description_set_weight(typeface.get(), bold ? PANGO_WEIGHT_BOLD : PANGO_WEIGHT_NORMAL);
  pango_font_description_set_absolute_size(typeface.get(), size_pt * PANGO_SCALE);
  Owned<PangoLayout> layout(pango_layout_new(context.get()));
  pango_layout_set_font_description(layout.get(), typeface.get());
  pango_layout_set_single_paragraph_mode(layout.get(), TRUE);
  const std::string line = legible(text);
  pango_layout_set_text(layout.get(), line.data(), int(line.size()));
  return layout;
}

}  // namespace

void expect_room() {
  // Typefaces take some 36 MiB of addresses; three threads that look for them (for bold ones and for those of
  // other scripts later on, too) a stack of 8 MiB each, and the C library 128 MiB for the heap of each, half
  // of which it gives back.
  constexpr std::size_t room = std::size_t(36 + 3 * (8 + 128)) << 20;
  // Where it was before, if that is free: emulators of processors keep tables of all addresses they ever
  // gave.
  static std::atomic<void*> before = nullptr;
  void* const addresses = mmap(before, room, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  if (addresses == MAP_FAILED) throw std::bad_alloc();
  munmap(addresses, room);
  before = addresses;
}

void draw_text(_cairo* drawing, const std::string& text, double size_pt, bool bold) {
  const auto layout = layout_of(text, size_pt, bold);
  pango_cairo_show_layout_line(drawing, pango_layout_get_line_readonly(layout.get(), 0));
}

double text_width(const std::string& text, double size_pt, bool bold) {
  int width = 0;
  pango_layout_get_size(layout_of(text, size_pt, bold).get(), &width, nullptr);
  return double(width) / PANGO_SCALE;
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
