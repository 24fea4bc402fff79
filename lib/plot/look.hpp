// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "plot/axis.hpp"
#include "plot/colour_map.hpp"

namespace slipwave::plot {

/// From low to high, low < high.
struct Limits {
  double low = 0, high = 1;
};

/// "LOW:HIGH". Throws a usage Error.
Limits parse_limits(std::string_view text);

/// What a user may ask of every picture.
struct Look {
  std::string map = {};                  // name of a colour map; empty: the picture's own
  double clip_percent = 99;              // colours and wiggles are full at this percentile of magnitudes
  std::optional<Limits> colours = {};    // instead, in the unit of the data
  std::optional<Limits> x = {}, y = {};  // what part of the axes is shown
  // Linearly between cells and traces wider than pixels; unsaid, between traces only.
  std::optional<bool> interpolate = {};
};

/// Narrows the axis to the limits, where there are any. Throws a usage Error naming `option` when nothing of
/// the data lies within.
void narrow(Axis& axis, const std::optional<Limits>& limits, const std::string& option);

/// Throws a usage Error unless the clip is above 0 and at most 100 percent.
void check_clip(const Look& look);

/// The map asked for, else the one named here.
ColourMap map_of(const Look& look, const std::string& usual);

}  // namespace slipwave::plot
