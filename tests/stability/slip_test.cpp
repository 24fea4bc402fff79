// SPDX-License-Identifier: BSD-3-Clause
// Slip takes energy out of the waves: friction, viscosity and the opening of planes can do nothing else. With
// stress that the scene was built with it is another sum that falls, see slip_prestress_test.cpp.
#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <tuple>

#include "slip_cases.hpp"

namespace slipwave::slip_test {
namespace {

constexpr int cells() { return 18; }
int steps() { return long_form() ? 600 : 120; }

using Case = std::tuple<Planes, SlipCorrection>;

class Slip : public ::testing::TestWithParam<Case> {
 protected:
  const Planes& planes() const { return std::get<0>(GetParam()); }
  std::size_t turn() const {
    return std::size_t(std::find_if(kinds_of_planes().begin(), kinds_of_planes().end(),
                                    [&](const Planes& kind) { return kind.name == planes().name; }) -
                       kinds_of_planes().begin());
  }
  /// In the short form a third of the laws, another one for the next kind of planes.
  std::vector<Law> some_laws() const { return share_of(laws(), turn()); }
  template <class Real>
  typename Lab<Real>::Setup setup(const Cluster& cluster, const FractureSet<2>& set) const {
    auto setup = fractured<Real>(medium_named(cluster.medium, cells()), cluster, set);
    setup.correction = std::get<1>(GetParam());
    rotation_.into(setup);
    return setup;
  }
  template <class Real>
  void expect_no_growth(const Cluster& cluster, const Law& law, double amplitude, double floor_share) {
    rotation_.next();
    SCOPED_TRACE(std::string(cluster.name) + " in " + cluster.medium + ", friction " +
                 std::to_string(law.friction) + ", viscosity " + std::to_string(law.viscosity_s) + ", " +
                 rotation_.shown() + (sizeof(Real) == 4 ? " (float)" : " (double)"));
    auto given = setup<Real>(cluster, set_of(planes(), law));
    given.amplitude = amplitude;
    Lab<Real> lab(given);
    lab.expect_no_growth(steps(), rounding<Real>(), floor_share * lab.energy());
  }

  const ThreadLimit one_thread_{1};
  Rotation rotation_;
};

}  // namespace

TEST_P(Slip, NeverAddsEnergy) {
  for (std::size_t n = 0; n < laws().size(); ++n)
    for (std::size_t m = 0; m < clusters().size(); ++m) {
      // In the short form every other case of each kind of planes.
      if (!long_form() && (n + m + turn()) % 2 != 0) {
        rotation_.next();
        continue;
      }
      if (rotation_.in_double())
        expect_no_growth<double>(clusters()[m], laws()[n], 1, 0);
      else
        expect_no_growth<float>(clusters()[m], laws()[n], 1, 0);
    }
}

TEST_P(Slip, NeverAddsEnergyToEnormousWaves) {
  for (const auto& law : some_laws())
    expect_no_growth<float>(cluster_named("every second cell"), law, 1e20, 0);
}

TEST_P(Slip, NeverAddsEnergyToTinyWaves) {
  for (const auto& law : some_laws()) expect_no_growth<float>(cluster_named("a block inside"), law, 1e-15, 0);
}

TEST_P(Slip, NeverAddsEnergyToDenormalWaves) {
  for (const auto& law : some_laws()) {
    // Stresses near 1e-37 Pa beside velocities that are denormal: what the smallest numbers round off is
    // the whole field. It may not grow past that.
    expect_no_growth<float>(cluster_named("every second cell"), law, 1e-44, 4);
    // Velocities up to half the amplitude a of which the smallest number m is lost: m/(a/2) of them, twice
    // that of the energy.
    constexpr double amplitude = 4e-36, smallest = std::numeric_limits<float>::min();
    expect_no_growth<float>(cluster_named("one row"), law, amplitude, 4 * smallest / amplitude);
  }
}

TEST_P(Slip, NeverAddsEnergyWherePlanesCarryNoNormalStress) {
  // S waves along z across planes that lie along x: s_n = 0 to the last bit in every step.
  for (const auto& law : some_laws())
    for (const double strength_pa : {0., 1e5}) {
      rotation_.next();
      SCOPED_TRACE(rotation_.shown() + ", strength " + std::to_string(strength_pa));
      Planes flat = planes();
      for (auto& angle_deg : flat.angles_deg) angle_deg -= planes().angles_deg.front();
      const Cluster every{"every row", [](int, int, int) { return true; }, "SolidLayersOf1Cell"};
      auto given = setup<double>(every, set_of(flat, law, strength_pa));
      given.along_z_only = true;
      given.fields = [](int, int k) {
        return CellFields{std::sin(0.7 * k), 0, 0, 0, 3e6 * std::cos(1.9 * k)};
      };
      Lab<double>(given).expect_no_growth(steps(), rounding<double>());
    }
}

TEST_P(Slip, NeverAddsEnergyWhereNormalStressAlternates) {
  // Tension beside pressure from cell to cell, at rest: next step the other way round.
  for (const auto& law : some_laws()) {
    rotation_.next();
    SCOPED_TRACE(rotation_.shown());
    auto given = setup<double>(cluster_named("everywhere, so every edge"), set_of(planes(), law));
    given.medium = rock(cells(), cells());
    given.fracture = Field<2, std::uint8_t>(given.medium.grid(), 1);
    given.fields = [](int i, int k) {
      const double sign = (i + k) % 2 == 0 ? 1 : -1;
      return CellFields{0, 0, sign * 3e6, sign * 5e6, 1e6 * std::sin(0.4 * i + 0.9 * k)};
    };
    Lab<double>(given).expect_no_growth(steps(), rounding<double>());
  }
}

TEST_P(Slip, NeverAddsEnergyInThousandsOfSteps) {
  for (const int time_order : {2, 4}) {
    auto given = setup<float>(cluster_named("everywhere, so every edge"), set_of(planes(), {0.1, 1e3}, 1e3));
    given.medium = medium_named("WaterOverCurvedRock", 20);
    for (std::size_t cell = 0; cell < given.medium.vs.size(); ++cell) {
      if (cell == 0) given.fracture = Field<2, std::uint8_t>(given.medium.grid());
      given.fracture[cell] = given.medium.is_solid(cell);
    }
    given.order = 5;
    given.time_order = time_order;
    given.cfl = 1;
    given.edges = all_edges(EdgeLaw::rigid);
    Lab<float>(given).expect_no_growth(long_form() ? 30000 : 2000, rounding<float>());
  }
}

INSTANTIATE_TEST_SUITE_P(PlanesAndCorrections, Slip,
                         ::testing::ValuesIn(share_of_pairs(kinds_of_planes(), corrections())),
                         [](const auto& info) { return std::apply(name_of_case, info.param); });

/// The centred rule takes off ahead what it may have to give back: energy wavers from step to step, within
/// what slip has taken before. It never passes its first value, and what it reaches late is not above what it
/// reached before.
class CentredSlip : public ::testing::TestWithParam<Planes> {
 protected:
  template <class Real>
  static void expect_bounded(const typename Lab<Real>::Setup& setup, int steps) {
    Lab<Real> lab(setup);
    const double begin = lab.energy();
    ASSERT_GT(begin, 0);
    double highest[4] = {};
    for (int n = 0; n < steps; ++n) {
      lab.step();
      const double now = lab.energy();
      // Written so that NaN fails.
      ASSERT_TRUE(now <= begin * (1 + rounding<Real>())) << "step " << n << ": " << now << " after " << begin;
      auto& here = highest[4 * n / steps];
      here = std::max(here, now);
    }
    for (const int quarter : {2, 3})
      EXPECT_LE(highest[quarter], highest[1] * (1 + 1e-3)) << quarter << ", first " << begin;
  }
};

// Proves (S27).
TEST_P(CentredSlip, NeverLetsWavesHaveMoreThanTheyBeganWith) {
  const ThreadLimit one_thread(1);
  Rotation rotation;
  int number = GetParam().open ? 1 : 0;
  for (const auto& law : laws()) {
    ++number;  // the other clusters
    for (const auto& cluster : clusters()) {
      rotation.next();
      // Every other case, of all kinds of planes and clusters, in the short form.
      if (!long_form() && ++number % 2 == 0) continue;
      SCOPED_TRACE(std::string(cluster.name) + " in " + cluster.medium + ", friction " +
                   std::to_string(law.friction) + ", viscosity " + std::to_string(law.viscosity_s) + ", " +
                   rotation.shown());
      const auto expect = [&](auto setup, auto real) {
        setup.correction = SlipCorrection::centred;
        rotation.into(setup);
        expect_bounded<decltype(real)>(setup, steps());
      };
      const auto medium = medium_named(cluster.medium, cells());
      if (rotation.in_double())
        expect(fractured<double>(medium, cluster, set_of(GetParam(), law)), double());
      else
        expect(fractured<float>(medium, cluster, set_of(GetParam(), law)), float());
    }
  }
}

/// Rock that slips in every cell, swept at the highest order and the longest step between rigid walls.
Lab<double>::Setup all_slipping(const Planes& planes, const Law& law) {
  auto setup = fractured<double>(rock(cells(), cells()), cluster_named("everywhere, so every edge"),
                                 set_of(planes, law));
  setup.order = 11;
  setup.cfl = 1;
  setup.edges = all_edges(EdgeLaw::rigid);
  setup.correction = SlipCorrection::centred;
  return setup;
}

// Proves (S27).
TEST_P(CentredSlip, LetsNothingGrowInThousandsOfSteps) {
  const ThreadLimit one_thread(1);
  for (const Law& law : {Law{0.1, 0}, Law{0.7, 0}, Law{0.3, 1e3}, Law{3, 1}}) {
    SCOPED_TRACE("friction " + std::to_string(law.friction));
    expect_bounded<double>(all_slipping(GetParam(), law), long_form() ? 20000 : 500);
  }
}

/// Any share in any cell, with edges in all directions: harder than what edges of regions leave.
Field<2> any_shares() {
  Field<2> shares(rock(cells(), cells()).grid());
  std::mt19937 engine(5);
  std::uniform_real_distribution<float> uniform(0.002F, 1.2F);
  for (auto& share : shares) share = std::min(uniform(engine), 1.F);
  return shares;
}

TEST_P(CentredSlip, LetsNothingGrowInThousandsOfStepsWhereEdgesCutCells) {
  const ThreadLimit one_thread(1);
  for (const Law& law : {Law{0.7, 0}, Law{0.3, 1e3}}) {
    SCOPED_TRACE("friction " + std::to_string(law.friction));
    auto setup = all_slipping(GetParam(), law);
    setup.fracture_share = any_shares();
    expect_bounded<double>(setup, long_form() ? 20000 : 100);
  }
}

// Proves (S39).
TEST_P(CentredSlip, NeverLetsWavesHaveMoreThanTheyBeganWithWhereEdgesCutCells) {
  const ThreadLimit one_thread(1);
  Rotation rotation;
  const auto shares = any_shares();
  std::size_t number = 0;
  for (const auto& law : laws())
    for (const auto correction : {SlipCorrection::centred, SlipCorrection::first, SlipCorrection::second,
                                  SlipCorrection::exponential}) {
      rotation.next();
      // In the short form each law with one correction.
      if (!long_form() && number++ % 5 != 0) continue;
      SCOPED_TRACE("friction " + std::to_string(law.friction) + ", viscosity " +
                   std::to_string(law.viscosity_s) + ", " + rotation.shown());
      auto setup = fractured<double>(rock(cells(), cells()), cluster_named("everywhere, so every edge"),
                                     set_of(GetParam(), law));
      setup.fracture_share = shares;
      setup.correction = correction;
      rotation.into(setup);
      expect_bounded<double>(setup, long_form() ? 600 : 60);
    }
}

INSTANTIATE_TEST_SUITE_P(Planes, CentredSlip, ::testing::ValuesIn(share_of(kinds_of_planes())),
                         [](const auto& info) { return std::string(info.param.name); });

TEST(SlipInEveryDirection, NeverAddsEnergyAtAnyOrder) {
  const ThreadLimit one_thread(1);
  std::size_t turn = 0;
  for (const int order : orders)
    for (const double angle : {0., 35., 45., 90., 135.})
      for (const auto correction : share_of(corrections(), turn++ % 3)) {
        SCOPED_TRACE("order " + std::to_string(order) + ", angle " + std::to_string(angle));
        auto setup = fractured<double>(medium_named("WaterOverCurvedRock", 28),
                                       cluster_named("everywhere, so every edge"),
                                       {"set", {system_of(angle, {0.3, 500}, 1e4)}});
        setup.order = order;
        setup.correction = correction;
        Lab<double>(setup).expect_no_growth(long_form() ? 3000 : 300, rounding<double>());
      }
}

TEST(FrictionlessSlip, TakesEnergyOutOfTheWaves) {
  const ThreadLimit one_thread(1);
  const auto left = [](SlipCorrection correction, bool slips) {
    auto setup = fractured<double>(rock(32, 32), cluster_named("everywhere, so every edge"),
                                   {"set", {system_of(45, {0, 0})}});
    setup.order = 7;
    setup.correction = correction;
    if (!slips) setup.fracture = {};
    Lab<double> lab(setup);
    for (int n = 0; n < 10; ++n) lab.step();
    return lab.energy();
  };
  for (const auto correction : corrections())
    EXPECT_LT(left(correction, true), 0.9 * left(correction, false));
}

}  // namespace slipwave::slip_test
