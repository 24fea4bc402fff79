// SPDX-License-Identifier: BSD-3-Clause
// Fourth order in time runs back in time in some of its sweeps, and its steps may be twice as long as those
// of second order: neither may make anything grow.
#include <array>
#include <tuple>

#include "lab.hpp"

namespace slipwave::splitting_test {
namespace {

class FourthOrderInTime : public ::testing::TestWithParam<std::string> {
 protected:
  const ThreadLimit one_thread_{1};
  std::size_t turn() const { return turn_of(GetParam(), medium_names()); }
  Lab<double>::Setup setup(int cells, int order, double cfl) const {
    Lab<double>::Setup setup;
    setup.medium = medium_named(GetParam(), cells);
    setup.order = order;
    setup.cfl = cfl;
    setup.time_order = 4;
    return setup;
  }
};

constexpr int cells() { return 20; }

/// Bounded all the time, and no more at the end than early on: the layer holds energy in its memory, too.
void expect_to_last(Lab<double>&& lab) {
  const double begin = lab.energy();
  for (int n = 0; n < 400; ++n) lab.step();
  const double early = lab.energy();
  EXPECT_LT(early, begin);
  for (int n = 0; n < (long_form() ? 10000 : 800); ++n) lab.step();
  // Written so that NaN fails.
  ASSERT_TRUE(lab.energy() < 1.001 * early) << lab.energy() << ", it was " << early;
}

}  // namespace

// Proves (E19).
TEST_P(FourthOrderInTime, NeverAddsEnergy) {
  for (const auto& [order, cfl] : share_of_pairs<int, double>(orders_tried(), {0.3, 1, 2}, turn())) {
    SCOPED_TRACE("order " + std::to_string(order) + " cfl " + std::to_string(cfl));
    Lab<double> lab(setup(cells(), order, cfl));
    lab.expect_no_growth(300, rounding<double>());
    if (long_form() && cfl == 2) lab.expect_fall_in_the_long_run(3000, rounding<double>());
  }
}

// Proves (E19).
TEST_P(FourthOrderInTime, NeverAddsEnergyBetweenOtherEdges) {
  for (const auto edges :
       share_of(std::vector{EdgeLaw::rigid, EdgeLaw::mirror, EdgeLaw::absorbing}, turn())) {
    SCOPED_TRACE("edges " + std::to_string(int(edges)));
    auto given = setup(cells(), 5, 2);
    given.edges = all_edges(edges);
    Lab<double> lab(given);
    lab.expect_no_growth(200, rounding<double>());
    if (long_form()) lab.expect_fall_in_the_long_run(4000, rounding<double>());
  }
}

// Proves (E19).
TEST_P(FourthOrderInTime, StaysBoundedInThePmlAndWherePlatesReachIntoIt) {
  for (const auto edge : share_of(std::vector{EdgeLaw::absorbing, EdgeLaw::free}, turn())) {
    SCOPED_TRACE(edge == EdgeLaw::free ? "plate" : "layers on all sides");
    auto given = setup(12, 7, 2);
    given.edges = all_edges(EdgeLaw::absorbing);
    given.edges[1] = {edge, edge};
    given.layer_hz = 0.03 * fastest_speed(given.medium) / given.medium.grid().spacing_m;
    expect_to_last(Lab<double>(given));
  }
}

INSTANTIATE_TEST_SUITE_P(HardMedia, FourthOrderInTime, ::testing::ValuesIn(share_of(medium_names(), 2)),
                         [](const auto& info) { return info.param; });

template <class Real>
void expect_to_fall_in_the_long_run(const std::string& medium, int order) {
  typename Lab<Real>::Setup setup;
  setup.medium = medium_named(medium, 20);
  setup.order = order;
  setup.cfl = 2;
  setup.time_order = 4;
  SCOPED_TRACE(medium + " order " + std::to_string(order));
  Lab<Real>(setup).expect_fall_in_the_long_run(16000, rounding<Real>(), long_form() ? gain_of_interfaces : 0);
}

// Proves (E19).
TEST(Energy, AtFourthOrderInTimeAndTheLongestStepFallsInTheLongRun) {
  const ThreadLimit one_thread(1);
  if (!long_form())
    return expect_to_fall_in_the_long_run<double>("RandomDensitiesBelowTheInterfaceRatio", 11);
  std::size_t turn = 0;
  for (const auto& medium : medium_names()) {
    const int order = std::array{11, 9, 7, 5}[turn % 4];
    if (turn++ / 4 % 2)
      expect_to_fall_in_the_long_run<double>(medium, order);
    else
      expect_to_fall_in_the_long_run<float>(medium, order);
  }
}

TEST(Energy, NeverRisesUnderACrustOfOneCellAtSmallSteps) {
  // 28 cells are nine layers of three and one of a single cell between an interface and the free surface
  // below.
  const ThreadLimit one_thread(1);
  for (const int time_order : {2, 4}) {
    Lab<double>::Setup setup;
    setup.medium = medium_named("SolidLayersOf3Cells", 28);
    setup.order = 7;
    setup.cfl = time_order == 2 ? 0.2 : 1;
    setup.time_order = time_order;
    Lab<double>(setup).expect_no_growth(time_order == 2 ? 8000 : 2500, rounding<double>());
  }
}

}  // namespace slipwave::splitting_test
