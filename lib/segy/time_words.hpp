// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "segy/words.hpp"

namespace slipwave::segy {

/// Whether a time in units of a word is a whole number of them, to a millionth: 0.0005 s is half a
/// millisecond and 0.0007 s 700 us, whatever a double makes of them.
bool is_whole(double value);

/// Sets the time of the first sample (byte 109). With `has_scalar` (since revision 1) the time scalar (byte
/// 215) becomes the coarsest, from the present one on, that holds it and all other times of bytes 95 to 114
/// exactly. Throws Error when none does, or the time is not one of whole milliseconds without it.
void set_first_sample(TraceWords& words, double start_s, bool has_scalar);

/// Applies the time scalar to the times of bytes 95 to 114 and makes it 1. Throws Error where the first
/// sample's is not one of whole milliseconds; returns whether any other was rounded.
bool apply_time_scalar(TraceWords& words);

}  // namespace slipwave::segy
