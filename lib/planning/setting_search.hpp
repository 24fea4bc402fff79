// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <optional>

#include "planning/scene_runs.hpp"

namespace slipwave {

/// What is known of the errors of a scene's settings: what dispersion does to direct waves, as it is derived,
/// times a factor that was measured, and all the rest, which falls with a power of the size of cells.
struct KnownErrors {
  double dispersion = 1;
  double rest = 0, rest_m = 1;  // in cells of that size
  double rest_order = 2;
};

/// The choice of the cheapest setting for an error.
template <int D>
class SettingSearch {
 public:
  /// The runs outlive this. `fits` says whether a setting can be run at all, by memory and time.
  SettingSearch(const SceneRuns<D>& runs, std::function<bool(const AccuracySetting&)> fits);

  /// The error expected of a setting.
  double expected(const AccuracySetting& setting, const KnownErrors& known) const;
  /// What dispersion does to direct waves.
  double dispersion(const AccuracySetting& setting) const;
  /// Its cost: cells times steps, times what its scheme takes for them against order 5.
  double cost(const AccuracySetting& setting) const;
  /// The cheapest of all orders from 3 on, both orders in time, Courant numbers that may pay and cells of any
  /// size, whose expected error is below `wanted`; of a width of edges in cells, 0: as they are. Costs are in
  /// fixed proportions, so the same scene gets the same choice on every machine. Nothing where none fits.
  std::optional<AccuracySetting> cheapest(double wanted, const KnownErrors& known, int zone_cells) const;

 private:
  const SceneRuns<D>& runs_;
  const Scene<D>& scene_;
  std::function<bool(const AccuracySetting&)> fits_;
  double largest_m_;
};

}  // namespace slipwave
