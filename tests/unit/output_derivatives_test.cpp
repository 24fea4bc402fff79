// SPDX-License-Identifier: BSD-3-Clause
#include "output/derivatives.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "curvilinear_grid.hpp"

namespace slipwave::output_derivatives_test {
namespace {

template <int D>
Field<D> filled(const Grid<D>& grid, const std::function<double(const Point<D>&)>& f) {
  Field<D> field(grid);
  for (std::int64_t cell = 0; cell < grid.size(); ++cell) {
    const auto at = grid.index(cell);
    Point<D> point;
    for (int axis = 0; axis < D; ++axis) point[axis] = grid.centre(axis, at[axis]);
    field[std::size_t(cell)] = float(f(point));
  }
  return field;
}

TEST(Derivative, IsExactForQuadraticsUpToTheEdges) {
  const Grid<2> grid{{9, 6}, 0.5, {}};
  const auto field =
      filled<2>(grid, [](const auto& p) { return 1 + p[0] * p[0] - 2 * p[0] * p[1] + 3 * p[1] * p[1]; });
  const auto dx = derivative<2>(field, 0), dz = derivative<2>(field, 1);
  for (std::int64_t cell = 0; cell < grid.size(); ++cell) {
    const auto at = grid.index(cell);
    const double x = grid.centre(0, at[0]), z = grid.centre(1, at[1]);
    EXPECT_NEAR(dx[std::size_t(cell)], 2 * x - 2 * z, 1e-4);
    EXPECT_NEAR(dz[std::size_t(cell)], -2 * x + 6 * z, 1e-4);
  }
}

TEST(Derivative, HasOrderFourInside) {
  const auto error = [](std::int64_t cells) {
    const Grid<2> grid{{cells, 1}, 1. / double(cells), {}};
    const auto field = filled<2>(grid, [](const auto& p) { return std::sin(6 * p[0]); });
    const auto slope = derivative<2>(field, 0);
    double largest = 0;
    for (std::int64_t i = 2; i < cells - 2; ++i)
      largest =
          std::max(largest, std::abs(double(slope[std::size_t(i)]) - 6 * std::cos(6 * grid.centre(0, i))));
    return largest;
  };
  EXPECT_NEAR(std::log2(error(16) / error(32)), 4, 0.2);
}

TEST(Curl, VanishesForAGradientAndDivergenceForAVortex) {
  const Grid<2> grid{{8, 8}, 1, {}};
  const std::array<Field<2>, 2> gradient = {filled<2>(grid, [](const auto& p) { return 2 * p[0] + p[1]; }),
                                            filled<2>(grid, [](const auto& p) { return p[0] + 3 * p[1]; })};
  const std::array<Field<2>, 2> vortex = {filled<2>(grid, [](const auto& p) { return p[1]; }),
                                          filled<2>(grid, [](const auto& p) { return -p[0]; })};
  for (std::size_t cell = 0; cell < 64; ++cell) {
    EXPECT_NEAR(curl(gradient)[cell], 0, 1e-5);
    EXPECT_NEAR(divergence<2>(gradient)[cell], 5, 1e-5);
    EXPECT_NEAR(curl(vortex)[cell], 2, 1e-5);
    EXPECT_NEAR(divergence<2>(vortex)[cell], 0, 1e-5);
  }
}

TEST(Curl, HasThreeComponentsIn3D) {
  // v = (y, 2 z, 3 x): curl = (-2, -3, -1), divergence 0.
  const Grid<3> grid{{5, 5, 5}, 2, {}};
  const std::array<Field<3>, 3> v = {filled<3>(grid, [](const auto& p) { return p[1]; }),
                                     filled<3>(grid, [](const auto& p) { return 2 * p[2]; }),
                                     filled<3>(grid, [](const auto& p) { return 3 * p[0]; })};
  const auto rotation = curl(v);
  for (std::size_t cell = 0; cell < 125; ++cell) {
    EXPECT_NEAR(rotation[0][cell], -2, 1e-5);
    EXPECT_NEAR(rotation[1][cell], -3, 1e-5);
    EXPECT_NEAR(rotation[2][cell], -1, 1e-5);
    EXPECT_NEAR(divergence<3>(v)[cell], 0, 1e-5);
  }
}

/// Rows bent by waves of `height` of the depth, regular at the bottom.
template <int D>
Grid<D> waving(const Grid<D>& grid, double height) {
  const double bottom = grid.end(D - 1);
  return bent<D>(grid, [=](double x, double y, double zeta) {
    return zeta + height * bottom * (1 - zeta / bottom) * (0.5 + 0.5 * std::sin(5 * (x + 0.5 * y) / bottom));
  });
}

TEST(Derivative, OfLinearFieldsIsExactOnCurvilinearRows) {
  const auto flat = waving(Grid<2>{{20, 15}, 0.5, {}}, 0.2);
  const auto of_plane = at_centres<2>(flat, [](const auto& p) { return 1 + 2 * p[0] - 3 * p[1]; });
  const auto deep = waving(Grid<3>{{9, 8, 7}, 0.5, {}}, 0.2);
  const auto of_space = at_centres<3>(deep, [](const auto& p) { return 2 * p[0] - 3 * p[1] + 5 * p[2]; });
  for (const auto& [axis, slope] : {std::pair{0, 2}, {1, -3}})
    for (const float value : derivative<2>(of_plane, axis)) EXPECT_NEAR(value, slope, 1e-4);
  for (const auto& [axis, slope] : {std::pair{0, 2}, {1, -3}, {2, 5}})
    for (const float value : derivative<3>(of_space, axis)) EXPECT_NEAR(value, slope, 1e-4);
}

TEST(Derivative, ConvergesToTrueDirectionsOnCurvilinearRows) {
  const auto error = [](std::int64_t cells, int axis) {
    const auto grid = waving(Grid<2>{{cells, cells}, 1. / double(cells), {}}, 0.2);
    const auto field = at_centres<2>(grid, [](const auto& p) { return std::sin(9 * p[0] + 6 * p[1]); });
    const auto exact = at_centres<2>(
        grid, [&](const auto& p) { return (axis == 0 ? 9 : 6) * std::cos(9 * p[0] + 6 * p[1]); });
    const auto slope = derivative<2>(field, axis);
    double largest = 0;
    for (std::int64_t cell = 0; cell < grid.size(); ++cell) {
      const auto at = grid.index(cell);
      const auto inside = [&](std::int64_t i) { return i >= 2 && i < cells - 2; };
      if (!inside(at[0]) || !inside(at[1])) continue;
      largest = std::max(largest, double(std::abs(slope[std::size_t(cell)] - exact[std::size_t(cell)])));
    }
    return largest;
  };
  for (const int axis : {0, 1}) {
    EXPECT_LT(error(40, axis), 0.01) << axis;
    EXPECT_GT(std::log2(error(20, axis) / error(40, axis)), 2.7) << axis;
  }
}

}  // namespace
}  // namespace slipwave::output_derivatives_test
