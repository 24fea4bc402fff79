#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "base/archive.hpp"
#include "solver/kernels/kernels.hpp"

namespace slipwave::solver {

/// The instant a pass works for: the end of step number `step` (0-based).
struct StepTime {
  std::int64_t step = 0;
  double dt_s = 0;
  double end_s() const { return double(step + 1) * dt_s; }
};

/// What a pass does to how many cells, for --plan.
struct EffectShare {
  std::string name;
  std::int64_t cells = 0;
};

/// One part of a time step: it exists only in scenes that call for it. It works line by line and on part of a
/// line at a time, as the fields come by; several steps may be under way at once, on different lines.
class Effect {
 public:
  virtual ~Effect() = default;
  /// Before the first line of each step, step after step.
  virtual void begin(const StepTime&) {}
  /// Brings the fields of these columns of a line to time.end_s(); then they are recorded.
  virtual void run(const StepTime& time, std::int64_t line, const IndexRange& columns) = 0;
  /// What the next step begins with, after recording.
  virtual void run_after_record(const StepTime&, std::int64_t, const IndexRange&) {}
  /// What it does, for --plan.
  virtual std::string name() const = 0;
  /// Cells it works on.
  virtual std::int64_t cells() const = 0;
  /// The same, with the parts it consists of.
  virtual std::vector<EffectShare> effects() const { return {{name(), cells()}}; }
  /// Lines whose fields it changes or needs whole at the end of a step, sweeps along x included. On all other
  /// lines the half sweeps along x of neighbouring steps are one. Only asked where acts() says so.
  virtual std::span<const std::int64_t> lines() const { return {}; }
  /// Whether it works on other lines too, where what two half sweeps have become comes to it as one.
  virtual bool acts_between_steps() const { return false; }
  /// Whether it may make something of a line that is zero.
  virtual bool injects(const StepTime&, std::int64_t) const { return false; }
  /// Whether it does anything at that instant.
  virtual bool active(const StepTime&) const { return true; }
  /// Hands over all that it remembers from one step to the next, fields apart; called when no step is under
  /// way.
  virtual void serialize(Archive& archive) = 0;

  /// Steps that may be under way at once: what begin() made for a step must last that long.
  static constexpr std::int64_t most_steps_in_progress = 32;
};

}  // namespace slipwave::solver
