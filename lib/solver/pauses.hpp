#pragma once

#include <cstdint>
#include <functional>

#include "base/archive.hpp"

namespace slipwave {

/// Gives all that the steps to come of a shot depend on.
using Serialize = std::function<void(Archive&)>;

/// Where a shot is.
struct ShotPlace {
  std::int64_t done = 0, steps = 0;
};

/// Somebody who may let a shot pause between two time tiles.
class Pauses {
 public:
  virtual ~Pauses() = default;
  /// Before the first step: may fill the shot with what an earlier run of it has kept.
  virtual void begin(const Serialize& keep) = 0;
  /// Whether to pause as soon as may be. Asked before each pass, by any thread.
  virtual bool wanted() = 0;
  /// No step is in progress. What it throws ends the shot.
  virtual void pause(const Serialize& keep, const ShotPlace& place) = 0;
};

}  // namespace slipwave
