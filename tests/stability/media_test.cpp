// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <tuple>

#include "lab.hpp"

namespace slipwave::media_test {
namespace {

template <class Real>
Lab<Real> lab_of(const std::string& name, int cells, int order, EdgeLaw edges) {
  typename Lab<Real>::Setup setup;
  setup.medium = medium_named(name, cells);
  setup.edges = all_edges(edges);
  setup.order = order;
  return Lab<Real>(setup);
}

template <class Real>
void expect_no_growth_in(const std::string& name, int order) {
  auto lab = lab_of<Real>(name, 30, order, EdgeLaw::free);
  lab.expect_no_growth(900, rounding<Real>());
  if (long_form())
    lab.expect_fall_in_the_long_run(sizeof(Real) == 4 ? 5000 : 20000, rounding<Real>(), gain_of_interfaces);
}

class EnergyIn : public ::testing::TestWithParam<std::tuple<std::string, int>> {
 protected:
  const ThreadLimit one_thread_{1};
};

}  // namespace

// Proves (E10), (E11a).
TEST_P(EnergyIn, NeverRisesInDouble) {
  const auto& [medium, order] = GetParam();
  expect_no_growth_in<double>(medium, order);
}

TEST_P(EnergyIn, NeverRisesInFloat) {
  const auto& [medium, order] = GetParam();
  expect_no_growth_in<float>(medium, order);
}

INSTANTIATE_TEST_SUITE_P(HardMedia, EnergyIn,
                         ::testing::ValuesIn(share_of_pairs(
                             medium_names(), std::vector<int>(std::begin(orders), std::end(orders)))),
                         [](const auto& info) {
                           return std::get<0>(info.param) + "AtOrder" +
                                  std::to_string(std::get<1>(info.param));
                         });

// Proves (E11a).
TEST(Energy, NeverRisesBetweenRigidWallsOrMirrors) {
  const ThreadLimit one_thread(1);
  std::size_t turn = 0;
  for (const std::string medium : {"WaterOverCurvedRock", "RandomAirAndSteel", "RandomMixture"})
    for (const auto& [order, edges] : share_of_pairs<int, EdgeLaw>(
             {std::begin(orders), std::end(orders)}, {EdgeLaw::rigid, EdgeLaw::mirror}, turn++)) {
      SCOPED_TRACE(medium + " order " + std::to_string(order) +
                   (edges == EdgeLaw::rigid ? " rigid" : " mirror"));
      lab_of<double>(medium, 24, order, edges).expect_no_growth(600, rounding<double>());
    }
}

TEST(Energy, NeverRisesInTenThousandSteps) {
  const ThreadLimit one_thread(1);
  for (const auto& [order, medium] :
       share_of_pairs<int, std::string>({5, 7, 11}, {"WaterOverCurvedRock", "RandomSolids"})) {
    SCOPED_TRACE(medium + " order " + std::to_string(order));
    lab_of<float>(medium, 20, order, EdgeLaw::free).expect_no_growth(10000, rounding<float>());
  }
}

// Proves (E11c).
TEST(Energy, OfSolidBetweenFreeEdgesFallsOverTenThousandSteps) {
  // Where free surfaces are corrected (theory.md (E11)) the energy is not one that falls in every step: it
  // may rise by a thousandth of what is left. What would grow shows over many steps, most of all at order 7.
  const ThreadLimit one_thread(1);
  for (const int order : {3, 5, 7, 9, 11})
    for (const bool below_air : {false, true})
      for (const double cfl : {0.9, 1.}) {
        if (!long_form() && (order / 2 + below_air + (cfl == 1)) % 2 != 0) continue;
        SCOPED_TRACE("order " + std::to_string(order) + " cfl " + std::to_string(cfl));
        Lab<double>::Setup setup;
        setup.medium = below_air ? medium_named("AirOverSteel", 20) : rock(16, 20);
        setup.order = order;
        setup.cfl = cfl;
        setup.edges = all_edges(EdgeLaw::free);
        Lab<double> lab(setup);
        lab.expect_fall_in_the_long_run(10000);
      }
}

/// Water in rock of 40 x 40 cells: beside an upright wall, and in a cave of 20 x 20.
Medium<2> water_in_rock(bool cave, const Material& rock_round_it) {
  return of_rocks(40, [&](int i, int k) {
    const bool wet = cave ? std::min({i, k, 39 - i, 39 - k}) >= 10 : i < 20;
    return wet ? Material{1500, 0, 1000} : rock_round_it;
  });
}

// Proves (E11a).
TEST(Energy, OfWaterBesideUprightWallsAndInCavesFallsInTheLongRun) {
  const ThreadLimit one_thread(1);
  std::size_t turn = 0;
  for (const bool cave : {false, true})
    for (const Material& round_it : {Material{4500, 2250, 2500}, Material{1900, 500, 1900}}) {
      if (!long_form() && cave != (round_it.vs < 1000)) continue;
      for (const auto& [order, cfl] : share_of_pairs<int, double>({5, 7, 11}, {0.3, 0.9, 1.}, turn++)) {
        SCOPED_TRACE("order " + std::to_string(order) + " cfl " + std::to_string(cfl) +
                     (cave ? " cave" : " wall") + " vp " + std::to_string(round_it.vp));
        Lab<double>::Setup setup;
        setup.medium = water_in_rock(cave, round_it);
        setup.order = order;
        setup.cfl = cfl;
        Lab<double>(setup).expect_fall_in_the_long_run(long_form() ? 20000 : 2000, rounding<double>(),
                                                       gain_of_interfaces);
      }
    }
}

// Proves (E11a).
TEST(Energy, OfHighOrdersAtInterfacesAndContrastsFallsInTheLongRun) {
  // With order 7 there, two of these gain after the first thousands of steps: by e^0.2 and e^0.04 in a
  // thousand. A slow gain hides behind what drains at first.
  const ThreadLimit one_thread(1);
  const auto media =
      long_form() ? medium_names()
                  : std::vector<std::string>{"RockInSofterRock", "RandomDensitiesBelowTheInterfaceRatio"};
  for (const auto& medium : media)
    for (const int order : {7, 9, 11}) {
      Lab<double>::Setup setup;
      setup.medium = medium_named(medium, 20);
      setup.order = order;
      setup.cfl = 0.9;
      Lab<double> lab(setup);
      for (int n = 0; n < 8000; ++n) lab.step();
      const double before = lab.energy();
      for (int n = 0; n < 8000; ++n) lab.step();
      EXPECT_LE(lab.energy(), before) << medium << " order " << order;
    }
}

// Proves (E10).
TEST(Energy, OfWavesAlongAnInterfaceGainsNoMoreThanIsKnown) {
  // Where speeds differ, waves along the interface of a closed box are what is left in the end
  // (theory/interfaces.md). 12 columns between mirrors hold half a wave.
  const ThreadLimit one_thread(1);
  const Grid<2> grid{{12, 24}, 5, {0, 0}};
  for (const auto& [order, cfl] : {std::pair(5, 1.), {7, 1.}, {7, 0.9}}) {
    Lab<double>::Setup setup;
    setup.medium = rock(12, 24);
    for (std::int64_t n = 0; n < grid.size(); ++n) {
      const bool soft = grid.index(n)[1] < 12;
      setup.medium.vp[std::size_t(n)] = soft ? 900 : 3500;
      setup.medium.vs[std::size_t(n)] = soft ? 300 : 2000;
      setup.medium.rho[std::size_t(n)] = soft ? 1800 : 2300;
    }
    setup.order = order, setup.cfl = cfl;
    setup.edges[0] = {EdgeLaw::mirror, EdgeLaw::mirror};
    setup.edges[1] = {EdgeLaw::rigid, EdgeLaw::rigid};
    Lab<double> lab(setup);
    const int thousands = long_form() ? 200 : 3;
    for (int n = 0; n < thousands * 1000; ++n) lab.step();
    const double before = lab.energy();
    for (int n = 0; n < 1000; ++n) lab.step();
    EXPECT_LT(lab.energy(), before * (1 + gain_of_interfaces)) << "order " << order << " cfl " << cfl;
  }
}

TEST(Energy, NeverRisesAtAnyCourantNumber) {
  const ThreadLimit one_thread(1);
  std::size_t turn = 0;
  for (const double cfl : {0.1, 0.3, 0.5, 0.7, 0.9})
    for (const std::string medium : {"WaterOverCurvedRock", "RandomAirAndSteel", "RandomSolids"})
      for (const int order : share_of(std::vector{3, 5, 7, 9, 11}, turn++ % 3)) {
        SCOPED_TRACE(medium + " order " + std::to_string(order) + " cfl " + std::to_string(cfl));
        Lab<double>::Setup setup;
        setup.medium = medium_named(medium, 24);
        setup.order = order;
        setup.cfl = cfl;
        Lab<double>(setup).expect_no_growth(500, rounding<double>());
      }
}

TEST(Energy, NeverRisesOnGridsOfAFewCells) {
  const ThreadLimit one_thread(1);
  std::size_t turn = 0;
  for (const auto& [nx, nz] : {std::pair{1, 1}, {1, 9}, {9, 1}, {2, 3}, {4, 4}, {17, 2}})
    for (const auto& [order, edges] :
         share_of_pairs<int, EdgeLaw>({std::begin(orders), std::end(orders)},
                                      {EdgeLaw::free, EdgeLaw::rigid, EdgeLaw::mirror}, turn++)) {
      SCOPED_TRACE(std::to_string(nx) + " x " + std::to_string(nz) + " order " + std::to_string(order));
      Lab<double>::Setup setup;
      setup.medium = rock(nx, nz);
      setup.order = order;
      setup.edges = all_edges(edges);
      Lab<double>(setup).expect_no_growth(2000, rounding<double>());
    }
}

}  // namespace slipwave::media_test
