// SPDX-License-Identifier: BSD-3-Clause
#include "build/import_fit.hpp"

#include <cmath>
#include <numbers>

#include "build/import.hpp"
#include "geology/layers.hpp"
#include "model_cases.hpp"

namespace slipwave::model_import_fit_test {
namespace {

/// A staircase model of layers.
Model<2> stairs(const Grid<2>& grid, const std::vector<Layer>& layers) {
  Model<2> model;
  model.medium = layered_medium(grid, layers, Average::none);
  return model;
}

std::vector<Layer> sea(const std::string& floor) {
  return {{0, 1500, 0, 1000}, {Horizon::parse(floor), {3000, 1500, 2000}, {}}};
}

}  // namespace

TEST(SmoothedStairs, OfAPlaneAreAPlaneWithinHalfACell) {
  std::vector<double> faces;
  for (int n = 0; n < 300; ++n) faces.push_back(10 * std::round((200 + 0.7 * n) / 10));
  const auto floor = smoothed(faces, 5);
  for (std::size_t n = 0; n < faces.size(); ++n) {
    EXPECT_LE(std::abs(floor[n] - faces[n]), 5);
    EXPECT_NEAR(floor[n], 200 + 0.7 * double(n), 2);
    EXPECT_NEAR(floor[n] - floor[n > 0 ? n - 1 : 1], n > 0 ? 0.7 : -0.7, 0.05);
  }
}

TEST(SmoothedStairs, OfASineHaveNoSteps) {
  std::vector<double> faces, slopes;
  const auto depth = [](double n) { return 200 + 25 * std::sin(2 * std::numbers::pi * n / 150); };
  for (int n = 0; n < 400; ++n) faces.push_back(5 * std::round(depth(n) / 5));
  const auto floor = smoothed(faces, 2.5);
  for (std::size_t n = 1; n < faces.size(); ++n) {
    EXPECT_NEAR(floor[n], depth(double(n)), 2.5);
    // The first and the last step bound it on one side only.
    if (n < 10 || n > 390) continue;
    EXPECT_NEAR(floor[n] - floor[n - 1], depth(double(n)) - depth(double(n) - 1), 0.2);
  }
}

TEST(ImportFit, FollowsAFloorThatIsGiven) {
  const auto grid = grid_of(100, 80, 5);
  const auto floor = Horizon::parse("sine,202,11,250");
  const auto fit = fit_imported(stairs(grid, sea("sine,202,11,250")), {{}, floor, false, 5});
  const auto& found = fit.model.grid();
  ASSERT_NE(found.rows, nullptr);
  EXPECT_TRUE(fit.warnings.empty());
  const auto row = found.rows->horizons().front().row;
  for (std::int64_t i = 0; i <= 100; ++i) EXPECT_EQ(found.rows->corner({i, row}), floor.at(5 * double(i)));
  for (std::int64_t cell = 0; cell < found.size(); ++cell)
    ASSERT_EQ(fit.model.medium.vp[std::size_t(cell)], found.index(cell)[1] < row ? 1500 : 3000);
  check(fit.model);
}

TEST(ImportFit, FindsAFloorInCells) {
  const auto grid = grid_of(200, 80, 5);
  const auto fit = fit_imported(stairs(grid, sea("sine,202,11,500")), {{}, {}, true, 5});
  const auto& found = fit.model.grid();
  ASSERT_NE(found.rows, nullptr);
  const auto floor = Horizon::parse("sine,202,11,500");
  const auto row = found.rows->horizons().front().row;
  for (std::int64_t i = 0; i <= 200; ++i)
    EXPECT_NEAR(found.rows->corner({i, row}), floor.at(5 * double(i)), 2.6);
  EXPECT_EQ(found.rows->horizons().front().role, "floor");
}

TEST(ImportFit, KeepsARegularGridOfAFlatFloor) {
  const auto model = stairs(grid_of(20, 40, 5), sea("100"));
  const auto fit = fit_imported(model, {{}, {}, true, 5});
  EXPECT_EQ(fit.model.grid(), model.grid());
  EXPECT_EQ(fit.summary, "");
}

TEST(ImportFit, MakesASurfaceTheTopAndLeavesOutVoid) {
  const auto grid = grid_of(100, 60, 5);
  const std::vector<Layer> land = {{Horizon::parse("sine,52,10,250"), {3000, 1500, 2000}, {}}};
  const auto fit = fit_imported(stairs(grid, land), {land[0].top, {}, false, 5});
  ASSERT_NE(fit.model.grid().rows, nullptr);
  for (std::size_t cell = 0; cell < fit.model.medium.vp.size(); ++cell)
    ASSERT_TRUE(fit.model.medium.is_solid(cell));
  EXPECT_EQ(fit.model.grid().rows->corner({7, 0}), land[0].top.at(35));
}

TEST(ImportFit, SaysWhereAHorizonIsElsewhereThanInTheCells) {
  const auto model = stairs(grid_of(100, 80, 5), sea("200"));
  const auto fit = fit_imported(model, {{}, Horizon(222), false, 5});
  ASSERT_EQ(fit.warnings.size(), 1U);
  EXPECT_EQ(
      fit.warnings[0],
      "the floor at 222 m lies 22 m from that of the cells at x=2.5; materials near it are continued to it");
  EXPECT_EQ(sentence_of([] {
              fit_imported(stairs(grid_of(100, 80, 5), {{0, 3000, 1500, 2000}}), {{}, {}, true, 5});
            }),
            "found no fluid above a sea floor at x=2.5, expected a floor in every column");
}

TEST(ImportFit, IsExtrudedWithItsRows) {
  const auto fit = fit_imported(stairs(grid_of(100, 80, 5), sea("sine,202,11,250")),
                                {{}, Horizon::parse("sine,202,11,250"), false, 5});
  const auto deep = extruded(fit.model.medium, 50);
  ASSERT_NE(deep.grid().rows, nullptr);
  EXPECT_EQ(deep.grid().shape, (Index<3>{100, 10, 80}));
  EXPECT_NEAR(deep.grid().depth({7, 3, 41}), fit.model.grid().depth({7, 41}), 1e-9);
  EXPECT_EQ(deep.vp({7, 3, 41}), fit.model.medium.vp({7, 41}));
}

}  // namespace slipwave::model_import_fit_test
