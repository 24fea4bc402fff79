// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "plot/canvas.hpp"

namespace slipwave::plot {

/// Finds free places for short texts beside points: clear of points, of each other and of the edges, and off
/// the lines where that is possible. A text without a free place is left out.
class PointLabels {
 public:
  PointLabels(const Rect& room, double text_pt) : room_(room), text_pt_(text_pt) {}
  /// Nothing is put here, or better not across here. Before label().
  void keep_clear(const Spot& point, double size_pt);
  void keep_off(const Spot& from, const Spot& to) { lines_.push_back({from, to}); }
  /// Draws `text` near a point of that size; says whether there was a place.
  bool label(Canvas& canvas, const Spot& point, double size_pt, const std::string& text,
             const Colour& colour);

 private:
  struct Line {
    Spot from, to;
  };
  bool free(const Rect& rect) const;
  int crossings(const Rect& rect) const;

  Rect room_;
  double text_pt_;
  std::vector<Rect> taken_;
  std::vector<Line> lines_;
};

}  // namespace slipwave::plot
