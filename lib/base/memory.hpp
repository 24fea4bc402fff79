// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace slipwave {

/// Gives the pages of heap memory that hold nothing but zeros back to the system: they are read as zeros as
/// before, and take memory again once they are written, on some systems once they are read. Where the system
/// can not, all stays as it is.
void release_zero_pages(std::span<const std::byte> memory);

/// Makes heap memory zeros that take no memory until they are written, where the system can.
void clear_and_release(std::span<std::byte> memory);

/// What memory takes after release_zero_pages(), bytes.
std::int64_t bytes_without_zero_pages(std::span<const std::byte> memory);

/// Gives memory that the program has freed, but holds for itself, back to the system.
void release_freed_memory();

}  // namespace slipwave
