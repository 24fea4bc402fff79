// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "segy/writer.hpp"

namespace slipwave::segy {

inline constexpr std::int64_t highest_16 = 65535;

/// The sample format of `info`, after refusing what its revision cannot hold: the format, the number of
/// samples, the interval, the delay. Each refusal says what was found and what fits.
const SampleFormat& checked_format(const FileInfo& info);

/// The binary header as `info` says it, carried words where it says nothing.
BinaryWords binary_header(const FileInfo& info);

/// Bytes of the binary header in file order with the revision: two bytes since 2, one 16-bit word before.
BinaryWords::Bytes with_revision_stamp(BinaryWords::Bytes bytes, const FileFormat& format);

/// Microseconds for a 16-bit word, rounded; 0 when they do not fit (revision 2 has a double beside it).
std::int64_t interval_word(double interval_s);

/// Whole milliseconds of the first sample's time; throws Error when they are not whole or do not fit 16 bits.
std::int64_t delay_word(double start_s);

/// Applies the time scalar (byte 215) to the times of bytes 95 to 114 and makes it 1.
void apply_time_scalar(TraceWords& words);

/// Makes bytes 181 to 240 zero, the time scalar applied to the times before.
void clear_for_su(TraceWords& words);

}  // namespace slipwave::segy
