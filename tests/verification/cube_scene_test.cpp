// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "cube_extruded.hpp"
#include "parallel/threads.hpp"

namespace slipwave::solver::cube_scene_test {
namespace {

/// The same in 3-D, not the same from row to row, with a source and receivers all over it.
Scene<3> reef(const EdgeLaws<3>& edges, const char* mechanism) {
  const Index<3> shape = {40, 36, 48};
  auto medium = uniform_cube(shape, 5, rock);
  for (std::int64_t n = 0; n < medium.grid().size(); ++n) {
    const auto at = medium.grid().index(n);
    put(medium, at, reef_at(at[0] + at[1] / 3, shape[0], at[2]));
  }
  return scene_of(medium, edges, {91, 87, 121}, mechanism, "ricker:40",
                  {{21, 30, 13}, {133, 71.3, 62.2}, {71, 160, 187}},
                  {Component::vx, Component::vy, Component::syz, Component::p}, 0.035, 0.001);
}

TEST(CubeTraces, DoNotDependOnWhoElseIsLooking) {
  auto edges = edges_all_3d(EdgeLaw::mirror);
  edges[2][0] = EdgeLaw::free;
  auto scene = reef(edges, "explosion");
  const auto all = samples_of(shoot(scene, 1));
  scene.snapshot_every_s = 0.007;
  int taken = 0;
  const auto watched = samples_of(shoot<3>(scene, 1, {}, [&](double, const FieldReader<3>& field) {
    taken += std::int64_t(field(Component::vy).size()) == scene.model.grid().size();
  }));
  EXPECT_EQ(all, watched);
  EXPECT_EQ(taken, 5);
  scene.survey.receivers_m.resize(1);
  const auto alone = shoot(scene, 1);
  EXPECT_TRUE(std::equal(alone.traces[0].samples.begin(), alone.traces[0].samples.end(), all.begin()));
}

const std::vector<Component> all = {Component::vx, Component::vz, Component::sxx, Component::szz,
                                    Component::sxz};

// Proves (E3), (E14).
TEST(ExtrudedScene, AlongYGivesTheTracesOf2D) {
  // The same sweeps: only rounding differs.
  for (const auto& edges : {edges_of(EdgeLaw::free, EdgeLaw::absorbing, EdgeLaw::absorbing),
                            edges_of(EdgeLaw::free, EdgeLaw::free, EdgeLaw::rigid),
                            edges_of(EdgeLaw::absorbing, EdgeLaw::mirror, EdgeLaw::free)})
    for (const auto& [mechanism, in_3d] :
         {std::pair("explosion", "explosion"), std::pair("force:1,2", "force:1,0,2"),
          std::pair("moment:1,2,3", "moment:1,0,2,0,3,0")}) {
      if (std::string(mechanism) != "explosion" && edges[1][0] == EdgeLaw::absorbing) continue;
      EXPECT_LT(largest_error(extruded({0, 2}, edges, mechanism, in_3d, all, all)), 1e-9) << mechanism;
    }
}

// Proves (Q8).
TEST(ExtrudedScene, ThatAttenuatesGivesTheTracesOf2D) {
  // Q from 20 to 50, other for P than for S.
  auto both = extruded({0, 2}, edges_of(EdgeLaw::free, EdgeLaw::free, EdgeLaw::rigid), "force:1,2",
                       "force:1,0,2", all, all);
  const auto attenuate = [](auto& scene) {
    auto& medium = scene.model.medium;
    for (const auto property : {Property::qp, Property::qs}) {
      auto& q = medium[property] = decltype(medium.vp)(medium.grid());
      for (std::size_t n = 0; n < q.size(); ++n)
        q[n] = (property == Property::qp ? 50.F : 20.F) * medium.rho[n] / 3000;
    }
    set_attenuation(scene);
  };
  both.flat.with_slip = both.deep.with_slip = false;
  const auto lossless = samples_of(shoot(both.deep, 1));
  attenuate(both.flat), attenuate(both.deep);
  // Q that is off by a thousandth would make more than 1e-5.
  EXPECT_LT(largest_error(both), 1e-8);
  EXPECT_GT(relative_error(samples_of(shoot(both.deep, 1)), lossless), 0.05);
}

// Proves (E3).
TEST(ExtrudedScene, AlongXGivesTheTracesOf2DSweptByHalves) {
  const std::vector<Component> of_yz = {Component::vy, Component::vz, Component::syy, Component::szz,
                                        Component::syz};
  for (const auto& edges : {edges_of(EdgeLaw::free, EdgeLaw::mirror, EdgeLaw::rigid),
                            edges_of(EdgeLaw::rigid, EdgeLaw::rigid, EdgeLaw::free)}) {
    auto both = extruded({1, 2}, edges, "force:1,2", "force:0,1,2", all, of_yz);
    keep_half_sweeps(both);
    both.flat.with_slip = false;
    both.flat.recording.duration_s = both.deep.recording.duration_s = 0.12;
    EXPECT_LT(largest_error(both), 1e-12);
  }
}

// Proves (E3).
TEST(ExtrudedScene, AlongZGivesTheTracesOf2DInShortSteps) {
  // Two half sweeps along y are the whole one along z of 2-D: what that changes goes with the step.
  const std::vector<Component> of_xy = {Component::vx, Component::vy, Component::sxx, Component::syy,
                                        Component::sxy};
  auto both = extruded({0, 1}, edges_of(EdgeLaw::free, EdgeLaw::free, EdgeLaw::mirror), "force:1,2",
                       "force:1,2,0", all, of_xy);
  both.flat.recording.duration_s = both.deep.recording.duration_s = 0.12;
  EXPECT_GT(order_of_difference(both, 0.1), 0.9);
}

}  // namespace
}  // namespace slipwave::solver::cube_scene_test
