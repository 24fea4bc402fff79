// SPDX-License-Identifier: BSD-3-Clause
// Source and receiver exchanged: beside and on interfaces and surfaces.
#include <gtest/gtest.h>

#include "drawn_scene.hpp"

namespace slipwave::solver {
namespace {

/// Relative difference of the trace of a force along x or z at `from`, recorded along it at `to`, and of the
/// exchanged shot.
double asymmetry(Scene<2> scene, const Point<2>& from, const Point<2>& to, bool along_x) {
  scene.recording.components = {along_x ? Component::vx : Component::vz};
  const char* const mechanism = along_x ? "force:1,0" : "force:0,1";
  shoot_from(scene, from, mechanism, {to});
  const auto there = traces_of(scene);
  shoot_from(scene, to, mechanism, {from});
  return difference(traces_of(scene), there);
}

/// Cells of the upper rock above row `face`.
Scene<2> two(const Rock& upper, const Rock& lower, std::int64_t face) {
  return scene_of(110, 100, [=](auto, auto k) { return k < face ? upper : lower; });
}

TEST(Exchange, AcrossAContrastOfDensityHoldsAsInOneRock) {
  for (const unsigned seed : seeds()) {
    Draw draw(seed);
    const Rock rock = draw.rock(20);
    Rock dense = rock;
    dense.rho *= draw.between(1.6, 4);
    const double near_face_m = 50 + draw.between(-2, 2) * double(draw.whole(0, 1));
    for (const bool along_x : {false, true}) {
      EXPECT_LT(asymmetry(two(rock, dense, 50), {40.2, near_face_m}, {70.3, 31.6}, along_x), 0.002)
          << "seed " << seed << " at " << near_face_m;
    }
  }
}

TEST(Exchange, AtAnInterfaceOfRocksHoldsToTheOrderOfTheScheme) {
  for (const unsigned seed : seeds()) {
    Draw draw(seed);
    const Rock upper = draw.rock(22), lower = draw.rock(draw.between(32, 40));
    for (const double away_m : {0., 0.5, -0.5, draw.between(1, 3)})
      for (const bool along_x : {false, true})
        // First order within half a cell of the interface.
        EXPECT_LT(asymmetry(two(upper, lower, 50), {40.2, 50 + away_m}, {70.3, 31.6}, along_x),
                  std::abs(away_m) < 1 ? 0.025 : 0.01)
            << "seed " << seed << ", " << away_m << " m away" << (along_x ? ", x" : ", z");
  }
}

TEST(Exchange, BelowVoidHoldsToTheOrderOfTheScheme) {
  for (const unsigned seed : seeds()) {
    Draw draw(seed);
    const Rock rock = draw.rock(20);
    const auto scene = two(nothing, rock, 30);
    for (const double below_m : {0., 0.5, draw.between(1, 3)})
      for (const bool along_x : {false, true})
        EXPECT_LT(asymmetry(scene, {40.2, 30 + below_m}, {70.3, 55.6}, along_x), below_m < 1 ? 0.04 : 0.015)
            << "seed " << seed << ", " << below_m << " m below" << (along_x ? ", x" : ", z");
  }
}

TEST(Exchange, OfPressureAndExplosionOnTheSeaFloorTakesTheWatersSide) {
  for (const unsigned seed : seeds()) {
    Draw draw(seed);
    const Rock rock = draw.rock(30), water{2000, 0, 1000};
    auto scene = two(water, rock, 50);
    scene.recording.components = {Component::p};
    const Point<2> on_floor{40.2, 50}, above{40.2, 50 - 1e-4}, in_water{70.3, 31.6};
    shoot_from(scene, in_water, "explosion", {on_floor, above});
    const auto found = traces_of(scene);
    const std::vector<double> floor(found.begin(), found.begin() + std::ptrdiff_t(found.size() / 2)),
        beside(found.begin() + std::ptrdiff_t(found.size() / 2), found.end());
    EXPECT_LT(difference(floor, beside), 0.001) << "seed " << seed;
    shoot_from(scene, on_floor, "explosion", {in_water});
    // First order within half a cell of the floor.
    EXPECT_LT(difference(traces_of(scene), floor), 0.05) << "seed " << seed;
  }
}

}  // namespace
}  // namespace slipwave::solver
