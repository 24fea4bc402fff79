#pragma once

#include <string>
#include <vector>

namespace slipwave::plot {

/// A picture as the bytes of its file, and sentences about what it does not show.
struct Picture {
  std::vector<char> bytes;
  std::vector<std::string> notes = {};
};

}  // namespace slipwave::plot
