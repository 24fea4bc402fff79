// SPDX-License-Identifier: BSD-3-Clause
#include "accuracy/ladder.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "grid/locate.hpp"
#include "model_cases.hpp"
#include "planning/measured.hpp"
#include "planning/measured_error.hpp"
#include "planning/plan.hpp"
#include "solver/simulation.hpp"

namespace slipwave::accuracy_ladder_test {
namespace {

/// A trace of each component, of these samples.
Gather gather_of(const std::vector<std::pair<Component, std::vector<double>>>& traces) {
  Gather gather;
  gather.axis = {std::int64_t(traces.front().second.size()), 0.001, 0};
  for (const auto& [component, samples] : traces) {
    gather.traces.push_back({{}, samples});
    gather.traces.back().header.component = component;
  }
  return gather;
}

/// Rock under water with cracks in a corner, 400 m x 300 m in cells of 10 m.
Scene<2> small_scene() {
  Scene<2> scene;
  scene.model = water_over_rock(grid_of(40, 30, 10), 7);
  scene.model.fracture = Field<2, std::uint8_t>(scene.model.grid());
  scene.model.fracture({35, 25}) = 1;
  scene.model.fracture_sets = {{"cracks", {{{0, 1}, 0.5, 100, 1e3}}}};
  scene.survey.sources = {{{105, 35}, Explosion{}, parse_wavelet("ricker:15"), 1e6}};
  scene.survey.receivers_m = {{305, 35}, {205, 155}};
  for (int axis = 0; axis < 2; ++axis) scene.edges[axis] = {EdgeLaw::absorbing, EdgeLaw::absorbing};
  scene.edges[1][0] = EdgeLaw::free;
  scene.recording = {{Component::vz, Component::p}, 0.3, 0.002};
  return scene;
}

}  // namespace

TEST(ErrorOfGathers, CountsVelocitiesAndStressesSeparately) {
  using enum Component;
  const auto exact =
      gather_of({{vx, {3, 0, 0, 0}}, {vz, {4, 0, 0, 0}}, {szz, {3e6, 0, 0, 0}}, {p, {4e6, 0, 0, 0}}});
  // 1 of 5 in the velocities, 1 of 50 in the stresses.
  auto found = exact;
  found.traces[1].samples[1] = 1;
  found.traces[2].samples[1] = 1e5;
  EXPECT_NEAR(gather_error({found}, {exact}).whole, 0.2, 1e-14);
  // The other way round.
  found = exact;
  found.traces[0].samples[2] = 0.1;
  found.traces[3].samples[2] = 1e6;
  EXPECT_NEAR(gather_error({found}, {exact}).whole, 0.2, 1e-14);
  EXPECT_EQ(gather_error({exact}, {exact}).whole, 0);
}

TEST(ErrorOfGathers, AddsTheEnergiesOfAllShots) {
  const auto one = [](double value) { return gather_of({{Component::vx, {value, 0, 0, 0}}}); };
  EXPECT_NEAR(gather_error({one(3), one(4.5)}, {one(3), one(4)}).whole, 0.1, 1e-14);
}

TEST(ErrorOfGathers, IsLateInTheLastQuarterOnly) {
  const auto exact = gather_of({{Component::vz, {4, 0, 0, 0, 0, 0, 3, 4}}});
  auto found = exact;
  found.traces[0].samples[5] = 1;
  EXPECT_EQ(gather_error({found}, {exact}).late, 0);
  EXPECT_NEAR(gather_error({found}, {exact}).whole, 1 / std::sqrt(41.), 1e-14);
  found.traces[0].samples[6] = 4;
  EXPECT_NEAR(gather_error({found}, {exact}).late, 0.2, 1e-14);
  EXPECT_NEAR(gather_error({found}, {exact}).whole, std::sqrt(2 / 41.), 1e-14);
}

TEST(ErrorOfGathers, IsInfiniteWhereNothingWasExpectedAndNoneWhereNothingCame) {
  const auto of = [](double v, double s) {
    return gather_of({{Component::vx, {v, 0, 0, 0}}, {Component::sxz, {s, 0, 0, 0}}});
  };
  EXPECT_EQ(gather_error({of(0, 5)}, {of(0, 5)}).whole, 0);
  EXPECT_EQ(gather_error({of(1e-9, 5)}, {of(0, 5)}).whole, std::numeric_limits<double>::infinity());
  EXPECT_EQ(gather_error({of(0, 0)}, {of(0, 0)}).whole, 0);
  // Nothing in the last quarter of either.
  EXPECT_EQ(gather_error({of(1, 5)}, {of(2, 5)}).late, 0);
  EXPECT_EQ(gather_error({of(0, 0)}, {of(2, 5)}).whole, 1);
}

TEST(SceneWithASetting, IsTheSameGeologyInOtherCells) {
  const auto scene = small_scene();
  const AccuracySetting setting{7, 0.4, 2.5, SlipCorrection::first, 4};
  const auto changed = with_setting(scene, setting);
  const auto &old_grid = scene.model.grid(), &grid = changed.model.grid();
  EXPECT_EQ(grid.shape, (Index<2>{160, 120}));
  EXPECT_EQ(grid.spacing_m, 2.5);
  for (std::int64_t n = 0; n < grid.size(); ++n) {
    const auto at = grid.index(n);
    const auto old = std::size_t(old_grid.flat({at[0] / 4, at[1] / 4}));
    const auto cell = std::size_t(n);
    ASSERT_EQ(changed.model.medium.vp[cell], scene.model.medium.vp[old]) << n;
    ASSERT_EQ(changed.model.medium.vs[cell], scene.model.medium.vs[old]) << n;
    ASSERT_EQ(changed.model.medium.rho[cell], scene.model.medium.rho[old]) << n;
    ASSERT_EQ(changed.model.fracture[cell], scene.model.fracture[old]) << n;
  }
  EXPECT_EQ(changed.model.fracture_sets.size(), 1u);
  EXPECT_EQ(changed.numerics.order, 7);
  EXPECT_EQ(changed.numerics.time_order, 4);
  EXPECT_EQ(changed.numerics.correction, SlipCorrection::first);
  EXPECT_NEAR(time_step_s(changed), 0.4 * 2.5 / 3000, 1e-12);
  EXPECT_EQ(changed.survey.receivers_m, scene.survey.receivers_m);
  EXPECT_EQ(changed.survey.sources[0].position_m, scene.survey.sources[0].position_m);
  EXPECT_EQ(changed.recording.samples(), scene.recording.samples());
}

TEST(SceneWithASetting, ForgetsATimeStepOfItsOwnAndKeepsTheRest) {
  auto scene = small_scene();
  scene.numerics.time_step_s = 1e-5;
  scene.numerics.double_precision = true;
  scene.numerics.zone_cells = 13;
  const auto changed = with_setting(scene, {3, 0.5, 10});
  EXPECT_NEAR(time_step_s(changed), 0.5 * 10 / 3000, 1e-12);
  EXPECT_TRUE(changed.numerics.double_precision);
  EXPECT_EQ(changed.numerics.zone_cells, 13);
  EXPECT_EQ(changed.model.grid(), scene.model.grid());
}

TEST(SceneWithASetting, CoversItsExtentWithCellsOfAnySize) {
  const auto scene = small_scene();
  for (const double spacing_m : {7., 11.3, 15.}) {
    const auto changed = with_setting(scene, {5, 0.9, spacing_m});
    const auto& grid = changed.model.grid();
    for (const int axis : {0, 1}) {
      EXPECT_GE(grid.end(axis), scene.model.grid().end(axis) - 1e-9);
      EXPECT_LT(grid.end(axis), scene.model.grid().end(axis) + spacing_m);
    }
    EXPECT_EQ(changed.model.medium.vs[0], 0);  // still water above
    check(changed.model);
    check(changed);
  }
}

TEST(NameOfASetting, SaysWhatIsVaried) {
  auto scene = small_scene();
  EXPECT_EQ(name_of({7, 0.5, 2.5, SlipCorrection::first}, scene),
            "order 7, Courant 0.5, 2.5 m, first-order slip");
  EXPECT_EQ(name_of({7, 1.9, 10. / 3, SlipCorrection::second, 4}, scene),
            "order 7, 4 in time, Courant 1.9, 3.333 m, second-order slip");
  scene.with_slip = false;
  EXPECT_EQ(name_of({3, 0.9, 10}, scene), "order 3, Courant 0.9, 10 m");
}

TEST(MeasuredSetting, SaysWhatWasComputed) {
  auto scene = small_scene();
  scene.survey.sources.push_back(scene.survey.sources[0]);
  scene.survey.sources[1].position_m = {295, 35};
  SceneRuns<2> runs(scene, {{1, 2}, false});
  const AccuracySetting setting{5, 0.8, 10};
  const auto row = measured(runs, setting, {});
  const auto gathers = runs.run(setting).observed;
  ASSERT_EQ(gathers.size(), 2u);
  EXPECT_EQ(gathers[0].traces.size(), 4u);
  EXPECT_TRUE(std::isnan(row.error));
  EXPECT_TRUE(std::isnan(row.late_error));
  EXPECT_EQ(row.order, 5);
  EXPECT_EQ(row.time_order, 2);
  EXPECT_EQ(row.slip_order, 4);
  EXPECT_NEAR(row.courant, 0.8, 1e-9);
  // PMLs of 20 cells at three edges.
  EXPECT_EQ(row.cells, (40 + 2 * 20) * (30 + 20));
  // Until the end, and as far beyond it as the interpolation in time reaches.
  EXPECT_GE(double(row.steps) * 0.8 * 10 / 3000, 0.3);
  EXPECT_LE(double(row.steps - 9) * 0.8 * 10 / 3000, 0.3);
  EXPECT_GT(row.seconds, 0);
  EXPECT_GT(row.memory_bytes, double(row.cells) * 10 * sizeof(float));
  // Against itself, and against traces one tenth larger.
  EXPECT_EQ(measured(runs, setting, gathers).error, 0);
  auto larger = gathers;
  for (auto& gather : larger)
    for (auto& trace : gather.traces)
      for (auto& sample : trace.samples) sample *= 1.1;
  EXPECT_NEAR(measured(runs, setting, larger).error, 0.1 / 1.1, 1e-6);
}

TEST(RunsOfAScene, AreMadeOnceAndGiveTheResponseAsADifference) {
  auto scene = small_scene();
  scene.survey.sources[0].amplitude = 1e12;  // so strong that the crack slips
  SceneRuns<2> runs(scene, {{1}, true});
  const auto& run = runs.run(setting_of(scene));
  EXPECT_EQ(&run, &runs.run(setting_of(scene)));
  auto intact = scene;
  intact.with_slip = false;
  const auto response = sum_of({shoot(scene, 1)}, {shoot(intact, 1)}, -1);
  EXPECT_EQ(size_of_error(sum_of(run.observed, response, -1), response).whole, 0);
  EXPECT_GT(size_of_error(run.observed, run.recorded).whole, 0);
}

TEST(RunsOfAScene, KeepEdgesThatSendWavesBackWhereTheyAre) {
  auto scene = small_scene();
  scene.edges[0] = {EdgeLaw::mirror, EdgeLaw::free};
  const SceneRuns<2> runs(scene, {{1}, false});
  const auto larger = runs.resized(setting_of(scene), 1.5);
  ASSERT_TRUE(larger);
  const double cells = 400 / larger->spacing_m;
  EXPECT_NEAR(cells, std::round(cells), 1e-9);
  EXPECT_NEAR(larger->spacing_m, 15, 0.6);
  // As wide in metres.
  EXPECT_NEAR(larger->zone_cells * larger->spacing_m, 200, larger->spacing_m);
}

TEST(RunsOfAScene, HoldNoCellsThatPutReceiversIntoOtherMatter) {
  auto scene = small_scene();
  // In the lowest row of water.
  scene.survey.receivers_m = {{205, 69}};
  const SceneRuns<2> runs(scene, {{1}, false});
  const auto other = runs.resized(setting_of(scene), 4);
  if (other) {
    const auto coarse = runs.scene_of(*other);
    const auto& medium = coarse.model.medium;
    EXPECT_TRUE(medium.is_fluid(std::size_t(medium.grid().flat(cell_of(medium.grid(), Point<2>{205, 69})))));
  }
}

TEST(MeasuredErrors, LeaveOutReceiversInTheCellsOfSources) {
  auto scene = small_scene();
  const auto measure = [&] {
    SceneRuns<2> runs(scene, {{1}, false});
    return measured_error(runs, setting_of(scene));
  };
  const auto without = measure();
  EXPECT_EQ(without.beside_source, 0u);
  scene.survey.receivers_m.push_back({115, 45});
  const auto with = measure();
  EXPECT_EQ(with.beside_source, 1u);
  for (const auto& trace : with.wrong[0].traces)
    EXPECT_EQ(std::all_of(trace.samples.begin(), trace.samples.end(), [](double one) { return one == 0; }),
              trace.header.channel == 3);
  // They are all that was asked for.
  scene.survey.receivers_m = {{115, 45}};
  const auto alone = measure();
  EXPECT_EQ(alone.beside_source, 0u);
  EXPECT_GT(alone.error.whole, 0);
}

TEST(ErrorOfGathers, IsNotWorstWhereNothingArrived) {
  using enum Component;
  auto found = gather_of({{vz, {0, 0, 3, 4}}, {vz, {0, 0, 0, 0}}});
  found.traces[1].header.channel = 2;
  auto wrong = found;
  for (auto& trace : wrong.traces) trace.samples = {0, 0, 0, 0.5};
  const auto error = size_of_error({wrong}, {found});
  EXPECT_NEAR(error.worst, 0.1, 1e-12);
  EXPECT_NE(error.worst_channel, 2);
}

TEST(RepresentativeShots, AreThoseThatDifferMost) {
  Survey<2> survey;
  const auto add = [&](double x, const char* wavelet) {
    survey.sources.push_back({{x, 5}, Explosion{}, parse_wavelet(wavelet), 1});
  };
  for (int n = 0; n < 9; ++n) add(100 * n, "ricker:15");
  EXPECT_EQ(representative_shots(survey), (std::vector<std::size_t>{1, 9}));
  survey.sources[4].wavelet = parse_wavelet("ricker:20");
  const auto shots = representative_shots(survey);
  EXPECT_EQ(std::count(shots.begin(), shots.end(), 5u), 1);
  for (int n = 9; n < 21; ++n) add(100 * n, "ricker:15");
  EXPECT_EQ(representative_shots(survey).size(), 3u);
  survey.sources.erase(survey.sources.begin() + 1, survey.sources.end());
  EXPECT_EQ(representative_shots(survey), (std::vector<std::size_t>{1}));
}

}  // namespace slipwave::accuracy_ladder_test
