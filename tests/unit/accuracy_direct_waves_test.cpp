// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "accuracy/direct_waves.hpp"
#include "accuracy/ladder.hpp"
#include "build/resample.hpp"
#include "geology/layers.hpp"

namespace slipwave::accuracy_direct_waves_test {
namespace {

/// Rock of one kind in cells of 10 m.
Model<2> uniform_model() {
  Model<2> model;
  model.medium = layered_medium<2>(grid_over<2>({400, 300}, 10), {{-1000, 3000, 1600, 2200}});
  return model;
}

/// A scene with a shot over a model.
Scene<2> shot_over(const Model<2>& model) {
  Scene<2> scene;
  scene.model = model;
  scene.survey.sources = {{{105, 45}, Explosion{}, parse_wavelet("ricker:15"), 1}};
  scene.survey.receivers_m = {{205, 55}, {305, 85}};
  for (const int axis : {0, 1}) scene.edges[axis] = {EdgeLaw::absorbing, EdgeLaw::absorbing};
  scene.recording = {{Component::vx}, 0.3, 0.001};
  return scene;
}

}  // namespace

// Proves (E16).
TEST(DirectWaves, AreThoseThatArriveAndFallWithTheSizeOfCells) {
  auto scene = shot_over(uniform_model());
  const auto coarse = DirectWaves<2>(scene).error(discretisation_of(scene));
  ASSERT_TRUE(coarse.p);
  // An explosion sends no S waves.
  EXPECT_FALSE(coarse.s);
  const auto fine = with_setting(scene, {5, 0.9, 5});
  EXPECT_LT(*DirectWaves<2>(fine).error(discretisation_of(fine)).p, *coarse.p / 3);
  scene.survey.sources[0].mechanism = PointForce<2>{{0, 1}};
  EXPECT_GT(*DirectWaves<2>(scene).error(discretisation_of(scene)).s, *coarse.p);
  scene.recording.duration_s = 0.01;
  EXPECT_FALSE(DirectWaves<2>(scene).error(discretisation_of(scene)).p);
}

}  // namespace slipwave::accuracy_direct_waves_test
