// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <limits>
#include <string_view>
#include <utility>

namespace slipwave::segy {

/// How a header word is stored: bytes and sign; f8 is an IEEE double.
enum class FieldType { u1, i2, u2, i4, u4, i8, u8, f8 };

/// One word of a header.
struct Field {
  std::string_view name;
  int byte;  // of its first byte, numbered from 1 as the standard does
  FieldType type;
  std::string_view meaning;
};

constexpr int size_of(FieldType type) {
  switch (type) {
    case FieldType::u1:
      return 1;
    case FieldType::i2:
    case FieldType::u2:
      return 2;
    case FieldType::i4:
    case FieldType::u4:
      return 4;
    case FieldType::i8:
    case FieldType::u8:
    case FieldType::f8:
      return 8;
  }
  return 0;
}

constexpr bool is_signed(FieldType type) {
  return type == FieldType::i2 || type == FieldType::i4 || type == FieldType::i8;
}

/// Lowest and highest value an integer word holds (u8: up to the highest std::int64_t).
constexpr std::pair<std::int64_t, std::int64_t> range_of(FieldType type) {
  constexpr auto limits = std::numeric_limits<std::int64_t>();
  if (size_of(type) == 8) return {is_signed(type) ? limits.min() : 0, limits.max()};
  const int bits = 8 * size_of(type);
  if (is_signed(type)) return {-(std::int64_t{1} << (bits - 1)), (std::int64_t{1} << (bits - 1)) - 1};
  return {0, (std::int64_t{1} << bits) - 1};
}

}  // namespace slipwave::segy
