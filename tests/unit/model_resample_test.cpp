// SPDX-License-Identifier: BSD-3-Clause
#include "build/resample.hpp"

#include <algorithm>
#include <cmath>

#include "model_cases.hpp"

namespace slipwave::model_resample_test {
namespace {

/// vp a linear function of place in rock under two rows of water.
Model<2> sloping(const Grid<2>& grid) {
  auto model = water_over_rock(grid, 2);
  for (std::int64_t cell = 0; cell < grid.size(); ++cell) {
    if (!model.medium.is_solid(std::size_t(cell))) continue;
    const auto at = grid.index(cell);
    model.medium.vp[std::size_t(cell)] = float(2000 + 2 * grid.centre(0, at[0]) + 3 * grid.centre(1, at[1]));
  }
  return model;
}

}  // namespace

TEST(Resample, KeepsTheExtentAndTheKinds) {
  const auto fine = resampled(sloping(grid_of(10, 8, 20)), 5.0);
  EXPECT_EQ(fine.grid().shape, (Index<2>{40, 32}));
  for (std::int64_t cell = 0; cell < fine.grid().size(); ++cell) {
    const bool water = fine.grid().centre(1, fine.grid().index(cell)[1]) < 40;
    EXPECT_EQ(fine.medium.is_fluid(std::size_t(cell)), water);
    EXPECT_EQ(fine.medium.is_solid(std::size_t(cell)), !water);
    if (water) {
      EXPECT_EQ(fine.medium.vp[std::size_t(cell)], 1500);
      EXPECT_EQ(fine.medium.rho[std::size_t(cell)], 1000);
    } else {
      EXPECT_EQ(fine.medium.vs[std::size_t(cell)], 1500);
    }
  }
}

TEST(Resample, IsExactForLinearFieldsInsideOneKind) {
  const auto fine = resampled(sloping(grid_of(10, 8, 20)), 4.0);
  int seen = 0;
  for (std::int64_t cell = 0; cell < fine.grid().size(); ++cell) {
    const auto at = fine.grid().index(cell);
    const double x = fine.grid().centre(0, at[0]), z = fine.grid().centre(1, at[1]);
    if (x < 10 || x > 190 || z < 50 || z > 150) continue;  // old centres of rock all round
    EXPECT_NEAR(fine.medium.vp[std::size_t(cell)], 2000 + 2 * x + 3 * z, 1e-3) << x << ' ' << z;
    ++seen;
  }
  EXPECT_GT(seen, 1000);
}

TEST(Resample, NeverLeavesTheRangeOfTheOldValues) {
  const auto model = sloping(grid_of(10, 8, 20));
  const auto fine = resampled(model, 2.5);
  const auto [low, high] = std::minmax_element(model.medium.vp.begin(), model.medium.vp.end());
  const auto [fine_low, fine_high] = std::minmax_element(fine.medium.vp.begin(), fine.medium.vp.end());
  EXPECT_EQ(*fine_low, *low);
  EXPECT_LE(*fine_high, *high);
}

TEST(Resample, ToTheSameStepChangesNothing) {
  const auto model = sloping(grid_of(10, 8, 20));
  const auto same = resampled(model, 20.0);
  for (std::size_t cell = 0; cell < model.medium.vp.size(); ++cell) {
    EXPECT_EQ(same.medium.vp[cell], model.medium.vp[cell]);
  }
}

TEST(Resample, AveragesIntoLargerCells) {
  const auto model = sloping(grid_of(10, 8, 20));
  const auto coarse = resampled(model, 40.0);
  EXPECT_EQ(coarse.grid().shape, (Index<2>{5, 4}));
  EXPECT_TRUE(coarse.medium.is_fluid(0));
  EXPECT_TRUE(coarse.medium.is_solid(5));
  // Round x = 20, z = 100: of one density, squares of slownesses are averaged.
  double squares = 0;
  for (const double vp : {2290., 2330., 2350., 2390.}) squares += 1 / (vp * vp) / 4;
  EXPECT_NEAR(coarse.medium.vp[10], 1 / std::sqrt(squares), 1e-3);
}

TEST(Resample, InterpolatesForLargerCellsWhereAsked) {
  const auto coarse = resampled(sloping(grid_of(10, 8, 20)), 40.0, false);
  EXPECT_TRUE(coarse.medium.is_fluid(0));
  EXPECT_TRUE(coarse.medium.is_solid(5));
  // At x = 20, z = 100, between four old centres.
  EXPECT_NEAR(coarse.medium.vp[10], 2000 + 2 * 20 + 3 * 100, 1e-3);
}

TEST(Resample, KeepsFracturesInTheCellsTheyWereIn) {
  auto model = sloping(grid_of(4, 4, 20));
  model.fracture = Field<2, std::uint8_t>(model.grid());
  model.fracture({1, 2}) = 1;
  model.fracture_sets = {{"set", {{{0, 1}, 0.1, 1, 0}}}};
  const auto fine = resampled(model, 10.0);
  EXPECT_EQ(std::count(fine.fracture.begin(), fine.fracture.end(), 1), 4);
  EXPECT_EQ(fine.fracture({2, 4}), 1);
  EXPECT_NO_THROW(check(fine));
}

TEST(Resample, RefusesAStepThatDoesNotDivide) {
  EXPECT_EQ(sentence_of([] { resampled(water_over_rock(grid_of(10, 8, 20), 1), 3.0); }),
            "200 m are 66.667 steps of 3 m, expected a whole number");
}

TEST(Resample, WorksInThreeDimensions) {
  Grid<3> grid;
  grid.shape = {4, 5, 6};
  grid.spacing_m = 10;
  Model<3> model;
  model.medium = {Field<3>(grid), Field<3>(grid, 1000), Field<3>(grid, 2000)};
  for (std::int64_t cell = 0; cell < grid.size(); ++cell) {
    const auto at = grid.index(cell);
    model.medium.vp[std::size_t(cell)] =
        float(2000 + grid.centre(0, at[0]) + 2 * grid.centre(1, at[1]) + 3 * grid.centre(2, at[2]));
  }
  const auto fine = resampled(model, 5.0);
  EXPECT_EQ(fine.grid().shape, (Index<3>{8, 10, 12}));
  // (3, 4, 5): x 17.5, y 22.5, z 27.5.
  EXPECT_NEAR(fine.medium.vp({3, 4, 5}), 2000 + 17.5 + 45 + 82.5, 1e-3);
}

TEST(Crop, KeepsCellsWhoseCentresAreInTheBox) {
  const auto model = sloping(grid_of(10, 8, 20));
  const auto part = cropped(model, Box<2>{{25, 35}, {110, 150}});
  // Centres 30 .. 110 and 50 .. 150.
  EXPECT_EQ(part.grid().shape, (Index<2>{5, 6}));
  EXPECT_EQ(part.grid().origin_m, (Point<2>{20, 0}));
  EXPECT_EQ(part.medium.vp({0, 0}), model.medium.vp({1, 2}));
  EXPECT_EQ(part.medium.vp({4, 5}), model.medium.vp({5, 7}));
}

TEST(Crop, RefusesABoxOutsideTheModelOrBetweenCentres) {
  const auto model = water_over_rock(grid_of(10, 8, 20), 1);
  EXPECT_EQ(sentence_of([&] {
              cropped(model, Box<2>{{0, 0}, {201, 100}});
            }),
            "found x from 0 to 201, expected it within the model, 0 to 200");
  EXPECT_EQ(sentence_of([&] {
              cropped(model, Box<2>{{11, 0}, {29, 100}});
            }),
            "the box holds no cell centre, expected at least one");
}

}  // namespace slipwave::model_resample_test
