#pragma once

#include <cstdint>
#include <functional>

#include "base/archive.hpp"

namespace slipwave::solver {

/// Carries out the list of a TimeStep, step after step. Whichever does it, the fields and what is recorded
/// have the same bits.
class Executor {
 public:
  virtual ~Executor() = default;
  /// Advances by the steps first <= n < last, which begin where the last call ended, from 0 on. `pause` (may
  /// be empty) is asked now and then, by any thread; where it says so, no further step is begun. Returns the
  /// first step that was not made.
  virtual std::int64_t run(std::int64_t first, std::int64_t last, const std::function<bool()>& pause) = 0;
  std::int64_t run(std::int64_t first, std::int64_t last) { return run(first, last, {}); }
  /// To be called when fields have been set from outside.
  virtual void fields_changed() {}
  /// Writes or reads what it remembers between two calls of run().
  virtual void serialize(Archive& archive) = 0;
  virtual std::int64_t memory_bytes() const { return 0; }
  /// Cells advanced along z, all sweeps together.
  virtual std::int64_t swept_cells() const = 0;
};

}  // namespace slipwave::solver
