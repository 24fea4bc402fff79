// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>
#include <vector>

#include "base/parse.hpp"
#include "grid/extent.hpp"
#include "model/model.hpp"

/// Single fractures in 3-D (docs/theory/fractures.md): plane polygons, closed, of the vertices of a trace.
namespace slipwave {

/// "X,Y,Z:RADIUS[:DIP[:AZIMUTH]]": a disc, as a polygon of 32 corners of its area; its plane dips towards an
/// azimuth in degrees from +x (90: +y). Throws a usage Error.
FractureTrace<3> parse_disc(const std::string& text);
/// "X,Y,Z:LENGTH,WIDTH[:DIP[:AZIMUTH]]": a rectangle, its length along the dip and its width level. Throws a
/// usage Error.
FractureTrace<3> parse_rectangle(const std::string& text);
/// A disc whose plane has that unit normal.
FractureTrace<3> disc_of(const Point<3>& centre_m, double radius_m, const Point<3>& normal);

Point<3> cross_product(const Point<3>& a, const Point<3>& b);
/// The unit normal, about which the vertices follow each other by the right-hand rule.
Point<3> normal_of_polygon(const FractureTrace<3>& polygon);
/// m2.
double area_of(const FractureTrace<3>& polygon);

/// What keeps vertices from being a fracture: "found ..., expected ...", or "" where nothing does. They must
/// lie in a plane within a thousandth of their distance, and edges must not cross.
std::string fault_of_polygon(const FractureTrace<3>& polygon);

/// What of it lies in a box; empty where nothing does.
FractureTrace<3> clipped(FractureTrace<3> polygon, const Box<3>& box);

/// Returns where it meets the plane across an axis at a place, in m: lines of two points, of the two axes
/// that are left. It is the outline where all of the polygon lies within `near_m` of that plane.
std::vector<FractureTrace<2>> met_by_plane(const FractureTrace<3>& polygon, int axis, double at_m,
                                           double near_m);

/// The area of it that the cells about it have a share in, over their volume, 1/m, by their number in the
/// grid: every point counts to 27 cells, the nearer the more (S30).
std::map<std::size_t, double> densities_of(const Grid<3>& grid, const FractureTrace<3>& polygon);

}  // namespace slipwave
