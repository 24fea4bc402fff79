// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <string>
#include <vector>

#include "gather/trace.hpp"

namespace slipwave {

/// Why two traces do not belong together: the first of shot, channel, component, source and receiver that
/// differs, with both values ("receiver x is 105 m, expected 100 m"); "" when none does. A component that is
/// not known goes with any. Positions agree to 0.5 mm, by which files of the same survey may round them.
std::string geometry_difference(const TraceHeader& found, const TraceHeader& expected);

/// Likewise for number of samples, interval (to a millionth of it) and start (to a thousandth of the
/// interval).
std::string sampling_difference(const SampleAxis& found, const SampleAxis& expected);

/// samples minus `subtrahend`, in place; throws Error when the lengths differ.
void subtract(std::span<double> samples, std::span<const double> subtrahend);

/// a minus b trace by trace, headers of a. Throws Error naming the first trace and field that differ.
Gather difference(const Gather& a, const Gather& b);

}  // namespace slipwave
