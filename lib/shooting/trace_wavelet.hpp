// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "acquisition/wavelet.hpp"

namespace slipwave {

/// A wavelet as --wavelet names it: parse_wavelet(), or "file:GATHER[:TRACE]", a trace of a SEG-Y or Seismic
/// Unix file, the first unless its number in the file says otherwise. Its samples are taken as they are, at
/// the times its header gives them. What is wrong in the file is a data Error that names it.
Wavelet wavelet_named(const std::string& text);

}  // namespace slipwave
