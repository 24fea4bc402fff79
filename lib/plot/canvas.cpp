// SPDX-License-Identifier: BSD-3-Clause
#include "plot/canvas.hpp"

#include <cairo/cairo-pdf.h>
#include <cairo/cairo-svg.h>
#include <cairo/cairo.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <new>
#include <numbers>
#include <string_view>

#include "base/error.hpp"
#include "plot/provenance.hpp"
#include "plot/typeface.hpp"

namespace slipwave::plot {
namespace {

struct Destroy {
  void operator()(cairo_surface_t* surface) const { cairo_surface_destroy(surface); }
  void operator()(cairo_t* context) const { cairo_destroy(context); }
  void operator()(cairo_pattern_t* pattern) const { cairo_pattern_destroy(pattern); }
};
using Surface = std::unique_ptr<cairo_surface_t, Destroy>;
using Drawing = std::unique_ptr<cairo_t, Destroy>;
using Pattern = std::unique_ptr<cairo_pattern_t, Destroy>;

void check(cairo_status_t status) {
  if (status != CAIRO_STATUS_SUCCESS)
    throw Error(std::string("the picture could not be drawn: ") + cairo_status_to_string(status));
}

cairo_status_t append(void* to, const unsigned char* bytes, unsigned int count) {
  try {
    auto& all = *static_cast<std::vector<char>*>(to);
    all.insert(all.end(), bytes, bytes + count);
    return CAIRO_STATUS_SUCCESS;
  } catch (const std::bad_alloc&) {  // cairo is C: nothing may fly through it
    return CAIRO_STATUS_NO_MEMORY;
  }
}

Surface surface_of(const Page& page, std::vector<char>& bytes) {
  expect_room();
  if (page.format == Format::png)
    return Surface(cairo_image_surface_create(CAIRO_FORMAT_RGB24,
                                              int(std::lround(page.width_pt * page.scale())),
                                              int(std::lround(page.height_pt * page.scale()))));
  if (page.format == Format::svg)
    return Surface(cairo_svg_surface_create_for_stream(append, &bytes, page.width_pt, page.height_pt));
  Surface surface(cairo_pdf_surface_create_for_stream(append, &bytes, page.width_pt, page.height_pt));
  // An empty date is left out of the file; without this line it holds the time of the run.
  cairo_pdf_surface_set_metadata(surface.get(), CAIRO_PDF_METADATA_CREATE_DATE, "");
  cairo_pdf_surface_set_metadata(surface.get(), CAIRO_PDF_METADATA_CREATOR, "slipwave");
  if (!page.title.empty())
    cairo_pdf_surface_set_metadata(surface.get(), CAIRO_PDF_METADATA_TITLE, page.title.c_str());
  if (!page.history.empty())
    cairo_pdf_surface_set_metadata(surface.get(), CAIRO_PDF_METADATA_SUBJECT, page.history.c_str());
  return surface;
}

void set_colour(cairo_t* to, const Colour& colour, double opacity = 1) {
  cairo_set_source_rgba(to, colour.red, colour.green, colour.blue, opacity);
}

void trace(cairo_t* to, const std::vector<Spot>& spots) {
  bool pen_down = false;
  for (const auto& spot : spots) {
    const bool there = std::isfinite(spot.x) && std::isfinite(spot.y);
    if (there) pen_down ? cairo_line_to(to, spot.x, spot.y) : cairo_move_to(to, spot.x, spot.y);
    pen_down = there;
  }
}

/// An element of SVG: a line of text that programs find and change as such, which cairo draws as outlines.
/// The typeface's next of kin stand in where it is not installed.
std::string svg_text(const Spot& at, double y, const std::string& text, const TextStyle& style) {
  const char* anchors[] = {"start", "middle", "end"};
  const auto byte = [](double part) { return int(std::lround(255 * part)); };
  char attributes[400];
  std::snprintf(attributes, sizeof attributes,
                "<text transform=\"translate(%.3f,%.3f)%s\" y=\"%.3f\" text-anchor=\"%s\" "
                "font-family=\"%s, Verdana, sans-serif\" font-size=\"%.3f\"%s fill=\"#%02x%02x%02x\">",
                at.x, at.y, style.upwards ? " rotate(-90)" : "", y, anchors[int(style.across)], typeface_name,
                style.size_pt, style.bold ? " font-weight=\"bold\"" : "", byte(style.colour.red),
                byte(style.colour.green), byte(style.colour.blue));
  return attributes + xml_text(legible(text)) + "</text>\n";
}

/// Returns the outline of a marker; all shapes are of equal area to the eye: a corner stands farther out than
/// a round edge.
std::vector<Spot> outline(Marker shape, double size) {
  const double radius = size * (shape == Marker::circle ? 0.88 : 1.1);
  constexpr double pi = std::numbers::pi;
  const auto corners = [&](int count, double first_rad, double inner) {
    std::vector<Spot> spots;
    for (int n = 0; n < count; ++n) {
      const double angle = first_rad + 2 * pi * n / count, r = n % 2 ? inner * radius : radius;
      spots.push_back({r * std::cos(angle), r * std::sin(angle)});
    }
    return spots;
  };
  switch (shape) {
    case Marker::square:
      return corners(4, pi / 4, 1);
    case Marker::diamond:
      return corners(4, 0, 1);
    case Marker::triangle:
      return corners(3, -pi / 2, 1);
    case Marker::triangle_down:
      return corners(3, pi / 2, 1);
    case Marker::star:
      return corners(10, -pi / 2, 0.45);
    case Marker::circle:
      break;
  }
  return corners(24, 0, 1);
}

}  // namespace

struct Canvas::Impl {
  std::vector<char> bytes;  // outlives the surface, which writes its end here
  Surface surface;
  Drawing drawing;
  std::string svg_texts;
};

Canvas::Canvas(const Page& page) : page_(page), impl_(std::make_unique<Impl>()) {
  check_size(page);
  impl_->surface = surface_of(page, impl_->bytes);
  check(cairo_surface_status(impl_->surface.get()));
  impl_->drawing.reset(cairo_create(impl_->surface.get()));
  if (page.format == Format::png) cairo_scale(impl_->drawing.get(), page.scale(), page.scale());
  set_colour(impl_->drawing.get(), white);
  cairo_paint(impl_->drawing.get());
}

Canvas::~Canvas() = default;

void Canvas::text(const Spot& at, const std::string& text, const TextStyle& style) {
  if (text.empty()) return;
  const double width = text_width(text, style.size_pt, style.bold);
  double x = 0, y = 0;
  if (style.across != Across::begin) x = style.across == Across::middle ? -width / 2 : -width;
  if (style.down == Down::top) y = cap_height * style.size_pt;
  if (style.down == Down::middle) y = cap_height * style.size_pt / 2;
  if (style.down == Down::bottom) y = -(line_height - 0.95) * style.size_pt;
  const double top = y - cap_height * style.size_pt, high = cap_height * style.size_pt;
  words_.push_back(style.upwards ? Rect{at.x + top, at.y - x - width, high, width}
                                 : Rect{at.x + x, at.y + top, width, high});
  if (page_.format == Format::svg) {
    impl_->svg_texts += svg_text(at, y, text, style);
    return;
  }
  cairo_t* to = impl_->drawing.get();
  cairo_save(to);
  set_colour(to, style.colour);
  cairo_translate(to, at.x, at.y);
  if (style.upwards) cairo_rotate(to, -std::numbers::pi / 2);
  cairo_move_to(to, x, y);
  draw_text(to, text, style.size_pt, style.bold);
  cairo_restore(to);
}

void Canvas::polyline(const std::vector<Spot>& spots, const Stroke& stroke) {
  cairo_t* to = impl_->drawing.get();
  cairo_new_path(to);
  trace(to, spots);
  set_colour(to, stroke.colour);
  cairo_set_line_width(to, stroke.width_pt);
  cairo_set_line_join(to, CAIRO_LINE_JOIN_ROUND);
  cairo_set_dash(to, stroke.dashes_pt.data(), int(stroke.dashes_pt.size()), 0);
  cairo_stroke(to);
}

void Canvas::line(const Spot& from, const Spot& end, const Stroke& stroke) { polyline({from, end}, stroke); }

void Canvas::polygon(const std::vector<Spot>& spots, const Colour& colour, double opacity) {
  cairo_t* to = impl_->drawing.get();
  cairo_new_path(to);
  trace(to, spots);
  cairo_close_path(to);
  set_colour(to, colour, opacity);
  cairo_fill(to);
}

void Canvas::fill(const Rect& rect, const Colour& colour, double opacity) {
  cairo_t* to = impl_->drawing.get();
  cairo_rectangle(to, rect.x, rect.y, rect.width, rect.height);
  set_colour(to, colour, opacity);
  cairo_fill(to);
}

void Canvas::frame(const Rect& rect, const Stroke& stroke) {
  cairo_t* to = impl_->drawing.get();
  cairo_rectangle(to, rect.x, rect.y, rect.width, rect.height);
  set_colour(to, stroke.colour);
  cairo_set_line_width(to, stroke.width_pt);
  cairo_set_line_join(to, CAIRO_LINE_JOIN_MITER);
  cairo_set_dash(to, stroke.dashes_pt.data(), int(stroke.dashes_pt.size()), 0);
  cairo_stroke(to);
}

void Canvas::marker(const Spot& at, Marker shape, double size_pt, const Colour& colour, bool filled) {
  auto spots = outline(shape, size_pt / 2);
  for (auto& spot : spots) spot = {spot.x + at.x, spot.y + at.y};
  polygon(spots, filled ? colour : white);
  spots.push_back(spots.front());
  polyline(spots, {filled ? white : colour, filled ? 0.4 : 0.9});
}

void Canvas::ring(const Spot& at, double radius_pt, const Stroke& stroke) {
  cairo_t* to = impl_->drawing.get();
  cairo_new_path(to);
  cairo_arc(to, at.x, at.y, radius_pt, 0, 2 * std::numbers::pi);
  set_colour(to, stroke.colour);
  cairo_set_line_width(to, stroke.width_pt);
  cairo_set_dash(to, nullptr, 0, 0);
  cairo_stroke(to);
}

void Canvas::image(const Image& image, const Rect& rect) {
  if (image.pixels.empty()) return;
  const Surface surface(cairo_image_surface_create(CAIRO_FORMAT_ARGB32, image.width, image.height));
  check(cairo_surface_status(surface.get()));
  cairo_surface_flush(surface.get());
  const auto stride = std::size_t(cairo_image_surface_get_stride(surface.get()));
  const auto width = std::size_t(image.width);
  for (std::size_t row = 0; row < std::size_t(image.height); ++row) {
    std::memcpy(cairo_image_surface_get_data(surface.get()) + row * stride, image.pixels.data() + row * width,
                width * 4);
  }
  cairo_surface_mark_dirty(surface.get());
  cairo_t* to = impl_->drawing.get();
  cairo_save(to);
  cairo_translate(to, rect.x, rect.y);
  cairo_scale(to, rect.width / image.width, rect.height / image.height);
  const Pattern pattern(cairo_pattern_create_for_surface(surface.get()));
  cairo_pattern_set_filter(pattern.get(), CAIRO_FILTER_NEAREST);
  cairo_pattern_set_extend(pattern.get(), CAIRO_EXTEND_NONE);
  cairo_set_source(to, pattern.get());
  cairo_paint(to);
  cairo_restore(to);
}

void Canvas::clip(const Rect& rect) {
  cairo_save(impl_->drawing.get());
  cairo_rectangle(impl_->drawing.get(), rect.x, rect.y, rect.width, rect.height);
  cairo_clip(impl_->drawing.get());
}

void Canvas::unclip() { cairo_restore(impl_->drawing.get()); }

std::vector<char> Canvas::finish() {
  check(cairo_status(impl_->drawing.get()));
  impl_->drawing.reset();
  if (page_.format == Format::png)
    check(cairo_surface_write_to_png_stream(impl_->surface.get(), append, &impl_->bytes));
  cairo_surface_finish(impl_->surface.get());
  check(cairo_surface_status(impl_->surface.get()));
  impl_->surface.reset();
  if (page_.format == Format::svg) {
    constexpr std::string_view closing = "</svg>";
    auto& bytes = impl_->bytes;
    const auto end = std::find_end(bytes.begin(), bytes.end(), closing.begin(), closing.end());
    bytes.insert(end, impl_->svg_texts.begin(), impl_->svg_texts.end());
  }
  return with_provenance(std::move(impl_->bytes), page_);
}

}  // namespace slipwave::plot
