#pragma once

#include "solver/effect/effect.hpp"
#include "solver/sweep/state.hpp"

namespace slipwave::solver {

/// A pass before and after recording, on all lines, while nothing else is under way.
template <int D>
void run_everywhere(Effect& pass, const StepTime& time, const Layout<D>& layout) {
  pass.begin(time);
  for (std::int64_t line = 0; line < layout.lines(); ++line) pass.run(time, line, {0, layout.shape()[0]});
}
template <int D>
void run_after_everywhere(Effect& pass, const StepTime& time, const Layout<D>& layout) {
  for (std::int64_t line = 0; line < layout.lines(); ++line)
    pass.run_after_record(time, line, {0, layout.shape()[0]});
}

}  // namespace slipwave::solver
