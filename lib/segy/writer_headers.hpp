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

/// A sentence about places that the scalar rounds by a noticeable share of the smallest distance; none where
/// it does not.
std::vector<std::string> places_rounded(const SurveyLayout& layout);

/// Whether trace headers of that format have a time scalar (byte 215).
bool has_time_scalar(const FileFormat& format);

}  // namespace slipwave::segy
