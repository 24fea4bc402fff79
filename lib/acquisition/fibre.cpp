// SPDX-License-Identifier: BSD-3-Clause
#include "acquisition/fibre.hpp"

#include <cmath>
#include <vector>

#include "acquisition/direction.hpp"
#include "base/error.hpp"
#include "base/parse.hpp"

namespace slipwave {

template <int D>
Fibre parse_fibre(const std::string& text) {
  const std::string expected =
      D == 2
          ? "expected das:ANGLE:GAUGE (degrees, 0 is down; m)"
          : "expected das:ANGLE:GAUGE or das:ANGLE:AZIMUTH:GAUGE (degrees, 0 is down, from x towards y; m)";
  const auto parts = split(text, ':');
  if (parts.front() != "das" || (parts.size() != 3 && !(D == 3 && parts.size() == 4)))
    throw Error("found '" + text + "', " + expected, ErrorKind::usage);
  const auto number = [&](std::size_t n) {
    return in_place("'" + text + "'", [&] { return parse_number(parts[n]); });
  };
  Fibre fibre{number(1), parts.size() == 4 ? number(2) : 0, number(parts.size() - 1)};
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

template <int D>
std::array<Point<D>, 2> gauge_ends(const Fibre& fibre, const Point<D>& receiver_m) {
  const auto direction = direction_of<D>(fibre);
  std::array<Point<D>, 2> ends = {receiver_m, receiver_m};
  for (std::size_t axis = 0; axis < D; ++axis) {
    ends[0][axis] -= direction[axis] * fibre.gauge_m / 2;
    ends[1][axis] += direction[axis] * fibre.gauge_m / 2;
  }
  return ends;
}

template Fibre parse_fibre<2>(const std::string&);
template Fibre parse_fibre<3>(const std::string&);
template Point<2> direction_of<2>(const Fibre&);
template Point<3> direction_of<3>(const Fibre&);
template std::array<Point<2>, 2> gauge_ends<2>(const Fibre&, const Point<2>&);
template std::array<Point<3>, 2> gauge_ends<3>(const Fibre&, const Point<3>&);

}  // namespace slipwave
