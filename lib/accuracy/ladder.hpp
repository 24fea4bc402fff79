// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "gather/trace.hpp"
#include "scene/scene.hpp"

namespace slipwave {

/// One way of computing a scene: what of its numerics is varied.
struct AccuracySetting {
  int order = 5;
  double cfl = 0.9;
  double spacing_m = 0;
  SlipCorrection correction = SlipCorrection::centred;
  int time_order = 2;
  bool monotone = false;
  int zone_cells = 0;  // width of the absorbing layers; 0: as the scene has it
  bool operator==(const AccuracySetting&) const = default;
};

/// Returns the setting of a scene as it is.
template <int D>
AccuracySetting setting_of(const Scene<D>& scene);

/// Returns a scene computed with this setting: the same geology in other cells (ModelInCells), survey and
/// recording untouched.
template <int D>
Scene<D> with_setting(const Scene<D>& scene, const AccuracySetting& setting);

/// The numerics of a scene with what a setting varies.
Numerics numerics_of(const AccuracySetting& setting, Numerics numerics);

/// "order 7, Courant 0.5, 2.5 m", and the order in time unless 2, and the slip correction where the scene
/// slips.
template <int D>
std::string name_of(const AccuracySetting& setting, const Scene<D>& scene);

/// Relative L2 norms of what is wrong with gathers. Velocities are taken together and so are stresses and
/// pressure; the larger of the two counts: m/s and Pa cannot be added.
struct GatherError {
  double whole = 0;
  double late = 0;  // last quarter of the samples
  /// The norms of each component by itself, in the order in which they are recorded.
  std::vector<std::pair<Component, double>> components;
  /// The trace that is most wrong, against all components of its unit that its receiver records: their
  /// relative error, and where it is.
  double worst = 0;
  std::size_t worst_shot = 0;  // of the list, from 0
  std::int64_t worst_channel = 0;
};
/// Returns the norms of what is `wrong` with what was found; shot by shot the same traces in the same order.
GatherError size_of_error(const std::vector<Gather>& wrong, const std::vector<Gather>& found);
/// Returns the norms of the error of what was found, against exact traces.
GatherError gather_error(const std::vector<Gather>& found, const std::vector<Gather>& exact);

/// a + factor b, trace by trace.
std::vector<Gather> sum_of(std::vector<Gather> a, const std::vector<Gather>& b, double factor);

}  // namespace slipwave
