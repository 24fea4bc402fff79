// SPDX-License-Identifier: BSD-3-Clause
#include "acquisition/fibre.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "acquisition/direction.hpp"
#include "base/error.hpp"
#include "base/instantiate.hpp"
#include "base/parse.hpp"

namespace slipwave {

template <int D>
Fibre parse_fibre(const std::string& text) {
  const std::string expected = D == 2 ? "expected das:ANGLE:GAUGE (degrees, 0 is down; m) or das:path:GAUGE"
                                      : "expected das:ANGLE:GAUGE or das:ANGLE:AZIMUTH:GAUGE (degrees, 0 is "
                                        "down, from x towards y; m), or "
                                        "das:path:GAUGE";
  const auto parts = split(text, ':');
  if (parts.front() != "das" || (parts.size() != 3 && !(D == 3 && parts.size() == 4)))
    throw Error("found '" + text + "', " + expected, ErrorKind::usage);
  const auto number = [&](std::size_t n) {
    return in_place("'" + text + "'", [&] { return parse_number(parts[n]); });
  };
  Fibre fibre;
  fibre.along_path = parts[1] == "path" && parts.size() == 3;
  if (!fibre.along_path) fibre.angle_deg = number(1);
  if (parts.size() == 4) fibre.azimuth_deg = number(2);
  fibre.gauge_m = number(parts.size() - 1);
  for (const double angle : {fibre.angle_deg, fibre.azimuth_deg})
    if (!(std::abs(angle) <= 360))
      throw Error("'" + text + "': found an angle of " + shown(angle) + " degrees, expected -360 to 360",
                  ErrorKind::usage);
  if (!(fibre.gauge_m > 0))
    throw Error("'" + text + "': found a gauge length of " + shown(fibre.gauge_m) + " m, expected it above 0",
                ErrorKind::usage);
  return fibre;
}

template <int D>
Point<D> direction_of(const Fibre& fibre) {
  const double across = sine_of_degrees(fibre.angle_deg);
  Point<D> direction{};
  direction[0] = across * (D == 2 ? 1 : cosine_of_degrees(fibre.azimuth_deg));
  if (D == 3) direction[1] = across * sine_of_degrees(fibre.azimuth_deg);
  direction[D - 1] = cosine_of_degrees(fibre.angle_deg);
  return direction;
}

namespace {

template <int D>
Point<D> scaled(Point<D> vector, double factor) {
  for (auto& part : vector) part *= factor;
  return vector;
}

template <int D>
Point<D> sum(Point<D> one, const Point<D>& other) {
  for (std::size_t axis = 0; axis < D; ++axis) one[axis] += other[axis];
  return one;
}

/// Lengths of the path from its first receiver to each.
template <int D>
std::vector<double> lengths_along(std::span<const Point<D>> path) {
  if (path.size() < 2)
    throw Error("das:path: found one receiver, expected two or more, through which the fibre runs");
  std::vector<double> along = {0};
  for (std::size_t n = 1; n < path.size(); ++n) {
    double length_m = 0;
    for (std::size_t axis = 0; axis < D; ++axis)
      length_m = std::hypot(length_m, path[n][axis] - path[n - 1][axis]);
    if (!(length_m > 0))
      throw Error("das:path: receivers " + std::to_string(n) + " and " + std::to_string(n + 1) +
                  " stand at one place, expected them along a fibre");
    along.push_back(along.back() + length_m);
  }
  return along;
}

/// Each straight piece within the gauge adds its direction at its end and takes it off at its beginning.
template <int D>
std::vector<GaugePoint<D>> points_along_path(double gauge_m, std::span<const Point<D>> path,
                                             std::size_t middle) {
  const auto along = lengths_along<D>(path);
  const double low = along[middle] - gauge_m / 2, high = along[middle] + gauge_m / 2;
  std::vector<GaugePoint<D>> points;
  for (std::size_t n = 0; n + 1 < path.size(); ++n) {
    const bool last = n + 2 == path.size();
    const double from = n == 0 ? low : std::max(low, along[n]),
                 to = last ? high : std::min(high, along[n + 1]);
    if (!(to > from)) continue;
    const auto direction =
        scaled<D>(sum<D>(path[n + 1], scaled<D>(path[n], -1)), 1 / (along[n + 1] - along[n]));
    const auto at = [&](double length) { return sum<D>(path[n], scaled<D>(direction, length - along[n])); };
    if (points.empty()) points.push_back({at(from), {}});
    auto& begin = points.back().weight_per_m;
    begin = sum<D>(begin, scaled<D>(direction, -1 / gauge_m));
    points.push_back({at(to), scaled<D>(direction, 1 / gauge_m)});
  }
  std::erase_if(points, [](const GaugePoint<D>& point) { return point.weight_per_m == Point<D>{}; });
  std::reverse(points.begin(), points.end());
  return points;
}

}  // namespace

template <int D>
std::vector<GaugePoint<D>> gauge_points(const Fibre& fibre, std::span<const Point<D>> receivers_m,
                                        std::size_t number) {
  if (fibre.along_path) return points_along_path<D>(fibre.gauge_m, receivers_m, number);
  const auto direction = direction_of<D>(fibre);
  std::vector<GaugePoint<D>> points;
  for (const double sign : {1., -1.}) {
    auto& point = points.emplace_back(GaugePoint<D>{receivers_m[number], direction});
    for (std::size_t axis = 0; axis < D; ++axis) {
      point.at_m[axis] += sign * direction[axis] * fibre.gauge_m / 2;
      point.weight_per_m[axis] *= sign / fibre.gauge_m;
    }
  }
  return points;
}

SLIPWAVE_INSTANTIATE_D(FUNCTION, parse_fibre);
SLIPWAVE_INSTANTIATE_D(FUNCTION, direction_of);
SLIPWAVE_INSTANTIATE_D(FUNCTION, gauge_points);

}  // namespace slipwave
