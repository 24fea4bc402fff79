// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "accuracy/ladder.hpp"

namespace slipwave {

/// The traces of a scene in cells of one size.
struct SizedTraces {
  double spacing_m = 0;
  const std::vector<Gather>* traces = nullptr;
  double derived = 0;  // of their error, what is derived (DirectWaves)
};

/// The order of the error, by the differences of traces in cells of three sizes: with |u1 - u0| = d1 and
/// |u2 - u0| = d2 in cells r1 and r2 times as large as those of u0, (r2^p - 1)/(r1^p - 1) = d2/d1. It is kept
/// between 1 and the order that the scheme keeps wherever it is smooth: what is of a higher order falls
/// faster and hides what is not.
double order_of_sizes(double d1, double d2, double r1, double r2, double kept = 2);

/// What is wrong with the traces in the first cells (exact ones taken away), by those in the others: of an
/// error of order p, u_n - u_0 = (r_n^p - 1) e. Bounds of it are known, and the least counts. One takes all
/// of u_1 - u_0 to be of the order that the three sizes show, `kept` at most: what is of a higher order is
/// less in the first cells. The others know how dispersion, of such a higher order, falls with the cells, by
/// that of the direct waves: a share of it, squared, is taken off |u_n - u_0|^2, the order is that of the
/// rest, and the share of what is derived for the first cells is added to it. The share is 1; k^2 where less
/// is found than is derived, by a factor k, since that is known to a factor of k alone; or, where the
/// differences grow as of the order kept or faster and that is not the first, the one that leaves a rest of
/// that order. Of two sizes p is `order_of_two`.
struct ErrorOfSizes {
  double order = 1;
  double apart = 0;           // |u_1 - u_0|
  double share = 1;           // of what is derived
  double rest = 0;            // in the first cells
  double error = 0;           // of both
  std::vector<Gather> wrong;  // u_1 - u_0, scaled to that error
};
ErrorOfSizes error_of_sizes(std::span<const SizedTraces> sizes, double order_of_two = 1, double kept = 2);

}  // namespace slipwave
