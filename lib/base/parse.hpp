// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace slipwave {

// The notation of the command line. Every function takes the whole text (nothing may follow), accepts finite
// numbers only, and throws a usage Error "found '12x', expected a number"; callers put the option in front.

/// "12.5", "-3", "1e-3".
double parse_number(std::string_view text);
/// "12", "-3".
std::int64_t parse_integer(std::string_view text);
/// Numbers with `separator` between them: "1,2,3". At least one.
std::vector<double> parse_numbers(std::string_view text, char separator);
/// The parts of `text` between separators: "a:b" gives "a", "b"; "" gives one empty part.
std::vector<std::string> split(std::string_view text, char separator);
/// "vx, vz, p"; `last` stands before the last one: "vx, vz or p".
std::string joined(const std::vector<std::string>& parts, const std::string& last = ", ");
/// The parts with `between` between them: the inverse of split().
std::string joined_by(const std::vector<std::string>& parts, std::string_view between);

/// "X,Z" or "X,Y,Z", in metres.
template <int D>
std::array<double, D> parse_point(std::string_view text);

/// Points on a line, ends included: "X0:X1:DX,Z". Any coordinate may be such a range (several ranges make a
/// lattice, x fastest) or a number; without a range it is one point. DX must lead from X0 to X1 in whole
/// steps (to 1e-6 of a step). At most ten million points.
template <int D>
std::vector<std::array<double, D>> parse_line(std::string_view text);

template <int D>
struct Box {
  std::array<double, D> low_m{}, high_m{};
  bool contains(const std::array<double, D>& point) const {
    for (int axis = 0; axis < D; ++axis) {
      if (!(point[axis] >= low_m[axis] && point[axis] <= high_m[axis])) return false;
    }
    return true;
  }
};

/// "X0:X1,Z0:Z1" or "X0:X1,Y0:Y1,Z0:Z1"; each low end below its high end.
template <int D>
Box<D> parse_box(std::string_view text);

/// "LXxLZ" or "LXxLYxLZ", each above zero, in metres.
template <int D>
std::array<double, D> parse_size(std::string_view text);

/// "NXxNZ" or "NXxNYxNZ", each a whole number above zero.
template <int D>
std::array<std::int64_t, D> parse_shape(std::string_view text);

}  // namespace slipwave
