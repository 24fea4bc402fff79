// SPDX-License-Identifier: BSD-3-Clause
#include "plot/point_labels.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace slipwave::plot {
namespace {

constexpr int most_crossings = 1;  // more would make a text hard to read
constexpr double apart_pt = 1.5;   // of two texts
constexpr double far_pt = 10;      // from its point a text needs a line to it

/// Does the line from a to b pass through the rectangle? (Liang and Barsky: the part of it inside is not
/// empty.)
bool crosses(const Spot& a, const Spot& b, const Rect& rect) {
  double first = 0, last = 1;
  const auto cut = [&](double move, double room) {
    if (move == 0) return room >= 0;
    const double at = room / move;
    (move < 0 ? first : last) = move < 0 ? std::max(first, at) : std::min(last, at);
    return first <= last;
  };
  return cut(a.x - b.x, a.x - rect.x) && cut(b.x - a.x, rect.right() - a.x) && cut(a.y - b.y, a.y - rect.y) &&
         cut(b.y - a.y, rect.bottom() - a.y);
}

}  // namespace

void PointLabels::keep_clear(const Spot& point, double size_pt) {
  taken_.push_back({point.x - size_pt / 2, point.y - size_pt / 2, size_pt, size_pt});
}

bool PointLabels::free(const Rect& rect) const {
  if (rect.x < room_.x + 1 || rect.right() > room_.right() - 1 || rect.y < room_.y + 1 ||
      rect.bottom() > room_.bottom() - 1)
    return false;
  return std::none_of(taken_.begin(), taken_.end(), [&](const Rect& other) { return overlap(rect, other); });
}

int PointLabels::crossings(const Rect& rect) const {
  return int(std::count_if(lines_.begin(), lines_.end(),
                           [&](const Line& line) { return crosses(line.from, line.to, rect); }));
}

bool PointLabels::label(Canvas& canvas, const Spot& point, double size_pt, const std::string& text,
                        const Colour& colour) {
  const double width = text_width(text, text_pt_) + 1, height = text_pt_;
  std::optional<Rect> best;
  int fewest = most_crossings + 1;
  for (const double off : {size_pt / 2 + 1, size_pt / 2 + 4, size_pt / 2 + far_pt}) {
    const double right = point.x + off, left = point.x - off - width;
    const double above = point.y - off - height, below = point.y + off;
    const double middle_x = point.x - width / 2, middle_y = point.y - height / 2;
    for (const auto& place :
         {Spot{right, above + 2}, Spot{left, below - 2}, Spot{left, above + 2}, Spot{right, below - 2},
          Spot{middle_x, above}, Spot{middle_x, below}, Spot{right, middle_y}, Spot{left, middle_y}}) {
      const Rect rect{place.x, place.y, width, height};
      if (!free(rect)) continue;
      const int crossed = crossings(rect);
      if (crossed >= fewest) continue;
      best = rect;
      fewest = crossed;
    }
  }
  if (!best) return false;
  taken_.push_back({best->x - apart_pt, best->y - apart_pt, width + 2 * apart_pt, height + 2 * apart_pt});
  const Spot nearest{std::clamp(point.x, best->x, best->right()),
                     std::clamp(point.y, best->y, best->bottom())};
  const double distance = std::hypot(nearest.x - point.x, nearest.y - point.y);
  if (distance > size_pt / 2 + far_pt / 2) {
    const double begin = size_pt / 2 / distance;
    canvas.line({point.x + begin * (nearest.x - point.x), point.y + begin * (nearest.y - point.y)}, nearest,
                {colour, 0.4});
  }
  if (fewest > 0) canvas.fill(*best, white, 0.7);
  canvas.text({best->x + 0.5, best->y + height / 2}, text,
              {.size_pt = text_pt_, .colour = colour, .down = Down::middle});
  return true;
}

}  // namespace slipwave::plot
