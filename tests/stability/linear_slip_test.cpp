// SPDX-License-Identifier: BSD-3-Clause
// Planes that give way as springs: the energy of waves and springs never rises above that of the beginning,
// however stiff or soft they are (docs/theory.md (S25)).
#include <algorithm>
#include <cmath>

#include "slip_cases.hpp"

namespace slipwave::linear_slip_test {
namespace {

constexpr int cells() { return 16; }
int steps() { return long_form() ? 1500 : 80; }

/// Compliance times the shear modulus of ordinary rock, normal and tangential, and the time in which dashpots
/// let the springs give way, in time steps.
struct Spring {
  double normal, tangential, dashpot_steps;
};
struct Kind {
  const char* name;
  std::vector<double> angles_deg;
  bool damped, slides;
};

constexpr double usual_mu = 2e10;

class Springs : public ::testing::TestWithParam<Kind> {
 protected:
  FractureSet<2> set_with(const Spring& spring, const Law& law, double dt_s) const {
    FractureSet<2> set{"springs", {}};
    double share = 1;
    for (const double angle_deg : GetParam().angles_deg) {
      set.systems.push_back(system_of(angle_deg, law, 0));
      auto& system = set.systems.back();
      if (!GetParam().slides) system.law = FrictionLaw::none;
      const double z_n = share * spring.normal / usual_mu, z_t = share * spring.tangential / usual_mu;
      // Relaxed within that many steps where the planes are softer than the rock, sooner where they are not.
      const double damping = GetParam().damped ? spring.dashpot_steps * dt_s * usual_mu : 0;
      system.compliance = {z_n, z_t, damping, damping / 3, 1};
      share /= 3;
    }
    return set;
  }

  template <class Real>
  void expect_bounded(const Cluster& cluster, const Spring& spring, const Law& law, bool cut = false) {
    rotation_.next();
    const auto medium = medium_named(cluster.medium, cells());
    const double dt_s = rotation_.cfl() * medium.grid().spacing_m / fastest_speed(medium);
    auto given = fractured<Real>(medium, cluster, set_with(spring, law, dt_s));
    given.correction = corrections()[number_++ % 3];
    if (cut) {
      given.fracture_share = Field<2>(medium.grid());
      for (std::size_t cell = 0; cell < given.fracture_share.size(); ++cell)
        given.fracture_share[cell] = float(1 + cell * 7 % 13) / 13;
    }
    rotation_.into(given);
    SCOPED_TRACE(std::string(cluster.name) + " in " + cluster.medium + ", compliances " +
                 std::to_string(spring.normal) + ", " + std::to_string(spring.tangential) + ", dashpots " +
                 std::to_string(spring.dashpot_steps) + ", friction " + std::to_string(law.friction) + ", " +
                 name_of(given.correction) + ", " + rotation_.shown());
    Lab<Real> lab(given);
    // Of each half of the run.
    double highest[2] = {lab.energy(), 0};
    ASSERT_GT(highest[0], 0);
    for (int n = 0; n < steps(); ++n) {
      lab.step();
      const double now = lab.energy();
      ASSERT_TRUE(now <= highest[0] * (1 + rounding<Real>()))
          << "step " << n << ": " << now << " of " << highest[0];
      if (2 * n > steps()) highest[1] = std::max(highest[1], now);
    }
    EXPECT_LE(highest[1], highest[0]);
  }

  const ThreadLimit one_thread_{1};
  Rotation rotation_;
  std::size_t number_ = 0;
};

// Proves (S25).
TEST_P(Springs, NeverAddEnergyHoweverStiffOrSoft) {
  const std::vector<double> dashpots =
      GetParam().damped ? std::vector<double>{0.01, 1, 100} : std::vector<double>{0};
  const std::vector<Law> laws =
      GetParam().slides ? std::vector<Law>{{0.1, 0}, {0.1, 1e3}, {0, 1e3}} : std::vector<Law>{{0, 0}};
  std::size_t turn = 0, other_turn = 0;
  for (const auto& cluster : clusters())
    for (const double soft : {1e-6, 1., 30., 1e9})
      for (const double dashpot : dashpots)
        for (const auto& law : share_of(laws, turn++ % laws.size()))
          for (const double other : share_of(std::vector{0., 2.}, other_turn++ % 5)) {
            const Spring spring{other * soft, soft, dashpot};
            if (rotation_.in_double())
              expect_bounded<double>(cluster, spring, law);
            else
              expect_bounded<float>(cluster, spring, law);
          }
}

TEST_P(Springs, NeverAddEnergyWhereEdgesCutCells) {
  const Law law = GetParam().slides ? Law{0.1, 1e3} : Law{0, 0};
  for (const double soft : {1e-6, 1., 30., 1e9})
    expect_bounded<double>(cluster_named("everywhere, so every edge"),
                           {2 * soft, soft, GetParam().damped ? 1. : 0.}, law, true);
}

INSTANTIATE_TEST_SUITE_P(Kinds, Springs,
                         ::testing::Values(Kind{"One", {35}, false, false}, Kind{"Level", {0}, false, false},
                                           Kind{"Damped", {35}, true, false},
                                           Kind{"BelowFriction", {35}, false, true},
                                           Kind{"DampedBelowFriction", {-60}, true, true},
                                           Kind{"Blocks", {20, 110}, false, false},
                                           Kind{"BlocksBelowFriction", {20, 110}, false, true},
                                           Kind{"Crossing", {20, 75}, false, false}),
                         [](const auto& info) { return info.param.name; });

}  // namespace
}  // namespace slipwave::linear_slip_test
