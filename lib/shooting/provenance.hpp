// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace slipwave {

/// What outputs say of the program that made them.
struct Provenance {
  std::string version;        // "slipwave 0.2.0"
  std::string command_line;   // without what changes no byte of the outputs
  std::string measured = "";  // the error that was measured; empty: none was
};

}  // namespace slipwave
