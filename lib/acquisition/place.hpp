// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace slipwave {

/// What a depth is measured from: depth 0, the ground or sea surface, or the sea floor.
enum class DepthFrom : std::uint8_t { datum, surface, floor };

/// A depth as it was given: so far below what it is measured from, m.
struct GivenDepth {
  DepthFrom from = DepthFrom::datum;
  double below_m = 0;
};

/// "12.5", "surface", "surface+2.5", "floor-1". Throws a usage Error.
GivenDepth parse_depth(std::string_view text);

/// The place of a source or a receiver, as it was given.
struct Place {
  std::array<double, 3> at_m{};  // x, y, z; y is 0 in 2-D
  DepthFrom depth_from = DepthFrom::datum;
  std::uint8_t relative = 0;  // a bit for each axis that is counted from the source
  /// Axes that are counted from the source where the model has no such coordinates: negative ones.
  std::uint8_t relative_if_outside = 0;
  bool operator==(const Place&) const = default;
};

/// Places on a line or lattice, as parse_line() takes them, whose last coordinate may be a depth as
/// parse_depth() takes it. Of receivers, a coordinate whose first number begins with + is counted from the
/// source ("+100:+2100:25", "+-50:50:5"), and so is one that is negative as a whole ("-2100:-100:25") where
/// the model has no such coordinates.
template <int D>
std::vector<Place> parse_places(const std::string& text, bool of_receivers);

}  // namespace slipwave
