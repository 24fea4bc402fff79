// SPDX-License-Identifier: BSD-3-Clause
#include "segy/float_words.hpp"

#include "segy/bytes.hpp"

namespace slipwave::segy {
namespace {

constexpr int ibm = 1, ieee = 5;  // codes
/// The number of different words that are enough, and the most that are kept: so many IEEE words all have the
/// digit in one of 15 million files, (15/16)^256 = 7e-8.
constexpr std::size_t enough = 256, most = 4096;
/// Powers of 16 that the samples must span for these bits to be as good as drawn.
constexpr std::size_t least_exponents = 4;

}  // namespace

void FloatWords::see(std::span<const std::uint8_t> samples, const SampleFormat& format, Endian endian) {
  if (format.code != ibm && format.code != ieee) return;
  code_ = format.code;
  for (std::size_t at = 0; at + 4 <= samples.size() && words_.size() < most; at += 4) {
    const auto word = static_cast<std::uint32_t>(load_bytes(&samples[at], 4, endian));
    if ((word & 0x7fffffffU) == 0 || !words_.insert(word).second) continue;
    exponents_.insert(word >> 24 & 0x7fU);
    if ((word >> 20 & 0xfU) == 0) ++without_digit_;
  }
}

std::string FloatWords::doubt() const {
  if (words_.size() < enough || exponents_.size() < least_exponents) return "";
  // Half of what IEEE words have; IBM ones have none.
  if (code_ == ibm && 32 * without_digit_ > words_.size())
    return "samples are called IBM floating point (format code 1) and look like IEEE; "
           "--format (sw-convert: --input-format) ieee reads them so";
  if (code_ == ieee && without_digit_ == 0)
    return "samples are called IEEE floating point (format code 5) and look like IBM; "
           "--format (sw-convert: --input-format) ibm reads them so";
  return "";
}

}  // namespace slipwave::segy
