// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "segy/bytes.hpp"

namespace slipwave::segy {

/// One data sample format of the standard.
struct SampleFormat {
  int code;          // binary header, byte 3225
  int bytes;         // a sample
  const char* name;  // "ieee", "int16", ...
  const char* meaning;
  int since;  // the first revision that has it
};

/// All formats read and written, by code. Code 4 (fixed point with gain) is not one of them.
std::span<const SampleFormat> sample_formats();

/// nullptr when the code is none of sample_formats().
const SampleFormat* find_format(std::int64_t code);

/// The format of that name or code ("ibm", "ieee", "double", "int16", "5"); usage Error listing the names
/// otherwise.
const SampleFormat& format_named(const std::string& name);

/// The float of System/360 nearest to `value`, ties to even; numbers below the smallest normalised one lose
/// digits, those below half of the smallest unnormalised one become zero.
/// Throws Error for NaN, infinity and magnitudes of 16^63 and above.
std::uint32_t ibm_from_double(double value);

/// Exact for every one of the 2^32 words, unnormalised ones included.
double double_from_ibm(std::uint32_t word);

/// into.size() samples from bytes (into.size() * format.bytes of them). 8-byte integers are rounded to
/// double.
void decode_samples(std::span<const std::uint8_t> bytes, const SampleFormat& format, Endian endian,
                    std::span<double> into);

/// The samples' bytes to `into` (samples.size() * format.bytes of them). Integers are rounded to nearest.
/// Throws Error "sample 17 ..." for NaN, infinity and values the format cannot hold; samples count from 1.
void encode_samples(std::span<const double> samples, const SampleFormat& format, Endian endian,
                    std::span<std::uint8_t> into);

/// Refuses what encode_samples() would refuse of samples that are in `format` already: NaN and infinity.
void check_samples(std::span<const std::uint8_t> bytes, const SampleFormat& format, Endian endian);

}  // namespace slipwave::segy
