#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "base/parse.hpp"
#include "grid/grid.hpp"

namespace slipwave {

/// A part of the x-z plane: all its points lie within bounds.
struct Region {
  Box<2> bounds;
  std::function<bool(const Point<2>&)> contains;
};

Region region_of_box(const Box<2>& box);
/// A closed polygon by the even-odd rule. Throws Error with less than three vertices.
Region region_of_polygon(std::vector<Point<2>> vertices);
/// A polygon of the points of a file (points_file.hpp). Throws Error naming the file.
Region read_polygon(const std::string& path);
/// "X,Z:A,B" or "X,Z:A,B:DIP": an ellipse round X,Z with half axes of A and B metres, A along a line that
/// dips by DIP degrees, deepening towards +x. Throws a usage Error.
Region parse_ellipse(std::string_view text);
/// "X,Z:LENGTH,THICKNESS" or "X,Z:LENGTH,THICKNESS:DIP": a slab round X,Z, its length along such a line.
/// Throws a usage Error.
Region parse_slab(std::string_view text);

/// Many small slabs.
struct Scatter {
  int count = 0;
  std::uint64_t seed = 1;
  double length_m = 0, thickness_m = 0;  // of slabs on average; each is 0.5 to 1.5 times as large
  double dip_deg = 0;                    // of all
};

/// Slabs whose centres are drawn evenly from a region, cut off at its border. The first ones of a seed are
/// the same for any count. Throws a usage Error for a count, length or thickness not above zero, an Error
/// when hardly any point of the bounds is in the region.
Region scattered_in(const Region& region, const Scatter& scatter);

}  // namespace slipwave
