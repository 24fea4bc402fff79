// SPDX-License-Identifier: BSD-3-Clause
// Fractures on faces between cells: who computes them makes no difference (docs/theory/fractures.md).
#include <gtest/gtest.h>

#include <limits>

#include "continued.hpp"
#include "model/single_fracture.hpp"
#include "scene_of_faces.hpp"

namespace slipwave::solver {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

void add(Model<2>& model, double normal, double tangential, std::vector<FractureTrace<2>> traces) {
  SlipSystem<2> system{normal_between_tips(traces.front()), 0, 0, 0, false, FrictionLaw::none};
  system.compliance = {normal, tangential, 0, 0, 0};
  add_single_fractures(model, {"faces", {system}, std::move(traces), true});
}

/// Two rocks, with cracks that cross, end between faces and lie on the interface, beside a cluster of
/// springs.
Scene<2> cracked() {
  auto scene = two_rocks();
  add(scene.model, infinite, infinite, {{{152, 300}, {301, 300}}, {{220, 141}, {220, 420}}});
  add(scene.model, 0, infinite, {{{80, 500}, {390, 500}}});
  add(scene.model, 2e-9, 1e-9, {{{330, 90}, {330, 700}}, {{100, 200}, {200, 200}}});
  return scene;
}

TEST(FractureOnFaces, GivesTheBitsOfThePlainExecutorInTiles) { expect_same_in_tiles(cracked()); }

TEST(FractureOnFaces, IsTheSameOnSeveralRanks) {
  const auto scene = cracked();
  const auto alone = all_samples(shoot(scene, 1));
  expect_same_on_ranks(scene, alone);
  auto whole = scene;
  whole.with_slip = false;
  EXPECT_FALSE(all_samples(shoot(whole, 1)) == alone);
}

// Along springs the order is lower in some rows on both sides, whichever ranks have them.
TEST(FractureOnFaces, AtHighOrdersIsTheSameOnSeveralRanks) {
  auto scene = two_rocks();
  scene.numerics.order = 11;
  std::vector<FractureTrace<2>> springs;
  for (double depth = 60; depth < 760; depth += 20) springs.push_back({{150, depth}, {300, depth}});
  add(scene.model, 2e-11, 5e-11, springs);
  expect_same_on_ranks(scene, all_samples(shoot(scene, 1)));
}

TEST(FractureOnFaces, ContinuesFromACheckpoint) { expect_to_continue(cracked()); }

TEST(FractureOnFaces, IsTheSameInSingleAndDoublePrecision) { expect_same_in_double_precision(cracked()); }

}  // namespace
}  // namespace slipwave::solver
