// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "gather/trace.hpp"

namespace slipwave {

/// Lengths of the flanks at the start and at the end of traces, in s; 0: none.
struct TaperLengths {
  double start_s = 0, end_s = 0;
};

/// "T" for both ends or "START,END", none negative; else a usage Error.
TaperLengths parse_taper(std::string_view text);

/// Weights of all samples of a trace: the product of two cosine flanks
///   (1 - cos(pi u/T))/2,  u < T the time since the first, or until the last sample, and 1 elsewhere.
/// The first and the last sample become 0.
std::vector<double> taper_weights(const SampleAxis& axis, const TaperLengths& lengths);

/// Multiplies in place; throws Error when the lengths differ.
void multiply(std::span<double> samples, std::span<const double> weights);

}  // namespace slipwave
