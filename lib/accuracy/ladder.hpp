#pragma once

#include <vector>

#include "accuracy/table.hpp"
#include "base/progress.hpp"
#include "scene/scene.hpp"

namespace slipwave {

/// One rung: what of a scene's numerics is varied.
struct AccuracySetting {
  int order = 5;
  double cfl = 0.9;
  double spacing_m = 0;
  SlipCorrection correction = SlipCorrection::second;
  int time_order = 2;
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

/// All shots of a checked scene. `seconds` receives the processor time they took.
std::vector<Gather> shoot_all(const Scene<2>& scene, double& seconds, const Progress& progress = {});

/// Runs the scene by a setting and measures it against `exact`. Empty `exact`: the errors are NaN.
/// `result` receives the gathers if given.
AccuracyRow measured(const Scene<2>& scene, const AccuracySetting& setting, const std::vector<Gather>& exact,
                     const Progress& progress = {}, std::vector<Gather>* result = nullptr);

}  // namespace slipwave
