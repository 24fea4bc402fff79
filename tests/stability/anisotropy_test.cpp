// SPDX-License-Identifier: BSD-3-Clause
// Energy in anisotropic media, cell by cell as different as they can be.
#include <algorithm>
#include <random>

#include "any_stiffness.hpp"
#include "lab.hpp"

namespace slipwave::anisotropy_test {
namespace {

template <class Real>
void expect_no_growth_of(const Medium<2>& medium, EdgeLaw edges, int order, double cfl, int steps) {
  typename Lab<Real>::Setup setup;
  setup.medium = medium;
  setup.edges = all_edges(edges);
  setup.order = order;
  setup.cfl = cfl;
  Lab<Real>(setup).expect_no_growth(steps, rounding<Real>());
}

}  // namespace

// Proves (V1).
TEST(EnergyOfAnisotropicRock, NeverRises) {
  const ThreadLimit one_thread(1);
  std::mt19937 engine(5);
  std::uniform_real_distribution<double> uniform(0, 1);
  const auto random = [&] { return uniform(engine); };
  const int media = long_form() ? 6 : 4, of_constants = long_form() ? 4 : 2,
            steps = long_form() ? 20000 : 400;
  for (int n = 0; n < media + of_constants; ++n)
    for (const auto& [block, order] : share_of_pairs<int, int>({1, 5}, {3, 5, 7}, std::size_t(n) / 2)) {
      SCOPED_TRACE("medium " + std::to_string(n) + " block " + std::to_string(block) + " order " +
                   std::to_string(order));
      constexpr int cells = 30;
      std::vector<Material> rocks;
      for (int k = 0; k < cells * cells; ++k) {
        auto rock = n < media ? random_anisotropic(random) : any_stiffness<2>(random, 0.05);
        // Some water, and with it interfaces of all kinds.
        if (n % 2 == 1 && random() < 0.2) rock = {1500, 0, 1000};
        rocks.push_back(rock);
      }
      const auto medium = of_rocks(
          cells, [&, size = block](int i, int k) { return rocks[std::size_t(k / size * cells + i / size)]; });
      expect_no_growth_of<double>(medium, n % 2 ? EdgeLaw::free : EdgeLaw::rigid, order, n % 3 ? 1 : 0.6,
                                  steps);
      if (n == 0) expect_no_growth_of<float>(medium, EdgeLaw::free, order, 1, steps);
    }
}

namespace {

/// Planes of these normals in every cell slide under a random field, by all rules; `draw` makes a medium.
void expect_slip_takes_energy(const std::vector<std::vector<Point<2>>>& families,
                              const std::function<Medium<2>()>& draw, int steps) {
  const ThreadLimit one_thread(1);
  std::size_t turn = 0;
  for (const auto& normals : families)
    for (const auto correction :
         share_of(std::vector{SlipCorrection::first, SlipCorrection::second, SlipCorrection::exponential},
                  turn++)) {
      Lab<double>::Setup setup;
      setup.medium = draw();
      FractureSet<2> set{"all", {}};
      for (const auto& normal : normals) set.systems.push_back({normal, 0.3, 1000, 0});
      setup.fracture_sets = {set};
      setup.fracture = Field<2, std::uint8_t>(setup.medium.grid(), 1);
      setup.correction = correction;
      setup.edges = all_edges(EdgeLaw::rigid);
      Lab<double>(setup).expect_no_growth(steps, rounding<double>());
    }
}

/// Random rocks whose beds dip at random.
Medium<2> of_tilted_rocks(int cells, const std::function<double()>& random) {
  auto medium = of_rocks(cells, [&](int, int) { return random_anisotropic(random); });
  auto& tilt = medium[Property::tilt] = Field<2>(medium.grid());
  for (std::size_t cell = 0; cell < tilt.size(); ++cell)
    if (is_anisotropic(medium, cell)) tilt[cell] = float(180 * random() - 90);
  return medium;
}

}  // namespace

// Proves (S34).
TEST(EnergyOfAnisotropicRock, IsTakenBySlipOfLevelAndUprightPlanes) {
  std::mt19937 engine(9);
  std::uniform_real_distribution<double> uniform(0, 1);
  const auto random = [&] { return uniform(engine); };
  expect_slip_takes_energy(
      {{{0, 1}}, {{1, 0}}, {{1, 0}, {0, 1}}},
      [&] { return of_rocks(24, [&](int, int) { return random_anisotropic(random); }); }, 600);
}

// Proves (S34).
TEST(EnergyOfAnisotropicRock, IsTakenBySlipOfPlanesAskewToItsAxes) {
  std::mt19937 engine(11);
  std::uniform_real_distribution<double> uniform(0, 1);
  const auto random = [&] { return uniform(engine); };
  expect_slip_takes_energy(
      {{{0, 1}}, {{0.6, 0.8}}, {{0.6, 0.8}, {1, 0}}}, [&] { return of_tilted_rocks(24, random); },
      long_form() ? 20000 : 300);
  expect_slip_takes_energy(
      {{{0.6, 0.8}}, {{0.6, 0.8}, {1, 0}}},
      [&] { return of_rocks(24, [&](int, int) { return any_stiffness<2>(random, 0.05); }); },
      long_form() ? 20000 : 300);
}

// Proves (V1).
TEST(EnergyOfAnisotropicRock, BetweenFreeEdgesFallsOverThousandsOfSteps) {
  // Corrected free surfaces and interfaces of water (theory.md (E11), (E11a)): the energy falls in the long
  // run.
  const ThreadLimit one_thread(1);
  std::size_t turn = 0;
  for (const auto& rock : {Material{3000, 1600, 2300, 0.2, 0.1}, Material{3200, 1700, 2400, -0.05, 0.2},
                           Material{3000, 1200, 2300, 0.5, -0.2}})
    for (const bool sea : {false, true})
      for (const int order : share_of(std::vector{3, 5, 7}, turn++)) {
        SCOPED_TRACE("order " + std::to_string(order) + (sea ? " below water" : ""));
        Lab<double>::Setup setup;
        setup.medium = of_rocks(32, [&](int, int k) {
          return sea && k < 16 ? Material{1500, 0, 1000} : rock;
        });
        setup.order = order;
        setup.edges = all_edges(EdgeLaw::free);
        Lab<double> lab(setup);
        lab.expect_fall_in_the_long_run(long_form() ? 10000 : 3000);
      }
}

}  // namespace slipwave::anisotropy_test
