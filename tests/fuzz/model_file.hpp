// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace slipwave::fuzz {

/// A netCDF file that the library has written and finds in order: a model with fractures, snapshots and a
/// table of accuracies at once, but for what `input` wants otherwise. It is a list of changes: other lengths,
/// types and dimensions, variables left out, single values, attributes. Without input it is a good file.
std::vector<char> model_file(std::span<const std::uint8_t> input);

}  // namespace slipwave::fuzz
