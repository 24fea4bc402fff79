// SPDX-License-Identifier: BSD-3-Clause
#include "grid/true_depth.hpp"

#include <gtest/gtest.h>

#include "curvilinear_grid.hpp"
#include "grid/slice.hpp"
#include "refusal.hpp"

namespace slipwave::grid_true_depth_test {
namespace {

/// 20 x 30 cells of 10 m under a surface that falls from 20 to 60 m, down to 300 m.
Grid<2> hillside() {
  return bent<2>({{20, 30}, 10, {0, 0}}, [](double x, double, double zeta) {
    const double top = 20 + 0.2 * x;
    return top + zeta / 300 * (300 - top);
  });
}

/// 12 x 8 x 10 cells of 10 m under a surface that falls along x and y.
Grid<3> slope() {
  return bent<3>({{12, 8, 10}, 10, {0, 0, 0}}, [](double x, double y, double zeta) {
    const double top = 10 + 0.2 * x + 0.1 * y;
    return top + zeta / 100 * (100 - top);
  });
}

TEST(TrueDepth, FacesOfAColumnAreMeansOfCorners) {
  const auto faces = faces_of_column(hillside(), {4, 7});
  ASSERT_EQ(faces.size(), 31u);
  for (std::size_t k = 0; k < faces.size(); ++k)
    EXPECT_NEAR(faces[k], 29 + double(k) / 30 * (300 - 29), 1e-12);  // x = 45 m
  EXPECT_EQ(faces_of_column(Grid<2>{{3, 4}, 2.5, {0, 0}}, {1, 0}), (std::vector<double>{0, 2.5, 5, 7.5, 10}));
}

TEST(TrueDepth, ARowBetweenFacesHoldsItsUpperFace) {
  const std::vector<double> faces = {20, 25, 40, 45};
  const std::vector<std::pair<double, int>> rows = {{19.9, -1}, {20, 0},   {24.9, 0}, {25, 1},
                                                    {39, 1},    {44.9, 2}, {45, 2},   {45.1, -1}};
  for (const auto& [depth, row] : rows) EXPECT_EQ(row_between(faces, depth), row) << depth;
}

TEST(TrueDepth, ExtentsBeginAtTheDatum) {
  EXPECT_EQ(depth_extent(hillside()), (std::array<double, 2>{0, 300}));
  EXPECT_EQ(depth_extent(Grid<2>{{3, 4}, 2.5, {0, 5}}), (std::array<double, 2>{5, 15}));
}

TEST(TrueDepth, LinearFieldsStayLinearInRegularDepth) {
  const auto grid = hillside();
  const auto field = at_centres<2>(grid, [](const auto& p) { return 3 * p[0] + 2 * p[1] + 100; });
  const auto regular = in_regular_depth(field, DepthTake::linear);
  EXPECT_EQ(regular.grid(), (Grid<2>{{20, 30}, 10, {0, 0}}));
  for (std::int64_t cell = 0; cell < regular.grid().size(); ++cell) {
    const auto at = regular.grid().index(cell);
    const double x = regular.grid().centre(0, at[0]), z = regular.grid().centre(1, at[1]);
    const auto faces = faces_of_column(grid, at);
    const double first = (faces[0] + faces[1]) / 2, last = (faces[29] + faces[30]) / 2;
    const double value = z < faces[0] ? 0 : 3 * x + 2 * std::clamp(z, first, last) + 100;
    EXPECT_NEAR(regular[std::size_t(cell)], value, 1e-3) << x << ' ' << z;
  }
}

TEST(TrueDepth, MediaTakeTheCellThatADepthIsIn) {
  const auto grid = hillside();
  Field<2> rows(grid);
  for (std::size_t cell = 0; cell < rows.size(); ++cell) rows[cell] = float(cell / 20 + 1);
  const auto regular = in_regular_depth(rows, DepthTake::nearest);
  for (std::int64_t cell = 0; cell < regular.grid().size(); ++cell) {
    const auto at = regular.grid().index(cell);
    const double x = regular.grid().centre(0, at[0]), z = regular.grid().centre(1, at[1]);
    const double top = 20 + 0.2 * x;
    const double row = z < top ? 0 : std::floor((z - top) / (300 - top) * 30) + 1;
    EXPECT_EQ(regular[std::size_t(cell)], float(row)) << x << ' ' << z;
  }
}

TEST(TrueDepth, RegularGridsStayWhatTheyAre) {
  const Grid<2> grid{{4, 3}, 10, {5, 0}};
  const auto field = at_centres<2>(grid, [](const auto& p) { return p[0] * p[1]; });
  for (const auto take : {DepthTake::nearest, DepthTake::linear}) {
    const auto same = in_regular_depth(field, take);
    EXPECT_EQ(same.grid(), grid);
    EXPECT_TRUE(std::equal(same.begin(), same.end(), field.begin()));
  }
}

TEST(FittedSlice, UprightOnesKeepTheirDepths) {
  const auto grid = slope();
  const auto depths = at_centres<3>(grid, [](const auto& p) { return p[2]; });
  for (const int axis : {0, 1}) {
    const auto layer = layer_on(grid, {axis, 34});
    EXPECT_EQ(layer.number, 3);
    EXPECT_FALSE(layer.depth_m);
    const auto part = layer_of(depths, layer);
    const auto section = section_of(depths, layer);
    EXPECT_EQ(part.grid().rows->horizons(), grid.rows->horizons());
    for (std::int64_t cell = 0; cell < part.grid().size(); ++cell) {
      const auto n = std::size_t(cell);
      EXPECT_NEAR(part.grid().depth(part.grid().index(cell)), part[n], 1e-5);
      EXPECT_NEAR(section.grid().depth(section.grid().index(cell)), section[n], 1e-5);
    }
    EXPECT_EQ(plane_of(grid, layer).at_m, 35);
  }
}

TEST(FittedSlice, LevelOnesTakeTheCellsAtTheirDepth) {
  const auto grid = slope();
  Field<3> rows(grid);
  for (std::size_t cell = 0; cell < rows.size(); ++cell) rows[cell] = float(cell / (12 * 8));
  const auto layer = layer_on(grid, {2, 31});
  EXPECT_EQ(plane_of(grid, layer).at_m, 31);
  const auto part = layer_of(rows, layer);
  EXPECT_EQ(part.grid(), (Grid<3>{{12, 8, 1}, 10, {0, 0, 26}}));
  const auto section = section_of(rows, layer);
  EXPECT_EQ(section.grid(), (Grid<2>{{12, 8}, 10, {0, 0}}));
  int above = 0;
  for (std::int64_t cell = 0; cell < part.grid().size(); ++cell) {
    const auto at = part.grid().index(cell);
    const double top = 10 + 0.2 * grid.centre(0, at[0]) + 0.1 * grid.centre(1, at[1]);
    const float found = part[std::size_t(cell)];
    if (top > 31) {
      ++above;
      EXPECT_TRUE(std::isnan(found) && std::isnan(section[std::size_t(cell)]));
      continue;
    }
    EXPECT_EQ(found, float(std::floor((31 - top) / (100 - top) * 10)));
    EXPECT_EQ(section[std::size_t(cell)], found);
  }
  EXPECT_GT(above, 5);
  EXPECT_EQ(refusal([&] { layer_on(grid, {2, 101}); }), "found z=101, expected it from 0 to 100");
}

}  // namespace
}  // namespace slipwave::grid_true_depth_test
