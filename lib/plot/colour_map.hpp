// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "plot/colour.hpp"

namespace slipwave::plot {

/// The colours of numbers from 0 to 1, in 256 steps.
class ColourMap {
 public:
  /// "uniform", "blue-red", ...: all names, for options.
  static std::vector<std::string> names();
  /// uniform: dark blue over green to yellow. grey: black to white. blue-red: blue, white in the middle, red;
  /// red-blue the other way round. white-black. Of these, equal steps of a number are equal distances of
  /// colour as the eye sees them (Oklab), on each side of the middle where there is one. viridis and seismic
  /// are as matplotlib has them. Throws a usage Error that lists the names, or says what is wrong with jet.
  explicit ColourMap(const std::string& name);

  /// Numbers outside 0 .. 1 take the end's colour; NaN is no_data.
  Colour at(double number) const;
  /// Returns this colour as 0xffRRGGBB.
  std::uint32_t pixel(double number) const;
  /// Has a middle that stands for zero?
  bool diverging() const { return diverging_; }

 private:
  static constexpr int steps = 256;
  std::array<Colour, steps> colours_;
  bool diverging_ = false;
};

/// 0xffRRGGBB, rounded to nearest.
std::uint32_t pixel_of(const Colour& colour);

/// The colour of line number `index`, told from its neighbours also by the colour-blind; repeats after 8.
Colour line_colour(std::size_t index);

}  // namespace slipwave::plot
