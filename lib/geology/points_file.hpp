// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "grid/grid.hpp"

namespace slipwave {

/// A point of a text file, and the line it stands on.
template <int D>
struct NumberedPoint {
  Point<D> at{};
  int line = 0;
};

/// The points of a text: "X Z", "X,Z" or "X;Z" a line, in 3-D "X Y Z", in metres, or as a header line names
/// columns and units ("x (km) elevation (ft)"); # begins a comment, empty lines are passed over. Throws Error
/// naming the line.
template <int D>
std::vector<NumberedPoint<D>> points_of_text(std::string_view text);

/// Returns the points of a file. Throws Error naming file and line.
std::vector<NumberedPoint<2>> read_points(const std::string& path);

/// Values on the first line that has any; 0 without one.
std::size_t columns_of_text(std::string_view text);

}  // namespace slipwave
