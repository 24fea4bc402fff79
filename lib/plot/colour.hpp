// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace slipwave::plot {

/// A colour as screens take it (sRGB), each part 0 to 1.
struct Colour {
  double red = 0, green = 0, blue = 0;
  bool operator==(const Colour&) const = default;
};

inline constexpr Colour black{0, 0, 0};
inline constexpr Colour white{1, 1, 1};
inline constexpr Colour no_data{0.86, 0.86, 0.86};  // what has no value: void cells, NaN

/// `under` seen through `over` of that opacity, 0 to 1.
constexpr Colour blend(const Colour& under, const Colour& over, double opacity) {
  return {under.red + opacity * (over.red - under.red), under.green + opacity * (over.green - under.green),
          under.blue + opacity * (over.blue - under.blue)};
}

}  // namespace slipwave::plot
