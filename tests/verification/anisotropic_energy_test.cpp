// SPDX-License-Identifier: BSD-3-Clause
// Energy of anisotropic rock in 3-D never rises, whatever its stiffness and whatever planes slip or give way
// in it.
#include <gtest/gtest.h>

#include "anisotropic_rocks.hpp"
#include "any_stiffness.hpp"
#include "parallel/threads.hpp"
#include "solver/effect/linear_slip.hpp"
#include "solver/effect/slip.hpp"
#include "whole_effect.hpp"

namespace slipwave::solver::anisotropic_energy_test {
namespace {

/// A scene of any rocks and water, which lie in cubes of so many cells, around a cluster of planes.
Scene<3> any_rocks(const std::function<Material()>& draw, int block, const FractureSet<3>& set,
                   const Index<3>& shape) {
  auto scene = cluster(turned_by(cracked, 20, 30, 40), set, shape);
  std::vector<Material> rocks;
  for (int n = 0; n < 4096; ++n) rocks.push_back(draw());
  scene.model.medium = medium_of(scene.model.grid(), rocks, [&](const Index<3>& at) {
    return rocks[std::size_t((at[2] / block * 16 + at[1] / block) * 16 + at[0] / block)];
  });
  return scene;
}

/// Energies after parts of so many steps, shaken at first, each below `factor` of the least before; how much
/// of the first is left.
double part_left(const Medium<3>& medium, EdgeLaw law, int order, int parts, int steps, double factor) {
  Cube<double> cube(medium, edges_all_3d(law), order, 0.99 * 5 / fastest_speed(medium));
  cube.shake(8);
  const double first = cube.energy();
  double least = first;
  for (int n = 0; n < parts; ++n) {
    cube.steps(steps);
    const double now = cube.energy();
    EXPECT_LT(now, least * factor) << "order " << order << ", part " << n;
    least = std::min(least, now);
  }
  EXPECT_GT(least, 0);
  return least / first;
}
constexpr double rounding = 1 + 1e-11, at_free_edges = 1 + 2e-3;

// Proves (O1), (O8).
TEST(EnergyOfAnisotropicSpace, NeverRises) {
  const ThreadLimit one_thread(1);
  // From cell to cell, as different as they can be, and from block to block; about axes of the grid, or any,
  // or of any elastic constants.
  for (const std::string kind : {"upright", "turned", "by constants"}) {
    const bool turned = kind != "upright";
    Draw draw(turned ? 11 : 7);
    const auto any = [&]() -> Material {
      if (draw(0, 1) < 0.15) return sea;
      if (kind == "by constants") return any_stiffness<3>([&] { return draw(0, 1); }, 0.05);
      return turned ? draw.rock(0.2, {0.4, 0.6}, true) : draw.rock(0.3, {0.2, 0.7}, false);
    };
    for (const int block : {1, 4})
      for (const int order : long_form() ? block == 1 ? std::vector{5, 11} : std::vector{3, 7}
                                         : std::vector{block == 1 ? 7
                                                       : turned   ? 5
                                                                  : 3})
        for (const auto law : {EdgeLaw::rigid, EdgeLaw::mirror, EdgeLaw::free}) {
          if (!turned && law == EdgeLaw::free) continue;
          if (!long_form() && turned && law == EdgeLaw::mirror && block == 4) continue;
          if (!long_form() && kind == "by constants" && law == EdgeLaw::mirror) continue;
          const auto scene =
              any_rocks(any, block, {}, long_form() ? Index<3>{16, 14, 15} : Index<3>{13, 11, 12});
          SCOPED_TRACE("block " + std::to_string(block) + ", " + kind);
          const bool whole = long_form() && turned;
          part_left(scene.model.medium, law, order, whole ? 20 : 45, whole ? 200 : 1,
                    law == EdgeLaw::free ? at_free_edges : rounding);
        }
  }
}

// Proves (O1).
TEST(EnergyOfAnisotropicSpace, BetweenFreeEdgesFallsInTheLongRun) {
  const ThreadLimit one_thread(1);
  for (const auto& rock : {cracked, crossed})
    for (const bool below_sea : {false, true}) {
      const auto medium = medium_of(Grid<3>{{16, 14, 18}, 5, {}}, {rock},
                                    [&](const Index<3>& at) { return below_sea && at[2] < 9 ? sea : rock; });
      EXPECT_LT(part_left(medium, EdgeLaw::free, 5, 20, 20, at_free_edges), 0.5);
    }
}

/// Planes by dip and azimuth, one family or two or three.
std::vector<std::array<double, 2>> any_dips(Draw& draw, int families) {
  std::vector<std::array<double, 2>> dips;
  for (int k = 0; k < families; ++k) dips.push_back({draw(0, 90), draw(-180, 180)});
  return dips;
}

/// Steps of a shaken cube with an effect: before(step) and after(step) see its energy on both sides of that.
template <class Effect>
void step_with(Effect& effect, Cube<double>& cube, std::int64_t steps, double dt_s,
               const std::function<void(std::int64_t, double before)>& after) {
  for (std::int64_t step = 0; step < steps; ++step) {
    cube.steps(1);
    const double before = cube.energy();
    run_everywhere(effect, {step, dt_s}, cube.state());
    run_after_everywhere(effect, {step, dt_s}, cube.state());
    after(step, before);
  }
}

// Proves (S34a).
TEST(EnergyOfAnisotropicSpace, IsTakenBySlip) {
  const ThreadLimit one_thread(1);
  using enum SlipCorrection;
  // Any stiffness about any axes from cell to cell, and any planes; what the diary says slip has turned into
  // heat is what the cells have lost.
  Draw draw(5);
  for (int n = 0; n < (long_form() ? 6 : 3); ++n) {
    auto set = families(any_dips(draw, 1 + n % 3), n % 2 ? 0.3 : 0, n % 4 < 2 ? 500 : 0);
    for (auto& system : set.systems) system.strength_pa = n % 2 ? 0 : 3e5;
    const auto rock = [&] {
      return n == 1 ? any_stiffness<3>([&] { return draw(0, 1); }, 0.05) : draw.rock(0.25, {0.3, 0.65}, true);
    };
    auto scene = any_rocks(rock, 1, set, long_form() ? Index<3>{12, 10, 11} : Index<3>{8, 7, 7});
    for (auto& cell : scene.model.fracture) cell = draw(0, 1) < 0.8;
    scene.slip_diary = true;
    const auto edges = edges_all_3d(n % 2 ? EdgeLaw::mirror : EdgeLaw::rigid);
    const double dt_s = 0.99 * stable_time_step_s(scene);
    for (const auto correction : {centred, second, exponential, first}) {
      scene.numerics.correction = correction;
      const int order = n % 3 == 0 ? 5 : n % 3 == 1 ? 7 : 3;
      Cube<double> cube(scene.model.medium, edges, order, dt_s);
      const auto domain = make_domain(scene.model.medium, edges, 1, {}, order);
      Slip<3, double> slip(cube.state(), domain, scene, dt_s);
      cube.shake(unsigned(n) + 4);
      const double all = cube.energy();
      double least = all, lost = 0;
      step_with(slip, cube, long_form() ? 1000 : 30, dt_s, [&](std::int64_t step, double before) {
        const double now = cube.energy();
        lost += before - now;
        // By the centred rule waves may waver by what slip took from them a step ago (S27).
        EXPECT_LT(now, (correction == centred ? all : least) * rounding)
            << n << name_of(correction) << ", step " << step;
        least = std::min(least, now);
      });
      EXPECT_GT(lost, 0);
      EXPECT_NEAR(slip.totals().dissipated, lost, 1e-8 * all) << n << name_of(correction);
    }
  }
}

// Proves (S34b).
TEST(EnergyOfAnisotropicSpace, IsNotAddedToBySpringsHoweverStiffOrSoft) {
  const ThreadLimit one_thread(1);
  // Any stiffness about any axes from cell to cell or from block to block, any planes.
  Draw draw(8);
  int number = 0;
  for (const double softness : {1e-3, 1., 30., 1e4, 1e9})
    for (const int block : {1, 5}) {
      const auto set = springs(any_dips(draw, 1 + number % 3), number % 4 == 3 ? 0 : softness, softness);
      const auto rock = [&] {
        return number % 3 == 1 ? any_stiffness<3>([&] { return draw(0, 1); }, 0.05)
                               : draw.rock(0.25, {0.3, 0.65}, true);
      };
      auto scene = any_rocks(rock, block, set, long_form() ? Index<3>{12, 10, 11} : Index<3>{10, 8, 9});
      for (auto& cell : scene.model.fracture) cell = number % 2 == 0 || draw(0, 1) < 0.7;
      const auto edges = edges_all_3d(number % 3 ? EdgeLaw::rigid : EdgeLaw::mirror);
      const int all[] = {5, 7, 3, 11, 9};
      const int order = all[number % 5];
      const double dt_s = 0.99 * stable_time_step_s(scene);
      Cube<double> cube(scene.model.medium, edges, order, dt_s);
      const auto domain = make_domain(scene.model.medium, edges, 1, {}, order);
      LinearSlip<3, double> effect(cube.state(), domain, scene, dt_s);
      cube.shake(unsigned(number) + 4);
      const double first = cube.energy();
      step_with(effect, cube, long_form() ? 1500 : 40, dt_s, [&](std::int64_t step, double) {
        if (step > 40 && step % 20) return;
        EXPECT_LT(cube.energy() + effect.stored_energy(), first * rounding)
            << "run " << number << ", softness " << softness << ", order " << order << ", step " << step;
      });
      ++number;
    }
}

}  // namespace
}  // namespace slipwave::solver::anisotropic_energy_test
