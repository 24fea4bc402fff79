// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <set>
#include <span>
#include <string>
#include <unordered_set>

#include "segy/sample_format.hpp"

namespace slipwave::segy {

/// Tells IBM from IEEE floating point by the words of some samples, since either reads as the other without a
/// fault. The first hexadecimal digit of an IBM fraction is never 0, as numbers are written normalised; in
/// IEEE numbers of several magnitudes those bits (the last of the exponent, the first three of the fraction)
/// are 0 in one of 16.
class FloatWords {
 public:
  void see(std::span<const std::uint8_t> samples, const SampleFormat& format, Endian endian);
  /// A sentence where the words are not of the format's kind; "" where they are, or too few to say.
  std::string doubt() const;

 private:
  int code_ = 0;
  std::unordered_set<std::uint32_t> words_;  // different ones, none of them 0
  std::set<std::uint32_t> exponents_;
  std::size_t without_digit_ = 0;
};

}  // namespace slipwave::segy
