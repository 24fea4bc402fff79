// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <random>

#include "cube_extruded.hpp"
#include "long_form.hpp"
#include "solver/effect/slip.hpp"
#include "whole_effect.hpp"

namespace slipwave::solver::cube_slip_test {
namespace {

constexpr SlipCorrection corrections[] = {SlipCorrection::first, SlipCorrection::second,
                                          SlipCorrection::exponential, SlipCorrection::centred};

/// What slip changes of the traces, as a share of them.
double effect_of_slip(Scene<2> scene) {
  const auto slipping = samples_of(shoot(scene, 1));
  scene.with_slip = false;
  return relative_error(slipping, samples_of(shoot(scene, 1)));
}

// Proves (S12).
TEST(ExtrudedFractures, AlongYGiveTheTracesOf2D) {
  const auto edges = edges_of(EdgeLaw::free, EdgeLaw::absorbing, EdgeLaw::absorbing);
  auto both =
      extruded({0, 2}, edges, "force:1,2", "force:1,0,2", {Component::vx, Component::vz, Component::sxz},
               {Component::vx, Component::vz, Component::sxz});
  fracture(both, {0.6, -0.8}, 0.2, 1e2);
  both.flat.recording.duration_s = both.deep.recording.duration_s = 0.12;
  EXPECT_GT(effect_of_slip(both.flat), 0.02);
  for (const auto correction : corrections) {
    both.flat.numerics.correction = both.deep.numerics.correction = correction;
    EXPECT_LT(largest_error(both), 1e-9) << name_of(correction);
  }
}

// Proves (S12).
TEST(ExtrudedFractures, AlongXGiveTheTracesOf2DSweptByHalves) {
  auto both = extruded({1, 2}, edges_of(EdgeLaw::free, EdgeLaw::mirror, EdgeLaw::rigid), "force:1,2",
                       "force:0,1,2", {Component::vx, Component::vz, Component::sxz},
                       {Component::vy, Component::vz, Component::syz});
  fracture(both, {0.6, -0.8}, 0.2, 1e2);
  keep_half_sweeps(both);
  // All receivers have P waves by then.
  both.flat.recording.duration_s = both.deep.recording.duration_s = 0.08;
  EXPECT_GT(effect_of_slip(both.flat), 0.02);
  for (const auto correction : corrections) {
    both.flat.numerics.correction = both.deep.numerics.correction = correction;
    EXPECT_LT(largest_error(both), 1e-9) << name_of(correction);
  }
}

// Proves (S12).
TEST(ExtrudedFractures, AlongZGiveTheTracesOf2DInShortSteps) {
  // As without fractures. Friction would make much of little: where normal stress decides whether planes
  // slip, traces that differ by 0.5 % without slip differ by some percent with it, at any step.
  auto both = extruded({0, 1}, edges_of(EdgeLaw::free, EdgeLaw::mirror, EdgeLaw::rigid), "force:1,2",
                       "force:1,2,0", {Component::vx, Component::vz, Component::sxz},
                       {Component::vx, Component::vy, Component::sxy});
  fracture(both, {0.6, -0.8}, 0, 1e4);
  both.flat.recording.duration_s = both.deep.recording.duration_s = 0.12;
  EXPECT_GT(effect_of_slip(both.flat), 0.5);
  EXPECT_GT(order_of_difference(both, 0.05), 0.9);
}

/// Rock with a block of three systems of planes in it, none of them along an axis.
Scene<3> block_scene() {
  const Index<3> shape = {24, 21, 27};
  auto scene = scene_of(uniform_cube(shape, 5, rock), edges_all_3d(EdgeLaw::mirror), {61, 52, 38},
                        "force:3,1,2", "ricker:40", {{34, 41, 112}, {97, 85, 93}},
                        {Component::vx, Component::vy, Component::vz}, 0.07, 0.001);
  scene.model.fracture = Field<3, std::uint8_t>(scene.model.grid());
  for (std::int64_t n = 0; n < scene.model.grid().size(); ++n) {
    const auto at = scene.model.grid().index(n);
    scene.model.fracture[std::size_t(n)] =
        at[0] > 6 && at[0] < 18 && at[1] > 4 && at[1] < 15 && at[2] > 12 && at[2] < 18;
  }
  scene.model.fracture_sets = {{"block",
                                {{{0.48, 0.6, 0.64}, 0.2, 500, 50},
                                 {{-0.64, 0.768, 0.024}, 0.3, 0, 100},
                                 {{0.6, 0.0, -0.8}, 0.1, 1000, 0}}}};
  for (auto& system : scene.model.fracture_sets[0].systems) {
    double square = 0;
    for (const double part : system.normal) square += part * part;
    for (double& part : system.normal) part /= std::sqrt(square);
  }
  scene.numerics.double_precision = true;
  return scene;
}

/// Axis a of the scene that comes out is axis axis_of[a] of the given one, seen in a mirror where `sign` < 0.
Scene<3> turned(const Scene<3>& scene, const std::array<std::size_t, 3>& axis_of,
                const std::array<int, 3>& sign) {
  auto other = scene;
  const auto& grid = scene.model.grid();
  const auto vector = [&](const Point<3>& from) {
    Point<3> to;
    for (std::size_t a = 0; a < 3; ++a) to[a] = sign[a] * from[axis_of[a]];
    return to;
  };
  const auto point = [&](const Point<3>& from) {
    auto to = vector(from);
    for (std::size_t a = 0; a < 3; ++a)
      if (sign[a] < 0) to[a] += grid.end(int(axis_of[a]));
    return to;
  };
  Grid<3> turned_grid = grid;
  for (std::size_t a = 0; a < 3; ++a) turned_grid.shape[a] = grid.shape[axis_of[a]];
  other.model.medium = uniform_cube(turned_grid.shape, grid.spacing_m, rock);
  other.model.fracture = Field<3, std::uint8_t>(turned_grid);
  for (std::int64_t n = 0; n < grid.size(); ++n) {
    const auto at = grid.index(n);
    Index<3> there;
    for (std::size_t a = 0; a < 3; ++a)
      there[a] = sign[a] < 0 ? turned_grid.shape[a] - 1 - at[axis_of[a]] : at[axis_of[a]];
    other.model.fracture(there) = scene.model.fracture[std::size_t(n)];
  }
  for (auto& system : other.model.fracture_sets[0].systems) system.normal = vector(system.normal);
  auto& source = other.survey.sources[0];
  source.position_m = point(source.position_m);
  auto& force = std::get<PointForce<3>>(source.mechanism).vector;
  force = vector(force);
  for (auto& receiver : other.survey.receivers_m) receiver = point(receiver);
  return other;
}

/// Velocities along the axes of the given scene from the traces of the turned one.
std::vector<double> turned_back(const Gather& gather, const std::array<std::size_t, 3>& axis_of,
                                const std::array<int, 3>& sign) {
  std::vector<double> all;
  const auto receivers = gather.traces.size() / 3;
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (std::size_t a = 0; a < 3; ++a)
      for (std::size_t n = 0; axis_of[a] == axis && n < receivers; ++n)
        for (const double sample : gather.traces[a * receivers + n].samples) all.push_back(sign[a] * sample);
  return all;
}

struct View {
  std::array<std::size_t, 3> axis_of;
  std::array<int, 3> sign;
};

/// By how much the traces of a scene seen from elsewhere differ from its own.
double difference_of(const Scene<3>& scene, const View& view, const std::vector<double>& own) {
  const auto seen = turned_back(shoot(turned(scene, view.axis_of, view.sign), 1), view.axis_of, view.sign);
  return relative_error(seen, own);
}

// Proves (S12).
TEST(BlockMedium, LooksTheSameInMirrors) {
  const auto scene = block_scene();
  auto intact = scene;
  intact.with_slip = false;
  const auto own = samples_of(shoot(scene, 1));
  EXPECT_GT(relative_error(own, samples_of(shoot(intact, 1))), 0.05);
  for (const std::array<int, 3>& sign : {std::array{-1, 1, 1}, std::array{1, -1, 1}, std::array{1, 1, -1}})
    EXPECT_LT(difference_of(scene, {{0, 1, 2}, sign}, own), 1e-9) << sign[0] << sign[1] << sign[2];
}

// Proves (S12).
TEST(BlockMedium, AtRightAnglesLooksTheSameFromAllSidesInShortSteps) {
  // Another order of the axes is another splitting, with halves of other sweeps: what that changes goes with
  // the step. Planes at other angles change each other's normal stress, and then friction makes much of it.
  auto scene = block_scene();
  auto& systems = scene.model.fracture_sets[0].systems;
  systems[0].normal = {2. / 7, 3. / 7, 6. / 7};
  systems[1].normal = {3. / 7, -6. / 7, 2. / 7};
  systems[2].normal = {6. / 7, 2. / 7, -3. / 7};
  const View views[] = {{{2, 1, 0}, {1, -1, 1}}, {{1, 2, 0}, {1, 1, 1}}};
  double difference[2][3];
  const int steps = long_form() ? 3 : 2;
  for (int n = 0; n < steps; ++n) {
    scene.numerics.cfl = 0.8 / double(1 << n);
    const auto own = samples_of(shoot(scene, 1));
    for (int of = 0; of < 2; ++of) difference[of][n] = difference_of(scene, views[of], own);
  }
  for (const auto& by_step : difference)
    for (int n = 1; n < steps; ++n) EXPECT_GT(observed_order(by_step[n - 1], by_step[n]), 0.9);
}

// Proves (S12).
TEST(BlockMedium, OnlyTakesEnergy) {
  // What its diary says slip has turned into heat is what the cells have lost.
  auto scene = block_scene();
  scene.slip_diary = true;
  const double dt_s = 0.9 * 5 / 4500;
  for (const auto correction : corrections) {
    scene.numerics.correction = correction;
    const auto edges = edges_all_3d(EdgeLaw::rigid);
    Cube<double> cube(scene.model.medium, edges, 5, dt_s);
    const auto domain = make_domain(scene.model.medium, edges, 1);
    Slip<3, double> slip(cube.state(), domain, scene, dt_s);
    cube.shake(4);
    double least = cube.energy(), lost = 0;
    for (std::int64_t step = 0; step < 20; ++step) {
      cube.steps(1);
      const double before = cube.energy();
      run_everywhere(slip, {step, dt_s}, cube.state());
      run_after_everywhere(slip, {step, dt_s}, cube.state());
      const double now = cube.energy();
      lost += before - now;
      EXPECT_LT(now, least * (1 + 1e-11)) << name_of(correction) << ", step " << step;
      least = std::min(least, now);
    }
    EXPECT_GT(lost, 0);
    EXPECT_NEAR(slip.totals().dissipated, lost, 1e-9 * lost) << name_of(correction);
  }
}

}  // namespace
}  // namespace slipwave::solver::cube_slip_test
