// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string_view>

namespace slipwave {

/// Do these first bytes (8 suffice) begin a netCDF file, classic or netCDF-4?
bool begins_netcdf(std::string_view first_bytes);

/// Copies `count` bytes from `offset` of a file to `to`; false past its end.
using ReadAt = std::function<bool(std::uint64_t offset, void* to, std::size_t count)>;

/// Throws Error "truncated: ..." when a netCDF file of `size` bytes is shorter than its own header says. The
/// netCDF library opens truncated classic files without complaint and reads zeros. Files of another kind and
/// malformed headers pass: opening them says what is wrong.
void check_not_truncated(const ReadAt& read_at, std::uint64_t size);

}  // namespace slipwave
