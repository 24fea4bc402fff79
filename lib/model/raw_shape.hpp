// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "model/import.hpp"

namespace slipwave {

/// Throws a usage Error where a raw file (field_from_raw) of this grid looks scrambled: neighbours across the
/// fast axis differ by more than three times what they would with both numbers of cells exchanged, and there
/// they agree much better than cells a little further apart do.
void check_raw_shape(const std::vector<char>& bytes, const Grid<2>& grid, FastAxis fast);

}  // namespace slipwave
