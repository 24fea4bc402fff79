// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "base/error.hpp"
#include "geology/layers.hpp"
#include "plot/rock_picture.hpp"

namespace slipwave::plot::plot_rock_test {
namespace {

Model<2> rocks() {
  Model<2> model;
  model.medium =
      layered_medium<2>(Grid<2>{{60, 40}, 10, {0, 0}},
                        {parse_layer("50:1500:0:1000"), parse_layer("100:2500:1250:2200 qp=60 qs=30"),
                         parse_layer("200:3000:1600:2300 epsilon=0.2 delta=0.1 tilt=30"),
                         parse_layer("250:3000:1600:2300 epsilon=0.2 delta=0.1 tilt=30 qp=60 qs=30"),
                         parse_layer("300:2000:1000:2000"), parse_layer("352:4000:2300:2400:5")},
                        Average::tilted);
  return model;
}

}  // namespace

TEST(RockPicture, AddsPanelsOfFrequencyWhereRockAttenuates) {
  const auto model = rocks();
  const auto attenuation = Attenuation{Mechanisms(3, 4, 50), 20};
  Page page;
  page.width_pt = 450;
  const auto words = [&](const Point<2>& at, const std::optional<Attenuation>& with) {
    return draw_rock(rock_at<2>(model, at), with, page).words.size();
  };
  const auto elastic = words({305, 155}, {});
  EXPECT_GT(words({305, 155}, attenuation), 2 * elastic);
  EXPECT_LT(words({305, 75}, attenuation), elastic + 5);
  // Of anisotropic rock Q by angle, too.
  EXPECT_GT(words({305, 275}, attenuation), words({305, 155}, attenuation));
}

TEST(RockPicture, TakesCutCellsForTheirMeanAboutTheNormal) {
  const auto model = rocks();
  const auto tilted = rock_at<2>(model, {305, 245});
  EXPECT_EQ(tilted.material, (Material{3000, 1600, 2300, double(0.2F), double(0.1F), 30}));
  EXPECT_EQ(tilted.place, "x=305 z=245");
  EXPECT_FALSE(tilted.attenuates());
  EXPECT_TRUE(rock_at<2>(model, {305, 155}).attenuates());
  const auto cut = rock_at<2>(model, {105, 365}).material;
  EXPECT_NEAR(cut.tilt, 5, 1e-5);
  EXPECT_TRUE(cut.is_anisotropic());
}

TEST(RockPicture, RefusesPointsWithoutRock) {
  const auto model = rocks();
  EXPECT_THROW(rock_at<2>(model, {305, 15}), Error);   // void
  EXPECT_THROW(rock_at<2>(model, {305, 405}), Error);  // outside
}

}  // namespace slipwave::plot::plot_rock_test
