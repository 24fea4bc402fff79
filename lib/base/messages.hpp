// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>

#include "base/progress.hpp"

namespace slipwave {

/// What a long computation says meanwhile; what becomes of it is the caller's business (cli writes it to
/// standard error). All three are set.
struct Messages {
  std::function<void(const std::string&sentence)> say, warn;
  /// Of a loop with this title ("shot 3").
  std::function<Progress(const std::string& title)> progress;
};

}  // namespace slipwave
