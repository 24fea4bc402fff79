// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace slipwave {

/// Receivers along a line, one every so many metres.
struct ReceiverLine {
  std::size_t axis = 0;  // x, y or z, along which it runs
  double spacing_m = 0;
  std::vector<std::size_t> order;  // of the receivers, by ascending position

  char axis_name() const { return "xyz"[axis]; }
};

/// The line of these receivers: along `axis`, or the first axis on which the first two differ. Throws Error
/// where there are fewer than two, all in one place, or they are not evenly spaced (to a thousandth).
ReceiverLine line_of(std::span<const std::array<double, 3>> receivers_m, const std::size_t* axis = nullptr);

}  // namespace slipwave
