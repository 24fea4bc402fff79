// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "plot/colour.hpp"
#include "plot/page.hpp"
#include "plot/place.hpp"

namespace slipwave::plot {

/// The alignment of a text to its spot: it begins, has its middle or ends there; likewise for up and down,
/// where `baseline` puts its line on the spot.
enum class Across { begin, middle, end };
enum class Down { top, middle, baseline, bottom };

struct TextStyle {
  double size_pt = 9;
  bool bold = false;
  Colour colour = black;
  Across across = Across::begin;
  Down down = Down::baseline;
  bool upwards = false;  // turned to run from the bottom to the top; across and down turn with it
};

struct Stroke {
  Colour colour = black;
  double width_pt = 0.6;
  std::vector<double> dashes_pt = {};
};

enum class Marker { circle, square, triangle, diamond, triangle_down, star };

/// Colours of width x height pixels, 0xAARRGGBB with the colours multiplied by the opacity; top row first.
struct Image {
  int width = 0, height = 0;
  std::vector<std::uint32_t> pixels;
  Image() = default;
  Image(int columns, int rows)
      : width(columns), height(rows), pixels(std::size_t(columns) * std::size_t(rows), 0) {}
  std::uint32_t& at(int column, int row) {
    return pixels[std::size_t(row) * std::size_t(width) + std::size_t(column)];
  }
};

/// Bytes that are no UTF-8, and control characters, as question marks: texts of files are drawn as far as
/// they can be.
std::string legible(const std::string& text);
/// Width of a text, made legible, in points.
double text_width(const std::string& text, double size_pt, bool bold = false);
/// Height of a line of text without what hangs below it, and with it, as parts of its size.
inline constexpr double cap_height = 0.73;
inline constexpr double line_height = 1.2;
/// `text`, shortened with "..." until it is at most `width_pt` wide.
std::string shortened(const std::string& text, double width_pt, double size_pt, bool bold = false);
/// Throws a usage Error unless `text` is UTF-8 without control characters.
void check_text(const std::string& text);

/// A page to draw on. The same calls give the same bytes.
class Canvas {
 public:
  /// White. Throws Error when there is no memory for it.
  explicit Canvas(const Page& page);
  ~Canvas();
  Canvas(const Canvas&) = delete;
  Canvas& operator=(const Canvas&) = delete;

  const Page& page() const { return page_; }

  void text(const Spot& at, const std::string& text, const TextStyle& style);
  void line(const Spot& from, const Spot& to, const Stroke& stroke);
  /// Joins the spots; a spot with NaN interrupts.
  void polyline(const std::vector<Spot>& spots, const Stroke& stroke);
  void polygon(const std::vector<Spot>& spots, const Colour& colour, double opacity = 1);
  void fill(const Rect& rect, const Colour& colour, double opacity = 1);
  void frame(const Rect& rect, const Stroke& stroke);
  /// `filled`: in that colour with a white rim, else white with a rim of that colour.
  void marker(const Spot& at, Marker shape, double size_pt, const Colour& colour, bool filled);
  void ring(const Spot& at, double radius_pt, const Stroke& stroke);
  /// Stretches the image over the rectangle, its pixels kept sharp.
  void image(const Image& image, const Rect& rect);
  /// What is drawn in `body` shows within the rectangle only.
  template <class Body>
  void within(const Rect& rect, Body&& body) {
    clip(rect);
    std::forward<Body>(body)();
    unclip();
  }

  /// Returns where the texts drawn so far stand: boxes as wide as their lines and as high as their capitals.
  const std::vector<Rect>& words() const { return words_; }

  /// The file. Once, at the end.
  std::vector<char> finish();

 private:
  struct Impl;
  void clip(const Rect& rect);
  void unclip();
  Page page_;
  std::vector<Rect> words_;
  std::unique_ptr<Impl> impl_;
};

}  // namespace slipwave::plot
