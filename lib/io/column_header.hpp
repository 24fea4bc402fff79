// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "io/units.hpp"

namespace slipwave {

/// The name that stands above a column of numbers, in small letters, and the unit of what stands below it.
struct ColumnHeader {
  std::string name, unit;

  /// How its numbers become ones in the unit `into`, as people spell units; as they are where it names none.
  /// Throws Error naming the column where they do not, or where `into` is "" and it names one.
  UnitConversion conversion(const std::string& into) const;
};

/// Returns the header that "VP.M/S", "vp (m/s)", "vp [m/s]" or "vp" gives.
ColumnHeader column_header(std::string_view cell);

/// Headers that stand between blanks, where a unit in brackets belongs to the name before it.
std::vector<ColumnHeader> column_headers(const std::vector<std::string_view>& words);

/// Whether words on the first line of columns are headers: none of them is a number. Throws Error at one that
/// seems to be a number with a decimal comma.
bool are_headers(const std::vector<std::string_view>& words);

}  // namespace slipwave
