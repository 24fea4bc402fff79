// SPDX-License-Identifier: BSD-3-Clause
#include "planning/setting_search.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "base/instantiate.hpp"
#include "planning/measured_error.hpp"

namespace slipwave {
namespace {

/// Orders in space and time, and the Courant numbers that may pay with them (theory.md 1.1: time order 4 pays
/// with orders from 7 on and long steps only; the longest sustain short waves near a force).
struct Scheme {
  int order, time_order;
  double cost;  // of a step, over that of order 5 (tests/bench/orders.sh): what is chosen must not hang on
                // the load of the moment
  std::vector<double> courant_numbers;
};
const std::vector<Scheme>& schemes() {
  static const std::vector<Scheme> all = {{3, 2, 0.78, {0.9, 0.7, 0.5}},
                                          {5, 2, 1, {0.9, 0.7, 0.5, 0.35}},
                                          {7, 2, 1.3, {0.9, 0.7, 0.5, 0.35}},
                                          {9, 2, 1.6, {0.9, 0.7, 0.5, 0.35}},
                                          {11, 2, 1.9, {0.9, 0.7, 0.5, 0.35, 0.25}},
                                          {7, 4, 6.2, {1.9, 1.5}},
                                          {9, 4, 7.7, {1.9, 1.5}},
                                          {11, 4, 9.7, {1.9, 1.5}}};
  return all;
}

/// Fewer cells than this in the shortest wave that matters hold no wave in the larger cells that it is
/// measured in.
constexpr double fewest_cells_tried = 2.5;
/// Cells are split into this many a side at most.
constexpr double most_parts = 16;

/// Sizes are chosen to three digits.
double rounded_down(double size_m) {
  const double unit = std::pow(10, std::floor(std::log10(size_m)) - 2);
  return std::floor(size_m / unit * (1 + 1e-9)) * unit;
}

}  // namespace

template <int D>
SettingSearch<D>::SettingSearch(const SceneRuns<D>& runs, std::function<bool(const AccuracySetting&)> fits)
    : runs_(runs),
      scene_(runs.scene()),
      fits_(std::move(fits)),
      largest_m_(slowest_wave(scene_.model.medium).speed / highest_frequency_hz(scene_.survey) /
                 fewest_cells_tried) {
  // No receiver may come to stand in the cells that a source is spread over.
  largest_m_ = std::min(largest_m_, nearest_receiver_m(runs) / cells_of_a_source);
  // The smallest side must stay a model.
  constexpr double fewest_along_a_side = 10;
  const auto& grid = scene_.model.grid();
  for (const auto cells : grid.shape)
    largest_m_ = std::min(largest_m_, grid.spacing_m * std::max(1., double(cells) / fewest_along_a_side));
}

template <int D>
double SettingSearch<D>::dispersion(const AccuracySetting& setting) const {
  return runs_.direct().together(runs_.discretisation_of(setting));
}

template <int D>
double SettingSearch<D>::expected(const AccuracySetting& setting, const KnownErrors& known) const {
  return std::hypot(known.dispersion * dispersion(setting),
                    known.rest * std::pow(setting.spacing_m, known.rest_order));
}

template <int D>
KnownErrors SettingSearch<D>::explained(std::vector<SettingRun> runs, double rest_order) const {
  std::sort(runs.begin(), runs.end(), [](const auto& a, const auto& b) { return a.error < b.error; });
  // Squares of what one unit of k and of r makes of the error of a run, relative to it.
  const auto by_dispersion = [&](const SettingRun& run) {
    return std::pow(dispersion(run.setting) / run.error, 2);
  };
  const auto by_rest = [&](const SettingRun& run) {
    return std::pow(std::pow(run.setting.spacing_m, rest_order) / run.error, 2);
  };
  const auto& best = runs.front();
  const double d = by_dispersion(best), r = by_rest(best);
  const double worst_off =
      std::pow(runs_.direct().latest(runs_.discretisation_of(best.setting)) / best.error, 2);
  const auto known_by = [&](double k) {
    KnownErrors known;
    known.dispersion = std::sqrt(k);
    known.rest = std::sqrt(std::max(0., 1 - k * d) / r);
    known.rest_order = rest_order;
    return known;
  };
  if (runs.size() == 1) return known_by(d > 0 ? std::min(1., worst_off) / d : 0);
  // Each two runs have a k; that counts which all of them are nearest to, by factors.
  const double most = d > 0 ? 1 / d : 0;
  KnownErrors nearest;
  double least = std::numeric_limits<double>::infinity();
  for (const auto& one : runs)
    for (const auto& other : runs) {
      const double determinant = by_dispersion(one) * by_rest(other) - by_rest(one) * by_dispersion(other);
      const double both = determinant == 0 ? 0 : (by_rest(other) - by_rest(one)) / determinant;
      // Of the direct waves all of it is there, as far as the error holds it.
      const auto known = known_by(std::clamp(both, std::min(1., most), most));
      double away = 0;
      for (const auto& run : runs) away += std::pow(std::log(expected(run.setting, known) / run.error), 2);
      if (away < least) nearest = known, least = away;
    }
  return nearest;
}

template <int D>
double SettingSearch<D>::cost(const AccuracySetting& setting) const {
  const auto scheme = std::find_if(schemes().begin(), schemes().end(), [&](const Scheme& one) {
    return one.order == setting.order && one.time_order == setting.time_order;
  });
  const int zone = setting.zone_cells > 0 ? setting.zone_cells
                                          : slipwave::zone_cells(scene_, scene_.survey.sources.front());
  double cost = (scheme == schemes().end() ? 1 : scheme->cost) / (setting.cfl * setting.spacing_m);
  for (int axis = 0; axis < D; ++axis) {
    const auto& grid = scene_.model.grid();
    double cells = double(grid.shape[std::size_t(axis)]) * grid.spacing_m / setting.spacing_m;
    for (const int side : {0, 1})
      if (scene_.edges[axis][side] == EdgeLaw::absorbing) cells += zone;
    cost *= cells;
  }
  return cost;
}

template <int D>
std::optional<AccuracySetting> SettingSearch<D>::cheapest(double wanted, const KnownErrors& known,
                                                          int zone_cells) const {
  std::optional<AccuracySetting> best;
  const double finest_m = scene_.model.grid().spacing_m / most_parts;
  for (const auto& scheme : schemes())
    for (const double cfl : scheme.courant_numbers) {
      // Sweeps back in time have no criterion of monotonicity.
      if (scheme.time_order == 4 && scene_.numerics.monotone) continue;
      AccuracySetting setting{scheme.order,      cfl,
                              largest_m_,        scene_.numerics.correction,
                              scheme.time_order, scene_.numerics.monotone,
                              zone_cells};
      // The largest cells that do, by halving; a larger size is as large an error at least.
      const double largest_m = std::min(largest_m_, known.largest_m);
      double low = std::log(std::min(finest_m, largest_m)), high = std::log(largest_m);
      for (int n = 0; n < 14; ++n) {
        setting.spacing_m = std::exp((low + high) / 2);
        (expected(setting, known) <= wanted ? low : high) = (low + high) / 2;
      }
      setting.spacing_m = rounded_down(std::exp(low));
      if (expected(setting, known) > wanted || (best && cost(setting) >= cost(*best)) || !fits_(setting))
        continue;
      best = setting;
    }
  return best;
}

SLIPWAVE_INSTANTIATE_D(TYPE, class SettingSearch);

}  // namespace slipwave
