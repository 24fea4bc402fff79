// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <limits>
#include <optional>
#include <vector>

#include "planning/scene_runs.hpp"

namespace slipwave {

/// What is known of the errors of a scene's settings: what dispersion does to direct waves, as it is derived,
/// times a factor that was measured (other waves travel longer, or are slower), and all the rest, which falls
/// with a power of the size of cells.
struct KnownErrors {
  double dispersion = 1;
  double rest = 0;  // in cells of 1 m
  double rest_order = 2;
  double largest_m = std::numeric_limits<double>::infinity();  // cells that were too large are the largest
};

/// A setting that was run, and the error measured of it: relative L2.
struct SettingRun {
  AccuracySetting setting;
  double error = 0;
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
  /// What explains the errors of the runs, error^2 = (k D)^2 + (r h^p)^2 in cells of h: the best one exactly,
  /// and all of them as well as can be, k being 1 at least as far as no error is less than D; of
  /// one run as dispersion alone, as far as no wave is worse off than the slowest one that travels as long as
  /// the traces last: cells that are too large by that guess are found out when they are run, those that are
  /// too small never.
  KnownErrors explained(std::vector<SettingRun> runs, double rest_order) const;
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
