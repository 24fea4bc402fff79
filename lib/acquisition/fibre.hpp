// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <string>
#include <vector>

#include "grid/grid.hpp"

namespace slipwave {

/// A fibre through each receiver, which is the middle of its gauge: what DAS (distributed acoustic sensing)
/// records there is the strain rate along the fibre, averaged over the gauge length. It is straight, or one
/// that runs through all receivers of a shot in their order, as in a deviated well: straight between two of
/// them and beyond the last.
struct Fibre {
  double angle_deg = 0;    // 0 is down, positive angles tilt towards +x, 90 lies along x
  double azimuth_deg = 0;  // 3-D: of what is horizontal, from x towards y
  double gauge_m = 0;
  bool along_path = false;  // then without angles
};

/// A point at which the velocity takes part in the mean strain rate of a gauge, which is the sum of weight .
/// v over its points.
template <int D>
struct GaugePoint {
  Point<D> at_m{};
  Point<D> weight_per_m{};
};

/// "das:ANGLE:GAUGE", in 3-D "das:ANGLE:AZIMUTH:GAUGE" too, or "das:path:GAUGE". Throws a usage Error.
template <int D>
Fibre parse_fibre(const std::string& text);

/// Unit vector along a straight fibre.
template <int D>
Point<D> direction_of(const Fibre& fibre);

/// The points of the gauge whose middle is receiver `number` (from 0) of a shot (theory.md (A22)): its ends,
/// that along the fibre first, and where the fibre bends between them, the bends. Throws Error where a path
/// has one receiver only, or two of them in a row at one place.
template <int D>
std::vector<GaugePoint<D>> gauge_points(const Fibre& fibre, std::span<const Point<D>> receivers_m,
                                        std::size_t number);

}  // namespace slipwave
