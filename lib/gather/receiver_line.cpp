// SPDX-License-Identifier: BSD-3-Clause
#include "gather/receiver_line.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>

#include "base/error.hpp"

namespace slipwave {
namespace {

constexpr double evenness = 1e-3;  // of the spacing

}  // namespace

ReceiverLine line_of(std::span<const std::array<double, 3>> receivers_m, const std::size_t* axis) {
  if (receivers_m.size() < 2) throw Error("has 1 receiver, expected a line of at least two");
  ReceiverLine line;
  if (axis)
    line.axis = *axis;
  else
    while (line.axis < 2 && receivers_m[0][line.axis] == receivers_m[1][line.axis]) ++line.axis;
  const auto place = [&](std::size_t n) { return receivers_m[n][line.axis]; };
  line.order.resize(receivers_m.size());
  std::iota(line.order.begin(), line.order.end(), std::size_t(0));
  std::stable_sort(line.order.begin(), line.order.end(),
                   [&](std::size_t a, std::size_t b) { return place(a) < place(b); });
  line.spacing_m = (place(line.order.back()) - place(line.order.front())) / double(receivers_m.size() - 1);
  if (!(line.spacing_m > 0)) throw Error("its receivers lie in one place, expected a line");
  for (std::size_t m = 0; m + 1 < line.order.size(); ++m) {
    const double here = place(line.order[m]), next = place(line.order[m + 1]);
    if (!(std::fabs(next - here - line.spacing_m) <= evenness * line.spacing_m))
      throw Error("receivers at " + std::string(1, line.axis_name()) + " = " + shown(here) + " and " +
                  shown(next) + " m, expected one every " + shown(line.spacing_m, 6) + " m");
  }
  return line;
}

}  // namespace slipwave
