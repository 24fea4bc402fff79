// SPDX-License-Identifier: BSD-3-Clause
#include "plot/look.hpp"

#include <algorithm>

#include "base/error.hpp"
#include "base/parse.hpp"

namespace slipwave::plot {

Limits parse_limits(std::string_view text) {
  const auto ends = parse_numbers(text, ':');
  if (ends.size() != 2 || !(ends[0] < ends[1]))
    throw Error("found '" + std::string(text) + "', expected LOW:HIGH with LOW below HIGH", ErrorKind::usage);
  return {ends[0], ends[1]};
}

void narrow(Axis& axis, const std::optional<Limits>& limits, const std::string& option) {
  if (!limits) return;
  if (limits->high <= axis.low || limits->low >= axis.high || (axis.log && limits->low <= 0))
    throw Error(option + ": found " + shown(limits->low) + ":" + shown(limits->high) +
                    ", the data run from " + shown(axis.low) + " to " + shown(axis.high),
                ErrorKind::usage);
  axis.low = limits->low;
  axis.high = limits->high;
}

void check_clip(const Look& look) {
  if (!(look.clip_percent > 0 && look.clip_percent <= 100))
    throw Error("found " + shown(look.clip_percent) + ", expected above 0, at most 100", ErrorKind::usage);
}

ColourMap map_of(const Look& look, const std::string& usual) {
  return ColourMap(look.map.empty() ? usual : look.map);
}

}  // namespace slipwave::plot
