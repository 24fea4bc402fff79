#include "accuracy/ladder.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

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

}  // namespace slipwave
