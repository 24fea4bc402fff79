// SPDX-License-Identifier: BSD-3-Clause
#include "fitted_scenes.hpp"

// Rows that follow horizons, where these are level.
namespace slipwave::solver::fitted_rows_test {
namespace {

/// The same scene with a grid that has the depths of a regular one.
template <int D>
Scene<D> with_regular_rows(Scene<D> scene) {
  auto grid = scene.model.grid();
  std::vector<double> corners;
  const auto columns = corner_columns(grid).size();
  for (std::int64_t row = 0; row <= grid.shape[D - 1]; ++row)
    corners.insert(corners.end(), columns, double(row) * grid.spacing_m);
  grid.rows = std::make_shared<const RowDepths<D>>(grid.shape, std::move(corners));
  const auto on_it = [&](auto& field) {
    auto moved = std::decay_t<decltype(field)>(grid);
    std::copy(field.begin(), field.end(), moved.begin());
    field = std::move(moved);
  };
  auto& model = scene.model;
  for (const Property property : model.medium.properties()) on_it(model.medium[property]);
  if (!model.fracture.empty()) on_it(model.fracture);
  return scene;
}

template <int D>
void expect_regular_rows_give_the_same(const Scene<D>& scene) {
  const auto fitted = with_regular_rows(scene);
  ASSERT_TRUE(fitted.model.grid().rows);
  EXPECT_EQ(time_step_s(fitted), time_step_s(scene));
  const auto expected = samples_of(shoot(scene, 1));
  EXPECT_GT(*std::max_element(expected.begin(), expected.end()), 0);
  EXPECT_TRUE(samples_of(shoot(fitted, 1)) == expected);
}

/// Zones as wide as those that rows bend in, and wider.
template <int D>
void expect_depths_of_each_corner(const Scene<D>& scene) {
  for (const int zone_cells : {3, 25}) {
    const auto domain = make_domain(scene.model.medium, scene.edges, zone_cells);
    const auto depths = corner_depths(domain);
    Grid<D> corners;
    for (std::size_t axis = 0; axis < D; ++axis) corners.shape[axis] = domain.grid.shape[axis] + 1;
    ASSERT_EQ(std::int64_t(depths.size()), corners.size());
    for (std::int64_t n = 0; n < corners.size(); ++n)
      ASSERT_EQ(depths[std::size_t(n)], corner_depth(domain, corners.index(n))) << n;
  }
}

// Proves (F10).
TEST(CornerDepths, AreTheDepthOfEachCorner) {
  expect_depths_of_each_corner(fitted_hills());
  expect_depths_of_each_corner(fitted_sea_3d());
}

// Proves (F1), (F8).
TEST(FittedRows, ThatAreAllOneCellHighGiveTheBitsOfARegularGrid) {
  for (const int order : orders) {
    Scene<2> scene = fitted_sea();
    scene.model = {};
    scene.model.medium = uniform_medium(220, 90, 5, {4500, 2250, 2500});
    for (std::int64_t k = 0; k < 90; ++k)
      for (std::int64_t i = 0; i < 220; ++i) {
        if (k < 20 + i / 40) put(scene.model.medium, {i, k}, {1500, 0, 1000});
        if (k > 60) put(scene.model.medium, {i, k}, {2500, 1200, 2000});
      }
    fracture_rows(scene.model, 230, 290, 70, 100, 1);
    scene.model.fracture_sets = {{"cracks", {{{0, 1}, 0.5, 1000, 0}}}};
    scene.numerics.order = order;
    expect_regular_rows_give_the_same(scene);
  }
  auto cube = fitted_sea_3d();
  cube.model = {};
  cube.model.medium = lumps({40, 22, 44}, 5, 7);
  for (std::int64_t n = 0; n < cube.model.grid().size(); ++n)
    if (const auto at = cube.model.grid().index(n); at[0] > 15 && at[0] < 37)
      put(cube.model.medium, at, {4500, 2250, 2500});
  for (auto& receiver : cube.survey.receivers_m) receiver[0] = 120;
  expect_regular_rows_give_the_same(cube);
}

}  // namespace
}  // namespace slipwave::solver::fitted_rows_test
