// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace slipwave {

/// 200 rms(a - b) / (rms(a) + rms(b)) in percent, over the samples within `half` of each one: 0 where they
/// are equal, 200 where they are opposite or one of them is 0. Throws Error where the lengths differ.
std::vector<double> nrms_over_time(std::span<const double> a, std::span<const double> b, std::size_t half);

}  // namespace slipwave
