// SPDX-License-Identifier: BSD-3-Clause
// What --plan promises of the response of fractures, and what --error --of response chooses by it, against
// converged runs of drawn scenes.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numeric>

#include "accuracy/choice.hpp"
#include "accuracy/expected_error.hpp"
#include "accuracy/response_error.hpp"
#include "response_scenes.hpp"
#include "single_fracture_scenes.hpp"

namespace slipwave::solver {
namespace {

/// None of these scenes was looked at when the promise was fitted.
constexpr std::uint64_t first_seed = 1000;

double promised_of(const Scene<2>& scene) {
  return FractureResponse(scene).promised(response_setting(scene)).error;
}

// Proves (S33).
TEST(ResponsePromise, IsWithinAFactorOfTwoOfTheErrorInMostScenes) {
  const bool all = std::getenv("SLIPWAVE_LONG");
  // The short form takes some that are small.
  std::vector<std::uint64_t> seeds = {2003, 2006, 2008};
  if (all) {
    seeds.resize(60);
    std::iota(seeds.begin(), seeds.end(), first_seed);
  }
  const std::size_t scenes = seeds.size();
  std::size_t within = 0, too_small = 0;
  for (const auto seed : seeds) {
    const ResponseScene drawn(seed, !all);
    const auto exact = response_of(drawn.reference());
    const double found =
        error_below(response_of(drawn.scene()), exact, drawn.below_hz(), drawn.scene().recording.interval_s);
    const double stated = promised_of(drawn.scene());
    within += stated >= found / 2 && stated <= 2 * found;
    too_small += stated < found / 2;
    if (std::abs(std::log2(stated / found)) > 1 || std::getenv("SLIPWAVE_SHOW"))
      GTEST_LOG_(INFO) << drawn.name() << ": promised " << 100 * stated << " %, found " << 100 * found
                       << " %";
  }
  RecordProperty("within", int(within));
  EXPECT_GE(10 * within, 9 * scenes) << within << " of " << scenes;
  EXPECT_LE(too_small, scenes / 20);
}

// Proves (S33a).
TEST(ResponsePromise, OfSingleFracturesIsWithinAFactorOfTwoOfWhatBoundaryElementsSay) {
  const bool all = std::getenv("SLIPWAVE_LONG");
  const int scenes = all ? 60 : 4;
  int within = 0;
  for (int n = 0; n < scenes; ++n) {
    const SingleFractureScene drawn(std::uint64_t(all ? 100 : 300) + std::uint64_t(n), !all);
    const double found = drawn.error(), stated = promised_of(drawn.scene());
    const bool right = stated >= found / 2 && stated <= 2 * found;
    within += right;
    if (!right || std::getenv("SLIPWAVE_SHOW"))
      GTEST_LOG_(INFO) << drawn.name() << ": promised " << 100 * stated << " %, found " << 100 * found
                       << " %";
  }
  EXPECT_GE(10 * within, 9 * scenes) << within << " of " << scenes;
}

/// A cluster under a plane wave, in large cells.
Scene<2> plane_wave_scene(double h) {
  Scene<2> scene;
  scene.model.medium = uniform_medium(std::int64_t(600 / h), std::int64_t(500 / h), h, {4500, 2250, 2500});
  scene.model.fracture = Field<2, std::uint8_t>(scene.model.grid());
  for (auto i = std::int64_t(150 / h); i < std::int64_t(450 / h); ++i)
    for (auto k = std::int64_t(250 / h); k < std::int64_t(350 / h); ++k) scene.model.fracture({i, k}) = 1;
  const double half = std::sqrt(0.5);
  scene.model.fracture_sets = {{"cluster", {{{half, half}, 0.1, 3800, 0}}}};
  scene.survey.sources = {{{300, 0}, parse_mechanism<2>("plane:0"), parse_wavelet("sine:30:1"), 0.01}};
  for (double x = 100; x < 501; x += 40) scene.survey.receivers_m.push_back({x, 100});
  scene.edges = edges_all(EdgeLaw::absorbing);
  scene.recording = {{Component::vx, Component::vz}, 0.3, 0.001};
  return scene;
}

// Proves (S32), (S33).
TEST(ResponsePromise, FallsWithCellsAndStepsAndNamesWhatIsLeft) {
  const auto of = [](double h, double cfl, SlipCorrection correction) {
    auto scene = plane_wave_scene(h);
    scene.numerics.cfl = cfl;
    scene.numerics.correction = correction;
    return FractureResponse(scene).promised(response_setting(scene));
  };
  using enum SlipCorrection;
  const auto coarse = of(10, 0.9, centred), fine = of(5, 0.9, centred);
  EXPECT_EQ(coarse.below_hz, 60);
  EXPECT_GT(observed_order(coarse.error, fine.error), 1.5);
  EXPECT_GT(of(5, 0.9, second).error, 2 * fine.error);
  EXPECT_LT(of(5, 0.45, centred).error, 0.8 * fine.error);
  const auto late = of(5, 0.9, second).causes.front();
  EXPECT_NE(late.name.find("time step of slip"), std::string::npos) << late.name;
  EXPECT_NE(late.remedy.find("--correction centred"), std::string::npos) << late.remedy;
}

/// A plane S wave on planes along the top of a cluster that nothing holds: it comes back whole.
struct MirroredWave {
  static constexpr double top_m = 150, receiver_m = 112.5, middle_m = 675, vs = 2250;
  Scene<2> scene;
  explicit MirroredWave(double h) {
    scene.model.medium =
        uniform_medium(std::llround(2 * middle_m / h), std::llround(270 / h), h, {4500, vs, 2500});
    scene.model.fracture = Field<2, std::uint8_t>(scene.model.grid());
    for (auto i = std::llround(75 / h); i < std::llround(1275 / h); ++i)
      for (auto k = std::llround(top_m / h); k < std::llround(240 / h); ++k) scene.model.fracture({i, k}) = 1;
    scene.model.fracture_sets = {{"cluster", {{{0, 1}, 0, 0, 0}}}};
    scene.survey.sources = {
        {{middle_m, 0}, parse_mechanism<2>("plane-s:0"), parse_wavelet("ricker:30"), 0.01}};
    scene.survey.receivers_m = {{middle_m, receiver_m}};
    scene.edges = edges_all(EdgeLaw::absorbing);
    scene.numerics.order = 7;
    // Until P waves come from its ends.
    scene.recording = {{Component::vx, Component::vz}, 0.2, 0.001};
  }
  double error() const {
    const auto found = response_of(scene);
    std::vector<double> exact;
    const auto& source = scene.survey.sources[0];
    for (std::size_t n = 0; n < found[0].size(); ++n)
      exact.push_back(source.amplitude * source.wavelet(double(n) * 0.001 - (2 * top_m - receiver_m) / vs));
    return error_below({found[0]}, {exact}, 60, 0.001);
  }
};

// Proves (S33b).
TEST(ResponsePromise, KnowsTheWavesThatCellsLetIntoAClusterAlongItsPlanes) {
  const MirroredWave coarse(7.5), fine(3.75);
  double before = 1;
  for (const auto& wave : {coarse, fine}) {
    const double found = wave.error(), stated = promised_of(wave.scene);
    EXPECT_GT(stated, 0.5 * found) << found;
    EXPECT_LT(stated, 2 * found) << found;
    EXPECT_LT(found, before);
    before = found;
  }
}

// Proves (S32a).
TEST(ResponsePromise, CountsWhatTheTimeStepLeavesOfWavesThatSpringsSlowDown) {
  // A cluster in which S waves have 0.5 to 0.7 of their speed (S32a). What springs send out by themselves was
  // promised only: 0.3 to 0.4 of what is found.
  constexpr double vp = 3800, vs = 2100, rho = 2400, mu = rho * vs * vs;
  const auto scene_of = [&](double h, double give, bool crossing) {
    Scene<2> scene;
    scene.model.medium = uniform_medium(std::int64_t(480 / h), std::int64_t(330 / h), h, {vp, vs, rho});
    scene.model.fracture = Field<2, std::uint8_t>(scene.model.grid());
    for (auto i = std::int64_t(190 / h); i < std::int64_t(290 / h); ++i)
      for (auto k = std::int64_t(140 / h); k < std::int64_t(190 / h); ++k) scene.model.fracture({i, k}) = 1;
    std::vector<SlipSystem<2>> systems(crossing ? 2 : 1);
    for (std::size_t n = 0; n < systems.size(); ++n) {
      systems[n].law = FrictionLaw::none;
      systems[n].normal = {n ? 1. : 0., n ? 0. : 1.};
      systems[n].compliance.spacing_m = 1;
      systems[n].compliance.normal_m_per_pa = systems[n].compliance.tangential_m_per_pa = give / mu;
    }
    scene.model.fracture_sets = {{"cluster", systems}};
    scene.survey.sources = {{{150, 60}, Explosion{}, parse_wavelet("ricker:40"), 1e9}};
    for (double x = 30; x < 451; x += 30)
      for (const double z : {40., 290.}) scene.survey.receivers_m.push_back({x, z});
    scene.edges = edges_all(EdgeLaw::absorbing);
    scene.recording = {{Component::vx, Component::vz}, 0.2, 0.0005};
    return scene;
  };
  for (const auto& [give, crossing] : {std::pair{1., true}, {3., false}}) {
    auto fine = with_setting(scene_of(2.5, give, crossing), {7, 0.45, 2.5 / 3, SlipCorrection::centred});
    fine.numerics.zone_cells = 60;
    const auto scene = scene_of(2.5, give, crossing);
    const double found = error_below(response_of(scene), response_of(fine), 80, 0.0005),
                 stated = promised_of(scene);
    if (std::getenv("SLIPWAVE_SHOW"))
      GTEST_LOG_(INFO) << give << ": promised " << 100 * stated << " %, found " << 100 * found << " %";
    EXPECT_GT(stated, 0.5 * found) << give;
    EXPECT_LT(stated, 2 * found) << give;
  }
}

// Proves (S33).
TEST(ResponsePromise, OfAWantedErrorIsKeptByTheSettingThatIsChosen) {
  const auto scene = plane_wave_scene(10);
  constexpr double wanted = 0.08;
  const auto choice = cheapest_setting_for_response(scene, wanted);
  ASSERT_TRUE(choice.good_enough);
  auto fine = with_setting(scene, {7, 0.45, 2.5, SlipCorrection::centred});
  fine.numerics.zone_cells = 60;
  const double found = error_below(response_of(chosen_scene(scene, choice)), response_of(fine), 60, 0.001);
  EXPECT_LT(found, wanted);
  EXPECT_GT(found, wanted / 6);
  // As it is, it would not do.
  EXPECT_GT(promised_of(scene), wanted);
  // A smaller one never gets less.
  double before = 1;
  for (const double less : {0.2, 0.1, 0.05, 0.02}) {
    const auto one = cheapest_setting_for_response(scene, less);
    EXPECT_LE(one.expected_error, before);
    before = one.expected_error;
  }
  // The elastic shot is computed alike.
  auto elastic = scene;
  elastic.with_slip = false;
  const auto same = cheapest_setting_for_response(elastic, wanted);
  EXPECT_EQ(same.setting.order, choice.setting.order);
  EXPECT_EQ(same.setting.cfl, choice.setting.cfl);
  EXPECT_EQ(same.setting.spacing_m, choice.setting.spacing_m);
  EXPECT_EQ(same.setting.zone_cells, choice.setting.zone_cells);
}

TEST(ResponsePromise, ChoosesWiderEdgesWhereTheResponseGrazesThem) {
  auto scene = plane_wave_scene(10);
  auto grazing = scene;
  // Receivers along a side, as far away as the model goes.
  grazing.model.medium = uniform_medium(60, 400, 10, {4500, 2250, 2500});
  grazing.model.fracture = Field<2, std::uint8_t>(grazing.model.grid());
  for (std::int64_t i = 0; i < 20; ++i)
    for (std::int64_t k = 360; k < 370; ++k) grazing.model.fracture({i, k}) = 1;
  grazing.recording.duration_s = 2.5;
  grazing.survey.receivers_m = {{10, 100}, {30, 100}, {50, 100}};
  const auto share = [](const Scene<2>& of, int zone) {
    auto setting = response_setting(of);
    setting.zone_cells = zone;
    for (const auto& cause : FractureResponse(of).promised(setting).causes)
      if (cause.name.find("edges") != std::string::npos) return cause.error;
    return 0.;
  };
  EXPECT_GT(share(grazing, 20), 20 * share(scene, 20));
  EXPECT_GT(share(grazing, 20), 3 * share(grazing, 60));
  EXPECT_GT(share(grazing, 20), 0.01);
}

TEST(ResponsePromise, TellsPlanesThatCanNotSlipFromTracesThatEndTooEarly) {
  auto scene = plane_wave_scene(10);
  const auto why = [&] { return FractureResponse(scene).why_not(); };
  auto& system = scene.model.fracture_sets[0].systems[0];
  system.strength_pa = 1e12;
  EXPECT_NE(why().find("the fractures do not slip"), std::string::npos) << why();
  EXPECT_EQ(why().find("before the traces end"), std::string::npos) << why();
  system.law = FrictionLaw::none;
  EXPECT_NE(why().find("neither slip nor give way"), std::string::npos) << why();
  scene.recording.duration_s = 0.001;
  EXPECT_NE(why().find("before the traces end"), std::string::npos) << why();
}

TEST(ResponsePromise, SaysWhatItDoesNotKnow) {
  auto scene = plane_wave_scene(10);
  const auto why = [&] { return expected_error(scene).response_unknown; };
  EXPECT_EQ(why(), "");
  EXPECT_TRUE(expected_error(scene).response);
  scene.edges[1][0] = EdgeLaw::free;
  scene.survey.sources[0].mechanism = Explosion{};
  scene.survey.sources[0].position_m = {300, 50};
  const auto left_out = FractureResponse(scene).not_covered();
  ASSERT_EQ(left_out.size(), 1);
  EXPECT_NE(left_out[0].find("reflection"), std::string::npos);
  scene.recording.duration_s = 0.05;
  EXPECT_NE(why().find("before the traces end"), std::string::npos) << why();
  scene.recording.duration_s = 0.3;
  scene.model.fracture_sets[0].systems[0].opens = true;
  EXPECT_NE(why().find("'cluster' open"), std::string::npos) << why();
  EXPECT_THROW(cheapest_setting_for_response(scene, 0.1), Error);
  scene.model.fracture_sets[0].systems[0].opens = false;
  scene.model.fracture_sets[0].systems[0].law = FrictionLaw::slip_weakening;
  EXPECT_NE(why().find("weaken"), std::string::npos) << why();
  scene.with_slip = false;
  EXPECT_EQ(why(), "");
  EXPECT_FALSE(expected_error(scene).response);
}

}  // namespace
}  // namespace slipwave::solver
