#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "accuracy/choice.hpp"
#include "accuracy/expected_error.hpp"
#include "promise_scenes.hpp"
#include "solver/simulation.hpp"

// What --plan promises against the errors of drawn scenes of layers, by their exact traces (LayerStack).
namespace slipwave::solver {
namespace {

/// None of these scenes was looked at when the promise was fitted.
constexpr std::uint64_t first_seed = 4000;

double true_error(const DrawnScene& drawn) {
  std::vector<double> found;
  for (const auto& trace : shoot(drawn.scene(), 1).traces)
    for (const float sample : trace.samples) found.push_back(sample / 1e6);
  return relative_error(found, drawn.exact_traces());
}

double promised_error(const DrawnScene& drawn) {
  return WavesOfScene(drawn.scene()).expected().promise->error;
}

TEST(Promise, IsWithinAFactorOfTwoOfTheErrorInNineOfTenScenes) {
  const bool all = std::getenv("SLIPWAVE_LONG");
  // The short form takes every fifth.
  const int scenes = all ? 50 : 10, step = all ? 1 : 5;
  int within = 0, too_small = 0;
  for (int n = 0; n < scenes; ++n) {
    const DrawnScene drawn(first_seed + std::uint64_t(n * step));
    const double found = true_error(drawn), stated = promised_error(drawn);
    within += stated >= found / 2 && stated <= 2 * found;
    too_small += stated < found / 2;
    if (std::abs(std::log2(stated / found)) > 1)
      GTEST_LOG_(INFO) << drawn.name() << ": promised " << 100 * stated << " %, found " << 100 * found
                       << " %";
  }
  RecordProperty("within", within);
  EXPECT_GE(10 * within, 9 * scenes) << within << " of " << scenes;
  EXPECT_LE(too_small, all ? 1 : 0);
}

TEST(Promise, NamesAStaircaseAsTheLargestCauseAndWhatWouldCureIt) {
  Scene<2> scene;
  const Grid<2> grid{{200, 160}, 5, {0, 0}};
  const std::vector<Layer> layers = {{0, 1500, 0, 1000}, {300, 3000, 1700, 2200, 15}};
  scene.survey.sources = {{{400, 200}, Explosion{}, parse_wavelet("ricker:15"), 1e6}};
  scene.survey.receivers_m = {{300, 300}, {500, 300}, {600, 300}};
  scene.edges = edges_all(EdgeLaw::absorbing);
  scene.recording = {{Component::vx, Component::vz}, 0.6, 0.001};
  scene.model.medium = layered_medium<2>(grid, layers);
  const auto stairs = *WavesOfScene(scene).expected().promise;
  ASSERT_FALSE(stairs.causes.empty());
  EXPECT_NE(stairs.causes[0].name.find("sea floor"), std::string::npos) << stairs.causes[0].name;
  EXPECT_NE(stairs.causes[0].name.find("staircase of up to 15 degrees"), std::string::npos);
  EXPECT_EQ(stairs.causes[0].remedy, "fit it (sw-layers --fit floor)");
  EXPECT_FALSE(stairs.causes[0].curable);
  // Cells that are split keep the stairs: that error does not fall.
  const WavesOfScene waves(scene);
  const double dt = time_step_s(scene);
  EXPECT_NEAR(waves.expected({5, dt / 4, 1.25}).promise->causes[0].error, stairs.causes[0].error,
              1e-9 * stairs.causes[0].error);
  const auto choice = cheapest_setting(scene, 0.01);
  EXPECT_FALSE(choice.good_enough);
  EXPECT_NE(choice.reason.find("however fine the cells"), std::string::npos) << choice.reason;
  // Fitted, it is no cause to speak of.
  const auto fit = fit_layers<2>(grid, layers, {});
  scene.model.medium = layered_medium<2>(fit.grid, layers, true, fit.rows);
  const auto fitted = *WavesOfScene(scene).expected().promise;
  EXPECT_LT(fitted.error, stairs.error / 4);
}

TEST(Promise, OfASplitModelIsNoBetterThanItsGeometry) {
  // The same stairs in cells a quarter as large.
  Scene<2> scene;
  const std::vector<Layer> layers = {{0, 1500, 0, 1000}, {303, 3000, 1700, 2200, 20}};
  scene.model.medium = layered_medium<2>(Grid<2>{{120, 100}, 8, {0, 0}}, layers);
  scene.survey.sources = {{{400, 200}, Explosion{}, parse_wavelet("ricker:15"), 1e6}};
  scene.survey.receivers_m = {{300, 300}, {500, 300}};
  scene.edges = edges_all(EdgeLaw::absorbing);
  scene.recording = {{Component::vx, Component::vz}, 0.5, 0.001};
  const double whole = WavesOfScene(scene).expected().promise->floor;
  const double split = WavesOfScene(with_setting(scene, {5, 0.9, 2})).expected().promise->floor;
  EXPECT_GT(whole, 0.05);
  EXPECT_NEAR(split, whole, 0.3 * whole);
}

}  // namespace
}  // namespace slipwave::solver
