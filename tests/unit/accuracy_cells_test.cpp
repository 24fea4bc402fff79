#include <gtest/gtest.h>

#include "accuracy/direct_waves.hpp"
#include "accuracy/ladder.hpp"
#include "accuracy/model_in_cells.hpp"
#include "model/layers.hpp"
#include "model/resample.hpp"

namespace slipwave {
namespace {

Model<2> model_of(const std::vector<Layer>& layers, double spacing_m, const std::string& history) {
  const auto grid = grid_over<2>({400, 300}, spacing_m);
  const auto fit = fit_layers<2>(grid, layers, parse_fit("none"));
  Model<2> model;
  model.medium = layered_medium<2>(fit.grid, layers, Average::isotropic, fit.rows);
  model.history = history;
  return model;
}

const std::vector<Layer> sea = {{0, 1500, 0, 1000}, {103, 3000, 1600, 2200, 10}, {203, 4000, 2300, 2400}};
const char* const sea_command =
    "sw-layers --size 400x300 --step 10 --layer 0:1500:0:1000 --layer '103:3000:1600:2200:10' "
    "--layer=203:4000:2300:2400 --average isotropic --fit none -o sea.nc";

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

void expect_alike(const Medium<2>& found, const Medium<2>& expected) {
  ASSERT_EQ(found.grid(), expected.grid());
  for (const auto property : expected.properties())
    for (std::size_t n = 0; n < std::size_t(expected.grid().size()); ++n)
      ASSERT_EQ(found[property][n], expected[property][n]) << n;
}

}  // namespace

TEST(ModelInCells, IsMadeFromTheTopsOfItsLayersInCellsOfAnySize) {
  const auto scene = shot_over(model_of(sea, 10, sea_command));
  const ModelInCells<2> model(scene);
  ASSERT_TRUE(model.from_layers());
  for (const double spacing_m : {2.5, 7., 15.})
    expect_alike(model.of(spacing_m).medium, model_of(sea, spacing_m, "").medium);
  EXPECT_TRUE(model.could_be_fitted());
  EXPECT_TRUE(model.fitted(5).grid().rows);
}

TEST(ModelInCells, IsRegriddedWhereItsHistoryDoesNotGiveIt) {
  auto changed = model_of(sea, 10, sea_command);
  changed.medium.vp[7] = 1501;
  std::vector<Model<2>> models = {changed};
  for (const char* history : {"", "sw-import --vp a.nc", "sw-layers --size 400x300 --step 10 --layer 0:x",
                              "sw-layers --size 400x300 --step 10 --layer @gone.txt:1500:0:1000"})
    models.push_back(model_of(sea, 10, history));
  for (const auto& model : models) {
    const auto scene = shot_over(model);
    const ModelInCells<2> cells(scene);
    EXPECT_FALSE(cells.from_layers()) << model.history;
    expect_alike(cells.of(15).medium, regridded(model, 15, Extent::covered).medium);
  }
}

TEST(ModelInCells, KeepsFracturesWithLayersMadeAnew) {
  auto model = model_of(sea, 10, std::string(sea_command) + "\nsw-fracture sea.nc");
  model.fracture = Field<2, std::uint8_t>(model.grid());
  model.fracture_sets = {{"cracks", {{{0, 1}, 0.5, 100, 1e3}}}};
  // 100 m x 50 m of rock.
  for (std::int64_t i = 20; i < 30; ++i)
    for (std::int64_t k = 22; k < 27; ++k) model.fracture({i, k}) = 1;
  const auto scene = shot_over(model);
  const ModelInCells<2> cells(scene);
  ASSERT_TRUE(cells.from_layers());
  for (const double spacing_m : {5., 15., 22.5}) {
    const auto other = cells.of(spacing_m);
    expect_alike(other.medium, model_of(sea, spacing_m, "").medium);
    double area = 0;
    for (std::size_t n = 0; n < other.fracture.size(); ++n)
      if (other.fracture[n] != 0)
        area += spacing_m * spacing_m * (other.fracture_share.empty() ? 1 : double(other.fracture_share[n]));
    EXPECT_NEAR(area, 5000, 1e-2) << spacing_m;
    check(other);
  }
}

TEST(ModelInCells, AttenuatesAsTheModelDoesWithTheSpeedsOfItsUnrelaxedRock) {
  auto layers = sea;
  layers[1].others = {{Property::qp, 60}, {Property::qs, 30}};
  const std::string command =
      "sw-layers --size 400x300 --step 10 --units km/s,g/cm3 --layer 0:1.5:0:1 --layer '103:3:1.6:2.2:10 "
      "qp=60 qs=30' --layer 203:4:2.3:2.4 --average isotropic --fit none";
  auto scene = shot_over(model_of(layers, 10, command));
  set_attenuation(scene);
  ASSERT_TRUE(scene.attenuates());
  const ModelInCells<2> cells(scene);
  ASSERT_TRUE(cells.from_layers());
  auto expected = shot_over(model_of(layers, 5, command));
  set_attenuation(expected);
  expect_alike(cells.of(5).medium, expected.model.medium);
  // Without its attenuation it is elastic in other cells, too.
  const auto elastic = shot_over(model_of(sea, 10, command));
  EXPECT_FALSE(ModelInCells<2>(elastic).of(5).medium.has(Property::qp));
}

// Proves (E16).
TEST(DirectWaves, AreThoseThatArriveAndFallWithTheSizeOfCells) {
  auto scene = shot_over(model_of({{-1000, 3000, 1600, 2200}}, 10, ""));
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

}  // namespace slipwave
