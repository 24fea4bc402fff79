// SPDX-License-Identifier: BSD-3-Clause
// Scenes mirrored, moved, enlarged, and with shots added.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "drawn_scene.hpp"
#include "model/fracture.hpp"

namespace slipwave::solver::symmetry_test {
namespace {

/// Water, two rocks and void with a wall of void, all drawn.
Scene<2> drawn(unsigned seed, std::int64_t void_below = 0, std::int64_t water_beside = 0,
               double spacing_m = 1) {
  Draw draw(seed);
  const Rock upper = draw.rock(14), lower = draw.rock(25), water{1500, 0, 1000};
  const auto floor = draw.whole(8, 12), layer = draw.whole(24, 34), wall = draw.whole(60, 66);
  auto scene = scene_of(
      80 + water_beside, 60 + void_below,
      [=](std::int64_t i, std::int64_t k) {
        if (k >= 60) return nothing;
        if (i >= 80) return water;
        if (i >= wall && k >= floor && k < layer) return nothing;
        return k < floor && i < 60 ? water : k < layer ? upper : lower;
      },
      0.06, spacing_m);
  scene.edges[1][0] = EdgeLaw::free;
  shoot_from(scene, {40.4, 20.7}, "force:0.3,1", {{30, double(floor)}, {50.2, 25.5}, {35, 4.5}});
  return scene;
}

TEST(Symmetry, MirroredScenesGiveMirroredTraces) {
  for (const unsigned seed : seeds()) {
    auto scene = drawn(seed);
    const auto there = traces_of(scene);
    auto mirrored = scene;
    const auto& medium = scene.model.medium;
    const auto n = scene.model.grid().shape[0];
    for (std::int64_t k = 0; k < 60; ++k)
      for (std::int64_t i = 0; i < n; ++i) {
        const Index<2> from{n - 1 - i, k};
        put(mirrored.model.medium, {i, k}, {medium.vp(from), medium.vs(from), medium.rho(from)});
      }
    std::vector<Point<2>> receivers;
    for (const auto& at : scene.survey.receivers_m) receivers.push_back({double(n) - at[0], at[1]});
    shoot_from(mirrored, {double(n) - 40.4, 20.7}, "force:-0.3,1", receivers);
    auto found = traces_of(mirrored);
    for (auto sample = found.begin() + std::ptrdiff_t(found.size() / 2); sample != found.end(); ++sample)
      *sample = -*sample;  // vx
    EXPECT_LT(difference(found, there), rounding) << "seed " << seed;
  }
}

TEST(Symmetry, VoidAndWaterFarAwayChangeNothing) {
  for (const unsigned seed : seeds()) {
    auto scene = drawn(seed);
    // What comes back from there would take longer.
    scene.recording.duration_s = 0.02;
    auto closed = scene;
    closed.edges[1][1] = EdgeLaw::free;
    auto larger = drawn(seed, 20);
    larger.recording.duration_s = 0.02;
    // The zone continues void.
    EXPECT_LT(difference(traces_of(larger), traces_of(closed)), rounding) << "seed " << seed;
  }
}

TEST(Symmetry, EverythingEightTimesAsLargeAndSlowGivesTracesOfAnEighth) {
  // In 2-D the velocity that a force gives falls with the lengths: v = F/(rho c L) f(x/L, c t/L).
  for (const unsigned seed : seeds()) {
    auto larger = traces_of(drawn(seed, 0, 0, 8));
    for (auto& sample : larger) sample *= 8;
    EXPECT_LT(difference(larger, traces_of(drawn(seed))), rounding) << "seed " << seed;
  }
}

TEST(Symmetry, PlanesOfNoComplianceChangeNothing) {
  for (const unsigned seed : seeds()) {
    const auto scene = drawn(seed);
    auto fractured = scene;
    auto& model = fractured.model;
    SlipSystem<2> springs{{std::sqrt(0.5), -std::sqrt(0.5)}};
    springs.law = FrictionLaw::none;
    springs.compliance = {.normal_m_per_pa = 1e-30, .tangential_m_per_pa = 1e-30, .spacing_m = 1};
    add_fractures<2>(model, {"planes", {springs}}, [](const Point<2>& at) { return at[1] > 36; });
    EXPECT_EQ(leave_out_inert(model, std::numeric_limits<double>::epsilon()),
              std::vector<std::string>{"planes"});
    EXPECT_TRUE(traces_of(fractured) == traces_of(scene)) << "seed " << seed;
  }
}

TEST(Symmetry, ShotsTogetherGiveTheSumOfTheirTraces) {
  for (const unsigned seed : seeds()) {
    auto scene = drawn(seed);
    const auto one = traces_of(scene);
    auto other_scene = scene;
    shoot_from(other_scene, {52.1, 27.3}, "explosion", scene.survey.receivers_m);
    auto sum = traces_of(other_scene);
    for (std::size_t n = 0; n < sum.size(); ++n) sum[n] += one[n];
    auto both = scene;
    both.survey.blended = {{other_scene.survey.sources[0]}};
    // Rows with a source take two half sweeps, and where one is does not change the waves of the other beyond
    // that.
    EXPECT_LT(difference(traces_of(both), sum), 0.002) << "seed " << seed;
  }
}

}  // namespace
}  // namespace slipwave::solver::symmetry_test
