// SPDX-License-Identifier: BSD-3-Clause
// Slip weakening in whole shots: its limits, and that its state is stored and sent between ranks.
#include <gtest/gtest.h>

#include "cube_extruded.hpp"
#include "lab.hpp"
#include "long_form.hpp"
#include "solver/simulation.hpp"

namespace slipwave::solver::solver_weakening_test {
namespace {

std::vector<double> samples(const Gather& gather) {
  std::vector<double> all;
  for (const auto& trace : gather.traces) all.insert(all.end(), trace.samples.begin(), trace.samples.end());
  return all;
}

/// Static friction from there on, falling over that slip.
template <int D>
Scene<D> weakening(Scene<D> scene, double distance_m) {
  for (auto& set : scene.model.fracture_sets)
    for (auto& system : set.systems) {
      system.law = FrictionLaw::slip_weakening;
      system.dynamic_friction = 0.1 * system.friction;
      system.slip_distance_m = distance_m;
    }
  return scene;
}

/// With dynamic friction from the beginning.
template <int D>
Scene<D> weak(Scene<D> scene) {
  for (auto& set : scene.model.fracture_sets)
    for (auto& system : set.systems) system.friction *= 0.1;
  return scene;
}

/// All corrections that it may be computed by; in the short form the second alone where another scene has
/// all.
std::vector<SlipCorrection> some_corrections(bool all = long_form()) {
  if (!all) return {SlipCorrection::second};
  return {SlipCorrection::first, SlipCorrection::second, SlipCorrection::exponential};
}

/// Endless distances are Coulomb to the bit; short ones come near dynamic friction, others lie between.
template <int D>
void expect_limits(Scene<D> scene, double distance_m,
                   const std::vector<SlipCorrection>& corrections = some_corrections()) {
  for (const auto correction : corrections) {
    SCOPED_TRACE(name_of(correction));
    scene.numerics.correction = correction;
    const auto coulomb = samples(shoot(scene, 1)), dynamic = samples(shoot(weak(scene), 1));
    EXPECT_TRUE(samples(shoot(weakening(scene, 1e300), 1)) == coulomb);
    EXPECT_GT(relative_error(dynamic, coulomb), 1e-3);
    const auto between = samples(shoot(weakening(scene, distance_m), 1));
    EXPECT_GT(relative_error(between, coulomb), 1e-3 * relative_error(dynamic, coulomb));
    EXPECT_LT(relative_error(samples(shoot(weakening(scene, 1e-3 * distance_m), 1)), dynamic),
              0.5 * relative_error(coulomb, dynamic));
  }
}

Scene<2> cracked(std::vector<SlipSystem<2>> systems) {
  Scene<2> scene;
  scene.model.medium = uniform_medium(80, 80, 5, {4500, 2250, 2500});
  scene.model.fracture = Field<2, std::uint8_t>(scene.model.grid());
  for (std::int64_t k = 30; k < 50; ++k)
    for (std::int64_t i = 30; i < 50; ++i) scene.model.fracture({i, k}) = 1;
  scene.model.fracture_sets = {{"cracks", std::move(systems)}};
  for (const float value : {-2e5F, -2e5F, 0.F})
    scene.model.prestress_pa.emplace_back(scene.model.grid(), value);
  scene.survey.sources = {{{200, 60}, parse_mechanism<2>("force:1,2"), parse_wavelet("ricker:30"), 2e8}};
  scene.survey.receivers_m = {{100, 103}, {202.5, 201.3}, {220, 333}};
  scene.recording = {{Component::vx, Component::vz, Component::sxz}, 0.15, 0.001};
  return scene;
}

const SlipSystem<2> first{{0.6, 0.8}, 0.5, 200, 10}, across{{0.8, -0.6}, 0.4, 100, 0},
    crossing{{1, 0}, 0.4, 0, 100};

// Proves (S17).
TEST(SlipWeakeningShot, HasItsLimitsForOneSystemBlocksAndCrossingPlanes) {
  expect_limits(cracked({first}), 1e-5, some_corrections(true));
  expect_limits(cracked({first, across}), 1e-5);
  expect_limits(cracked({first, crossing}), 1e-5);
}

// Proves (S18).
TEST(SlipWeakeningShot, HasThemIn3DToo) {
  const Index<3> shape = {18, 16, 20};
  auto scene = scene_of(uniform_cube(shape, 5, rock), edges_all_3d(EdgeLaw::mirror), {46, 39, 28},
                        "force:3,1,2", "ricker:40", {{26, 31, 84}, {73, 64, 70}},
                        {Component::vx, Component::vy, Component::vz}, 0.07, 0.001);
  scene.survey.sources[0].amplitude = 1e9;
  scene.model.fracture = Field<3, std::uint8_t>(scene.model.grid(), 1);
  for (const float value : {-1e5F, -1e5F, -1e5F, 0.F, 0.F, 0.F})
    scene.model.prestress_pa.emplace_back(scene.model.grid(), value);
  scene.model.fracture_sets = {{"one", {{{0.6, 0, 0.8}, 0.5, 200, 10}}}};
  expect_limits(scene, 1e-5, {SlipCorrection::first, SlipCorrection::exponential});
  scene.model.fracture_sets = {
      {"three", {{{0.6, 0, 0.8}, 0.5, 200, 10}, {{0.8, 0, -0.6}, 0.4, 0, 10}, {{0, 1, 0}, 0.4, 100, 0}}}};
  expect_limits(scene, 1e-5);
}

}  // namespace
}  // namespace slipwave::solver::solver_weakening_test
