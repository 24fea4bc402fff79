// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "acquisition/wavelet.hpp"

namespace slipwave {

/// A wavelet as --wavelet names it: parse_wavelet(), or "file:GATHER[:TRACE]", a trace of a SEG-Y or Seismic
/// Unix file, the first unless its number in the file says otherwise. Its samples are taken as they are, at
/// the times its header gives them. What is wrong in the file is a data Error that names it.
Wavelet wavelet_named(const std::string& text);

/// A sentence where more than 1 % (root mean square) of a wavelet of samples lies beyond the end of a record,
/// as of one whose times are in ms: the sources would not, or hardly, act. "" where all is well.
std::string beyond_record(const Wavelet& wavelet, double delay_s, double record_s);

}  // namespace slipwave
