#pragma once

#include <cstdint>
#include <span>
#include <string>

namespace slipwave::solver {

/// The instant a pass works for: the end of step number `step` (0-based).
struct StepTime {
  std::int64_t step = 0;
  double dt_s = 0;
  double end_s() const { return double(step + 1) * dt_s; }
};

/// One part of a time step: it exists only in scenes that call for it.
class Pass {
 public:
  virtual ~Pass() = default;
  /// Brings the fields to time.end_s(); then they are recorded.
  virtual void run(const StepTime& time) = 0;
  /// What the next step begins with, after recording.
  virtual void run_after(const StepTime&) {}
  /// What it does, for --plan.
  virtual std::string name() const = 0;
  /// Cells it works on.
  virtual std::int64_t cells() const = 0;
  /// Lines whose fields it changes or needs whole at the end of a step, sweeps along x included. On all other
  /// lines the half sweeps along x of neighbouring steps are one. Only asked where acts() says so.
  virtual std::span<const std::int64_t> lines() const { return {}; }
  /// Whether it does anything at that instant.
  virtual bool acts(const StepTime&) const { return true; }
};

}  // namespace slipwave::solver
