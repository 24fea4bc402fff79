// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <numbers>

#include "accuracy/full_space.hpp"
#include "lab.hpp"
#include "long_form.hpp"
#include "samples.hpp"
#include "solver/simulation.hpp"
#include "stack_scene.hpp"

namespace slipwave::solver::solver_absorbing_test {
namespace {

constexpr Rock rock{4500, 2250, 2500};
constexpr double h = 5, depth_m = 300;
const std::vector<double> angles_deg = {0, 20, 40, 60};

/// A line source 300 m below an absorbing edge at z = top_m = 0, receivers at its depth where rays come back
/// from z = 0 under each angle, and at the mirror images of those beyond z = 0 if the model holds them.
Gather shoot_at_an_edge(const char* mechanism, double top_m, int cells, double duration_s) {
  const Grid<2> grid{{340, std::int64_t((700 - top_m) / h)}, h, {-300, top_m}};
  Scene<2> scene;
  scene.model.medium = {Field<2>(grid, float(rock.vp)), Field<2>(grid, float(rock.vs)),
                        Field<2>(grid, float(rock.rho))};
  scene.model.fracture = Field<2, std::uint8_t>(grid);
  scene.survey.sources = {{{0, depth_m}, parse_mechanism<2>(mechanism), parse_wavelet("ricker:30"), 1e6}};
  for (const double z : {depth_m, -depth_m})
    for (const double angle : angles_deg)
      if (z > top_m)
        scene.survey.receivers_m.push_back({2 * depth_m * std::tan(angle * std::numbers::pi / 180), z});
  scene.edges = edges_all(EdgeLaw::absorbing);
  scene.numerics.zone_cells = cells;
  scene.recording = {{Component::vx, Component::vz}, duration_s, 0.001};
  check(scene);
  return shoot(scene, 1);
}

/// Peaks of the reflection of an edge, relative to that of a perfect mirror: the difference to a model in
/// which that edge is 1200 m further away, over the wave at the receiver's image.
std::vector<double> reflections(const char* mechanism, int cells, double duration_s) {
  const Gather near = shoot_at_an_edge(mechanism, 0, cells, duration_s);
  const Gather far = shoot_at_an_edge(mechanism, -1200, cells, duration_s);
  const std::size_t count = angles_deg.size();
  std::vector<double> shares;
  for (std::size_t n = 0; n < count; ++n) {
    double back = 0, mirrored = 0;
    for (std::size_t t = 0; t < near.traces[0].samples.size(); ++t) {
      const auto difference = [&](std::size_t component) {
        return near.traces[component * count + n].samples[t] -
               far.traces[component * 2 * count + n].samples[t];
      };
      back = std::max(back, std::hypot(difference(0), difference(1)));
      mirrored = std::max(mirrored,
                          std::hypot(far.traces[count + n].samples[t], far.traces[3 * count + n].samples[t]));
    }
    shares.push_back(back / mirrored);
  }
  return shares;
}

void expect_below(const std::vector<double>& found, const std::vector<double>& bounds, const char* wave) {
  for (std::size_t n = 0; n < found.size(); ++n)
    EXPECT_LT(found[n], bounds[n]) << wave << " under " << angles_deg[n] << " degrees";
}

// The reflection is what crosses the PML twice, what the little damping outside plates reflects at an angle
// and what the grid does.
// Proves (E14).
TEST(AbsorbingEdge, SendsBackLessThanSixtyDecibelsStraightAndFortyFiveUpToSixtyDegrees) {
  const std::vector<double> bounds = {1e-3, 1e-3, 2e-3, 5.6e-3};
  expect_below(reflections("explosion", 20, 0.42), bounds, "P");
  expect_below(reflections("force:1,0", 20, 0.72), bounds, "S");
}

// Proves (E14).
TEST(AbsorbingEdge, SendsBackLessThanTwoThousandthsFromTwiceTheWidth) {
  const std::vector<double> bounds(4, 0.002);
  if (long_form()) expect_below(reflections("explosion", 40, 0.42), bounds, "P");
  expect_below(reflections("force:1,0", 40, 0.72), bounds, "S");
}

/// Traces of an explosion in the middle of a model between two absorbing edges across an axis, each `half_m`
/// away, at 5 and 10 times 300 m.
Gather graze_edges(int across, double half_m, int cells, double courant) {
  const auto placed = [&](auto along, auto of_axis) {
    return across ? std::array{along, of_axis} : std::array{of_axis, along};
  };
  const Grid<2> grid{placed(std::int64_t(640), std::int64_t(2 * half_m / h)), h, placed(-100., -half_m)};
  Scene<2> scene;
  scene.model.medium = {Field<2>(grid, float(rock.vp)), Field<2>(grid, float(rock.vs)),
                        Field<2>(grid, float(rock.rho))};
  scene.model.fracture = Field<2, std::uint8_t>(grid);
  scene.survey.sources = {{{0, 0}, parse_mechanism<2>("explosion"), parse_wavelet("ricker:30"), 1e6}};
  scene.survey.receivers_m = {placed(1500., 0.), placed(3000., 0.)};
  scene.edges = edges_all(EdgeLaw::absorbing);
  scene.numerics.zone_cells = cells;
  scene.numerics.cfl = courant;
  scene.recording = {{across ? Component::vx : Component::vz}, 0.78, 0.001};
  check(scene);
  return shoot(scene, 1);
}

/// Errors of both traces against edges from which nothing comes back in time.
std::array<double, 2> grazing_errors(int across, int cells, double courant) {
  const Gather near = graze_edges(across, depth_m, cells, courant);
  const Gather far = graze_edges(across, 900, 20, courant);
  return {relative_error(near.traces[0].samples, far.traces[0].samples),
          relative_error(near.traces[1].samples, far.traces[1].samples)};
}

// At a Courant number at which the damping does not match the steps.
// Proves (E14a). Proves (E14b).
TEST(AbsorbingEdge, TakesUpWavesThatGrazeItWithAnErrorOfSecondOrderInItsCells) {
  const auto of_20 = grazing_errors(1, 20, 1), of_40 = grazing_errors(1, 40, 1);
  EXPECT_LT(of_20[0], 0.005);
  EXPECT_LT(of_20[1], 0.015);
  for (const std::size_t n : {0, 1}) EXPECT_LT(of_40[n], of_20[n] / 2.5) << n;
}

// Where it does, ten times the distance to the edge sends back less than half of what may leak at fifteen.
// Proves (E14d). Proves (E14b).
TEST(AbsorbingEdge, TakesUpWavesThatGrazeItWithoutAnErrorOfTheTimeStep) {
  for (const int across : {0, 1}) {
    const auto found = grazing_errors(across, 20, 0.9);
    EXPECT_LT(found[0], 0.0005) << across;
    EXPECT_LT(found[1], 0.005) << across;
  }
}

/// Traces of a force on 15 m of soft ground over rock, up to 5 m from edges that are 20 m wide; with all
/// edges `further_m` away.
std::vector<double> on_soft_ground(std::int64_t further_m) {
  const Grid<2> grid{{100 + 2 * further_m, 40 + further_m}, 1, {-double(further_m), 0}};
  Scene<2> scene;
  auto& medium = scene.model.medium;
  medium = {Field<2>(grid, 1500), Field<2>(grid, 700), Field<2>(grid, 2000)};
  for (std::size_t cell = 0; cell < std::size_t(15 * grid.shape[0]); ++cell)
    medium.vp[cell] = 600, medium.vs[cell] = 250, medium.rho[cell] = 1800;
  scene.model.fracture = Field<2, std::uint8_t>(grid);
  scene.survey.sources = {{{40, 0}, parse_mechanism<2>("force:0,1"), parse_wavelet("ricker:8"), 1e6}};
  for (double x = 5; x < 100; x += 10) scene.survey.receivers_m.push_back({x, 0});
  scene.edges = edges_all(EdgeLaw::absorbing);
  scene.edges[1][0] = EdgeLaw::free;
  scene.numerics.zone_cells = 20;
  scene.recording = {{Component::vx, Component::vz}, 0.7, 0.002};
  check(scene);
  return samples_of(shoot(scene, 1));
}

// The ground is a plate, in which fields are damped that would grow. Damping that set in with the layer sent
// back 4 %.
// Proves (E14c).
TEST(AbsorbingEdge, TakesUpGroundRollOfSoftGroundOverRock) {
  EXPECT_LT(relative_error(on_soft_ground(0), on_soft_ground(150)), 0.003);
}

// Rows slope there, where the layer lets waves grow that move against their phase along rows.
// Proves (F10a).
TEST(AbsorbingEdge, LetsAFloorRunIntoItAslant) {
  StackScene stack{"floor", {{1500, 0, 1000}, {3000, 1700, 2200}}, {0}};
  stack.dip_deg = 30, stack.source_b = -100, stack.spacing_m = 3, stack.order = 7;
  for (const double b : {-40., 40.})
    for (double a = 100; a <= 500; a += 100) stack.receivers.push_back({a, b});
  stack.margin_m = 200, stack.deeper_m = 300;
  const auto with_edges = [&](int cells) {
    stack.zone_cells = cells;
    return samples_of(shoot(stack.scene(), 1));
  };
  EXPECT_LT(relative_error(with_edges(20), with_edges(40)), 0.0015);
}

// Without any damping for slopes this grew beyond all bounds after 16 850 steps.
// Proves (F10a).
TEST(AbsorbingEdge, OfASteepFloorLetsNothingGrowInTheLongRun) {
  StackScene stack{"steep floor", {{1500, 0, 1000}, {2200, 1200, 2000}}, {0}};
  stack.dip_deg = 38, stack.source_b = -40, stack.spacing_m = 2, stack.order = 7, stack.zone_cells = 40;
  for (const double b : {-20., 20.})
    for (double a = 50; a <= 250; a += 50) stack.receivers.push_back({a, b});
  stack.margin_m = 100, stack.deeper_m = 380, stack.duration_s = 5;
  double peak = 0, late = 0;
  for (const auto& trace : shoot(stack.scene(), 1).traces)
    for (std::size_t n = 0; n < trace.samples.size(); ++n) {
      const double value = std::abs(trace.samples[n]);
      peak = std::max(peak, value);
      if (4 * n >= 3 * trace.samples.size()) late = std::max(late, value);
    }
  EXPECT_LT(late, 1e-6 * peak);
}

}  // namespace
}  // namespace slipwave::solver::solver_absorbing_test
