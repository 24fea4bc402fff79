// SPDX-License-Identifier: BSD-3-Clause
#include "accuracy/beyond_sides.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace slipwave {
namespace {

/// Points of a half-space of the plane behind a mirror: n . (x - at) = 0.
struct Mirror {
  Point<2> at, normal;
  double away(const Point<2>& point) const {
    return normal[0] * (point[0] - at[0]) + normal[1] * (point[1] - at[1]);
  }
  Point<2> image(const Point<2>& point) const {
    const double twice = 2 * away(point);
    return {point[0] - twice * normal[0], point[1] - twice * normal[1]};
  }
};

/// Reflections of a way at most; more of them carry next to nothing.
constexpr std::size_t most_reflections = 40;

}  // namespace

double reflected_from_beyond(const LineBeyondSide& line, const Point<2>& source_m, const Point<2>& receiver_m,
                             double longest_m, double wavelength_m) {
  const double length = std::hypot(1, line.slope);
  const Mirror face{line.at_m, {-line.slope / length, 1 / length}}, surface{{0, line.surface_m}, {0, 1}};
  const double side = face.away(source_m);
  if (side * face.away(receiver_m) <= 0) return 0;
  const bool multiples = line.below_surface && side < 0;
  const double direct =
      std::max(std::hypot(source_m[0] - receiver_m[0], source_m[1] - receiver_m[1]), wavelength_m);
  double sum = 0;
  for (const bool from_face : {true, false}) {
    if (!from_face && !multiples) break;
    const auto is_face = [&](std::size_t n) { return (n % 2 == 0) == from_face; };
    const auto mirror = [&](std::size_t n) -> const Mirror& { return is_face(n) ? face : surface; };
    std::vector<Point<2>> images = {source_m};
    double strength = 1;
    for (std::size_t n = 0; n < (multiples ? most_reflections : 1); ++n) {
      images.push_back(mirror(n).image(images.back()));
      if (is_face(n)) strength *= line.reflection * line.reflection;
      const double way = std::hypot(images.back()[0] - receiver_m[0], images.back()[1] - receiver_m[1]);
      if (way > longest_m) break;
      // Backwards from the receiver: each image must be seen through the mirror that made it.
      Point<2> at = receiver_m;
      bool exists = true, beyond = false;
      for (std::size_t k = n + 1; k-- > 0 && exists;) {
        const auto& image = images[k + 1];
        const double here = mirror(k).away(at), there = mirror(k).away(image);
        exists = here * there <= 0 && here != there;
        if (!exists) break;
        const double share = here / (here - there);
        at = {at[0] + share * (image[0] - at[0]), at[1] + share * (image[1] - at[1])};
        if (is_face(k)) beyond = beyond || (line.to_the_right ? at[0] > line.at_m[0] : at[0] < line.at_m[0]);
      }
      if (exists && beyond) sum += strength * direct / way;
    }
  }
  return sum;
}

}  // namespace slipwave
