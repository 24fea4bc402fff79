// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "anisotropic_cube.hpp"

namespace slipwave::solver {

/// A cluster of fractures amid a cube of one rock, under a force above it.
inline Scene<3> cluster(const Material& rock, const FractureSet<3>& set,
                        const Index<3>& shape = {18, 18, 18}) {
  auto scene = scene_of(uniform_rock(shape, 5, rock), edges_all_3d(EdgeLaw::rigid), {41, 52, 18},
                        "force:1,0.5,1", "ricker:25", {{51, 37, 78}, {26, 62, 53}},
                        {Component::vx, Component::vy, Component::vz}, 0.06, 0.001);
  scene.model.fracture = Field<3, std::uint8_t>(scene.model.grid());
  for (std::int64_t n = 0; n < scene.model.grid().size(); ++n) {
    const auto at = scene.model.grid().index(n);
    bool inside = true;
    for (std::size_t axis = 0; axis < 3; ++axis)
      inside = inside && at[axis] >= shape[axis] / 3 && at[axis] < shape[axis] - shape[axis] / 3;
    scene.model.fracture[std::size_t(n)] = inside;
  }
  scene.model.fracture_sets = {set};
  return scene;
}

inline std::vector<double> difference(std::vector<double> one, const std::vector<double>& other) {
  for (std::size_t n = 0; n < one.size(); ++n) one[n] -= other[n];
  return one;
}
/// What slip changes in the traces.
inline std::vector<double> of_slip(Scene<3> scene) {
  check(scene);
  const auto with = samples_of(shoot(scene, 1));
  scene.with_slip = false;
  return difference(with, samples_of(shoot(scene, 1)));
}

/// How far what slip changes is from that of the same experiment turned by a right angle about the vertical,
/// where x becomes y, and y becomes -x: rock and cluster, whose planes set_of() gives by azimuth, source and
/// receiver.
inline double error_of_turned(const Material& rock,
                              const std::function<FractureSet<3>(double azimuth)>& set_of) {
  const auto shot = [&](const Material& of, double azimuth, const Point<3>& source,
                        const std::vector<Point<3>>& receivers, const char* force) {
    auto scene = cluster(of, set_of(azimuth));
    scene.survey.sources[0].position_m = source;
    scene.survey.sources[0].mechanism = parse_mechanism<3>(force);
    scene.survey.receivers_m = receivers;
    scene.numerics.cfl = 0.4;
    return of_slip(scene);
  };
  const auto one = shot(turned_by(rock, 25, 35, 50), 20, {31, 42, 18}, {{51, 62, 78}}, "force:1,0,0"),
             turned = shot(turned_by(rock, 25, 125, 50), 110, {48, 31, 18}, {{28, 51, 78}}, "force:0,1,0");
  const auto count = one.size() / 3;
  auto back = turned;
  for (std::size_t n = 0; n < count; ++n) back[n] = turned[count + n], back[count + n] = -turned[n];
  return relative_error(back, one);
}

/// Orthorhombic rock with any stiffness about any axes; `between` draws between two numbers.
inline Material any_turned_rock(const std::function<double(double low, double high)>& between) {
  for (;;) {
    const double vp = between(2500, 4500);
    Material rock{vp, vp * between(0.3, 0.65), between(2000, 2600), between(-0.25, 0.5), between(-0.25, 0.5),
                  0,  between(-0.25, 0.5)};
    rock.orthorhombic = {between(-0.2, 0.5), between(-0.2, 0.5), between(-0.2, 0.3), between(-0.2, 0.5)};
    if (!fault_of_anisotropy(rock, true))
      return turned_by(rock, between(-90, 90), between(-180, 180), between(-180, 180));
  }
}

}  // namespace slipwave::solver
