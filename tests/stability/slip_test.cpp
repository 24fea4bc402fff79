#include <cmath>
#include <functional>
#include <tuple>

#include "lab.hpp"

namespace slipwave {
namespace {

using Region = std::function<bool(int i, int k, int n)>;

struct Cluster {
  const char* name;
  Region holds;
};

const std::vector<Cluster>& clusters() {
  static const std::vector<Cluster> all = {
      {"one cell", [](int i, int k, int n) { return i == n / 2 && k == n / 2; }},
      {"one row", [](int, int k, int n) { return k == n / 3; }},
      {"one column", [](int i, int, int n) { return i == n / 3; }},
      {"a block inside",
       [](int i, int k, int n) { return std::abs(i - n / 2) < n / 5 && std::abs(k - 2 * n / 3) < n / 8; }},
      {"everywhere, so every edge", [](int, int, int) { return true; }},
      {"every second cell", [](int i, int k, int) { return (i + k) % 2 == 0; }},
  };
  return all;
}

FractureSet<2> planes(double angle_deg, double friction, double viscosity_s, double strength_pa = 0) {
  const double angle = angle_deg * std::acos(-1.0) / 180;
  return {"set", {{{std::sin(angle), -std::cos(angle)}, friction, viscosity_s, strength_pa}}};
}

template <class Real>
typename Lab<Real>::Setup fractured(const Medium<2>& medium, const Region& region,
                                    const FractureSet<2>& set) {
  typename Lab<Real>::Setup setup;
  setup.medium = medium;
  setup.fracture_sets = {set};
  setup.fracture = Field<2, std::uint8_t>(medium.grid());
  const int n = int(medium.grid().shape[0]);
  for (int k = 0; k < n; ++k)
    for (int i = 0; i < n; ++i) {
      const auto cell = std::size_t(k * n + i);
      setup.fracture[cell] = medium.is_solid(cell) && region(i, k, n);
    }
  return setup;
}

template <class Real>
void expect_no_growth_with_slip(double friction, double viscosity_s, double amplitude, double floor_share) {
  const int cells = long_form() ? 48 : 24, steps = long_form() ? 3000 : 250;
  for (const auto correction : {SlipCorrection::first, SlipCorrection::second})
    for (const auto& cluster : clusters())
      for (const std::string name : {"WaterOverRock", "SolidBlocksOf3Cells"}) {
        SCOPED_TRACE(std::string(cluster.name) + " in " + name +
                     (correction == SlipCorrection::first ? ", first order" : ", second order"));
        auto setup =
            fractured<Real>(medium_named(name, cells), cluster.holds, planes(35, friction, viscosity_s));
        setup.correction = correction;
        setup.amplitude = amplitude;
        Lab<Real> lab(setup);
        lab.expect_no_growth(steps, rounding<Real>(), floor_share * lab.energy());
      }
}

class Slip : public ::testing::TestWithParam<std::tuple<double, double>> {
 protected:
  double friction() const { return std::get<0>(GetParam()); }
  double viscosity_s() const { return std::get<1>(GetParam()); }
  const ThreadLimit one_thread_{1};
};

}  // namespace

TEST_P(Slip, NeverAddsEnergyInDouble) { expect_no_growth_with_slip<double>(friction(), viscosity_s(), 1, 0); }
TEST_P(Slip, NeverAddsEnergyInFloat) { expect_no_growth_with_slip<float>(friction(), viscosity_s(), 1, 0); }
TEST_P(Slip, NeverAddsEnergyToEnormousWavesInFloat) {
  expect_no_growth_with_slip<float>(friction(), viscosity_s(), 1e20, 0);
}
TEST_P(Slip, NeverAddsEnergyToDenormalWavesInFloat) {
  // Stresses near 1e-37 Pa beside velocities that are denormal: what the smallest numbers round off is
  // the whole field. It may not grow past that.
  expect_no_growth_with_slip<float>(friction(), viscosity_s(), 1e-44, 4);
  // Velocities up to half the amplitude a of which the smallest number m is lost: m/(a/2) of them, twice that
  // of the energy.
  constexpr double amplitude = 4e-36, smallest = std::numeric_limits<float>::min();
  expect_no_growth_with_slip<float>(friction(), viscosity_s(), amplitude, 4 * smallest / amplitude);
}

INSTANTIATE_TEST_SUITE_P(FrictionAndViscosity, Slip,
                         ::testing::Combine(::testing::Values(0, 0.1, 100),
                                            ::testing::Values(0, 1e-300, 1, 1e3, 1e300)),
                         [](const auto& info) { return "Case" + std::to_string(info.index); });

TEST(SlipInEveryDirection, NeverAddsEnergyAtAnyOrder) {
  const ThreadLimit one_thread(1);
  for (const int order : {1, 3, 5, 7})
    for (const double angle : {0., 35., 45., 90., 135.})
      for (const auto correction : {SlipCorrection::first, SlipCorrection::second}) {
        SCOPED_TRACE("order " + std::to_string(order) + ", angle " + std::to_string(angle));
        auto setup = fractured<double>(medium_named("WaterOverCurvedRock", 32), clusters()[4].holds,
                                       planes(angle, 0.3, 500, 1e4));
        setup.order = order;
        setup.correction = correction;
        Lab<double>(setup).expect_no_growth(500, rounding<double>());
      }
}

TEST(SlipOnTwoSystems, NeverAddsEnergy) {
  const ThreadLimit one_thread(1);
  for (const double viscosity_s : {0., 1e3}) {
    auto set = planes(20, 0.1, viscosity_s);
    set.systems.push_back(planes(110, 0.4, viscosity_s, 1e5).systems.front());
    for (const auto correction : {SlipCorrection::first, SlipCorrection::second}) {
      auto setup = fractured<double>(medium_named("RandomMixture", 32), clusters()[4].holds, set);
      setup.correction = correction;
      Lab<double>(setup).expect_no_growth(1000, rounding<double>());
    }
  }
}

TEST(SlipBesideAbsorbingEdges, NeverAddsEnergy) {
  const ThreadLimit one_thread(1);
  for (const auto correction : {SlipCorrection::first, SlipCorrection::second}) {
    auto setup = fractured<double>(rock(32, 32), clusters()[4].holds, planes(45, 0.1, 1e3));
    setup.edges = all_edges(EdgeLaw::absorbing);
    setup.correction = correction;
    Lab<double>(setup).expect_no_growth(1000, rounding<double>());
  }
}

TEST(SlipForTenThousandSteps, NeverAddsEnergy) {
  const ThreadLimit one_thread(1);
  for (const auto correction : {SlipCorrection::first, SlipCorrection::second}) {
    auto setup =
        fractured<float>(medium_named("WaterOverCurvedRock", 32), clusters()[3].holds, planes(45, 0.1, 1e3));
    setup.correction = correction;
    Lab<float>(setup).expect_no_growth(10000, rounding<float>());
  }
}

TEST(FrictionlessSlip, TakesEnergyOutOfTheWaves) {
  const ThreadLimit one_thread(1);
  const auto left = [](std::uint8_t slips) {
    auto setup = fractured<double>(rock(32, 32), clusters()[4].holds, planes(45, 0, 0));
    setup.order = 7;
    if (!slips) setup.fracture = {};
    Lab<double> lab(setup);
    for (int n = 0; n < 10; ++n) lab.step();
    return lab.energy();
  };
  EXPECT_LT(left(1), 0.9 * left(0));
}

}  // namespace slipwave
