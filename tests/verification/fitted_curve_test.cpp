// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "fitted_scenes.hpp"
#include "solver/simulation.hpp"

// A sea floor that is a sine of 20 m x 300 m.
namespace slipwave::solver::fitted_curve_test {
namespace {

constexpr Rock rock{3000, 1600, 2200};
constexpr double peak_hz = 15;

struct Shot {
  Point<2> source;
  const char* mechanism;
  std::vector<Point<2>> receivers;
};

Scene<2> curved_floor(double cells, const Shot& shot, bool sea = true) {
  const double wide_m = 1200, deep_m = 650;
  const auto nx = std::int64_t(std::ceil(wide_m * peak_hz * cells / (sea ? 1500 : rock.vs)));
  const double h = wide_m / double(nx);
  const auto floor = [](double x, double) {
    return 301.3 + 20 * std::sin(2 * std::numbers::pi * x / 300 + 0.4);
  };
  const Grid<2> grid{{nx, std::int64_t(deep_m / h)}, h, {0, 0}};
  Scene<2> scene;
  scene.model.medium = sea ? fitted_medium<2>(grid, {water_above, below(floor, rock)})
                           : fitted_medium<2>(grid, {below(floor, rock)}, true);
  scene.survey.sources = {{shot.source, parse_mechanism<2>(shot.mechanism), parse_wavelet("ricker:15"), 1e6}};
  scene.survey.receivers_m = shot.receivers;
  scene.edges = edges_all(EdgeLaw::absorbing);
  if (!sea) scene.edges[1][0] = EdgeLaw::free;
  scene.recording = {{Component::vx, Component::vz}, 0.5, 0.001};
  check(scene);
  return scene;
}

// Proves (E11a), (F4), (F5), (F7), (F6).
TEST(CurvedFloor, HasErrorsBelowOnePercent) {
  for (const bool sea : {true, false}) {
    SCOPED_TRACE(sea ? "sea floor" : "hills");
    Shot shot{{500, 140}, "explosion", {{350, 160}, {620, 160}, {400, 450}, {600, 500}, {750, 420}}};
    if (!sea) shot = {{500, 450}, "explosion", {{350, 400}, {620, 380}, {400, 450}, {700, 500}}};
    const auto of = [&](double cells) { return samples_of(shoot(curved_floor(cells, shot, sea), 1)); };
    const auto fine = of(48);
    const double at_16 = relative_error(of(16), fine), at_24 = relative_error(of(24), fine);
    if (std::getenv("SLIPWAVE_SHOW"))
      std::printf("curved %s: %.2f %.2f %%\n", sea ? "floor" : "hills", 100 * at_16, 100 * at_24);
    EXPECT_LT(at_24, 0.01);
    // The surface becomes level in the PML: what comes back from there stays.
    EXPECT_GT(std::log(at_16 / at_24) / std::log(1.5), sea ? 2 : 1);
  }
}

// Proves (F5).
TEST(CurvedFloor, ObeysReciprocityOfForces) {
  // What a force along one axis moves a place along another is what the other way round it does.
  // The last place is in the water.
  const Point<2> places[] = {{380, 420}, {690, 380}, {450, 180}};
  const char* const forces[] = {"force:1,0", "force:0,1"};
  std::array<std::array<Gather, 2>, 3> shots;
  for (std::size_t n = 0; n < 3; ++n)
    for (std::size_t along = 0; along < 2; ++along)
      shots[n][along] =
          shoot(curved_floor(24, {places[n], forces[along], {std::begin(places), std::end(places)}}), 1);
  const auto trace = [&](std::size_t from, std::size_t along, std::size_t to, std::size_t component) {
    return shots[from][along].traces[3 * component + to].samples;
  };
  for (const auto& [a, b] : {std::pair<std::size_t, std::size_t>{0, 1}, {0, 2}, {1, 2}})
    for (std::size_t i = 0; i < 2; ++i)
      for (std::size_t k = 0; k < 2; ++k) {
        const double difference = relative_error(trace(a, i, b, k), trace(b, k, a, i));
        if (std::getenv("SLIPWAVE_SHOW"))
          std::printf("reciprocity %zu %zu %zu%zu: %.3f %%\n", a, b, i, k, 100 * difference);
        EXPECT_LT(difference, b == 2 ? 0.015 : 0.01) << a << ' ' << b << ' ' << i << k;
      }
}

}  // namespace
}  // namespace slipwave::solver::fitted_curve_test
