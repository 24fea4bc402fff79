// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "base/parse.hpp"
#include "grid/grid.hpp"

namespace slipwave {

/// A part of space: all its points lie within bounds.
template <int D>
struct RegionIn {
  Box<D> bounds;
  std::function<bool(const Point<D>&)> contains;
  /// Share of the volume of a box that lies in it, from 0 to 1; absent: share_within() samples it.
  std::function<double(const Box<D>& cell)> share = {};
};
/// A region of the x-z plane.
using Region = RegionIn<2>;

/// Share of the volume of a box that lies in a region: of boxes, polygons that do not cross themselves and
/// slabs in 2-D to rounding, else within 0.01.
template <int D>
double share_within(const RegionIn<D>& region, const Box<D>& cell);

template <int D = 2>
RegionIn<D> region_of_box(const Box<D>& box);
/// A closed polygon by the even-odd rule. Throws Error with less than three vertices.
Region region_of_polygon(std::vector<Point<2>> vertices);
/// A polygon of the points of a file (points_file.hpp). Throws Error naming the file.
Region read_polygon(const std::string& path);
/// "X,Z:A,B" or "X,Z:A,B:DIP": an ellipse round X,Z with half axes of A and B metres, A along a line that
/// dips by DIP degrees, deepening towards +x. In 3-D "X,Y,Z:A,B,C[:DIP[:AZIMUTH]]": an ellipsoid, A along a
/// line that dips towards AZIMUTH degrees from +x (90: +y), B level across it, C across both. Throws a usage
/// Error.
template <int D = 2>
RegionIn<D> parse_ellipse(std::string_view text);
/// "X,Z:LENGTH,THICKNESS" or "X,Z:LENGTH,THICKNESS:DIP": a slab round X,Z, its length along such a line; in
/// 3-D "X,Y,Z:LENGTH,WIDTH,THICKNESS[:DIP[:AZIMUTH]]". Throws a usage Error.
template <int D = 2>
RegionIn<D> parse_slab(std::string_view text);

/// Many small slabs.
struct Scatter {
  int count = 0;
  std::uint64_t seed = 1;
  double length_m = 0, thickness_m = 0;  // of slabs on average; each is 0.5 to 1.5 times as large
  double dip_deg = 0;                    // of all
  double azimuth_deg = 0;                // that they dip towards, in 3-D, where they are as wide as long
};

/// Slabs whose centres are drawn evenly from a region, cut off at its border. The first ones of a seed are
/// the same for any count. Throws a usage Error for a count, length or thickness not above zero, an Error
/// when hardly any point of the bounds is in the region.
template <int D>
RegionIn<D> scattered_in(const RegionIn<D>& region, const Scatter& scatter);

}  // namespace slipwave
