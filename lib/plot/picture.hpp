// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "plot/place.hpp"

namespace slipwave::plot {

/// A picture as the bytes of its file, where its texts stand, and sentences about what it does not show.
struct Picture {
  std::vector<char> bytes;
  std::vector<Rect> words = {};
  std::vector<std::string> notes = {};
};

}  // namespace slipwave::plot
