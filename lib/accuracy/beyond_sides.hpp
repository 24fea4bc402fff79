// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "grid/grid.hpp"

namespace slipwave {

/// An interface that leaves the model at a side as a straight line, and what waves meet there.
struct LineBeyondSide {
  Point<2> at_m;      // where it leaves
  bool to_the_right;  // by which side
  double slope;       // its depth over x
  double reflection;  // coefficient of amplitude
  /// Depth of a level free surface that sends back what the interface reflects; none below another interface.
  bool below_surface;
  double surface_m;
};

/// Energy of what such a line reflects to a receiver from beyond the side, over that of the direct wave, by
/// image sources in the plane: reflections, and multiples between it and the surface, whose way is at most
/// `longest_m`. Absorbing zones take it away. Beside the source the direct wave is that of `wavelength_m`.
double reflected_from_beyond(const LineBeyondSide& line, const Point<2>& source_m, const Point<2>& receiver_m,
                             double longest_m, double wavelength_m);

}  // namespace slipwave
