// SPDX-License-Identifier: BSD-3-Clause
#include "geology/region.hpp"

#include <algorithm>

#include "base/error.hpp"
#include "base/instantiate.hpp"
#include "geology/frame.hpp"
#include "geology/points_file.hpp"
#include "geology/polygon.hpp"
#include "io/input_bytes.hpp"

namespace slipwave {
namespace {

template <int D>
Frame<D> parse_frame(std::string_view text, const std::string& expected) {
  const auto parts = split(text, ':');
  if (parts.size() < 2 || parts.size() > D + 1) {
    throw Error("found '" + std::string(text) + "', expected " + expected, ErrorKind::usage);
  }
  return in_place('\'' + std::string(text) + "'", [&] {
    const auto centre = parse_point<D>(parts[0]);
    const auto sizes = parse_numbers(parts[1], ',');
    const double dip_deg = parts.size() > 2 ? parse_number(parts[2]) : 0;
    const double azimuth_deg = parts.size() > 3 ? parse_number(parts[3]) : 0;
    if (sizes.size() != D || !std::all_of(sizes.begin(), sizes.end(), [](double size) { return size > 0; })) {
      throw Error("found '" + parts[1] + "', expected " + (D == 2 ? "two" : "three") + " lengths above zero",
                  ErrorKind::usage);
    }
    Point<D> size_m{};
    std::copy(sizes.begin(), sizes.end(), size_m.begin());
    return Frame<D>(centre, size_m, dip_deg, azimuth_deg);
  });
}

/// Length over which two intervals overlap.
double overlap(double low_a, double high_a, double low_b, double high_b) {
  return std::max(0., std::min(high_a, high_b) - std::max(low_a, low_b));
}

template <int D>
double volume_of(const Box<D>& box) {
  double volume = 1;
  for (std::size_t axis = 0; axis < D; ++axis) volume *= box.high_m[axis] - box.low_m[axis];
  return volume;
}

/// Area of what a rectangle leaves of a polygon that does not cross itself.
double area_within(std::vector<Point<2>> polygon, const Box<2>& cell) {
  std::vector<Point<2>> room;
  for (const std::size_t axis : {0, 1})
    for (const bool beyond : {true, false}) {
      cut(polygon, room, axis, beyond ? cell.low_m[axis] : cell.high_m[axis], beyond);
      if (polygon.empty()) return 0;
    }
  return std::abs(area_and_middle(polygon).area);
}

/// Calls with(point) at the middles of `parts` parts of a box along each axis but the last, and of so many
/// along the last one.
template <int D, class With>
void each_middle(const Box<D>& cell, std::int64_t parts, std::int64_t of_last, const With& with) {
  Grid<D> grid;
  grid.shape.fill(parts);
  grid.shape[D - 1] = of_last;
  for (std::int64_t n = 0; n < grid.size(); ++n) {
    const auto at = grid.index(n);
    Point<D> point{};
    for (std::size_t axis = 0; axis < D; ++axis)
      point[axis] = cell.low_m[axis] + (cell.high_m[axis] - cell.low_m[axis]) * (double(at[axis]) + 0.5) /
                                           double(grid.shape[axis]);
    with(point);
  }
}

/// By lines along the last axis, of whose chords the length within the box is known.
template <int D, class Chord>
double share_of_chords(const Box<D>& cell, const Chord& chord) {
  constexpr std::int64_t lines = D == 2 ? 32 : 12;
  constexpr std::size_t last = D - 1;
  double sum = 0, count = 0;
  each_middle(cell, lines, 1, [&](const Point<D>& point) {
    const auto [low, high] = chord(point, last);
    sum += overlap(low, high, cell.low_m[last], cell.high_m[last]);
    count += 1;
  });
  return sum / (count * (cell.high_m[last] - cell.low_m[last]));
}

}  // namespace

template <int D>
double share_within(const RegionIn<D>& region, const Box<D>& cell) {
  for (std::size_t axis = 0; axis < D; ++axis)
    if (cell.high_m[axis] <= region.bounds.low_m[axis] || cell.low_m[axis] >= region.bounds.high_m[axis])
      return 0;
  if (region.share) return std::clamp(region.share(cell), 0., 1.);
  constexpr std::int64_t parts = D == 2 ? 16 : 6;
  double inside = 0, count = 0;
  each_middle(cell, parts, parts, [&](const Point<D>& point) {
    inside += region.contains(point) ? 1 : 0;
    count += 1;
  });
  return inside / count;
}

template <int D>
RegionIn<D> region_of_box(const Box<D>& box) {
  return {box, [box](const Point<D>& at) { return box.contains(at); },
          [box](const Box<D>& cell) {
            double share = 1;
            for (std::size_t axis = 0; axis < D; ++axis)
              share *= overlap(box.low_m[axis], box.high_m[axis], cell.low_m[axis], cell.high_m[axis]) /
                       (cell.high_m[axis] - cell.low_m[axis]);
            return share;
          }};
}

Region region_of_polygon(std::vector<Point<2>> vertices) {
  if (vertices.size() < 3) {
    throw Error("found " + std::to_string(vertices.size()) + " vertices, expected at least 3");
  }
  Box<2> bounds{vertices.front(), vertices.front()};
  for (const auto& vertex : vertices) {
    for (std::size_t axis = 0; axis < 2; ++axis) {
      bounds.low_m[axis] = std::min(bounds.low_m[axis], vertex[axis]);
      bounds.high_m[axis] = std::max(bounds.high_m[axis], vertex[axis]);
    }
  }
  std::function<double(const Box<2>&)> share;
  if (!crosses_itself(vertices))
    share = [vertices](const Box<2>& cell) { return area_within(vertices, cell) / volume_of(cell); };
  return {bounds,
          [vertices = std::move(vertices)](const Point<2>& at) {
            bool inside = false;
            for (std::size_t i = 0, j = vertices.size() - 1; i < vertices.size(); j = i++) {
              const auto &a = vertices[i], &b = vertices[j];
              if ((a[1] > at[1]) == (b[1] > at[1])) continue;
              if (at[0] < a[0] + (b[0] - a[0]) * (at[1] - a[1]) / (b[1] - a[1])) inside = !inside;
            }
            return inside;
          },
          std::move(share)};
}

Region read_polygon(const std::string& path) {
  std::vector<Point<2>> vertices;
  for (const auto& point : read_points(path)) vertices.push_back(point.at);
  return in_place(shown_input(path), [&] { return region_of_polygon(std::move(vertices)); });
}

template <int D>
RegionIn<D> parse_ellipse(std::string_view text) {
  const auto frame =
      parse_frame<D>(text, D == 2 ? "an ellipse X,Z:A,B[:DIP]" : "an ellipsoid X,Y,Z:A,B,C[:DIP[:AZIMUTH]]");
  const auto chord = [frame](const Point<D>& at, std::size_t axis) { return frame.ellipse_chord(at, axis); };
  return {frame.ellipse_bounds(), [frame](const Point<D>& at) { return frame.in_ellipse(at); },
          [chord](const Box<D>& cell) { return share_of_chords(cell, chord); }};
}

template <int D>
RegionIn<D> parse_slab(std::string_view text) {
  const auto frame = parse_frame<D>(text, D == 2 ? "a slab X,Z:LENGTH,THICKNESS[:DIP]"
                                                 : "a slab X,Y,Z:LENGTH,WIDTH,THICKNESS[:DIP[:AZIMUTH]]");
  const auto contains = [frame](const Point<D>& at) { return frame.in_slab(at); };
  if constexpr (D == 2) {
    const auto corners = frame.corners();
    return {frame.slab_bounds(), contains, [corners](const Box<2>& cell) {
              return area_within({corners.begin(), corners.end()}, cell) / volume_of(cell);
            }};
  }
  const auto chord = [frame](const Point<D>& at, std::size_t axis) { return frame.slab_chord(at, axis); };
  return {frame.slab_bounds(), contains,
          [chord](const Box<D>& cell) { return share_of_chords(cell, chord); }};
}

SLIPWAVE_INSTANTIATE_D(FUNCTION, share_within);
SLIPWAVE_INSTANTIATE_D(FUNCTION, region_of_box);
SLIPWAVE_INSTANTIATE_D(FUNCTION, parse_ellipse);
SLIPWAVE_INSTANTIATE_D(FUNCTION, parse_slab);

}  // namespace slipwave
