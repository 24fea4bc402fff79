// SPDX-License-Identifier: BSD-3-Clause
// Cells whose axes of symmetry do not lie along the grid: tilted means.
#include <gtest/gtest.h>

#include <numbers>

#include "accuracy/full_space.hpp"
#include "anisotropic_stack.hpp"
#include "base/parse.hpp"
#include "elastic_disc.hpp"
#include "lab.hpp"
#include "model/layers.hpp"
#include "model/tilted_mean.hpp"
#include "plain_and_tiled.hpp"
#include "shared_out.hpp"
#include "solver/simulation.hpp"
#include "unit/model_cases.hpp"

namespace slipwave::solver {
namespace {

/// Water over rocks whose interfaces dip both ways, and meet.
Scene<2> wedges() {
  Scene<2> scene;
  const Grid<2> grid{{110, 90}, 5, {0, 0}};
  scene.model.medium = layered_medium(grid,
                                      {{-1e4, 1500, 0, 1000},
                                       {100, 2000, 1150, 2000},
                                       {150, 4000, 2300, 2300, 18},
                                       {430, 2500, 1200, 2100, -25}},
                                      Average::tilted);
  scene.survey.sources = {{{231, 183}, parse_mechanism<2>("force:0.6,0.8"), parse_wavelet("ricker:30"), 1e6}};
  scene.survey.receivers_m = {{150, 140}, {420, 330}, {500, 60}, {333, 420}};
  scene.edges = edges_all(EdgeLaw::absorbing);
  scene.edges[1][0] = EdgeLaw::free;
  scene.recording = {{Component::vx, Component::szz}, 0.12, 0.002};
  return scene;
}

}  // namespace

// Proves (T3), (T5).
TEST(TiltedMeans, OfAWholeRockAreARotatedOne) {
  constexpr Material shale{3000, 1600, 2300, 0.2, 0.1};
  constexpr double dip_deg = 27, dip = dip_deg * std::numbers::pi / 180, h = 5, middle = 350;
  const Point<2> along{std::cos(dip), std::sin(dip)}, down{-along[1], along[0]};
  const auto turned = [&](double a, double b) {
    return Point<2>{a * along[0] + b * down[0], a * along[1] + b * down[1]};
  };
  Scene<2> scene;
  const Grid<2> grid{{140, 140}, h, {0, 0}};
  scene.model.medium = Medium<2>(grid);
  add_tilted_means(scene.model.medium);
  for (std::size_t cell = 0; cell < std::size_t(grid.size()); ++cell) {
    put(scene.model.medium, cell, {shale.vp, shale.vs, shale.rho});
    put_tilted_mean(scene.model.medium, cell, shale, dip);
  }
  const std::vector<AnisotropicStack::Receiver> receivers = {
      {0, 100}, {60, 80}, {90, 40}, {-90, 50}, {70, -80}};
  const auto force = turned(0.6, 0.8);
  scene.survey.sources = {{{middle, middle}, PointForce<2>{force}, parse_wavelet("ricker:20"), 1e6}};
  for (const auto& at : receivers) {
    const auto place = turned(at.x, at.z);
    scene.survey.receivers_m.push_back({middle + place[0], middle + place[1]});
  }
  scene.edges = edges_all(EdgeLaw::absorbing);
  // Before anything comes back from zones, which are isotropic.
  scene.recording = {{Component::vx, Component::vz}, 0.2, 0.001};
  check(scene);
  const auto gather = shoot(scene, 1);
  AnisotropicStack stack{{{elasticity_of<2>(shale), shale.rho}}, {}};
  stack.force = {0.6, 0.8};
  const auto exact = stack.ricker(20, 0.001, std::size_t(gather.axis.count), receivers);
  std::vector<double> found, wanted;
  for (std::size_t r = 0; r < receivers.size(); ++r)
    for (std::size_t n = 0; n < std::size_t(gather.axis.count); ++n) {
      const double vx = gather.traces[r].samples[n], vz = gather.traces[receivers.size() + r].samples[n];
      found.push_back(vx * along[0] + vz * along[1]);
      found.push_back(vx * down[0] + vz * down[1]);
      wanted.push_back(1e6 * exact[r][0][n]);
      wanted.push_back(1e6 * exact[r][1][n]);
    }
  EXPECT_LT(relative_error(found, wanted), 0.02);
}

// Proves (T4).
TEST(TiltedMeans, OfAClosedBodyScatterAsInTheClosedForm) {
  constexpr Rock around{2000, 1150, 2000}, inside{4000, 2300, 2300};
  constexpr double radius = 100, peak_hz = 15, interval_s = 0.002, size = 1000;
  const Point<2> centre{503.3, 497.1}, source{-40, -260};
  const std::vector<Point<2>> receivers = {{-300, -150}, {100, -250}, {300, 30},
                                           {120, 240},   {-150, 260}, {-40, 30}};
  // Its upper and its lower half as tops of layers.
  const auto half = [&](double sign) {
    std::string lines = "0 " + shown(centre[1]) + "\n";
    for (int n = 0; n <= 360; ++n) {
      const double angle = n * std::numbers::pi / 360;
      lines += shown(centre[0] - radius * std::cos(angle), 9) + ' ' +
               shown(centre[1] + sign * radius * std::sin(angle), 9) + '\n';
    }
    return lines + shown(size) + ' ' + shown(centre[1]) + '\n';
  };
  const TextFile upper(half(-1)), lower(half(1));
  Scene<2> scene;
  const double cells = std::round(size * 24 * peak_hz / around.vs);
  const auto medium = [&](Average average) {
    return layered_medium(
        grid_of_size<2>({size, size}, size / cells),
        {parse_layer("0:2000:1150:2000"), parse_layer("@" + upper.path() + ":4000:2300:2300"),
         parse_layer("@" + lower.path() + ":2000:1150:2000")},
        average);
  };
  scene.model.medium = medium(Average::tilted);
  const auto place = [&](const Point<2>& at) { return Point<2>{centre[0] + at[0], centre[1] + at[1]}; };
  scene.survey.sources = {{place(source), parse_mechanism<2>("explosion"), parse_wavelet("ricker:15"), 1e6}};
  for (const auto& receiver : receivers) scene.survey.receivers_m.push_back(place(receiver));
  scene.edges = edges_all(EdgeLaw::absorbing);
  scene.recording = {{Component::vx, Component::vz}, 0.6, interval_s};
  check(scene);
  const auto gather = shoot(scene, 1);
  const auto count = std::size_t(gather.axis.count);
  std::vector<Point<2>> polar;
  for (const auto& at : receivers)
    polar.push_back({std::hypot(at[0], at[1]), std::atan2(at[1], at[0]) - std::atan2(source[1], source[0])});
  const auto added = ElasticDisc{around, inside, radius, std::hypot(source[0], source[1])}.ricker(
      peak_hz, interval_s, count, polar);
  std::vector<double> found, exact;
  for (std::size_t r = 0; r < receivers.size(); ++r) {
    const auto& at = receivers[r];
    const double c = at[0] / polar[r][0], s = at[1] / polar[r][0];
    const auto direct = ricker_response(peak_hz, interval_s, std::int64_t(count), [&](double omega) {
      return explosion_motion(around, omega, at[0] - source[0], at[1] - source[1]);
    });
    for (std::size_t row = 0; row < 2; ++row)
      for (std::size_t n = 0; n < count; ++n) {
        found.push_back(gather.traces[row * receivers.size() + r].samples[n] / 1e6);
        const double along = added[r][0][n], across = added[r][1][n];
        exact.push_back((row == 0 ? c * along - s * across : s * along + c * across) +
                        (polar[r][0] > radius ? direct[row][n] : 0));
      }
  }
  // 0.012 with isotropic means.
  EXPECT_LT(relative_error(found, exact), 0.006);
}

TEST(TiltedMeans, AreIsotropicWhereRockSlipsOrAttenuates) {
  auto scene = wedges();
  scene.model.fracture_sets = {{"all", {{{0, 1}, 0.3, 1000, 0}}}};
  scene.model.fracture = Field<2, std::uint8_t>(scene.model.grid(), 0);
  for (std::size_t cell = 0; cell < scene.model.fracture.size(); ++cell)
    scene.model.fracture[cell] = scene.model.medium.is_solid(cell) ? 1 : 0;
  auto isotropic = scene;
  drop_tilted_means(isotropic.model.medium);
  EXPECT_TRUE(all_samples(shoot(scene, 1)) == all_samples(shoot(isotropic, 1)));
  scene.with_slip = isotropic.with_slip = false;
  EXPECT_FALSE(all_samples(shoot(scene, 1)) == all_samples(shoot(isotropic, 1)));
}

}  // namespace slipwave::solver
