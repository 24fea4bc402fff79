// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>

// A System/360 float: sign, 7 bits of exponent e, 24 bits of fraction f; (-1)^s f 2^-24 16^(e - 64).
// Without branches or tables, so that loops over traces run at the speed of memory.

namespace slipwave::segy {

/// Two to the power of `exponent`, -1022 to 1023.
inline double power_of_two(std::int64_t exponent) {
  return std::bit_cast<double>(static_cast<std::uint64_t>(exponent + 1023) << 52);
}

/// Exact for every one of the 2^32 words, unnormalised ones included.
inline double double_of_ibm_word(std::uint32_t word) {
  const auto fraction = static_cast<double>(static_cast<std::int32_t>(word & 0xffffffU));
  const double magnitude = fraction * power_of_two(4 * static_cast<std::int64_t>(word >> 24 & 0x7fU) - 280);
  return (word >> 31) != 0 ? -magnitude : magnitude;
}

/// A number on its way into a word: beyond the largest float (NaN and infinity too) `fits` is false and the
/// word worth nothing.
struct IbmWord {
  std::uint32_t word;
  bool fits;
};

inline IbmWord ibm_word_of(double value) {
  const auto bits = std::bit_cast<std::uint64_t>(value);
  const double magnitude = std::bit_cast<double>(bits & ~(std::uint64_t{1} << 63));
  // Of 2^(b - 1023) <= |value| < 2^(b - 1022) the hexadecimal exponent is the one whose leading digit is not
  // 0; below 16^-65 (b = 763) there is none left, and digits are lost.
  const auto binary = std::max<std::int64_t>(static_cast<std::int64_t>(bits >> 52 & 0x7ffU), 763);
  const std::int64_t exponent = (binary - 763) >> 2;
  // Adding 2^52 rounds to a whole number, ties to even.
  const double whole = magnitude * power_of_two(280 - 4 * exponent) + 0x1p52;
  const std::uint64_t fraction = std::bit_cast<std::uint64_t>(whole) & 0x1ffffffU;
  const std::uint64_t carry = fraction >> 24;  // rounded up to the next power of 16
  const auto biased = static_cast<std::uint64_t>(exponent) + carry;
  const std::uint64_t word = bits >> 63 << 31 | (biased & 0x7fU) << 24 | (fraction >> 4 * carry & 0xffffffU);
  return {static_cast<std::uint32_t>(word), biased < 128};
}

}  // namespace slipwave::segy
