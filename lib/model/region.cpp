#include "model/region.hpp"

#include <algorithm>

#include "base/error.hpp"
#include "io/input_bytes.hpp"
#include "model/frame.hpp"
#include "model/points_file.hpp"

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

}  // namespace

template <int D>
RegionIn<D> region_of_box(const Box<D>& box) {
  return {box, [box](const Point<D>& at) { return box.contains(at); }};
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
  return {bounds, [vertices = std::move(vertices)](const Point<2>& at) {
            bool inside = false;
            for (std::size_t i = 0, j = vertices.size() - 1; i < vertices.size(); j = i++) {
              const auto &a = vertices[i], &b = vertices[j];
              if ((a[1] > at[1]) == (b[1] > at[1])) continue;
              if (at[0] < a[0] + (b[0] - a[0]) * (at[1] - a[1]) / (b[1] - a[1])) inside = !inside;
            }
            return inside;
          }};
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
  return {frame.ellipse_bounds(), [frame](const Point<D>& at) { return frame.in_ellipse(at); }};
}

template <int D>
RegionIn<D> parse_slab(std::string_view text) {
  const auto frame = parse_frame<D>(text, D == 2 ? "a slab X,Z:LENGTH,THICKNESS[:DIP]"
                                                 : "a slab X,Y,Z:LENGTH,WIDTH,THICKNESS[:DIP[:AZIMUTH]]");
  return {frame.slab_bounds(), [frame](const Point<D>& at) { return frame.in_slab(at); }};
}

template RegionIn<2> region_of_box(const Box<2>&);
template RegionIn<3> region_of_box(const Box<3>&);
template RegionIn<2> parse_ellipse<2>(std::string_view);
template RegionIn<3> parse_ellipse<3>(std::string_view);
template RegionIn<2> parse_slab<2>(std::string_view);
template RegionIn<3> parse_slab<3>(std::string_view);

}  // namespace slipwave
