// SPDX-License-Identifier: BSD-3-Clause
#include "lab.hpp"

namespace slipwave::edges_test {
namespace {

class AbsorbingEdges : public ::testing::TestWithParam<std::string> {
 protected:
  std::size_t turn() const { return turn_of(GetParam(), medium_names()); }
  const ThreadLimit one_thread_{1};
};

}  // namespace

TEST_P(AbsorbingEdges, NeverFeedEnergyBack) {
  for (const auto& [order, zone] : share_of_pairs<int, int>(orders_tried(), {1, 3, 20}, turn())) {
    SCOPED_TRACE("order " + std::to_string(order) + ", zones of " + std::to_string(zone) + " cells");
    Lab<double>::Setup setup;
    setup.medium = medium_named(GetParam(), 20);
    setup.edges = all_edges(EdgeLaw::absorbing);
    setup.order = order;
    setup.zone_cells = zone;
    Lab<double> lab(setup);
    lab.expect_no_growth(300, rounding<double>());
    if (long_form()) lab.expect_fall_in_the_long_run(4000, rounding<double>());
  }
}

TEST_P(AbsorbingEdges, BesideAFreeSurfaceNeverFeedEnergyBack) {
  for (const int order : share_of(std::vector{3, 5, 7}, turn())) {
    SCOPED_TRACE("order " + std::to_string(order));
    Lab<float>::Setup setup;
    setup.medium = medium_named(GetParam(), 20);
    setup.edges = all_edges(EdgeLaw::absorbing);
    setup.edges[1][0] = EdgeLaw::free;
    setup.order = order;
    setup.zone_cells = 10;
    Lab<float> lab(setup);
    lab.expect_no_growth(600, rounding<float>());
    if (long_form()) lab.expect_fall_in_the_long_run(10000, rounding<float>());
  }
}

// Proves (E14).
TEST_P(AbsorbingEdges, WithPmlDrainTheField) {
  for (const auto& [order, top] : share_of_pairs<int, EdgeLaw>(
           share_of(orders_tried(), turn()), {EdgeLaw::absorbing, EdgeLaw::free}, turn() / 3)) {
    SCOPED_TRACE("order " + std::to_string(order) + (top == EdgeLaw::free ? ", free surface" : ""));
    Lab<float>::Setup setup;
    setup.medium = medium_named(GetParam(), 16);
    setup.edges = all_edges(EdgeLaw::absorbing);
    setup.edges[1][0] = top;
    setup.order = order;
    setup.zone_cells = 20;
    setup.layer_hz = 0.05 * fastest_speed(setup.medium) / setup.medium.grid().spacing_m;
    Lab<float> lab(setup);
    // The layer holds energy in its memory too, so that of the fields falls over many steps, not in each.
    double lowest = lab.energy();
    for (int n = 100; n <= (long_form() ? 10000 : 400); n += 100) {
      for (int k = 0; k < 100; ++k) lab.step();
      ASSERT_LE(lab.energy(), 1.001 * lowest) << "step " << n;
      lowest = std::min(lowest, lab.energy());
    }
  }
}

INSTANTIATE_TEST_SUITE_P(HardMedia, AbsorbingEdges, ::testing::ValuesIn(share_of(medium_names(), 0)),
                         [](const auto& info) { return info.param; });

TEST(Sponge, LetTheWaveFieldLeave) {
  const ThreadLimit one_thread(1);
  Lab<double>::Setup setup;
  setup.medium = rock(40, 40);
  setup.edges = all_edges(EdgeLaw::absorbing);
  setup.zone_cells = 20;
  Lab<double> lab(setup);
  const double begin = lab.energy();
  // The slowest wave crosses the model four times. Random stresses are partly in equilibrium; those stay.
  for (int n = 0; n < 320; ++n) lab.step();
  EXPECT_LT(lab.energy(), 2e-2 * begin);
}

}  // namespace slipwave::edges_test
