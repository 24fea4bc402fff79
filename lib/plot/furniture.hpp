// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "plot/axis.hpp"
#include "plot/canvas.hpp"
#include "plot/colour_map.hpp"

namespace slipwave::plot {

/// Which colours stand for which numbers: `axis.low` and `axis.high` are the ends of the map. An arrow points
/// where numbers lie beyond an end.
struct ColourBar {
  ColourMap map;
  Axis axis;
  bool below = false, above = false;

  /// Sets the arrows for numbers from `low` to `high`.
  void point_beyond(double low, double high);
  /// The part of the bar's rectangle that its arrows leave to the map.
  Rect body(const Rect& rect) const;
};

/// What a line, marker or area means.
struct LegendEntry {
  std::string text;
  Colour colour;
  std::optional<Stroke> line = {};
  std::optional<Marker> marker = {};
  bool filled = true;  // the marker
  bool patch = false;  // a small area of the colour,
  Colour to = {};      // which goes over to this one where it is `graded`
  bool graded = false;
  bool ring = false;  // round what is chosen
};

/// Height to add to a page whose size is free, so that a long legend does not press the data together.
double extra_height_pt(std::size_t legend_entries);

/// The legend of a panel in rows and columns, shortened where one entry is wider than the room.
class Legend {
 public:
  Legend(std::vector<LegendEntry> entries, double room_width_pt, double text_pt);
  double width() const { return double(columns_) * column_width_; }
  double height() const;
  void draw(Canvas& canvas, const Spot& top_left) const;
  /// Width of the widest entry.
  static double widest(const std::vector<LegendEntry>& entries, double text_pt);

 private:
  std::vector<LegendEntry> entries_;
  double text_pt_, column_width_ = 0;
  std::size_t columns_ = 1, rows_ = 0;
};

/// Draws the bar and its arrows into `rect`, ticks and labels to the right of it.
void draw_colour_bar(Canvas& canvas, const ColourBar& bar, const AxisMarks& marks, const Rect& rect,
                     double text_pt);

/// Draws the title above several panels and gives the height it takes.
double draw_title(Canvas& canvas, const std::string& title);

/// Sizes that panels share, in parts of the text or points.
inline constexpr double tick_pt = 3, minor_tick_pt = 1.7, frame_pt = 0.7, pad_pt = 2.5;

}  // namespace slipwave::plot
