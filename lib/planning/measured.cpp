// SPDX-License-Identifier: BSD-3-Clause
#include "planning/measured.hpp"

#include <limits>

#include "base/instantiate.hpp"
#include "planning/plan.hpp"

namespace slipwave {

template <int D>
AccuracyRow measured(SceneRuns<D>& runs, const AccuracySetting& setting, const std::vector<Gather>& exact) {
  const auto expected = plan(runs.scene_of(setting));
  AccuracyRow row;
  row.order = setting.order;
  row.time_order = setting.time_order;
  row.monotone = setting.monotone;
  row.courant = setting.cfl;  // that of the plan differs by rounding
  row.spacing_m = setting.spacing_m;
  if (runs.scene().slips()) row.slip_order = int(setting.correction) + 1;
  row.cells = expected.computed.size();
  row.steps = expected.steps;
  row.memory_bytes = double(expected.memory_bytes);
  const auto& run = runs.run(setting);
  row.seconds = run.seconds;
  row.error = row.late_error = std::numeric_limits<double>::quiet_NaN();
  if (exact.empty()) return row;
  const auto error = gather_error(run.observed, exact);
  row.error = error.whole;
  row.late_error = error.late;
  return row;
}

SLIPWAVE_INSTANTIATE_D(FUNCTION, measured);

}  // namespace slipwave
