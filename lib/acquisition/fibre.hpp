// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <string>

#include "grid/grid.hpp"

namespace slipwave {

/// A straight fibre through each receiver, which is the middle of its gauge: what DAS (distributed acoustic
/// sensing) records there is the strain rate along the fibre, averaged over the gauge length.
struct Fibre {
  double angle_deg = 0;    // 0 is down, positive angles tilt towards +x, 90 lies along x
  double azimuth_deg = 0;  // 3-D: of what is horizontal, from x towards y
  double gauge_m = 0;
};

/// "das:ANGLE:GAUGE", in 3-D "das:ANGLE:AZIMUTH:GAUGE" too. Throws a usage Error.
template <int D>
Fibre parse_fibre(const std::string& text);

/// Unit vector along a fibre.
template <int D>
Point<D> direction_of(const Fibre& fibre);

/// Both ends of the gauge with its middle at a receiver, m: against the fibre's direction, and along it.
template <int D>
std::array<Point<D>, 2> gauge_ends(const Fibre& fibre, const Point<D>& receiver_m);

extern template Fibre parse_fibre<2>(const std::string&);
extern template Fibre parse_fibre<3>(const std::string&);
extern template Point<2> direction_of<2>(const Fibre&);
extern template Point<3> direction_of<3>(const Fibre&);
extern template std::array<Point<2>, 2> gauge_ends<2>(const Fibre&, const Point<2>&);
extern template std::array<Point<3>, 2> gauge_ends<3>(const Fibre&, const Point<3>&);

}  // namespace slipwave
