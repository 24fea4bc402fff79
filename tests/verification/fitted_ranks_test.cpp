// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "fitted_scenes.hpp"
#include "shared_out.hpp"

// Several ranks against one where rows follow horizons.
namespace slipwave::solver {
namespace {

// Proves (F9).
TEST(FittedRanks, TakeTheTimeStepOfOneProcess) {
  const auto scene = fitted_sea(90, 190);
  const double alone = time_step_s(scene);
  RanksInThreads::run(3, [&](Ranks& ranks) { EXPECT_EQ(time_step_s(part_of(scene, ranks)), alone); });
}

// Proves (F10).
TEST(FittedRanks, RecordWhatOneProcessDoes) {
  struct Kind {
    EdgeLaw sides;
    int order, time_order;
  };
  for (const auto& [sides, order, time_order] : {Kind{EdgeLaw::absorbing, 5, 2}, Kind{EdgeLaw::free, 7, 4},
                                                 Kind{EdgeLaw::rigid, 3, 2}, Kind{EdgeLaw::mirror, 1, 2}})
    for (const bool hills : {false, true}) {
      SCOPED_TRACE("sides " + std::to_string(int(sides)) + (hills ? " hills" : " sea"));
      auto scene = hills ? fitted_hills(90, 190) : fitted_sea(90, 190);
      scene.survey.sources[0].position_m[0] = 203;
      scene.survey.receivers_m = {{330, 130}, {262.5, 261.3}, {240, 333}, {40, 162}, {300, 301}, {33, 901}};
      scene.edges[0] = {sides, sides};
      scene.numerics.order = order;
      scene.numerics.time_order = time_order;
      scene.recording.duration_s = 0.2;
      check(scene);
      const auto alone = all_samples(shoot(scene, 1));
      ASSERT_GT(*std::max_element(alone.begin(), alone.end()), 0);
      for (const int count : {2, time_order == 4 ? 2 : 4})
        EXPECT_TRUE(all_samples(shared_out(scene, count, count == 2 ? 3 : 1)) == alone) << count << " ranks";
    }
}

TEST(FittedRanks, RecordInThreeDimensionsWhatOneProcessDoes) {
  auto scene = fitted_sea_3d({34, 20, 100});
  scene.recording.duration_s = 0.05;
  scene.survey.receivers_m.push_back({80, 50, 470});
  const auto alone = all_samples(shoot(scene, 1));
  ASSERT_GT(*std::max_element(alone.begin(), alone.end()), 0);
  for (const int count : {2, 3})
    EXPECT_TRUE(all_samples(shared_out(scene, count, count)) == alone) << count << " ranks";
}

}  // namespace
}  // namespace slipwave::solver
