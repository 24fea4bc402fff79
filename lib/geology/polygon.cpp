// SPDX-License-Identifier: BSD-3-Clause
#include "geology/polygon.hpp"

namespace slipwave {
namespace {

bool part_on_sides(const Point<2>& a, const Point<2>& b, const Point<2>& c, const Point<2>& d) {
  const auto side = [](const Point<2>& p, const Point<2>& q, const Point<2>& r) {
    return (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0]);
  };
  return side(a, b, c) * side(a, b, d) < 0 && side(c, d, a) * side(c, d, b) < 0;
}

}  // namespace

PolygonArea area_and_middle(const std::vector<Point<2>>& polygon) {
  PolygonArea of;
  if (polygon.empty()) return of;
  const auto& origin = polygon.front();  // so that little is lost in rounding
  double twice = 0;
  for (std::size_t i = 0, j = polygon.size() - 1; i < polygon.size(); j = i++) {
    const Point<2> a = {polygon[j][0] - origin[0], polygon[j][1] - origin[1]},
                   b = {polygon[i][0] - origin[0], polygon[i][1] - origin[1]};
    const double part = a[0] * b[1] - b[0] * a[1];
    twice += part;
    for (const std::size_t k : {0, 1}) of.middle[k] += part * (a[k] + b[k]) / 3;
  }
  of.area = twice / 2;
  for (const std::size_t k : {0, 1}) of.middle[k] = origin[k] + (twice != 0 ? of.middle[k] / twice : 0);
  return of;
}

bool crosses_itself(const std::vector<Point<2>>& polygon) {
  const auto n = polygon.size();
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = i + 2; j < n; ++j)
      if (part_on_sides(polygon[i], polygon[i + 1], polygon[j], polygon[(j + 1) % n])) return true;
  return false;
}

}  // namespace slipwave
