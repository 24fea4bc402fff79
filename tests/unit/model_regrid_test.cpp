// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include "build/resample.hpp"
#include "model_cases.hpp"

namespace slipwave::model_regrid_test {
namespace {

/// Every cell of another rock, water in between, the last row void, two fracture codes.
template <int D>
Model<D> motley(const Index<D>& shape, double spacing_m) {
  Grid<D> grid;
  grid.shape = shape;
  grid.spacing_m = spacing_m;
  grid.origin_m[0] = 30;
  Model<D> model;
  model.medium = {Field<D>(grid), Field<D>(grid), Field<D>(grid)};
  model.fracture = Field<D, std::uint8_t>(grid);
  SlipSystem<D> system{};
  system.normal[0] = 1;
  model.fracture_sets = {{"one", {system}}, {"two", {system}}};
  model.title = "motley";
  for (std::int64_t n = 0; n < grid.size(); ++n) {
    const auto cell = std::size_t(n);
    if (grid.index(n)[D - 1] == shape[D - 1] - 1) continue;
    const bool fluid = n % 4 == 1;
    model.medium.vp[cell] = fluid ? 1500 : 3000 + float(n);
    model.medium.vs[cell] = fluid ? 0 : 1400 + float(n) / 7;
    model.medium.rho[cell] = fluid ? 1000 + float(n) : 2000 + float(n) / 3;
    if (!fluid) model.fracture[cell] = std::uint8_t(n % 3);
  }
  return model;
}

template <int D>
void expect_same(const Model<D>& a, const Model<D>& b) {
  ASSERT_EQ(a.grid(), b.grid());
  EXPECT_EQ(a.title, b.title);
  EXPECT_EQ(a.fracture_sets.size(), b.fracture_sets.size());
  for (std::size_t cell = 0; cell < a.medium.vp.size(); ++cell) {
    EXPECT_EQ(a.medium.vp[cell], b.medium.vp[cell]) << cell;
    EXPECT_EQ(a.medium.vs[cell], b.medium.vs[cell]) << cell;
    EXPECT_EQ(a.medium.rho[cell], b.medium.rho[cell]) << cell;
    EXPECT_EQ(a.fracture[cell], b.fracture[cell]) << cell;
  }
}

template <int D>
void expect_split_and_joined(const Model<D>& model) {
  for (const int factor : {2, 3, 5}) {
    const double h = model.grid().spacing_m;
    const auto fine = regridded(model, h / factor);
    for (std::int64_t n = 0; n < fine.grid().size(); ++n) {
      auto at = fine.grid().index(n);
      for (auto& i : at) i /= factor;
      const auto old = std::size_t(model.grid().flat(at));
      ASSERT_EQ(fine.medium.vp[std::size_t(n)], model.medium.vp[old]) << factor;
      ASSERT_EQ(fine.medium.vs[std::size_t(n)], model.medium.vs[old]) << factor;
      ASSERT_EQ(fine.medium.rho[std::size_t(n)], model.medium.rho[old]) << factor;
      ASSERT_EQ(fine.fracture[std::size_t(n)], model.fracture[old]) << factor;
    }
    expect_same(regridded(fine, h), model);
  }
}

/// A column one cell wide of rocks {vp, vs, rho}.
Model<2> column(const std::vector<std::array<double, 3>>& rocks, double spacing_m) {
  const auto grid = grid_of(1, std::int64_t(rocks.size()), spacing_m);
  Model<2> model;
  model.medium = {Field<2>(grid), Field<2>(grid), Field<2>(grid)};
  for (std::size_t k = 0; k < rocks.size(); ++k) {
    model.medium.vp[k] = float(rocks[k][0]);
    model.medium.vs[k] = float(rocks[k][1]);
    model.medium.rho[k] = float(rocks[k][2]);
  }
  return model;
}

/// The column twice beside itself, that cells may be twice as large.
Model<2> doubled(const Model<2>& narrow) {
  Model<2> model;
  const auto grid = grid_of(2, narrow.grid().shape[1], narrow.grid().spacing_m);
  model.medium = {Field<2>(grid), Field<2>(grid), Field<2>(grid)};
  for (std::size_t cell = 0; cell < model.medium.vp.size(); ++cell) {
    model.medium.vp[cell] = narrow.medium.vp[cell / 2];
    model.medium.vs[cell] = narrow.medium.vs[cell / 2];
    model.medium.rho[cell] = narrow.medium.rho[cell / 2];
  }
  return model;
}

}  // namespace

TEST(Regrid, SplitsCellsIntoCopiesAndJoinsThemAgain) {
  expect_split_and_joined<2>(motley<2>({5, 4}, 10));
  expect_split_and_joined<3>(motley<3>({3, 4, 3}, 0.7));
}

TEST(Regrid, AveragesDensitiesAndCompliances) {
  const auto model = doubled(column({{2500, 1200, 2000}, {4500, 2250, 2500}}, 10));
  const auto coarse = regridded(model, 20);
  ASSERT_EQ(coarse.grid().size(), 1);
  const double p = 2 / (1 / (2000 * 2500. * 2500) + 1 / (2500 * 4500. * 4500));
  const double s = 2 / (1 / (2000 * 1200. * 1200) + 1 / (2500 * 2250. * 2250));
  EXPECT_FLOAT_EQ(coarse.medium.rho[0], 2250);
  EXPECT_FLOAT_EQ(coarse.medium.vp[0], float(std::sqrt(p / 2250)));
  EXPECT_FLOAT_EQ(coarse.medium.vs[0], float(std::sqrt(s / 2250)));
}

TEST(Regrid, KeepsTravelTimeAtNormalIncidenceToSecondOrderOfTheContrast) {
  // With one density and a slowness of 1 +- e, compliance is the mean of squares: sqrt(1 + e^2) for 1.
  const double e = 0.1;
  const auto model =
      doubled(column({{3000 / (1 + e), 1500 / (1 + e), 2000}, {3000 / (1 - e), 1500 / (1 - e), 2000}}, 10));
  const auto coarse = regridded(model, 20);
  EXPECT_NEAR(coarse.medium.vp[0], 3000 / std::sqrt(1 + e * e), 1e-3);
  EXPECT_NEAR(coarse.medium.vs[0], 1500 / std::sqrt(1 + e * e), 1e-3);
}

// Proves (M1).
TEST(Regrid, WeighsPartsByTheirVolumeAtAnyRatio) {
  // 3 cells of 10 m become 2 of 15 m: parts of 2 : 1 and 1 : 2.
  const auto grid = grid_of(3, 3, 10);
  Model<2> model;
  model.medium = {Field<2>(grid), Field<2>(grid, 1500), Field<2>(grid, 2000)};
  const double speeds[] = {3000, 3600, 4500};
  for (std::int64_t n = 0; n < 9; ++n) model.medium.vp[std::size_t(n)] = float(speeds[grid.index(n)[1]]);
  const auto coarse = regridded(model, 15);
  ASSERT_EQ(coarse.grid().shape, (Index<2>{2, 2}));
  const auto square = [](double v) { return v * v; };
  EXPECT_FLOAT_EQ(coarse.medium.vp[0], float(1 / std::sqrt((2 / square(3000) + 1 / square(3600)) / 3)));
  EXPECT_FLOAT_EQ(coarse.medium.vp[2], float(1 / std::sqrt((1 / square(3600) + 2 / square(4500)) / 3)));
  EXPECT_EQ(coarse.medium.vs[0], 1500);
  // And 2 of 15 m become 3 of 10 m, the middle one half and half.
  const auto finer = regridded(coarse, 10);
  EXPECT_EQ(finer.medium.vp[0], coarse.medium.vp[0]);
  EXPECT_EQ(finer.medium.vp[6], coarse.medium.vp[2]);
  EXPECT_FLOAT_EQ(
      finer.medium.vp[3],
      float(1 / std::sqrt((1 / square(coarse.medium.vp[0]) + 1 / square(coarse.medium.vp[2])) / 2)));
}

TEST(Regrid, NeverAveragesAcrossAnInterfaceOfSolidFluidAndVoid) {
  // Three rows make one: the middle one says what it is, and only rows of that kind are in it.
  const std::array<double, 3> rock{3000, 1500, 2000}, hard{4500, 2250, 2500}, water{1500, 0, 1000},
      brine{1600, 0, 1100}, air{0, 0, 0};
  const auto joined = [&](const std::vector<std::array<double, 3>>& rows) {
    const auto grid = grid_of(3, 3, 10);
    Model<2> model;
    model.medium = {Field<2>(grid), Field<2>(grid), Field<2>(grid)};
    for (std::int64_t n = 0; n < 9; ++n) {
      const auto& row = rows[std::size_t(grid.index(n)[1])];
      model.medium.vp[std::size_t(n)] = float(row[0]);
      model.medium.vs[std::size_t(n)] = float(row[1]);
      model.medium.rho[std::size_t(n)] = float(row[2]);
    }
    const auto coarse = regridded(model, 30);
    return std::array<double, 3>{coarse.medium.vp[0], coarse.medium.vs[0], coarse.medium.rho[0]};
  };
  EXPECT_EQ(joined({water, rock, rock}), rock);
  EXPECT_EQ(joined({water, water, rock}), water);
  EXPECT_EQ(joined({air, rock, water}), rock);
  EXPECT_EQ(joined({rock, air, water}), air);
  EXPECT_EQ(joined({rock, water, brine})[2], 1050);
  EXPECT_EQ(joined({water, rock, hard})[2], 2250);
}

TEST(Regrid, RefusesAStepThatDoesNotDivide) {
  EXPECT_EQ(sentence_of([] { regridded(water_over_rock(grid_of(10, 8, 20), 1), 3.0); }),
            "200 m are 66.667 steps of 3 m, expected a whole number");
}

}  // namespace slipwave::model_regrid_test
