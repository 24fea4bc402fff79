// SPDX-License-Identifier: BSD-3-Clause
#include "build/resample.hpp"
#include "geology/layers.hpp"
#include "model_cases.hpp"

namespace slipwave::model_refit_test {
namespace {

template <int D>
Model<D> fitted_model(const Grid<D>& grid, const std::vector<Layer>& layers) {
  const auto fit = fit_layers(grid, layers, FitChoice());
  Model<D> model;
  model.medium = layered_medium(fit.grid, layers, Average::isotropic, fit.rows);
  return model;
}

const std::vector<Layer> sea = {
    {0, 1500, 0, 1000}, {Horizon::parse("sine,102,6,100"), {2000, 1000, 2000}, {}}, {163, 3000, 1500, 2300}};

}  // namespace

TEST(Refit, IsFinerGeometryNotFinerStairs) {
  const auto coarse = fitted_model(grid_of(40, 60, 5), sea);
  const auto fine = regridded(coarse, 2.5), direct = fitted_model(grid_of(80, 120, 2.5), sea);
  ASSERT_NE(fine.grid().rows, nullptr);
  EXPECT_EQ(fine.grid().shape, direct.grid().shape);
  EXPECT_EQ(fine.grid().rows->horizons(), direct.grid().rows->horizons());
  const auto& found = fine.grid().rows->corners_m();
  const auto& expected = direct.grid().rows->corners_m();
  // Cubics between corners 5 m apart of a sine of 100 m: 3/128 (2 pi 5/100)^4 6 m inside the grid.
  for (std::size_t n = 0; n < expected.size(); ++n) ASSERT_NEAR(found[n], expected[n], 0.01);
  for (std::size_t cell = 0; cell < fine.medium.vp.size(); ++cell) {
    ASSERT_EQ(fine.medium.vp[cell], direct.medium.vp[cell]);
    ASSERT_EQ(fine.medium.rho[cell], direct.medium.rho[cell]);
  }
}

TEST(Refit, JoinsCellsBetweenHorizons) {
  const auto coarse = regridded(fitted_model(grid_of(80, 120, 2.5), sea), 5);
  EXPECT_EQ(coarse.grid().shape, (Index<2>{40, 60}));
  const auto direct = fitted_model(grid_of(40, 60, 5), sea);
  EXPECT_EQ(coarse.grid().rows->horizons(), direct.grid().rows->horizons());
  for (std::size_t cell = 0; cell < direct.medium.vp.size(); ++cell)
    ASSERT_EQ(coarse.medium.vp[cell], direct.medium.vp[cell]);
}

TEST(Refit, StaysFittedWhereHorizonsComeToLieOnFaces) {
  const auto fine =
      regridded(fitted_model(grid_of(4, 60, 5), {{0, 1500, 0, 1000}, {102, 3000, 1500, 2000}}), 1);
  ASSERT_NE(fine.grid().rows, nullptr);
  EXPECT_EQ(fine.grid().rows->horizons().front().row, 102);
  EXPECT_EQ(fine.grid().rows->heights()[0], 1);
}

TEST(Refit, KeepsASurface) {
  const std::vector<Layer> land = {{Horizon(52, 5), {2000, 1000, 2000}}, {150, 3000, 1500, 2300}};
  const auto fine = regridded(fitted_model(grid_of(40, 60, 5), land), 2.5);
  ASSERT_NE(fine.grid().rows, nullptr);
  EXPECT_EQ(fine.grid().rows->horizons().front().role, "surface");
  EXPECT_NEAR(fine.grid().rows->corner({3, 0}), land[0].top.at(7.5), 1e-9);
  EXPECT_EQ(fine.grid().end(1), 300);
}

TEST(Refit, WorksInThreeDimensions) {
  const auto fine = regridded(fitted_model(grid_of_size<3>({100, 50, 300}, 10), sea), 5);
  const auto direct = fitted_model(grid_of_size<3>({100, 50, 300}, 5), sea);
  ASSERT_NE(fine.grid().rows, nullptr);
  EXPECT_EQ(fine.grid().rows->horizons(), direct.grid().rows->horizons());
  for (std::size_t cell = 0; cell < fine.medium.vp.size(); ++cell)
    ASSERT_EQ(fine.medium.vp[cell], direct.medium.vp[cell]);
}

TEST(Refit, TakesFracturesAndTheMeanOfCutCells) {
  auto model = fitted_model(grid_of(40, 60, 5), sea);
  model.fracture = Field<2, std::uint8_t>(model.grid());
  model.fracture_sets = {{"set", {{}}}};
  model.fracture({10, 40}) = 1;
  const auto fine = regridded(model, 2.5);
  std::int64_t fractured = 0;
  for (const auto code : fine.fracture) fractured += code;
  EXPECT_EQ(fractured, 4);
}

TEST(Refit, RefusesRowsWithoutHorizons) {
  auto grid = grid_of(1, 2, 5);
  grid.rows = std::make_shared<const RowDepths<2>>(grid.shape, std::vector<double>{0, 0, 4, 6, 10, 10});
  EXPECT_EQ(
      sentence_of([&] { regridded(water_over_rock(grid, 1), 2.5); }),
      "found rows that follow no named horizon, or end in one: such a grid cannot be made anew in other "
      "cells");
  EXPECT_EQ(sentence_of([&] { resampled(water_over_rock(grid, 1), 2.5); }),
            "found rows that follow horizons, expected a regular grid");
}

}  // namespace slipwave::model_refit_test
