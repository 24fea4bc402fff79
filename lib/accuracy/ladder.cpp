#include "accuracy/ladder.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "accuracy/plan.hpp"
#include "base/error.hpp"
#include "base/processor_time.hpp"
#include "model/resample.hpp"
#include "solver/simulation.hpp"

namespace slipwave {
namespace {

/// Sums over samples: of the differences and of the exact values.
struct Sums {
  double wrong = 0, all = 0;
  double relative() const {
    if (all > 0) return std::sqrt(wrong / all);
    return wrong > 0 ? std::numeric_limits<double>::infinity() : 0;
  }
};

}  // namespace

Scene<2> with_setting(const Scene<2>& scene, const AccuracySetting& setting) {
  Scene<2> changed = scene;
  if (setting.spacing_m != scene.model.grid().spacing_m)
    changed.model = regridded(scene.model, setting.spacing_m);
  changed.numerics.order = setting.order;
  changed.numerics.cfl = setting.cfl;
  changed.numerics.time_step_s.reset();
  changed.numerics.correction = setting.correction;
  changed.numerics.time_order = setting.time_order;
  return changed;
}

std::string name_of(const AccuracySetting& setting, const Scene<2>& scene) {
  std::string name = "order " + std::to_string(setting.order) +
                     (setting.time_order == 2 ? "" : ", " + std::to_string(setting.time_order) + " in time") +
                     ", Courant " + shown(setting.cfl) + ", " + shown(setting.spacing_m, 4) + " m";
  if (scene.slips())
    name += setting.correction == SlipCorrection::first    ? ", first-order slip"
            : setting.correction == SlipCorrection::second ? ", second-order slip"
                                                           : ", exponential slip";
  return name;
}

GatherError gather_error(const std::vector<Gather>& found, const std::vector<Gather>& exact) {
  std::array<Sums, 2> whole, late;  // velocities, stresses
  for (std::size_t shot = 0; shot < exact.size(); ++shot)
    for (std::size_t n = 0; n < exact[shot].traces.size(); ++n) {
      const auto& a = found[shot].traces[n].samples;
      const auto& b = exact[shot].traces[n].samples;
      const bool stress = std::string(unit_of(exact[shot].traces[n].header.component)) == "Pa";
      for (std::size_t sample = 0; sample < b.size(); ++sample) {
        const double wrong = (a[sample] - b[sample]) * (a[sample] - b[sample]);
        whole[stress].wrong += wrong;
        whole[stress].all += b[sample] * b[sample];
        if (4 * sample < 3 * b.size()) continue;
        late[stress].wrong += wrong;
        late[stress].all += b[sample] * b[sample];
      }
    }
  // A NaN counts as the larger.
  const auto larger = [](double a, double b) { return std::isnan(a) || a > b ? a : b; };
  return {larger(whole[0].relative(), whole[1].relative()), larger(late[0].relative(), late[1].relative())};
}

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
  row.courant = setting.cfl;  // that of the plan differs by rounding
  row.spacing_m = setting.spacing_m;
  if (scene.slips()) row.slip_order = int(setting.correction) + 1;
  row.cells = expected.computed.size();
  row.steps = expected.steps;
  row.predicted_error = expected.error.overall();
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
