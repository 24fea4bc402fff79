// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "cube.hpp"
#include "planning/computed_share.hpp"
#include "solver/shot_simulation.hpp"

namespace slipwave::cube_share_test {

using namespace slipwave::solver;

namespace {

/// Of all cells in all steps.
struct Shares {
  double found = 0, expected = 0;
};

/// Of a shot in rock whose speeds grow with depth.
Shares shares_of(const Index<3>& shape, int order, double source_y, double duration_s,
                 const std::vector<Point<3>>& receivers_m) {
  Scene<3> scene;
  scene.model.medium = uniform_cube(shape, 10, {2500, 1250, 2000});
  const auto& grid = scene.model.grid();
  for (std::int64_t n = 0; n < grid.size(); ++n) {
    const auto at = grid.index(n);
    const double speed = 2300 + 0.5 * grid.centre(2, at[2]);
    put(scene.model.medium, at, {speed, speed / 2, 2000});
  }
  scene.survey.sources = {
      {{grid.end(0) / 2, source_y, 20}, parse_mechanism<3>("explosion"), parse_wavelet("ricker:20"), 1e6}};
  scene.survey.receivers_m = receivers_m;
  scene.edges = edges_all_3d(EdgeLaw::absorbing);
  scene.edges[2][0] = EdgeLaw::free;
  scene.numerics.order = order;
  scene.recording = {{Component::vz}, duration_s, 0.002};
  ShotSimulation<3, float> step(scene, 1, {});
  step.run_to(step.steps());
  return {step.computed_share(), expected_share(scene, step.domain().grid)};
}

}  // namespace

// Proves (E20).
TEST(CubeComputedShare, IsAsExpected) {
  const Index<3> slab{16, 240, 40}, cube{64, 64, 64};
  const std::vector<Point<3>> near = {{80, 1500, 5}}, apart = {{80, 5, 5}, {80, 2395, 395}};
  const auto compare = [](const Shares& shares, double least, double most) {
    EXPECT_NEAR(shares.found, shares.expected, 0.05);
    EXPECT_GT(shares.found, least);
    EXPECT_LT(shares.found, most);
  };
  compare(shares_of(slab, 3, 1200, 0.2, apart), 0.1, 0.25);
  compare(shares_of(slab, 5, 1200, 0.2, near), 0.05, 0.2);
  compare(shares_of(cube, 5, 320, 0.2, {{5, 5, 5}, {635, 635, 635}}), 0.3, 0.7);
}

}  // namespace slipwave::cube_share_test
