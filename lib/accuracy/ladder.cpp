// SPDX-License-Identifier: BSD-3-Clause
#include "accuracy/ladder.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>

#include "base/error.hpp"
#include "model/resample.hpp"

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
  changed.numerics.monotone = setting.monotone;
  if (setting.zone_cells > 0) changed.numerics.zone_cells = setting.zone_cells;
  return changed;
}

std::string name_of(const AccuracySetting& setting, const Scene<2>& scene) {
  std::string name =
      "order " + std::to_string(setting.order) +
      (setting.time_order == 2 ? "" : ", " + std::to_string(setting.time_order) + " in time") +
      (setting.monotone ? ", monotone" : "") + ", Courant " + shown(setting.cfl) + ", " +
      shown(setting.spacing_m, 4) + " m" +
      (setting.zone_cells == 0 ? "" : ", edges of " + std::to_string(setting.zone_cells) + " cells");
  if (scene.slips())
    name += setting.correction == SlipCorrection::first     ? ", first-order slip"
            : setting.correction == SlipCorrection::second  ? ", second-order slip"
            : setting.correction == SlipCorrection::centred ? ", centred slip"
                                                            : ", exponential slip";
  return name;
}

GatherError gather_error(const std::vector<Gather>& found, const std::vector<Gather>& exact) {
  std::map<std::string, Sums> whole, late;  // by unit: what is alike counts together
  for (std::size_t shot = 0; shot < exact.size(); ++shot)
    for (std::size_t n = 0; n < exact[shot].traces.size(); ++n) {
      const auto& a = found[shot].traces[n].samples;
      const auto& b = exact[shot].traces[n].samples;
      const std::string unit = unit_of(exact[shot].traces[n].header.component);
      auto &all = whole[unit], &last = late[unit];
      for (std::size_t sample = 0; sample < b.size(); ++sample) {
        const double wrong = (a[sample] - b[sample]) * (a[sample] - b[sample]);
        all.wrong += wrong;
        all.all += b[sample] * b[sample];
        if (4 * sample < 3 * b.size()) continue;
        last.wrong += wrong;
        last.all += b[sample] * b[sample];
      }
    }
  // A NaN counts as the larger.
  const auto largest = [](const std::map<std::string, Sums>& of_units) {
    double most = 0;
    for (const auto& [unit, sums] : of_units)
      if (const double one = sums.relative(); std::isnan(one) || one > most) most = one;
    return most;
  };
  return {largest(whole), largest(late)};
}

}  // namespace slipwave
