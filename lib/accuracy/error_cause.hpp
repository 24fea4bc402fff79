// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <string>

namespace slipwave {

/// Something that makes traces differ from exact ones.
struct ErrorCause {
  std::string name;     // "S waves, 6.1 cells per shortest wavelength"
  std::string remedy;   // "fit it (sw-layers --fit floor)"
  double error = 0;     // relative L2 over all traces, of this cause alone
  bool curable = true;  // smaller cells reduce it
};
/// What --monotone leaves unknown.
inline constexpr const char* flattened_extrema = "what --monotone takes from crests and troughs";

/// Errors beyond some tens of percent do not grow as small ones do: waves that are shifted by more than half
/// a period are as wrong as can be.
inline double saturated(double squared) { return std::sqrt(squared / (1 + squared / 2)); }

/// "12 %: free surface, a staircase of 15 degrees, however fine the cells: fit it (sw-layers --fit surface)".
std::string sentence_of(const ErrorCause& cause);

}  // namespace slipwave
