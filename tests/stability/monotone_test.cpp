// SPDX-License-Identifier: BSD-3-Clause
// The criterion of monotonicity in hard media.
#include <algorithm>

#include "lab.hpp"
#include "media.hpp"

namespace slipwave::monotone_test {
namespace {

template <class Real>
void expect_bounded(const std::string& medium, int order, double cfl, EdgeLaw edges) {
  SCOPED_TRACE(medium + ", order " + std::to_string(order) + ", Courant " + std::to_string(cfl));
  typename Lab<Real>::Setup setup;
  setup.medium = medium_named(medium, 18);
  setup.edges = all_edges(edges);
  setup.order = order;
  setup.cfl = cfl;
  setup.monotone = true;
  Lab<Real> lab(setup);
  lab.expect_no_growth(250, rounding<Real>());
  if (long_form()) lab.expect_fall_in_the_long_run(6000, rounding<Real>(), gain_of_interfaces);
}

}  // namespace

// Proves (C1).
TEST(EnergyOfMonotoneSweeps, NeverRisesInHardMedia) {
  const ThreadLimit one_thread(1);
  for (const double cfl : {0.3, 1.}) {
    std::size_t turn = cfl == 1;
    for (const auto& medium : medium_names())
      for (const int order : share_of(std::vector{3, 5, 11}, turn++)) {
        expect_bounded<double>(medium, order, cfl, EdgeLaw::free);
        if (order == 5) expect_bounded<float>(medium, order, cfl, EdgeLaw::rigid);
      }
  }
}

}  // namespace slipwave::monotone_test
