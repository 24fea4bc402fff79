// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "build/import.hpp"

namespace slipwave {

/// Throws a usage Error where a raw file (field_from_raw) looks as if its lines were of another length, that
/// of the other order or of exchanged numbers of cells. Neighbouring lines of the right length change alike
/// along them, since media are layered; and where a line ends, values jump. Where neither tells the lengths
/// apart, as where both are equal, an order that makes layers stand upright is refused.
template <int D>
void check_raw_shape(const std::vector<char>& bytes, const Grid<D>& grid, FastAxis fast);

/// A sentence where speeds fall with depth by more than half of what the means of rows vary, as those of a
/// file that begins at the bottom do; "" otherwise.
std::string doubt_of_depth(const Field<3>& speeds);

}  // namespace slipwave
