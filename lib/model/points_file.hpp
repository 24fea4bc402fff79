#pragma once

#include <string>
#include <vector>

#include "grid/grid.hpp"

namespace slipwave {

/// A point of a text file, and the line it stands on.
struct NumberedPoint {
  Point<2> at{};
  int line = 0;
};

/// The points of a text file, one "X Z" or "X,Z" a line; # begins a comment, empty lines are passed over.
/// Throws Error naming file and line.
std::vector<NumberedPoint> read_points(const std::string& path);

}  // namespace slipwave
