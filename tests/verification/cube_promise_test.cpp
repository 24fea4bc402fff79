// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cstdlib>

#include "accuracy/expected_error.hpp"
#include "accuracy/upright_plane.hpp"
#include "fitted_scenes.hpp"

// What --plan promises in 3-D.
namespace slipwave::solver {
namespace {

constexpr double interval_s = 0.001;
constexpr Rock water{1500, 0, 1000};

/// Samples of all traces.
std::vector<double> samples_of_shot(const Scene<3>& scene) {
  std::vector<double> all;
  for (const auto& trace : shoot(scene, 1).traces)
    all.insert(all.end(), trace.samples.begin(), trace.samples.end());
  return all;
}

double promise_of(const Scene<3>& scene) { return expected_error(scene).promise->error; }

void expect_within_a_factor_of_two(double promised, double found, const std::string& what) {
  if (std::getenv("SLIPWAVE_SHOW"))
    std::printf("%s: promised %.2f %%, found %.2f %%\n", what.c_str(), 100 * promised, 100 * found);
  EXPECT_GT(promised, found / 2) << what;
  EXPECT_LT(promised, 2 * found) << what;
}

TEST(PromiseIn3D, IsWithinAFactorOfTwoOfTheErrorInAFullSpace) {
  // An explosion in water, whose far and near field is a pulse and its derivative; on mirrors it stands for
  // the whole space.
  const Point<3> receivers[] = {{120, 90, 150}, {40, 30, 190}, {200, 100, 60}, {160, 10, 5}};
  const RickerForm wavelet{30};
  for (const double h : {5., 4.}) {
    auto edges = edges_all_3d(EdgeLaw::mirror);
    for (int axis = 0; axis < 3; ++axis) edges[axis][1] = EdgeLaw::absorbing;
    const auto n = std::int64_t(220 / h);
    auto scene = scene_of(uniform_cube({n, n, n}, h, water), edges, {0, 0, 0}, "explosion", "ricker:30",
                          {std::begin(receivers), std::end(receivers)},
                          {Component::vx, Component::vy, Component::vz}, 0.25, interval_s);
    check(scene);
    std::vector<double> exact;
    const auto count = std::size_t(scene.recording.samples());
    for (std::size_t axis = 0; axis < 3; ++axis)
      for (const auto& r : receivers)
        for (std::size_t sample = 0; sample < count; ++sample) {
          const double distance = std::hypot(r[0], r[1], r[2]);
          const double delayed = double(sample) * interval_s - distance / water.vp;
          // Eight images make one source.
          exact.push_back(
              8 * 1e9 * r[axis] / distance / (4 * std::numbers::pi * water.rho * water.vp * water.vp) *
              (wavelet(delayed) / (distance * distance) + wavelet.slope(delayed) / (water.vp * distance)));
        }
    expect_within_a_factor_of_two(promise_of(scene), relative_error(samples_of_shot(scene), exact),
                                  "water in cells of " + std::to_string(h));
  }
}

/// Water over rock, level or fitted to a floor that dips along x and y; receivers in several directions.
Scene<3> sea(double h, double dip, bool staircase, int order, const char* mechanism) {
  const auto floor = [dip](double x, double y) { return 120.3 + dip * (x - 150) + 0.5 * dip * (y - 100); };
  const Grid<3> grid{{std::int64_t(std::lround(300 / h)), std::int64_t(std::lround(216 / h)),
                      std::int64_t(std::lround(240 / h))},
                     h,
                     {0, 0, 0}};
  Medium<3> medium = fitted_medium<3>(grid, {water_above, below(floor, {2600, 1500, 2200})});
  if (staircase) {
    medium = uniform_cube(grid.shape, h, {2600, 1500, 2200});
    for (std::int64_t n = 0; n < grid.size(); ++n) {
      const auto at = grid.index(n);
      if (grid.centre(2, at[2]) < floor(grid.centre(0, at[0]), grid.centre(1, at[1]))) put(medium, at, water);
    }
  }
  auto scene = scene_of(
      std::move(medium), edges_all_3d(EdgeLaw::absorbing), {150, 102, 60}, mechanism, "ricker:20",
      {{60, 102, 70}, {250, 102, 70}, {80, 40, 180}, {220, 170, 180}, {220, 40, 70}, {150, 190, 190}},
      {Component::vx, Component::vy, Component::vz}, 0.3, interval_s);
  scene.numerics.order = order;
  check(scene);
  return scene;
}

TEST(PromiseIn3D, IsWithinAFactorOfTwoOfTheErrorOverSeaFloors) {
  if (!std::getenv("SLIPWAVE_LONG")) GTEST_SKIP() << "long";
  for (const double dip : {0., 0.2}) {
    auto fine = sea(3, dip, false, 7, "explosion");
    const auto exact = samples_of_shot(fine);
    for (const int order : {5, 7}) {
      const auto scene = sea(6, dip, false, order, "explosion");
      expect_within_a_factor_of_two(
          promise_of(scene), relative_error(samples_of_shot(scene), exact),
          "fitted floor, slope " + std::to_string(dip) + ", order " + std::to_string(order));
    }
    if (dip == 0) continue;
    const auto scene = sea(6, dip, true, 5, "explosion");
    expect_within_a_factor_of_two(promise_of(scene), relative_error(samples_of_shot(scene), exact),
                                  "stairs, slope " + std::to_string(dip));
  }
}

TEST(PromiseIn3D, IsThatIn2DWhereTheModelDoesNotChangeAcross) {
  for (const bool staircase : {false, true}) {
    Scene<2> flat;
    const auto floor = [](double x, double) { return 120.3 + 0.2 * (x - 150); };
    const Grid<2> grid{{60, 48}, 5, {0, 0}};
    flat.model.medium = fitted_medium<2>(grid, {water_above, below(floor, {2600, 1500, 2200})});
    if (staircase) {
      flat.model.medium = uniform_medium(60, 48, 5, {2600, 1500, 2200});
      for (std::int64_t n = 0; n < grid.size(); ++n) {
        const auto at = grid.index(n);
        if (grid.centre(1, at[1]) < floor(grid.centre(0, at[0]), 0)) put(flat.model.medium, at, water);
      }
    }
    flat.survey.sources = {{{152, 60}, Explosion{}, parse_wavelet("ricker:20"), 1e9}};
    flat.survey.receivers_m = {{60, 70}, {250, 70}, {80, 180}, {220, 180}};
    flat.edges = edges_all(EdgeLaw::absorbing);
    flat.recording = {{Component::vx, Component::vz}, 0.3, interval_s};
    const auto in_2d = *expected_error(flat).promise;
    // Along y, so that the plane is not that of the grid's first axis.
    const auto turned = [&](double x, double y) { return floor(y, x); };
    const Grid<3> cube{{8, 60, 48}, 5, {0, 0, 0}};
    auto medium = fitted_medium<3>(cube, {water_above, below(turned, {2600, 1500, 2200})});
    if (staircase) {
      medium = uniform_cube(cube.shape, 5, {2600, 1500, 2200});
      for (std::int64_t n = 0; n < cube.size(); ++n) {
        const auto at = cube.index(n);
        if (cube.centre(2, at[2]) < turned(cube.centre(0, at[0]), cube.centre(1, at[1])))
          put(medium, at, water);
      }
    }
    std::vector<Point<3>> receivers;
    for (const auto& at : flat.survey.receivers_m) receivers.push_back({22, at[0], at[1]});
    auto deep = scene_of(std::move(medium), edges_all_3d(EdgeLaw::absorbing), {22, 152, 60}, "explosion",
                         "ricker:20", receivers, {Component::vz}, 0.3, interval_s);
    deep.edges[0] = {EdgeLaw::mirror, EdgeLaw::mirror};
    const auto in_3d = *expected_error(deep).promise;
    ASSERT_FALSE(in_3d.causes.empty());
    // The same interface in the same cells; waves spread otherwise, and the wavelet has higher frequencies.
    EXPECT_EQ(in_3d.causes[0].name.substr(0, 18), in_2d.causes[0].name.substr(0, 18));
    EXPECT_GT(in_3d.error, 0.8 * in_2d.error);
    EXPECT_LT(in_3d.error, 1.6 * in_2d.error);
  }
}

TEST(PromiseIn3D, SaysWhatItDoesNotKnow) {
  auto scene = sea(12, 0, false, 5, "force:0,1,0");
  scene.survey.sources[0].position_m[2] = 150;
  scene.survey.receivers_m = {{60, 102, 70}, {250, 102, 70}};
  const auto across = expected_error(scene);
  EXPECT_FALSE(across.promise);
  ASSERT_FALSE(across.not_covered.empty());
  EXPECT_EQ(across.not_covered.back(), "SH waves");
  scene.survey.receivers_m.push_back({150, 190, 70});
  const auto both = expected_error(scene);
  ASSERT_TRUE(both.promise);
  EXPECT_GT(both.promise->error, 0);
  EXPECT_EQ(both.not_covered.back(), "SH waves");
}

}  // namespace
}  // namespace slipwave::solver
