// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>

namespace slipwave::segy {

enum class Endian { big, little };

inline constexpr Endian native_endian =
    std::endian::native == std::endian::big ? Endian::big : Endian::little;

/// "big" or "little".
const char* name_of(Endian endian);

/// The unsigned integer of `count` bytes (1 to 8) at `from`.
inline std::uint64_t load_bytes(const std::uint8_t* from, int count, Endian endian) {
  std::uint64_t value = 0;
  for (int i = 0; i < count; ++i) value = value << 8 | from[endian == Endian::big ? i : count - 1 - i];
  return value;
}

/// Writes the low `count` bytes of `value` to `to`.
inline void store_bytes(std::uint8_t* to, int count, Endian endian, std::uint64_t value) {
  for (int i = 0; i < count; ++i) {
    to[endian == Endian::big ? count - 1 - i : i] = static_cast<std::uint8_t>(value);
    value >>= 8;
  }
}

/// `value` of `count` bytes read as two's complement.
inline std::int64_t sign_extended(std::uint64_t value, int count) {
  const int unused = 64 - 8 * count;
  return static_cast<std::int64_t>(value << unused) >> unused;
}

}  // namespace slipwave::segy
