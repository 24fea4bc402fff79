// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace slipwave::plot {

/// Lengths on the page are in points, y down.
struct Spot {
  double x = 0, y = 0;
};
struct Rect {
  double x = 0, y = 0, width = 0, height = 0;
  double right() const { return x + width; }
  double bottom() const { return y + height; }
};

/// Do they share more than an edge?
constexpr bool overlap(const Rect& a, const Rect& b) {
  return a.x < b.x + b.width && b.x < a.x + a.width && a.y < b.y + b.height && b.y < a.y + a.height;
}

}  // namespace slipwave::plot
