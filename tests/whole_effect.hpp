// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "solver/effect/effect.hpp"

namespace slipwave::solver {

/// An effect before and after recording, on all rows, while no other step is in progress.
template <int D, class Real>
void run_everywhere(Effect<D, Real>& effect, const StepTime& time, State<D, Real>& state) {
  effect.begin(time);
  for (std::int64_t row = 0; row < state.layout.lines(); ++row)
    effect.apply(time, state.row_fields(row), {0, state.layout.shape()[0]});
}
template <int D, class Real>
void run_after_everywhere(Effect<D, Real>& effect, const StepTime& time, State<D, Real>& state) {
  for (std::int64_t row = 0; row < state.layout.lines(); ++row)
    effect.apply_after_record(time, state.row_fields(row), {0, state.layout.shape()[0]});
}

}  // namespace slipwave::solver
