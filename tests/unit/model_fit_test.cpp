// SPDX-License-Identifier: BSD-3-Clause
#include "geology/fit.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "geology/layers.hpp"
#include "model/fracture.hpp"
#include "model/prestress.hpp"
#include "model_cases.hpp"
#include "rock/tilted_mean.hpp"

namespace slipwave::model_fit_test {
namespace {

const FitChoice as_usual;

Layer curved(const std::string& top, double vp, double vs, double rho) {
  return {Horizon::parse(top), {vp, vs, rho}};
}

double corner(const Grid<2>& grid, std::int64_t i, std::int64_t k) { return grid.rows->corner({i, k}); }

/// Least and largest height of rows in [first, last), in cells.
std::array<double, 2> heights(const Grid<2>& grid, std::int64_t first, std::int64_t last) {
  std::array<double, 2> range{1e9, 0};
  for (std::int64_t k = first; k < last; ++k)
    for (std::int64_t i = 0; i <= grid.shape[0]; ++i) {
      const double height = (corner(grid, i, k + 1) - corner(grid, i, k)) / grid.spacing_m;
      range = {std::min(range[0], height), std::max(range[1], height)};
    }
  return range;
}

/// Of cells of true height, kg/m.
double true_mass_of(const Medium<2>& medium) {
  double mass = 0;
  for (std::int64_t cell = 0; cell < medium.grid().size(); ++cell)
    mass += double(medium.rho[std::size_t(cell)]) * medium.grid().height(medium.grid().index(cell));
  return mass * medium.grid().spacing_m;
}

}  // namespace

TEST(Fit, IsParsedStrictly) {
  EXPECT_TRUE(parse_fit("surface,floor").floors);
  EXPECT_FALSE(parse_fit("surface,floor").layers);
  EXPECT_FALSE(parse_fit("none").surfaces);
  EXPECT_TRUE(parse_fit("all").layers);
  EXPECT_TRUE(parse_fit("floor").asked);
  EXPECT_EQ(sentence_of([] { parse_fit("sea"); }),
            "found 'sea', expected surface, floor, surface,floor, all or none");
}

TEST(Fit, KeepsTheRegularGridWhereHorizonsLieOnFaces) {
  const auto grid = grid_of(40, 60, 5);
  const std::vector<Layer> layers = {
      {50, 1500, 0, 1000}, {100, 3000, 1500, 2000}, curved("sine,200,0,50", 3500, 1800, 2200)};
  const auto fit = fit_layers(grid, layers, as_usual);
  EXPECT_EQ(fit.grid, grid);
  EXPECT_EQ(fit.grid.rows, nullptr);
  EXPECT_EQ(fit.summary, "");
  EXPECT_TRUE(fit.left_out.empty());
  EXPECT_EQ(fit.rows, (std::vector<std::int64_t>{-1, -1, -1}));
}

TEST(Fit, FollowsASeaFloorAndIsRegularFarFromIt) {
  const auto grid = grid_of(100, 200, 5);
  const std::vector<Layer> layers = {{0, 1500, 0, 1000}, curved("sine,502,10,250", 3000, 1500, 2000)};
  const auto fit = fit_layers(grid, layers, as_usual);
  ASSERT_NE(fit.grid.rows, nullptr);
  EXPECT_EQ(fit.grid.shape, grid.shape);
  EXPECT_EQ(fit.grid.origin_m, grid.origin_m);
  ASSERT_EQ(fit.rows[1], 100);
  EXPECT_EQ(fit.grid.rows->horizons(), (std::vector<FittedHorizon>{{"floor", "floor", 100}}));
  for (std::int64_t i = 0; i <= 100; ++i) {
    EXPECT_EQ(corner(fit.grid, i, 100), layers[1].top.at(5 * double(i)));
    // 12 m at most are taken up by 1.5 x 12 m/(0.15 x 5 m) = 24 rows on either side.
    for (std::int64_t k = 0; k <= 76; ++k) EXPECT_EQ(corner(fit.grid, i, k), 5 * double(k));
    for (std::int64_t k = 124; k <= 200; ++k) EXPECT_EQ(corner(fit.grid, i, k), 5 * double(k));
  }
  const auto [least, largest] = heights(fit.grid, 0, 200);
  EXPECT_GE(least, 0.85);
  EXPECT_LE(largest, 1.15);
  EXPECT_EQ(fit.summary, "fitted: floor at sine,502,10,250, rows 0.85 to 1.15 of 5 m");
  const auto medium = layered_medium(fit.grid, layers, Average::isotropic, fit.rows);
  for (std::int64_t cell = 0; cell < fit.grid.size(); ++cell)
    EXPECT_EQ(medium.vp[std::size_t(cell)], fit.grid.index(cell)[1] < 100 ? 1500 : 3000);
}

TEST(Fit, MakesRowsOfOneHeightAboveASteepFloor) {
  const auto grid = grid_of(100, 200, 5);
  const auto fit = fit_layers(grid, {{0, 1500, 0, 1000}, {200, 3000, 1500, 2000, 30}}, as_usual);
  ASSERT_NE(fit.grid.rows, nullptr);
  const auto row = fit.rows[1];
  for (std::int64_t i = 0; i <= 100; ++i) {
    const double floor = 200 + 5 * double(i) * std::tan(std::numbers::pi / 6);
    EXPECT_EQ(corner(fit.grid, i, row), floor);
    for (std::int64_t k = 0; k < row; ++k)
      EXPECT_NEAR(corner(fit.grid, i, k + 1) - corner(fit.grid, i, k), floor / double(row), 1e-9);
    EXPECT_EQ(corner(fit.grid, i, 200), 1000);
  }
}

TEST(Fit, GivesLevelLayersRowsOfOneHeight) {
  const auto grid = grid_of(4, 200, 5);
  const auto fit = fit_layers(
      grid,
      {{0, 1500, 0, 1000}, {402, 2000, 900, 2000}, {411.7, 2500, 1200, 2100}, {613.2, 3000, 1500, 2200}},
      as_usual);
  EXPECT_EQ(fit.rows, (std::vector<std::int64_t>{-1, 80, 83, 123}));
  EXPECT_EQ(fit.grid.shape[1], 200);
  const auto near = [&](std::int64_t first, std::int64_t last, double height) {
    const auto found = heights(fit.grid, first, last);
    EXPECT_NEAR(found[0], height, 1e-9);
    EXPECT_NEAR(found[1], height, 1e-9);
  };
  near(0, 80, 402. / 400);
  near(80, 83, 9.7 / 15);
  near(83, 123, 201.5 / 200);
  EXPECT_EQ(corner(fit.grid, 2, 150), 750);
}

TEST(Fit, GivesThinBedsThreeRowsOrAsManyAsMayBeThatThin) {
  const auto bed = fit_layers(grid_of(4, 200, 5),
                              {{0, 1500, 0, 1000}, {400, 3000, 1500, 2200}, {402, 1500, 0, 1000}}, as_usual);
  ASSERT_NE(bed.grid.rows, nullptr);
  EXPECT_EQ(bed.rows[2] - bed.rows[1], 2);  // of a fifth of a cell each; three would be thinner
  EXPECT_EQ(corner(bed.grid, 0, 80), 400);
  EXPECT_EQ(corner(bed.grid, 0, 81), 401);
  EXPECT_EQ(corner(bed.grid, 0, 200), 1000);
  const auto [least, largest] = heights(bed.grid, 82, 200);
  EXPECT_GE(least, 0.85);
  EXPECT_LE(largest, 1.15);
}

TEST(Fit, GivesBedsOfACellBetweenSolidsThreeRows) {
  for (const auto& [thickness_m, rows] : {std::pair(9.7, 3), {5.1, 3}, {4.9, 2}, {3.2, 1}}) {
    const auto bed = fit_layers(
        grid_of(4, 200, 5),
        {{0, 3000, 1500, 2200}, {401, 1800, 700, 1900}, {401 + thickness_m, 3500, 1900, 2300}}, as_usual);
    EXPECT_EQ(bed.rows[2] - bed.rows[1], rows) << thickness_m;
  }
}

TEST(Fit, GivesSlowBedsUpToEightRowsIfTheyCostNoTimeStep) {
  // Thickness in cells of 4 m, Vp of the bed, rows: 3500 over Vp a cell, and by thickness alone.
  for (const auto& [thickness_m, vp, rows] : {std::tuple(9.7, 1800., 4),
                                              {13.1, 1800., 6},
                                              {20.2, 1800., 8},
                                              {39.8, 1800., 10},
                                              {9.7, 3400., 3},
                                              {21.9, 3400., 5}}) {
    const auto bed = fit_layers(
        grid_of(4, 200, 4),
        {{0, 3000, 1500, 2200}, {401, vp, vp / 2, 1900}, {401 + thickness_m, 3500, 1900, 2300, 0.5}},
        as_usual);
    const auto first = bed.rows[1], last = bed.rows[2];
    EXPECT_EQ(last - first, rows) << thickness_m << ' ' << vp;
    if (vp > 3000) continue;
    EXPECT_GE(heights(bed.grid, first, last)[0] * (1 + 1e-9), vp / 3500);
  }
}

TEST(Fit, FindsRoomNearTheBottom) {
  const auto fit = fit_layers(grid_of(4, 20, 5), {{0, 1500, 0, 1000}, {98, 3000, 1500, 2200}}, as_usual);
  ASSERT_NE(fit.grid.rows, nullptr);
  EXPECT_EQ(fit.rows[1], 19);
  EXPECT_EQ(corner(fit.grid, 0, 19), 98);
  EXPECT_EQ(corner(fit.grid, 0, 20), 100);
}

TEST(Fit, MakesAFreeSurfaceTheTop) {
  const auto grid = grid_of(100, 60, 5);
  const std::vector<Layer> layers = {curved("sine,52,10,250", 3000, 1500, 2000)};
  const auto fit = fit_layers(grid, layers, as_usual);
  ASSERT_NE(fit.grid.rows, nullptr);
  EXPECT_EQ(fit.rows[0], 0);
  EXPECT_EQ(fit.grid.shape[1], 50);
  EXPECT_EQ(fit.grid.origin_m[1], 50);
  EXPECT_EQ(fit.grid.end(1), 300);
  EXPECT_EQ(fit.grid.rows->horizons(), (std::vector<FittedHorizon>{{"surface", "surface", 0}}));
  for (std::int64_t i = 0; i <= 100; ++i) {
    EXPECT_EQ(corner(fit.grid, i, 0), layers[0].top.at(5 * double(i)));
    EXPECT_EQ(corner(fit.grid, i, 49), 295);  // at its row coordinate
  }
  const auto medium = layered_medium(fit.grid, layers, Average::isotropic, fit.rows);
  for (std::size_t cell = 0; cell < medium.vp.size(); ++cell) EXPECT_TRUE(medium.is_solid(cell));
}

TEST(Fit, LeavesOutWhatCrosses) {
  const auto grid = grid_of(100, 100, 5);
  const std::vector<Layer> layers = {
      {0, 1500, 0, 1000}, {202, 2000, 1000, 2000}, {250, 3000, 1500, 2200}, {270, 3500, 1700, 2300, -10}};
  const auto fit = fit_layers(grid, layers, as_usual);
  ASSERT_NE(fit.grid.rows, nullptr);
  EXPECT_EQ(fit.rows[1], 40);
  EXPECT_GT(fit.rows[2], 0);
  EXPECT_EQ(fit.rows[3], -1);
  ASSERT_EQ(fit.left_out.size(), 1U);
  EXPECT_EQ(fit.left_out[0],
            "not fitted: layer at 270 m dip -10 meets or crosses layer at 250 m at x=500, z=181.837");
}

TEST(Fit, FollowsNoTopAtWhichNothingChanges) {
  const Grid<2> grid{{40, 30}, 10, {0, 0}};
  const auto expect_alike = [&](const std::vector<Layer>& split, const std::vector<Layer>& whole) {
    const auto of_split = fit_layers(grid, split, {}), of_whole = fit_layers(grid, whole, {});
    EXPECT_TRUE(of_split.left_out.empty());
    EXPECT_EQ(of_split.summary, of_whole.summary);
    const auto one = layered_medium(of_split.grid, split, Average::tilted, of_split.rows),
               other = layered_medium(of_whole.grid, whole, Average::tilted, of_whole.rows);
    for (const auto property : {Property::vp, Property::vs, Property::rho})
      EXPECT_TRUE(std::equal(one[property].begin(), one[property].end(), other[property].begin()));
    EXPECT_EQ(tilted_means(one), tilted_means(other));
  };
  const Layer top(0, 2000, 1000, 2000), rock(203, 3000, 1700, 2300);
  expect_alike({top, {133, 2000, 1000, 2000}, rock}, {top, rock});
  // It would cross the top of the rock.
  expect_alike({top, {133, 2000, 1000, 2000, 12}, rock}, {top, rock});
  // Where it rises above the other, something changes there.
  const auto crossing = fit_layers(grid, {top, {100, 2500, 1300, 2100}, {143, 2500, 1300, 2100, -15}}, {});
  EXPECT_FALSE(crossing.left_out.empty() && crossing.summary.find("143") == std::string::npos);
}

TEST(Fit, KeepsHorizonsOnTheirFacesWhereOthersBendRows) {
  const std::vector<Layer> layers = {
      {50, 1500, 0, 1000}, {200, 3000, 1500, 2200, 5}, {400, 4000, 2000, 2500}};
  const auto fit = fit_layers(grid_of(100, 100, 5), layers, parse_fit("floor"));
  ASSERT_NE(fit.grid.rows, nullptr);
  EXPECT_EQ(fit.rows[0], 0);
  EXPECT_EQ(corner(fit.grid, 3, 0), 50);
  EXPECT_EQ(corner(fit.grid, 3, fit.rows[2]), 400);
  EXPECT_EQ(fit_layers(grid_of(100, 100, 5), layers, parse_fit("none")).grid.rows, nullptr);
}

TEST(Fit, FollowsTheFloorWhereALayerCropsOut) {
  const auto grid = grid_of(100, 100, 5);
  const std::vector<Layer> layers = {
      {0, 1500, 0, 1000}, {202, 2000, 1000, 2000}, {230, 3000, 1500, 2200, -10}};
  const auto fit = fit_layers(grid, layers, as_usual);
  ASSERT_NE(fit.grid.rows, nullptr);
  const auto row = fit.rows[1];
  EXPECT_EQ(fit.rows[2], -1);
  const auto medium = layered_medium(fit.grid, layers, Average::isotropic, fit.rows);
  for (std::int64_t i = 0; i <= 100; ++i)
    EXPECT_EQ(corner(fit.grid, i, row), std::min(202., layers[2].top.at(5 * double(i))));
  for (std::int64_t cell = 0; cell < fit.grid.size(); ++cell)
    EXPECT_EQ(medium.is_fluid(std::size_t(cell)), fit.grid.index(cell)[1] < row);
  // Where it is not cut off (x < 158.8 m) the bed is a triangle of 158.8 m by 28 m; cells that a top cuts
  // have the mean density of their parts, so that the mass is exact but for the chords of the kink.
  const double slope = std::tan(10 * std::numbers::pi / 180), reach = 28 / slope;
  const double water = 1000 * (202 * reach + (500 - reach) * (202 - (500 - reach) * slope / 2));
  const double bed = 2000 * reach * 28 / 2;
  const double rock = 2200 * (500 * 500. - water / 1000 - bed / 2000);
  EXPECT_NEAR(true_mass_of(medium), water + bed + rock, 3e-5 * (water + bed + rock));
}

TEST(Fit, RefusesWhatIsAskedForAndCannotBe) {
  const auto grid = grid_of(100, 60, 5);
  const auto refusal = [&](const std::vector<Layer>& layers, const std::string& choice) {
    return sentence_of([&] { fit_layers(grid, layers, parse_fit(choice)); });
  };
  const std::string remedy = "; move it, use other cells or do not fit it";
  const Layer water(0, 1500, 0, 1000), deep(200, 3000, 1500, 2000, 30), shallow(100, 3000, 1500, 2000, -30);
  EXPECT_EQ(refusal({water, deep}, "floor"),
            "floor at 200 m dip 30 leaves the model at its bottom, at x=500, z=488.675" + remedy);
  EXPECT_EQ(refusal({water, shallow}, "all"),
            "floor at 100 m dip -30 leaves the model at its top, at x=500, z=-188.675" + remedy);
  EXPECT_EQ(refusal({water, {1, 3000, 1500, 2000, 20}}, "floor"),
            "top of the model and floor at 1 m dip 20 are 1 m apart at x=0 and 182.985 m at x=500, rows "
            "between them would be thinner than a fifth of a cell of 5 m or thicker than 1.6 cells" +
                remedy);
  EXPECT_EQ(refusal({water, {100, 3000, 1500, 2000}, {100.7, 1500, 0, 1000}}, "floor"),
            "floor at 100 m and layer at 100.7 m are 0.7 m apart at x=0, rows between them would be thinner "
            "than a fifth of a cell of 5 m" +
                remedy);
  EXPECT_EQ(refusal({water, shallow}, "none"), "no error");
  EXPECT_EQ(refusal({water, shallow}, "surface"), "no error");
  EXPECT_EQ(fit_layers(grid, {water, shallow}, as_usual).left_out,
            (std::vector<std::string>{
                "not fitted: floor at 100 m dip -30 leaves the model at its top, at x=500, z=-188.675"}));
}

TEST(Fit, TakesGradientsAtTrueDepths) {
  const auto grid = grid_of(20, 40, 5);
  const std::vector<Layer> layers = {{0, 1500, 0, 1000}, {Horizon(53, 10), {2000, 1000, 2000}, {2, 1, 0.5}}};
  const auto fit = fit_layers(grid, layers, as_usual);
  ASSERT_NE(fit.grid.rows, nullptr);
  const auto medium = layered_medium(fit.grid, layers, Average::isotropic, fit.rows);
  for (std::int64_t cell = 0; cell < fit.grid.size(); ++cell) {
    const auto at = fit.grid.index(cell);
    if (at[1] < fit.rows[1]) continue;
    const double below = fit.grid.depth(at) - layers[1].top.at(fit.grid.centre(0, at[0]));
    EXPECT_NEAR(double(medium.vp[std::size_t(cell)]), 2000 + 2 * below, 1e-3);
    EXPECT_NEAR(double(medium.rho[std::size_t(cell)]), 2000 + 0.5 * below, 1e-3);
  }
}

TEST(Fit, FollowsPlanesInThreeDimensions) {
  const auto grid = grid_of_size<3>({200, 100, 300}, 10);
  const std::vector<Layer> layers = {{0, 1500, 0, 1000}, curved("sine,121,5,100", 3000, 1500, 2000)};
  const auto fit = fit_layers(grid, layers, as_usual);
  ASSERT_NE(fit.grid.rows, nullptr);
  EXPECT_EQ(fit.rows[1], 12);
  const auto medium = layered_medium(fit.grid, layers, Average::isotropic, fit.rows);
  for (std::int64_t j = 0; j <= 10; ++j)
    for (std::int64_t i = 0; i <= 20; ++i)
      EXPECT_EQ(fit.grid.rows->corner({i, j, 12}), layers[1].top.at(10 * double(i)));
  for (std::int64_t cell = 0; cell < fit.grid.size(); ++cell)
    EXPECT_EQ(medium.is_fluid(std::size_t(cell)), fit.grid.index(cell)[2] < 12);
}

TEST(Fit, FollowsGridsInThreeDimensions) {
  const TextFile file("0 0 120\n200 0 130\n0 100 110\n200 100 131\n");
  const auto grid = grid_of_size<3>({200, 100, 300}, 10);
  const std::vector<Layer> layers = {{0, 1500, 0, 1000}, curved("@" + file.path(), 3000, 1500, 2000)};
  const auto fit = fit_layers(grid, layers, as_usual);
  ASSERT_NE(fit.grid.rows, nullptr);
  const auto row = fit.rows[1];
  EXPECT_EQ(fit.grid.rows->corner({0, 0, row}), 120);
  EXPECT_EQ(fit.grid.rows->corner({0, 10, row}), 110);
  EXPECT_EQ(fit.grid.rows->corner({20, 10, row}), 131);
  EXPECT_NEAR(fit.grid.rows->corner({10, 0, row}), 125, 1e-9);
}

TEST(FittedModel, IsCheckedForThinRows) {
  auto grid = grid_of(1, 3, 5);
  grid.rows = std::make_shared<const RowDepths<2>>(
      grid.shape, std::vector<double>{0, 0, 5, 5, 5.9, 5.9, 15, 15}, std::vector<FittedHorizon>{});
  EXPECT_EQ(sentence_of([&] { check(water_over_rock(grid, 1)); }),
            "the row at x=2.5 z=5.45 is 0.9 m high, expected at least a fifth of a cell of 5 m: fit fewer "
            "horizons or choose smaller cells");
}

// Proves (F10a).
TEST(FittedModel, IsFracturedAndLoadedAtTrueDepths) {
  const auto grid = grid_of(20, 60, 5);
  const std::vector<Layer> layers = {{0, 1500, 0, 1000}, {100, 3000, 1500, 2000, 20}};
  const auto fit = fit_layers(grid, layers, as_usual);
  ASSERT_NE(fit.grid.rows, nullptr);
  Model<2> model;
  model.medium = layered_medium(fit.grid, layers, Average::isotropic, fit.rows);
  FractureSet<2> set{"set", {{}}};
  set.systems[0].normal = {0, 1};
  add_fractures<2>(model, set, [](const Point<2>& at) { return at[1] >= 150 && at[1] <= 170; });
  set_prestress<2>(model, 1, parse_prestress<2>("lithostatic"));
  std::int64_t fractured = 0;
  for (std::int64_t cell = 0; cell < fit.grid.size(); ++cell) {
    const auto at = fit.grid.index(cell);
    const double z = fit.grid.depth(at), x = fit.grid.centre(0, at[0]);
    EXPECT_EQ(model.fracture[std::size_t(cell)] != 0, z >= 150 && z <= 170);
    if (model.fracture[std::size_t(cell)] == 0) continue;
    ++fractured;
    const double floor = layers[1].top.at(x);
    EXPECT_NEAR(double(model.prestress_pa[1][std::size_t(cell)]),
                -9.80665 * (1000 * floor + 2000 * (z - floor)), 1);
  }
  EXPECT_GT(fractured, 60);
}

TEST(Fit, OfAnyPileIsAGridThatFollowsWhatItSays) {
  std::mt19937 random(19);
  const auto draw = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  int fitted = 0;
  for (int scene = 0; scene < 400; ++scene) {
    const double h = draw(2, 12);
    const auto grid = grid_of(60, 80, h);
    std::vector<Layer> layers;
    double depth = draw(0, 1) < 0.3 ? draw(0, 10 * h) : 0;
    for (int n = 0; n < 5 && depth < 75 * h; ++n) {
      const bool fluid = draw(0, 1) < 0.3;
      Layer layer(depth, 1500 + 300 * n, fluid ? 0 : 800, 1000 + 200 * n,
                  draw(0, 1) < 0.5 || n == 0 ? 0 : draw(-12, 12));
      if (draw(0, 1) < 0.3 && depth > 0)
        layer.top = Horizon::parse("sine," + std::to_string(depth) + ',' + std::to_string(draw(0, 4 * h)) +
                                   ',' + std::to_string(draw(20 * h, 80 * h)));
      layers.push_back(layer);
      depth += draw(0, 1) < 0.2 ? draw(0.1 * h, 3 * h) : draw(3 * h, 30 * h);
    }
    const auto fit = fit_layers(grid, layers, as_usual);
    if (!fit.grid.rows) continue;
    ++fitted;
    const auto& rows = *fit.grid.rows;
    const auto [least, largest] = rows.heights();
    EXPECT_GE(least, 0.2 * h * (1 - 1e-9)) << scene;
    EXPECT_LE(largest, 1.6 * h * (1 + 1e-9)) << scene;
    for (const double bottom : rows.row(fit.grid.shape[1])) EXPECT_EQ(bottom, 80 * h) << scene;
    EXPECT_NEAR(fit.grid.end(1), 80 * h, 1e-9 * h);
    for (std::size_t n = 0; n < layers.size(); ++n) {
      if (fit.rows[n] < 0) continue;
      for (std::int64_t i = 0; i <= 60; ++i)
        EXPECT_LE(rows.corner({i, fit.rows[n]}), layers[n].top.at(double(i) * h)) << scene;
    }
    Model<2> model;
    model.medium = layered_medium(fit.grid, layers, Average::isotropic, fit.rows);
    check(model);
  }
  EXPECT_GT(fitted, 250);
}

}  // namespace slipwave::model_fit_test
