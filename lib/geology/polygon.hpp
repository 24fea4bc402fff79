// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <vector>

#include "grid/grid.hpp"

/// Closed polygons, by their vertices.
namespace slipwave {

/// Leaves of a polygon what lies beyond a place on an axis, or before it (Sutherland & Hodgman 1974); where
/// it falls apart, edges lie on that side forth and back. `room` is for the vertices.
template <std::size_t N>
void cut(std::vector<std::array<double, N>>& polygon, std::vector<std::array<double, N>>& room,
         std::size_t axis, double limit, bool beyond) {
  const double sign = beyond ? 1 : -1;
  room.clear();
  for (std::size_t i = 0, j = polygon.size() - 1; i < polygon.size(); j = i++) {
    const auto &from = polygon[j], &to = polygon[i];
    const double before = sign * (from[axis] - limit), after = sign * (to[axis] - limit);
    if ((before < 0) != (after < 0)) {
      const double way = before / (before - after);
      auto crossing = from;
      for (std::size_t k = 0; k < N; ++k) crossing[k] += way * (to[k] - from[k]);
      crossing[axis] = limit;
      room.push_back(crossing);
    }
    if (after >= 0) room.push_back(to);
  }
  polygon.swap(room);
}

/// Area, positive where vertices turn from the first axis to the second, and the middle of it.
struct PolygonArea {
  double area = 0;
  Point<2> middle{};
};
PolygonArea area_and_middle(const std::vector<Point<2>>& polygon);

/// Whether edges cross.
bool crosses_itself(const std::vector<Point<2>>& polygon);

}  // namespace slipwave
