// SPDX-License-Identifier: BSD-3-Clause
#include "accuracy/ladder.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <tuple>

#include "base/error.hpp"
#include "base/instantiate.hpp"
#include "build/model_in_cells.hpp"
#include "scene/bands.hpp"

namespace slipwave {
namespace {

/// Sums over samples: of the squares of what is wrong and of what it is measured against.
struct Sums {
  double wrong = 0, all = 0;
  double relative() const {
    if (all > 0) return std::sqrt(wrong / all);
    return wrong > 0 ? std::numeric_limits<double>::infinity() : 0;
  }
};

/// A NaN counts as the largest.
template <class Key>
std::pair<Key, double> largest(const std::map<Key, Sums>& of) {
  std::pair<Key, double> most{};
  for (const auto& [key, sums] : of)
    if (const double one = sums.relative(); std::isnan(one) || one > most.second) most = {key, one};
  return most;
}

}  // namespace

template <int D>
AccuracySetting setting_of(const Scene<D>& scene) {
  const auto& numerics = scene.numerics;
  return {numerics.order,
          numerics.time_step_s ? *numerics.time_step_s / stable_time_step_s(scene) : numerics.cfl,
          scene.model.grid().spacing_m,
          numerics.correction,
          numerics.time_order,
          numerics.monotone,
          numerics.zone_cells};
}

template <int D>
Scene<D> with_setting(const Scene<D>& scene, const AccuracySetting& setting) {
  auto changed = setting.spacing_m == scene.model.grid().spacing_m
                     ? scene
                     : with_model(scene, in_cells_of(scene.model, setting.spacing_m, scene.attenuation));
  changed.numerics = numerics_of(setting, scene.numerics);
  return changed;
}

Numerics numerics_of(const AccuracySetting& setting, Numerics numerics) {
  numerics.order = setting.order;
  numerics.cfl = setting.cfl;
  numerics.time_step_s.reset();
  numerics.correction = setting.correction;
  numerics.time_order = setting.time_order;
  numerics.monotone = setting.monotone;
  if (setting.zone_cells > 0) numerics.zone_cells = setting.zone_cells;
  return numerics;
}

template <int D>
std::string name_of(const AccuracySetting& setting, const Scene<D>& scene) {
  const auto& bands = scene.numerics.bands;
  const std::string cells = bands.empty()
                                ? shown(setting.spacing_m, 4) + " m"
                                : shown(resized(bands, setting.spacing_m / scene.model.grid().spacing_m), 4);
  std::string name =
      "order " + std::to_string(setting.order) +
      (setting.time_order == 2 ? "" : ", " + std::to_string(setting.time_order) + " in time") +
      (setting.monotone ? ", monotone" : "") + ", Courant " + shown(setting.cfl, 3) + ", " + cells +
      (setting.zone_cells == 0 ? "" : ", edges of " + std::to_string(setting.zone_cells) + " cells");
  if (scene.slips())
    name += setting.correction == SlipCorrection::first     ? ", first-order slip"
            : setting.correction == SlipCorrection::second  ? ", second-order slip"
            : setting.correction == SlipCorrection::centred ? ", centred slip"
                                                            : ", exponential slip";
  return name;
}

GatherError size_of_error(const std::vector<Gather>& wrong, const std::vector<Gather>& found) {
  std::map<std::string, Sums> whole, late;  // by unit: what is alike counts together
  std::map<Component, Sums> components;
  std::map<std::tuple<std::size_t, std::int64_t, std::string>, Sums> receivers;
  GatherError error;
  for (std::size_t shot = 0; shot < found.size(); ++shot)
    for (std::size_t n = 0; n < found[shot].traces.size(); ++n) {
      const auto& header = found[shot].traces[n].header;
      const auto& a = wrong[shot].traces[n].samples;
      const auto& b = found[shot].traces[n].samples;
      const std::string unit = unit_of(header.component);
      Sums trace, last;
      for (std::size_t sample = 0; sample < b.size(); ++sample) {
        trace.wrong += a[sample] * a[sample];
        trace.all += b[sample] * b[sample];
        if (4 * sample < 3 * b.size()) continue;
        last.wrong += a[sample] * a[sample];
        last.all += b[sample] * b[sample];
      }
      const auto add = [](Sums& to, const Sums& sums) { to.wrong += sums.wrong, to.all += sums.all; };
      if (components.count(header.component) == 0) error.components.emplace_back(header.component, 0);
      add(whole[unit], trace);
      add(late[unit], last);
      add(components[header.component], trace);
      add(receivers[{shot, header.channel, unit}], trace);
    }
  error.whole = largest(whole).second;
  error.late = largest(late).second;
  for (auto& [component, share] : error.components) share = components[component].relative();
  // What is below the rounding of all others was not recorded at all.
  constexpr double rounding = std::numeric_limits<float>::epsilon();
  std::erase_if(receivers, [&](const auto& entry) {
    const double all = whole[std::get<2>(entry.first)].all;
    return all > 0 && entry.second.all <= rounding * rounding * all;
  });
  const auto [place, worst] = largest(receivers);
  error.worst = worst;
  error.worst_shot = std::get<0>(place);
  error.worst_channel = std::get<1>(place);
  return error;
}

GatherError gather_error(const std::vector<Gather>& found, const std::vector<Gather>& exact) {
  return size_of_error(sum_of(found, exact, -1), exact);
}

std::vector<Gather> sum_of(std::vector<Gather> a, const std::vector<Gather>& b, double factor) {
  for (std::size_t shot = 0; shot < a.size(); ++shot)
    for (std::size_t n = 0; n < a[shot].traces.size(); ++n) {
      auto& samples = a[shot].traces[n].samples;
      const auto& others = b[shot].traces[n].samples;
      for (std::size_t sample = 0; sample < samples.size(); ++sample)
        samples[sample] += factor * others[sample];
    }
  return a;
}

SLIPWAVE_INSTANTIATE_D(FUNCTION, setting_of);
SLIPWAVE_INSTANTIATE_D(FUNCTION, with_setting);
template std::string name_of(const AccuracySetting&, const Scene<2>&);
template std::string name_of(const AccuracySetting&, const Scene<3>&);

}  // namespace slipwave
