// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstdlib>
#include <string>
#include <vector>

#include "anisotropic_space.hpp"
#include "cube_extruded.hpp"

namespace slipwave::solver {

/// Whether SLIPWAVE_LONG asks for the long form.
inline bool long_form() { return std::getenv("SLIPWAVE_LONG") != nullptr; }

/// Alike in all horizontal directions: a shale, and one whose waves turn; orthorhombic: a shale with upright
/// cracks (Schoenberg and Helbig 1997, over density 2300), one like it that shows more.
inline const Material shale{3000, 1600, 2300, 0.2, 0.1, 0, 0.15},
    crossed{3200, 1700, 2400, -0.05, 0.2, 0, -0.1};
inline const Material cracked =
    material_of(orthorhombic({2300 * 9e6, 2300 * 9.84e6, 2300 * 5.9375e6, 2300 * 2e6, 2300 * 1.6e6,
                              2300 * 2.182e6, 2300 * 3.6e6, 2300 * 2.25e6, 2300 * 2.4e6}),
                2300);

/// The rock with its axes turned so, in degrees.
inline Material turned_by(Material rock, double tilt, double azimuth, double rotation = 0) {
  rock.tilt = tilt, rock.azimuth = azimuth, rock.rotation = rotation;
  return rock;
}

/// Gives a medium the angles that any of these rocks has.
template <int D>
void add_angles(Medium<D>& medium, const std::vector<Material>& rocks) {
  const auto add = [&](Property property, const auto& of) {
    if (std::any_of(rocks.begin(), rocks.end(), [&](const Material& rock) { return of(rock) != 0; }))
      medium[property] = Field<D>(medium.grid());
  };
  add(Property::tilt, [](const Material& rock) { return rock.tilt; });
  add(Property::azimuth, [](const Material& rock) { return rock.azimuth; });
  add(Property::rotation, [](const Material& rock) { return rock.rotation; });
}

/// Blocks of so many cells of rocks in turn, below eight rows of water.
inline Medium<3> blocks_below_water(const std::vector<Material>& rocks, const Index<3>& shape,
                                    const Index<3>& block) {
  constexpr std::int64_t wet = 8;
  Medium<3> medium(Grid<3>{shape, 5, {0, 0, 0}});
  medium[Property::epsilon1] = Field<3>(medium.grid());
  add_angles(medium, rocks);
  complete_anisotropy(medium);
  for (std::int64_t n = 0; n < medium.grid().size(); ++n) {
    const auto at = medium.grid().index(n);
    const auto turn = at[0] / block[0] + at[1] / block[1] + (at[2] - wet) / block[2];
    put(medium, std::size_t(n),
        at[2] < wet ? Material{1500, 0, 1000} : rocks[std::size_t(turn) % rocks.size()]);
  }
  return medium;
}

/// Leaves the first of these cells, in the order of the file, isotropic.
inline void make_isotropic(Medium<3>& medium, std::size_t cells) {
  for (const auto property : medium.properties())
    for (std::size_t cell = 0; cell < cells && property >= Property::epsilon; ++cell)
      medium[property][cell] = 0;
}

/// The traces of a force, shot from one place to another.
inline Gather shot_between(Scene<3> scene, const Point<3>& from, const Point<3>& to, const char* force) {
  scene.survey.sources[0].position_m = from, scene.survey.sources[0].mechanism = parse_mechanism<3>(force);
  scene.survey.receivers_m = {to};
  return shoot(scene, 1);
}

/// All of one rock, from the origin on.
inline Medium<3> uniform_rock(const Index<3>& shape, double spacing_m, const Material& rock,
                              const Point<3>& origin_m = {}) {
  Medium<3> medium(Grid<3>{shape, spacing_m, origin_m});
  medium[rock.orthorhombic ? Property::epsilon1 : Property::gamma] = Field<3>(medium.grid());
  add_angles(medium, {rock});
  complete_anisotropy(medium);
  for (std::size_t cell = 0; cell < medium.vp.size(); ++cell) put(medium, cell, rock);
  return medium;
}

/// A force along y, slowest waves of so many cells at the peak of the wavelet, receivers about 1.4 of them
/// away in all directions. Planes of symmetry across y stand at x = 0 and z = 0, in rock that is tilted along
/// y at x = 0 alone, else nowhere.
struct ForceInSpace {
  Scene<3> scene;
  double peak_hz, sources;  // planes of symmetry hold several sources

  /// Error of all traces against velocities [component][sample] by receiver and number of samples, per N.
  template <class Exact>
  double error(const Exact& exact) const {
    const auto gather = shoot(scene, 1);
    const auto& receivers = scene.survey.receivers_m;
    std::vector<double> found, wanted;
    for (std::size_t at = 0; at < receivers.size(); ++at) {
      const auto of = exact(receivers[at], std::size_t(gather.axis.count));
      for (std::size_t component = 0; component < 3; ++component) {
        const auto& samples = gather.traces[component * receivers.size() + at].samples;
        for (const double sample : samples) found.push_back(sample / sources);
        for (const double value : of[component]) wanted.push_back(1e9 * value);
      }
    }
    return relative_error(found, wanted);
  }
};
inline ForceInSpace force_in_space(const Material& rock, int cells) {
  const std::int64_t n = (34 * cells + 23) / 24;
  constexpr double h = 5;
  const double peak_hz = slowest_speeds<3>(rock).s / (cells * h), share = cells / 24.;
  const bool tilted = rock.tilt != 0, mirrored = !tilted || rock.azimuth == 90;
  auto edges = edges_all_3d(EdgeLaw::absorbing);
  if (mirrored) edges[0][0] = EdgeLaw::mirror;
  if (!tilted) edges[2][0] = EdgeLaw::mirror;
  std::vector<Point<3>> receivers = {{150, 0, 20},  {10, 160, 10},   {15, 20, 155}, {105, 110, 5},
                                     {5, 100, 115}, {110, -20, 105}, {90, -95, 85}};
  if (tilted) receivers.insert(receivers.end(), {{20, 90, -110}, {75, -85, -95}});
  if (!mirrored) receivers.insert(receivers.end(), {{-110, 80, 85}, {-90, -100, -75}});
  for (auto& at : receivers)
    for (auto& part : at) part *= share;
  const Index<3> shape = {mirrored ? n : 2 * n, 2 * n, tilted ? 2 * n : n};
  const double before = -double(n) * h;
  auto scene = scene_of(uniform_rock(shape, h, rock, {mirrored ? 0 : before, before, tilted ? before : 0}),
                        edges, {0, 0, 0}, "force:0,1,0", ("ricker:" + std::to_string(peak_hz)).c_str(),
                        receivers, {Component::vx, Component::vy, Component::vz}, 3.2 / peak_hz, 0.001);
  scene.numerics.order = 7;
  // In small models layers as wide as usual are most of the cells.
  if (!long_form()) scene.numerics.zone_cells = 10;
  return {std::move(scene), peak_hz, !tilted ? 4. : mirrored ? 2. : 1.};
}

/// The error of its traces against sums over plane waves.
inline double error_of_a_force(const Material& rock, int cells, int order = 7) {
  auto force = force_in_space(rock, cells);
  force.scene.numerics.order = order;
  check(force.scene);
  const AnisotropicSpace space(rock);
  return force.error([&](const Point<3>& at, std::size_t count) {
    return space.velocity(at, 1, {force.peak_hz}, 0.001, count);
  });
}

/// A slice in the plane of two axes, one cell thick between mirrors, and what it is in 2-D: `flat` below
/// water and a free surface, with `under` of the same kind beneath.
inline Extruded slice(const std::array<int, 2>& axes, const Material& upper, const Material& lower,
                      const Material& flat_upper, const Material& flat_lower) {
  EdgeLaws<2> edges = edges_all(EdgeLaw::absorbing);
  edges[1][0] = EdgeLaw::free;
  const bool level = axes[1] == 1;
  const char* names[] = {"vx", "vy", "vz"};
  std::vector<Component> deep = {component_named(names[axes[0]], 3), component_named(names[axes[1]], 3)};
  std::string force = "force:0,0,0";
  force[std::size_t(6 + 2 * axes[0])] = '1', force[std::size_t(6 + 2 * axes[1])] = '1';
  auto both = extruded(axes, edges, "force:1,1", force.c_str(), {Component::vx, Component::vz}, deep);
  auto& flat_medium = both.flat.model.medium;
  auto& medium = both.deep.model.medium;
  flat_medium[Property::epsilon] = Field<2>(flat_medium.grid());
  medium[Property::epsilon1] = Field<3>(medium.grid());
  add_angles(flat_medium, {flat_upper, flat_lower}), add_angles(medium, {upper, lower});
  complete_anisotropy(flat_medium), complete_anisotropy(medium);
  const Material sea{1500, 0, 1000};
  for (std::int64_t n = 0; n < flat_medium.grid().size(); ++n) {
    const auto [i, k] = flat_medium.grid().index(n);
    const bool wet = !level && k<12, deeper = k> 38;
    put(flat_medium, std::size_t(n), wet ? sea : deeper ? flat_lower : flat_upper);
    put(medium, std::size_t(medium.grid().flat(both.deep_cell(i, k))), wet ? sea : deeper ? lower : upper);
  }
  return both;
}

}  // namespace slipwave::solver
