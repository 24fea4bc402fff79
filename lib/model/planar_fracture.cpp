// SPDX-License-Identifier: BSD-3-Clause
#include "model/planar_fracture.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/error.hpp"
#include "geology/frame.hpp"
#include "geology/polygon.hpp"
#include "grid/slice.hpp"
#include "model/fracture.hpp"
#include "model/spline_shares.hpp"

namespace slipwave {
namespace {

/// Corners of a disc: a multiple of four, so that those that lie along axes are alike.
constexpr int corners_of_disc = 32;
/// Pieces that a polygon is cut into, per cell and direction.
constexpr double pieces_a_cell = 8;

Point<3> difference(const Point<3>& a, const Point<3>& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
double product(const Point<3>& a, const Point<3>& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/// Along the normal, as long as the area (Newell's sum).
Point<3> area_vector(const FractureTrace<3>& polygon) {
  Point<3> sum{};
  for (std::size_t n = 2; n < polygon.size(); ++n) {
    const auto twice =
        cross_product(difference(polygon[n - 1], polygon[0]), difference(polygon[n], polygon[0]));
    for (std::size_t axis = 0; axis < 3; ++axis) sum[axis] += twice[axis] / 2;
  }
  return sum;
}

/// From where to where it reaches on an axis.
std::array<double, 2> reach_of(const std::vector<Point<2>>& points, std::size_t axis) {
  const auto [low, high] = std::minmax_element(
      points.begin(), points.end(), [&](const auto& a, const auto& b) { return a[axis] < b[axis]; });
  return {(*low)[axis], (*high)[axis]};
}

/// The first edge that is not much shorter than the longest: its direction is not one of rounding.
Point<3> leading_edge(const FractureTrace<3>& polygon) {
  std::vector<Point<3>> edges;
  double longest = 0;
  for (std::size_t n = 0; n < polygon.size(); ++n) {
    edges.push_back(difference(polygon[(n + 1) % polygon.size()], polygon[n]));
    longest = std::max(longest, length<3, double>(edges.back()));
  }
  return *std::find_if(edges.begin(), edges.end(),
                       [&](const auto& edge) { return length<3, double>(edge) >= longest / 2; });
}

/// A polygon in its plane: along an edge, and across it.
struct Flat {
  Point<3> origin{}, along{}, across{};
  std::vector<Point<2>> corners;

  explicit Flat(const FractureTrace<3>& polygon) {
    const auto normal = normal_of_polygon(polygon);
    for (const auto& vertex : polygon)
      for (std::size_t axis = 0; axis < 3; ++axis) origin[axis] += vertex[axis] / double(polygon.size());
    auto edge = leading_edge(polygon);
    const double off = product(edge, normal);
    for (std::size_t axis = 0; axis < 3; ++axis) edge[axis] -= off * normal[axis];
    along = unit_normal<3>(edge), across = cross_product(normal, along);
    for (const auto& vertex : polygon) {
      const auto from_middle = difference(vertex, origin);
      corners.push_back({product(from_middle, along), product(from_middle, across)});
    }
  }
  /// What lies below a box of space, seen along the normal.
  Box<2> under(const Box<3>& box) const {
    std::vector<Point<2>> seen;
    for (std::size_t corner = 0; corner < 8; ++corner) {
      Point<3> at{};
      for (std::size_t axis = 0; axis < 3; ++axis)
        at[axis] = (corner >> axis & 1 ? box.high_m : box.low_m)[axis] - origin[axis];
      seen.push_back({product(at, along), product(at, across)});
    }
    const auto [from, to] = reach_of(seen, 0);
    const auto [bottom, top] = reach_of(seen, 1);
    return {{from, bottom}, {to, top}};
  }
  Point<3> in_3d(const Point<2>& at) const {
    Point<3> point = origin;
    for (std::size_t axis = 0; axis < 3; ++axis) point[axis] += at[0] * along[axis] + at[1] * across[axis];
    return point;
  }
};

/// Calls with(piece) for the pieces that squares of a side cut a polygon into, of squares that reach into a
/// box. Which squares there are does not depend on the box.
template <class With>
void each_piece(const std::vector<Point<2>>& polygon, double side, const Box<2>& box, const With& with) {
  const auto [bottom, top] = reach_of(polygon, 1);
  std::vector<Point<2>> strip, square, room;
  for (double row = std::floor(std::max(bottom, box.low_m[1]) / side);
       row * side < std::min(top, box.high_m[1]); ++row) {
    strip = polygon;
    cut(strip, room, 1, row * side, true);
    if (!strip.empty()) cut(strip, room, 1, (row + 1) * side, false);
    if (strip.empty()) continue;
    const auto [from, to] = reach_of(strip, 0);
    for (double column = std::floor(std::max(from, box.low_m[0]) / side);
         column * side < std::min(to, box.high_m[0]); ++column) {
      square = strip;
      cut(square, room, 0, column * side, true);
      if (!square.empty()) cut(square, room, 0, (column + 1) * side, false);
      const auto piece = area_and_middle(square);
      if (piece.area > 0) with(piece);
    }
  }
}

/// "X,Y,Z:SIZES[:DIP[:AZIMUTH]]".
Frame<3> parse_plane(const std::string& text, std::size_t sizes, const std::string& expected) {
  const auto parts = split(text, ':');
  if (parts.size() < 2 || parts.size() > 4)
    throw Error("found '" + text + "', expected " + expected, ErrorKind::usage);
  return in_place('\'' + text + "'", [&] {
    const auto centre = parse_point<3>(parts[0]);
    const auto given = parse_numbers(parts[1], ',');
    if (given.size() != sizes ||
        !std::all_of(given.begin(), given.end(), [](double size) { return size > 0; }))
      throw Error("found '" + std::string(parts[1]) + "', expected " +
                      (sizes == 1 ? "a radius" : "a length and a width") + " above zero",
                  ErrorKind::usage);
    const double dip_deg = parts.size() > 2 ? parse_number(parts[2]) : 0,
                 azimuth_deg = parts.size() > 3 ? parse_number(parts[3]) : 0;
    normal_of_dip(dip_deg, azimuth_deg);  // refuses a dip that is none
    return Frame<3>(centre, {given.front(), given.back(), 0}, dip_deg, azimuth_deg);
  });
}

FractureTrace<3> disc_in(const Point<3>& centre, const Point<3>& along, const Point<3>& across,
                         double radius) {
  const double corner = 2 * std::numbers::pi / corners_of_disc,
               reach = radius * std::sqrt(corner / std::sin(corner));
  FractureTrace<3> disc;
  for (int n = 0; n < corners_of_disc; ++n) {
    const double c = reach * std::cos(n * corner), s = reach * std::sin(n * corner);
    auto& vertex = disc.emplace_back(centre);
    for (std::size_t axis = 0; axis < 3; ++axis) vertex[axis] += c * along[axis] + s * across[axis];
  }
  return disc;
}

}  // namespace

Point<3> cross_product(const Point<3>& a, const Point<3>& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

FractureTrace<3> parse_disc(const std::string& text) {
  const auto of = parse_plane(text, 1, "a disc X,Y,Z:RADIUS[:DIP[:AZIMUTH]]");
  return disc_in(of.centre, of.axes[0], of.axes[1], of.size_m[0]);
}

FractureTrace<3> parse_rectangle(const std::string& text) {
  const auto of = parse_plane(text, 2, "a rectangle X,Y,Z:LENGTH,WIDTH[:DIP[:AZIMUTH]]");
  const auto corners = of.corners();
  return {corners.begin(), corners.end()};
}

FractureTrace<3> disc_of(const Point<3>& centre_m, double radius_m, const Point<3>& normal) {
  const double level = std::hypot(normal[0], normal[1]);
  const Point<3> across = level > 0 ? Point<3>{-normal[1] / level, normal[0] / level, 0} : Point<3>{0, 1, 0};
  return disc_in(centre_m, cross_product(across, normal), across, radius_m);
}

Point<3> normal_of_polygon(const FractureTrace<3>& polygon) { return unit_normal<3>(area_vector(polygon)); }

double area_of(const FractureTrace<3>& polygon) { return length<3, double>(area_vector(polygon)); }

std::string fault_of_polygon(const FractureTrace<3>& polygon) {
  if (polygon.size() < 3)
    return "found a fracture of " + std::to_string(polygon.size()) + " points, expected at least 3";
  double largest = 0;
  for (const auto& vertex : polygon) {
    // Farther away than any model reaches.
    for (const double part : vertex)
      if (!(std::abs(part) <= 1e9)) return "found a fracture without end, expected points within 1e9 m";
    largest = std::max(largest, length<3, double>(difference(vertex, polygon.front())));
  }
  if (!(area_of(polygon) > 1e-9 * largest * largest))
    return "found a fracture without area, expected points that span one";
  const auto normal = normal_of_polygon(polygon);
  for (const auto& vertex : polygon)
    if (const double off = std::abs(product(difference(vertex, polygon.front()), normal));
        off > 1e-3 * largest)
      return "found a fracture that bends, by " + shown(off, 3) + " m at " + shown(vertex[0]) + "," +
             shown(vertex[1]) + "," + shown(vertex[2]) + ", expected points in one plane";
  for (std::size_t n = 0; n < polygon.size(); ++n)
    if (polygon[n] == polygon[(n + 1) % polygon.size()])
      return "found a point of a fracture twice in a row, expected each once: outlines close by themselves";
  if (crosses_itself(Flat(polygon).corners))
    return "found a fracture whose outline crosses itself, expected one that does not";
  return "";
}

FractureTrace<3> clipped(FractureTrace<3> polygon, const Box<3>& box) {
  FractureTrace<3> left;
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (const bool beyond : {true, false})
      if (!polygon.empty()) cut(polygon, left, axis, beyond ? box.low_m[axis] : box.high_m[axis], beyond);
  polygon.erase(std::unique(polygon.begin(), polygon.end()), polygon.end());
  while (polygon.size() > 1 && polygon.back() == polygon.front()) polygon.pop_back();
  if (polygon.size() < 3 || !(area_of(polygon) > 0)) return {};
  return polygon;
}

std::vector<FractureTrace<2>> met_by_plane(const FractureTrace<3>& polygon, int axis, double at_m,
                                           double near_m) {
  const auto [a, b] = axes_left(axis);
  const auto off = [&](const Point<3>& point) { return point[std::size_t(axis)] - at_m; };
  if (std::all_of(polygon.begin(), polygon.end(),
                  [&](const auto& vertex) { return std::abs(off(vertex)) <= near_m; })) {
    FractureTrace<2> outline;
    for (const auto& vertex : polygon) outline.push_back({vertex[a], vertex[b]});
    outline.push_back(outline.front());
    return {outline};
  }
  FractureTrace<2> crossings;
  for (std::size_t i = 0, j = polygon.size() - 1; i < polygon.size(); j = i++) {
    const double before = off(polygon[j]), after = off(polygon[i]);
    if ((before < 0) == (after < 0)) continue;
    const double way = before / (before - after);
    crossings.push_back({polygon[j][a] + way * (polygon[i][a] - polygon[j][a]),
                         polygon[j][b] + way * (polygon[i][b] - polygon[j][b])});
  }
  // All lie on one line: by pairs along it they are where the line enters and leaves.
  std::sort(crossings.begin(), crossings.end());
  std::vector<FractureTrace<2>> lines;
  for (std::size_t n = 1; n < crossings.size(); n += 2) lines.push_back({crossings[n - 1], crossings[n]});
  return lines;
}

std::map<std::size_t, double> densities_of(const Grid<3>& grid, const FractureTrace<3>& polygon) {
  const Flat flat(polygon);
  auto box = box_of_grid(grid);  // points farther than two cells from it count to none
  for (std::size_t axis = 0; axis < 3; ++axis)
    box.low_m[axis] -= 2 * grid.spacing_m, box.high_m[axis] += 2 * grid.spacing_m;
  // By the first of the cells that a piece counts to, those along z first: in parts of a grid cells get the
  // same sums in the same order.
  std::map<Index<3>, std::array<double, 27>> shares;
  auto at = shares.end();
  each_piece(flat.corners, grid.spacing_m / pieces_a_cell, flat.under(box), [&](const PolygonArea& piece) {
    const auto point = flat.in_3d(piece.middle);
    for (std::size_t axis = 0; axis < 3; ++axis)
      if (!(point[axis] >= box.low_m[axis] && point[axis] <= box.high_m[axis])) return;
    const auto [x, y, z] = spline_shares<3>(grid, point);
    const Index<3> first = {z.first, y.first, x.first};
    if (at == shares.end() || at->first != first) at = shares.try_emplace(first).first;
    for (std::size_t k = 0; k < 3; ++k)
      for (std::size_t j = 0; j < 3; ++j)
        for (std::size_t i = 0; i < 3; ++i)
          at->second[(k * 3 + j) * 3 + i] += piece.area * x.of[i] * y.of[j] * z.of[k];
  });
  std::map<std::size_t, double> densities;
  for (const auto& [first, areas] : shares)
    for (std::size_t n = 0; n < areas.size(); ++n) {
      const Index<3> index = {first[2] + std::int64_t(n % 3), first[1] + std::int64_t(n / 3 % 3),
                              first[0] + std::int64_t(n / 9)};
      bool inside = areas[n] > 0;
      for (std::size_t axis = 0; axis < 3; ++axis)
        inside = inside && index[axis] >= 0 && index[axis] < grid.shape[axis];
      if (inside)
        densities[std::size_t(grid.flat(index))] +=
            areas[n] / (grid.spacing_m * grid.spacing_m * grid.height(index));
    }
  return densities;
}

}  // namespace slipwave
