// SPDX-License-Identifier: BSD-3-Clause
#include "planning/measured.hpp"

#include <limits>

#include "base/processor_time.hpp"
#include "planning/plan.hpp"
#include "solver/simulation.hpp"

namespace slipwave {

std::vector<Gather> shoot_all(const Scene<2>& scene, double& seconds, const Progress& progress) {
  std::vector<Gather> gathers;
  const double start = processor_time_s();
  for (std::size_t shot = 1; shot <= scene.survey.sources.size(); ++shot)
    gathers.push_back(shoot(scene, shot, progress));
  seconds = processor_time_s() - start;
  return gathers;
}

AccuracyRow measured(const Scene<2>& scene, const AccuracySetting& setting, const std::vector<Gather>& exact,
                     const Progress& progress, std::vector<Gather>* result) {
  const auto changed = with_setting(scene, setting);
  check(changed);
  const auto expected = plan(changed);
  AccuracyRow row;
  row.order = setting.order;
  row.time_order = setting.time_order;
  row.monotone = setting.monotone;
  row.courant = setting.cfl;  // that of the plan differs by rounding
  row.spacing_m = setting.spacing_m;
  if (scene.slips()) row.slip_order = int(setting.correction) + 1;
  row.cells = expected.computed.size();
  row.steps = expected.steps;
  // What the criterion takes from extrema is not known beforehand.
  row.predicted_error =
      setting.monotone ? std::numeric_limits<double>::quiet_NaN() : expected.error.overall();
  row.predicted_seconds = expected.seconds;
  row.memory_bytes = double(expected.memory_bytes);
  auto gathers = shoot_all(changed, row.seconds, progress);
  row.error = row.late_error = std::numeric_limits<double>::quiet_NaN();
  if (!exact.empty()) {
    const auto error = gather_error(gathers, exact);
    row.error = error.whole;
    row.late_error = error.late;
  }
  if (result) *result = std::move(gathers);
  return row;
}

}  // namespace slipwave
