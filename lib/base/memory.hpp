// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace slipwave {

/// Gives the pages of heap memory that hold nothing but zeros back to the system: they are read as zeros as
/// before, and take memory again once they are written, on some systems once they are read. Where the system
/// cannot, all stays as it is.
void release_zero_pages(std::span<const std::byte> memory);

/// Makes heap memory zeros that take no memory until they are written, where the system can.
void clear_and_release(std::span<std::byte> memory);

/// What memory takes after release_zero_pages(), bytes.
std::int64_t bytes_without_zero_pages(std::span<const std::byte> memory);

/// What the values of a vector take, bytes; of several vectors together.
template <class Value>
std::int64_t bytes_of(const std::vector<Value>& values) {
  return std::int64_t(values.size() * sizeof(Value));
}
template <class Vector, std::size_t Count>
std::int64_t bytes_of(const std::array<Vector, Count>& vectors) {
  std::int64_t bytes = 0;
  for (const auto& vector : vectors) bytes += bytes_of(vector);
  return bytes;
}

/// Gives memory that the program has freed, but holds for itself, back to the system.
void release_freed_memory();

}  // namespace slipwave
