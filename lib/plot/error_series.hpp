// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "accuracy/table.hpp"

namespace slipwave::plot {

/// A way of computing, whatever the cell size.
struct Method {
  int order = 0, time_order = 0, slip_order = 0;
  double courant = 0;
  int monotone = 0;
  bool operator==(const Method&) const = default;
};

/// A cell size of a method: what it cost and gave, both above 0. Percent.
struct ErrorPoint {
  double spacing_m = 0, seconds = 0, error = 0;
  bool chosen = false;
};

/// The points of one method in a table, coarsest cells first.
struct ErrorSeries {
  Method method;
  std::vector<ErrorPoint> points;
};

/// In the order in which methods first appear in the table. Left out is what has no place on axes of decades:
/// the reference, whose error against itself is 0, and settings without a known error or time.
std::vector<ErrorSeries> series_of(const AccuracyTable& table);

/// "order 5", and of time order, slip order and Courant number those in which `methods` differ.
std::string name_of(const Method& method, const std::vector<Method>& methods);

}  // namespace slipwave::plot
