// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdlib>
#include <string_view>

namespace slipwave {

/// Whether SLIPWAVE_LONG asks for the long form of the tests.
inline bool long_form() {
  const char* const asked = std::getenv("SLIPWAVE_LONG");
  return asked && std::string_view(asked) != "" && std::string_view(asked) != "0";
}

}  // namespace slipwave
