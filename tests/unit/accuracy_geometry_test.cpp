// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "accuracy/finer_model.hpp"
#include "accuracy/local_stack.hpp"
#include "base/error.hpp"
#include "model/layers.hpp"
#include "model/resample.hpp"

namespace slipwave {
namespace {

Model<2> model_of(const std::vector<Layer>& layers, double spacing_m, const std::string& history) {
  const Grid<2> grid{{std::int64_t(400 / spacing_m), std::int64_t(300 / spacing_m)}, spacing_m, {0, 0}};
  const auto fit = fit_layers<2>(grid, layers, parse_fit("none"));
  Model<2> model;
  model.medium = layered_medium<2>(fit.grid, layers, Average::isotropic, fit.rows);
  model.history = history;
  return model;
}

const std::vector<Layer> sea = {{0, 1500, 0, 1000}, {103, 3000, 1600, 2200, 10}, {203, 4000, 2300, 2400}};
const char* const sea_command =
    "sw-layers --size 400x300 --step 10 --layer 0:1500:0:1000 --layer '103:3000:1600:2200:10' "
    "--layer=203:4000:2300:2400 --fit none -o sea.nc";

Scene<2> shot_over(const Model<2>& model) {
  Scene<2> scene;
  scene.model = model;
  scene.survey.sources = {{{105, 45}, Explosion{}, parse_wavelet("ricker:15"), 1}};
  scene.survey.receivers_m = {{205, 55}, {305, 185}, {205, 255}};
  for (const int axis : {0, 1}) scene.edges[axis] = {EdgeLaw::absorbing, EdgeLaw::absorbing};
  scene.recording = {{Component::vx}, 0.3, 0.001};
  return scene;
}

/// A scene with no more than a model.
Scene<2> with(const Model<2>& model) {
  Scene<2> scene;
  scene.model = model;
  return scene;
}

/// Of the first shot, twelve receivers followed.
LocalStack stack_of(const Scene<2>& scene) { return local_stack(scene, 0, followed_receivers(scene, 0, 12)); }

TEST(FinerModel, IsMadeFromTheTopsOfItsLayers) {
  const auto model = model_of(sea, 10, sea_command);
  const auto finer = finer_model(with(model), 2.5);
  ASSERT_TRUE(finer);
  const auto expected = model_of(sea, 2.5, "");
  ASSERT_EQ(finer->grid(), expected.grid());
  for (std::size_t n = 0; n < std::size_t(expected.grid().size()); ++n)
    ASSERT_EQ(finer->medium.vs[n], expected.medium.vs[n]) << n;
  // Its own command does not give it in other cells: it can be made finer no more.
  EXPECT_FALSE(finer_model(with(*finer), 1.25));
}

TEST(FinerModel, IsNotMadeWhereItsHistoryDoesNotGiveIt) {
  auto model = model_of(sea, 10, sea_command);
  model.medium.vp[7] = 1501;
  EXPECT_FALSE(finer_model(with(model), 5));
  for (const char* history : {"", "sw-import --vp a.nc", "sw-layers --size 400x300 --step 10 --layer 0:x",
                              "sw-layers --size 400x300 --step 10 --layer @gone.txt:1500:0:1000"})
    EXPECT_FALSE(finer_model(with(model_of(sea, 10, history)), 5)) << history;
  EXPECT_FALSE(finer_model(with(model_of(sea, 10, std::string(sea_command) + "\nsw-fracture sea.nc")), 5));
}

TEST(FinerModel, AttenuatesAsTheModelDoesWithTheSpeedsOfItsUnrelaxedRock) {
  auto layers = sea;
  layers[1].others = {{Property::qp, 60}, {Property::qs, 30}};
  const std::string command =
      "sw-layers --size 400x300 --step 10 --units km/s,g/cm3 --layer 0:1.5:0:1 --layer '103:3:1.6:2.2:10 "
      "qp=60 "
      "qs=30' --layer 203:4:2.3:2.4 --fit none";
  auto scene = shot_over(model_of(layers, 10, command));
  set_attenuation(scene);
  ASSERT_TRUE(scene.attenuates());
  const auto finer = finer_model(scene, 5);
  ASSERT_TRUE(finer);
  auto expected = shot_over(model_of(layers, 5, command));
  set_attenuation(expected);
  const auto& medium = expected.model.medium;
  for (const auto property : medium.properties())
    for (std::size_t n = 0; n < medium.vp.size(); ++n)
      ASSERT_EQ(finer->medium[property][n], medium[property][n]) << n;
  // Without its attenuation it is elastic in other cells, too.
  scene = shot_over(model_of(sea, 10, command));
  EXPECT_FALSE(finer_model(scene, 5).value().medium.has(Property::qp));
}

TEST(LocalStack, HasTheLayersDipsAndRepresentationsOfTheModel) {
  const auto stack = stack_of(shot_over(model_of(sea, 5, "")));
  ASSERT_EQ(stack.interfaces.size(), 2u);
  const auto &floor = stack.interfaces[0], &inner = stack.interfaces[1];
  EXPECT_EQ(floor.kind, LocalInterface::Kind::fluid_solid);
  EXPECT_EQ(floor.representation, Representation::staircase);
  EXPECT_NEAR(floor.dip_deg, 10, 1);
  EXPECT_NEAR(floor.depth_m, 103 + 105 * std::tan(0.1745), 5);
  EXPECT_EQ(floor.name().rfind("sea floor at ", 0), 0u) << floor.name();
  EXPECT_EQ(inner.representation, Representation::averaged);
  EXPECT_NEAR(inner.depth_m, 203, 0.5);
  EXPECT_NEAR(inner.cut, 0.6, 0.02);
  ASSERT_EQ(stack.places.layers.size(), 3u);
  EXPECT_NEAR(stack.places.layers[1].vs, 1600, 1);
  ASSERT_EQ(stack.places.receivers.size(), 3u);
  for (const std::size_t n : {0, 1, 2}) EXPECT_EQ(stack.places.receivers[n].layer, n);
}

TEST(LocalStack, SeesTheCellsThatAModelWasSplitFrom) {
  const auto model = model_of(sea, 10, "");
  for (const auto& [spacing_m, block] : {std::pair{10., 1}, std::pair{5., 2}, std::pair{2.5, 4}}) {
    const auto stack = stack_of(shot_over(regridded(model, spacing_m)));
    ASSERT_EQ(stack.interfaces.size(), 2u) << spacing_m;
    for (const auto& interface : stack.interfaces) EXPECT_EQ(interface.block, block) << interface.name();
  }
}

TEST(LocalStack, TakesDepthsOfLevelFloorsFromTheHistory) {
  const std::vector<Layer> level = {{0, 1500, 0, 1000}, {103, 3000, 1600, 2200}};
  const auto unknown = stack_of(shot_over(model_of(level, 10, ""))).interfaces[0];
  EXPECT_EQ(unknown.representation, Representation::on_faces);
  EXPECT_EQ(unknown.true_depth_m, 100);
  const auto known = stack_of(shot_over(model_of(level, 10, "sw-layers --layer 103:3000:1600:2200")));
  EXPECT_EQ(known.interfaces[0].true_depth_m, 103);
}

}  // namespace
}  // namespace slipwave
