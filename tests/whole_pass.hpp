#pragma once

#include "solver/pass.hpp"
#include "solver/state.hpp"

namespace slipwave::solver {

/// A pass before and after recording, on all lines, while nothing else is under way.
template <int D>
void run_everywhere(Pass& pass, const StepTime& time, const Layout<D>& layout) {
  pass.begin(time);
  for (std::int64_t line = 0; line < layout.lines(); ++line) pass.run(time, line, {0, layout.shape()[0]});
}
template <int D>
void run_after_everywhere(Pass& pass, const StepTime& time, const Layout<D>& layout) {
  for (std::int64_t line = 0; line < layout.lines(); ++line)
    pass.run_after(time, line, {0, layout.shape()[0]});
}

}  // namespace slipwave::solver
