// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "plot/furniture.hpp"

namespace slipwave::plot {

/// Groups of neighbours along x, separated by lines through the data and named above them.
struct Bands {
  std::string name;                 // of what they are, "shot"
  std::vector<double> edges;        // ascending, one more than there are bands
  std::vector<std::string> labels;  // of the bands; those that find room
  std::vector<double> minor;        // further lines, fainter
};

/// What a panel shows round its data.
struct PanelSpec {
  std::string title;
  Axis x, y;
  std::optional<ColourBar> bar = {};
  std::vector<LegendEntry> legend = {};
  double least_left_pt = 0, least_right_pt = 0;  // beside the data, to align panels above each other
  double least_top_pt = 0;                       // above them, likewise
  Bands bands = {};
};

/// A rectangle of data with axes, title, colour bar and legend round it, laid out so that everything stands
/// inside its room and nothing on something else.
class Panel {
 public:
  /// Throws a usage Error when the room leaves less than 8 mm for the data.
  Panel(const PanelSpec& spec, const Rect& room, const Page& page);

  /// Gives the page the size at which the data's rectangle has `height_per_width`: the page's own width, less
  /// where the rectangle would be higher than 11 cm; lower than 2.4 cm it never is, whatever its shape should
  /// be.
  static void fit_page(Page& page, const PanelSpec& spec, double height_per_width);

  /// Returns the rectangle that the data go into; its edges lie between pixels.
  const Rect& plot() const { return plot_; }
  double x(double value) const { return x_scale_.place(value); }
  double y(double value) const { return y_scale_.place(value); }
  const Scale& x_scale() const { return x_scale_; }
  const Scale& y_scale() const { return y_scale_; }
  const AxisMarks& x_marks() const { return x_marks_; }
  const AxisMarks& y_marks() const { return y_marks_; }

  /// Thin lines at the labelled values, for what is read off lines. Before the data.
  void draw_grid(Canvas& canvas) const;
  /// Frame, ticks, words, colour bar and legend. After the data.
  void draw(Canvas& canvas) const;

 private:
  struct Margins {
    double left = 0, right = 0, top = 0, bottom = 0;
  };
  void lay_out(const Rect& room);
  Margins margins() const;
  double highest_word_pt() const;
  std::vector<std::string> title_lines(double width_pt) const;
  bool legend_right(const Rect& room) const;
  void draw_axes(Canvas& canvas) const;
  void draw_bands(Canvas& canvas) const;

  PanelSpec spec_;
  Rect room_;
  double text_pt_, scale_;
  Rect plot_;
  Scale x_scale_, y_scale_;
  AxisMarks x_marks_, y_marks_, bar_marks_;
  std::vector<std::string> title_;
  std::optional<Legend> legend_;
  bool legend_right_ = false;
};

}  // namespace slipwave::plot
