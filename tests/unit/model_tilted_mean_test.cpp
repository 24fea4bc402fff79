// SPDX-License-Identifier: BSD-3-Clause
#include "rock/tilted_mean.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "geology/layers.hpp"
#include "model_cases.hpp"
#include "refusal.hpp"

namespace slipwave::model_tilted_mean_test {
namespace {

const Material soft{2000, 1150, 2000}, hard{4000, 2300, 2300};

Layer layer_of(double depth, const Material& rock, double dip_deg = 0) {
  return {depth, rock.vp, rock.vs, rock.rho, dip_deg};
}

/// Soft rock over hard, parted at a depth at x = 0.
Medium<2> parted(const Grid<2>& grid, double depth, double dip_deg, Average average = Average::tilted) {
  return layered_medium(grid, {layer_of(-1e5, soft, 0), layer_of(depth, hard, dip_deg)}, average);
}

/// Of a turned Hooke's law, by its four indices.
double turned(const Elasticity<2>& c, double angle, std::array<int, 4> of) {
  // e[a]: along the beds, and their normal, in x and z.
  const double e[2][2] = {{std::cos(angle), std::sin(angle)}, {-std::sin(angle), std::cos(angle)}};
  double sum = 0;
  for (int n = 0; n < 16; ++n) {
    const int a = n & 1, b = n >> 1 & 1, d = n >> 2 & 1, f = n >> 3 & 1;
    const double value = a == b && d == f   ? (a != d   ? c(1, 3)
                                               : a == 0 ? c(1, 1)
                                                        : c(3, 3))
                         : a != b && d != f ? c(5, 5)
                                            : 0;
    sum += value * e[a][of[0]] * e[b][of[1]] * e[d][of[2]] * e[f][of[3]];
  }
  return sum;
}

}  // namespace

// Proves (T2).
TEST(TiltedMean, TurnsAsATensorDoes) {
  const auto c = vertical_symmetry(31e9, 9e9, 22e9, 6e9);
  for (const double angle : {0., 0.3, -0.9, 1.4}) {
    const auto found = slipwave::turned(c, axes_of<2>({.tilt = angle / degree}));
    const double size = 1e-13 * c(1, 1);
    EXPECT_NEAR(found(1, 1), turned(c, angle, {0, 0, 0, 0}), size);
    EXPECT_NEAR(found(1, 3), turned(c, angle, {0, 0, 1, 1}), size);
    EXPECT_NEAR(found(1, 5), turned(c, angle, {0, 0, 0, 1}), size);
    EXPECT_NEAR(found(3, 3), turned(c, angle, {1, 1, 1, 1}), size);
    EXPECT_NEAR(found(3, 5), turned(c, angle, {1, 1, 0, 1}), size);
    EXPECT_NEAR(found(5, 5), turned(c, angle, {0, 1, 0, 1}), size);
  }
}

// Proves (T1).
TEST(TiltedMean, IsThatOfBackusAboutTheNormal) {
  // 0.3 of the cells in row 2 are soft.
  const auto medium = parted({{3, 5}, 10, {0, 0}}, 23, 0);
  const auto modulus = [](const Material& rock, double c) { return rock.rho * c * c; };
  const double m[2] = {modulus(soft, soft.vp), modulus(hard, hard.vp)},
               mu[2] = {modulus(soft, soft.vs), modulus(hard, hard.vs)}, w[2] = {0.3, 0.7};
  double over_m = 0, over_mu = 0, ratio = 0, plate = 0;
  for (int n = 0; n < 2; ++n) {
    const double lambda = m[n] - 2 * mu[n];
    over_m += w[n] / m[n], over_mu += w[n] / mu[n], ratio += w[n] * lambda / m[n];
    plate += w[n] * (m[n] - lambda * lambda / m[n]);
  }
  const auto cell = std::size_t(medium.grid().flat({1, 2}));
  EXPECT_EQ(tilted_means(medium), 3);
  ASSERT_TRUE(is_tilted_mean(medium, cell));
  const auto found = elasticity_of<2>(tilted_mean_of(medium, cell));
  EXPECT_NEAR(found(3, 3) * over_m, 1, 1e-6);
  EXPECT_NEAR(found(5, 5) * over_mu, 1, 1e-6);
  EXPECT_NEAR(found(1, 3) / (ratio / over_m), 1, 1e-6);
  EXPECT_NEAR(found(1, 1) / (plate + ratio * ratio / over_m), 1, 1e-6);
  EXPECT_EQ(found(1, 5), 0);
  EXPECT_EQ(found(3, 5), 0);
}

TEST(TiltedMean, HasTheSpeedsOfTheIsotropicOneAndTheDipOfTheInterface) {
  const Grid<2> grid{{30, 30}, 10, {0, 0}};
  for (const double dip : {20., -35.}) {
    const double depth = 150 * (1 - std::tan(dip * degree));
    const auto medium = parted(grid, depth, dip), isotropic = parted(grid, depth, dip, Average::isotropic);
    EXPECT_FALSE(isotropic.has(Property::cut_epsilon));
    std::int64_t mixed = 0;
    for (std::size_t cell = 0; cell < medium.vp.size(); ++cell) {
      EXPECT_EQ(medium.vp[cell], isotropic.vp[cell]);
      EXPECT_EQ(medium.vs[cell], isotropic.vs[cell]);
      EXPECT_EQ(medium.rho[cell], isotropic.rho[cell]);
      // Parts of a thousandth say nothing.
      const double share = (double(medium.rho[cell]) - soft.rho) / (hard.rho - soft.rho);
      if (share > 1e-3 && share < 1 - 1e-3) {
        ++mixed;
        EXPECT_TRUE(is_tilted_mean(medium, cell));
      }
      if (is_tilted_mean(medium, cell)) {
        EXPECT_NEAR(medium.value(Property::cut_dip, cell), dip, 1e-4);
      }
    }
    EXPECT_GT(mixed, 30);
  }
}

TEST(TiltedMean, IsNoFasterThanTheFastestRockInIt) {
  const Grid<2> grid{{40, 40}, 10, {0, 0}};
  const auto medium = parted(grid, 50, 33);
  for (std::size_t cell = 0; cell < medium.vp.size(); ++cell)
    if (is_tilted_mean(medium, cell)) {
      EXPECT_LT(fastest_in_tilted_mean(medium, cell), hard.vp);
    }
}

TEST(TiltedMean, IsOnlyOfIsotropicSolids) {
  const Grid<2> grid{{20, 20}, 10, {0, 0}};
  const auto count = [&](const char* over, const char* under) {
    return tilted_means(layered_medium(grid, {parse_layer(over), parse_layer(under)}, Average::tilted));
  };
  EXPECT_GT(count("0:2000:1150:2000", "53:4000:2300:2300:10"), 0);
  EXPECT_EQ(count("0:1500:0:1000", "53:4000:2300:2300:10"), 0);
  EXPECT_EQ(count("0:1500:0:1000", "53:1900:0:1200:10"), 0);
  EXPECT_EQ(count("0:2000:1150:2000 epsilon=0.1", "53:4000:2300:2300:10"), 0);
  // Rocks that differ in density alone.
  EXPECT_EQ(count("0:2000:1000:2000", "53:1000:500:8000:10"), 0);
  // Where no cell is cut the model is as it was.
  const auto on_faces = layered_medium(grid, {layer_of(0, soft), layer_of(50, hard)}, Average::tilted);
  for (const auto property : {Property::cut_epsilon, Property::cut_delta, Property::cut_dip})
    EXPECT_FALSE(on_faces.has(property));
  const auto cube = layered_medium(Grid<3>{{4, 4, 10}, 10, {0, 0, 0}},
                                   {layer_of(0, soft), layer_of(53, hard, 10)}, Average::tilted);
  EXPECT_FALSE(cube.has(Property::cut_epsilon));
}

TEST(TiltedMean, IsRefusedWhereNoneCanBe) {
  Model<2> model;
  model.medium = parted({{3, 5}, 10, {0, 0}}, 23, 0);
  check(model);
  const auto cell = std::size_t(model.medium.grid().flat({1, 2}));
  auto wrong = model;
  wrong.medium[Property::cut_delta][cell] = -0.45F;
  EXPECT_NE(sentence_of([&] { check(wrong); }).find("cut_delta at x=15 z=25 is -0.45"), std::string::npos)
      << sentence_of([&] { check(wrong); });
  wrong = model;
  wrong.medium.vs[cell] = 0;
  EXPECT_EQ(sentence_of([&] { check(wrong); }).substr(0, 24), "cut_epsilon at x=15 z=25");
  wrong = model;
  wrong.medium[Property::cut_dip][cell] = 120;
  EXPECT_NE(sentence_of([&] { check(wrong); }).find("expected a finite number from -90 to 90"),
            std::string::npos);
}

}  // namespace slipwave::model_tilted_mean_test
