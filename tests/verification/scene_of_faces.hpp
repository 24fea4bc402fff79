// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "lab.hpp"
#include "model/prestress.hpp"
#include "model/single_fracture.hpp"
#include "shared_out.hpp"

namespace slipwave::solver {

/// Two rocks, one upon the other, without fractures: 480 m by 800 m, for those on faces between their cells.
inline Scene<2> two_rocks() {
  constexpr Rock rock{4500, 2250, 2500}, soft{2500, 1200, 2000};
  constexpr std::int64_t nx = 96, nz = 160;
  Scene<2> scene;
  scene.model.medium = uniform_medium(nx, nz, 5, rock);
  for (std::int64_t k = 100; k < nz; ++k)
    for (std::int64_t i = 0; i < nx; ++i) put(scene.model.medium, {i, k}, soft);
  scene.survey.sources = {{{203, 261}, parse_mechanism<2>("force:1,2"), parse_wavelet("ricker:40"), 1e6}};
  scene.survey.receivers_m = {{100, 33}, {402.5, 201.3}, {220, 400}, {227, 703.3}, {33, 641}};
  scene.edges = edges_all(EdgeLaw::absorbing);
  scene.edges[1][0] = EdgeLaw::free;
  scene.numerics.order = 7;
  scene.recording = {{Component::vx, Component::vz, Component::sxz}, 0.12, 0.001};
  return scene;
}

/// Faces of springs without friction.
inline void add_faces(Model<2>& model, double normal, double tangential,
                      std::vector<FractureTrace<2>> traces) {
  SlipSystem<2> system{normal_between_tips(traces.front()), 0, 0, 0, false, FrictionLaw::none};
  system.compliance = {normal, tangential, 0, 0, 0};
  add_single_fractures(model, {"faces", {system}, std::move(traces), true});
}

/// Two rocks, with cracks that cross, end between faces and lie on the interface, beside a cluster of
/// springs.
inline Scene<2> cracked() {
  constexpr double infinite = std::numeric_limits<double>::infinity();
  auto scene = two_rocks();
  add_faces(scene.model, infinite, infinite, {{{152, 300}, {301, 300}}, {{220, 141}, {220, 420}}});
  add_faces(scene.model, 0, infinite, {{{80, 500}, {390, 500}}});
  add_faces(scene.model, 2e-9, 1e-9, {{{330, 90}, {330, 700}}, {{100, 200}, {200, 200}}});
  return scene;
}

/// A plane with friction.
struct Plane {
  double friction = 0.5, cohesion_pa = 0, viscosity_s = 0;
  bool opens = false;
  double z_n = 0, z_t = 0;
  std::string law = "coulomb";
};

/// Faces under stress there was before the waves.
inline void add_faces(Model<2>& model, const Plane& of, std::vector<FractureTrace<2>> traces,
                      const std::string& prestress) {
  SlipSystem<2> system{normal_between_tips(traces.front()), of.friction, of.viscosity_s, of.cohesion_pa,
                       of.opens};
  set_friction_law(system, of.law);
  system.compliance = {of.z_n, of.z_t, 0, 0, of.viscosity_s > 0 ? 5. : 0};
  add_single_fractures(model, {"faces", {system}, std::move(traces), true});
  set_prestress(model, model.fracture_sets.size(), parse_prestress<2>(prestress));
}

/// Two rocks, with planes that stick and slide, open and shut, with springs and viscosity and without, cross,
/// end between faces and lie on the interface, beside a cluster of planes.
inline Scene<2> faulted() {
  auto scene = two_rocks();
  auto& model = scene.model;
  model.fracture = Field<2, std::uint8_t>(model.grid());
  for (std::int64_t k = 60; k < 70; ++k)
    for (std::int64_t i = 10; i < 30; ++i) model.fracture({i, k}) = 1;
  model.fracture_sets = {{"cluster", {{{0.6, 0.8}, 0.1, 2e3, 1e3}}}};
  add_faces(model, {}, {{{152, 300}, {301, 300}}, {{220, 141}, {220, 420}}}, "-2000,-3000,500");
  add_faces(model, {0.3, 100, 0, true}, {{{80, 500}, {390, 500}}}, "-1500,-1000,-200");
  add_faces(model, {0.2, 0, 5, true, 2e-9, 1e-9}, {{{330, 90}, {330, 700}}}, "-1000,-1000,0");
  add_faces(model, {0.4, 0, 20}, {{{100, 200}, {200, 200}}}, "-1000,-2000,-700");
  add_faces(model, {0.5, 50, 0, true, 0, 1e-10, "slip-weakening:0.1:2e-6"}, {{{430, 151}, {430, 599}}},
            "-1000,-2000,200");
  return scene;
}

/// Expects single precision to be as near to double precision as rounding leaves it.
inline void expect_same_in_double_precision(Scene<2> scene) {
  scene.recording.duration_s = 0.3;
  const auto single = samples_of(shoot(scene, 1));
  scene.numerics.double_precision = true;
  const auto precise = samples_of(shoot(scene, 1));
  // Stresses and velocities have scales of their own: each by the largest of its trace.
  const std::size_t a_trace = precise.size() / 15;
  for (std::size_t n = 0; n < precise.size(); n += a_trace) {
    double off = 0, largest = 0;
    for (auto k = n; k < n + a_trace; ++k) {
      off = std::max(off, std::abs(single[k] - precise[k]));
      largest = std::max(largest, std::abs(precise[k]));
    }
    EXPECT_LT(off, 1e-4 * largest) << n / a_trace;
  }
}

}  // namespace slipwave::solver
