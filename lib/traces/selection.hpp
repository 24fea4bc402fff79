// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "segy/reader.hpp"
#include "traces/expression.hpp"

namespace slipwave {

/// These count the traces that meet a condition, and how many of one shot follow each other at most.
struct SelectionCounts {
  std::int64_t traces = 0, per_shot = 0;
};

/// Reads all traces that are left.
SelectionCounts count_selected(segy::Reader& reader, const Expression& condition);

}  // namespace slipwave
