// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>

#include "base/archive.hpp"

namespace slipwave {

/// Writes or reads all that the remaining steps of a shot depend on.
using Serialize = std::function<void(Archive&)>;

/// The progress of a shot.
struct ShotPlace {
  std::int64_t done = 0, steps = 0;
};

/// Decides whether a shot pauses between two time tiles.
class Pauses {
 public:
  virtual ~Pauses() = default;
  /// Before the first step: may restore the state that an earlier run of the shot has written.
  virtual void begin(const Serialize& keep) = 0;
  /// Whether to pause as soon as possible. Called before each time tile, by any thread.
  virtual bool wanted() = 0;
  /// Called when no step is in progress. An exception ends the shot.
  virtual void pause(const Serialize& keep, const ShotPlace& place) = 0;
};

}  // namespace slipwave
