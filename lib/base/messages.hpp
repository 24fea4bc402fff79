// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>

#include "base/progress.hpp"

namespace slipwave {

/// What a long computation says meanwhile; what becomes of it is the caller's business (cli writes it to
/// standard error). All are set.
struct Messages {
  std::function<void(const std::string&sentence)> say, warn;
  /// What it took and gave, at its end: for who watches, or keeps a log. `sentence` is asked for only where
  /// there is such a one.
  std::function<void(const std::function<std::string()>& sentence)> close;
  /// Returns the progress of a loop with this title ("shot 3") over things of this name ("steps").
  std::function<Progress(const std::string& title, const std::string& things)> progress;
  /// Whether anybody gets to see a sentence: what takes long to find out need not be found out else.
  bool heard = true;
};

}  // namespace slipwave
