// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "scene/scene.hpp"

namespace slipwave {

/// One rung: what of a scene's numerics is varied.
struct AccuracySetting {
  int order = 5;
  double cfl = 0.9;
  double spacing_m = 0;
  SlipCorrection correction = SlipCorrection::centred;
  int time_order = 2;
  bool monotone = false;
  int zone_cells = 0;  // width of the absorbing layers; 0: as the scene has it
};

/// The same scene computed so: the same geology in other cells (regridded()), survey and recording untouched.
/// Throws a usage Error when the model's extent is no whole number of cells.
Scene<2> with_setting(const Scene<2>& scene, const AccuracySetting& setting);

/// "order 7, Courant 0.5, 2.5 m", and the order in time unless 2, and the slip correction where the scene
/// slips.
std::string name_of(const AccuracySetting& setting, const Scene<2>& scene);

/// Relative L2 differences of gathers. Velocities are taken together and so are stresses and pressure; the
/// larger of the two counts: m/s and Pa can not be added.
struct GatherError {
  double whole = 0;
  double late = 0;  // last quarter of the samples
};
/// Shot by shot the same traces in the same order.
GatherError gather_error(const std::vector<Gather>& found, const std::vector<Gather>& exact);

}  // namespace slipwave
