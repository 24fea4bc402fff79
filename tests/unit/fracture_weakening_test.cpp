// SPDX-License-Identifier: BSD-3-Clause
// Slip weakening: its limit, its closed form, its order in time, its energy.
#include <functional>
#include <numbers>

#include "fracture_slip_cases.hpp"
#include "model/fracture.hpp"

namespace slipwave::fracture_weakening_test {
namespace {

template <class Case>
class Weakening : public SlipLaw<Case> {};
TYPED_TEST_SUITE(Weakening, SlipCases);

template <class Real>
SlipStrength<Real> weakening(double friction, double dynamic, double distance_m, double cohesion_pa,
                             double slip_per_pa) {
  return {Real(friction), Real(cohesion_pa), FrictionLaw::slip_weakening, dynamic, distance_m, slip_per_pa};
}

// Proves (S17).
TYPED_TEST(Weakening, OverAnEndlessDistanceIsCoulombToTheBit) {
  using Real = typename TypeParam::Real;
  using Correction = typename TypeParam::Correction;
  for (const double distance_m : {std::numeric_limits<double>::infinity(), 1e300})
    for (const double d : {0., 1e-6, 1e-4}) {
      const auto n = this->any_normal();
      const auto weak = weakening<Real>(0.4, 0.1, distance_m, 100, 1e-9);
      const SlipStrength<Real> coulomb{Real(0.4), Real(100)};
      typename TestFixture::Memory memory{}, memory_coulomb{};
      typename TestFixture::Cell s{}, s_coulomb{};
      for (int step = 0; step < 300; ++step) {
        const auto load = this->any_stress(3e4);
        for (int k = 0; k < s.components; ++k)
          s.values[k] += load.values[k], s_coulomb.values[k] += load.values[k];
        correct<Correction, TypeParam::D, Real>(weak, n, d, s, memory);
        correct<Correction, TypeParam::D, Real>(coulomb, n, d, s_coulomb, memory_coulomb);
        ASSERT_EQ(s, s_coulomb) << step;
        begin<Correction, TypeParam::D, Real>(weak, n, d, s, memory);
        begin<Correction, TypeParam::D, Real>(coulomb, n, d, s_coulomb, memory_coulomb);
        ASSERT_EQ(s, s_coulomb) << step;
      }
      EXPECT_GT(memory[slip_in_memory], 0);
    }
}

// Proves (S18).
TYPED_TEST(Weakening, NeverAddsEnergyAndStoresTheSlip) {
  using Real = typename TypeParam::Real;
  using Correction = typename TypeParam::Correction;
  const double slip_per_pa = 1e-9;
  for (const double distance_m : {1e-12, 1e-5, 1e-3})  // at once, from 1.5 steps to many
    for (const double d : {0., 1e-6, 1e-4}) {
      const auto n = this->any_normal();
      const auto law = weakening<Real>(0.4, 0.1, distance_m, 1e3, slip_per_pa);
      typename TestFixture::Memory memory{};
      typename TestFixture::Cell s{};
      double lost = 0;
      for (int step = 0; step < 300; ++step) {
        const auto load = this->any_stress(5e4);
        for (int k = 0; k < s.components; ++k) s.values[k] = Real(0.8) * s.values[k] + load.values[k];
        const auto change = [&](auto act) {
          const auto before = s;
          act();
          ASSERT_LE(shear_magnitude(n, s), shear_magnitude(n, before) + 20 * this->eps * 1e5);
          auto taken = before;
          for (int k = 0; k < s.components; ++k) taken.values[k] -= s.values[k];
          lost += shear_magnitude(n, taken);
        };
        change([&] { correct<Correction, TypeParam::D, Real>(law, n, d, s, memory); });
        change([&] { begin<Correction, TypeParam::D, Real>(law, n, d, s, memory); });
      }
      EXPECT_NEAR(memory[slip_in_memory], lost * slip_per_pa,
                  1e3 * this->eps * 1e5 * slip_per_pa + 1e-4 * this->eps);
    }
}

TYPED_TEST(Weakening, KeepsAllNumbersFinite) {
  using Real = typename TypeParam::Real;
  for (const double distance_m : {1e-300, 1e-40, 1e-6, 1e30, 1e300})
    for (const double slip_per_pa : {0., 1e-30, 1e-9, 1e30})
      for (const double d : {0., 1e-6, 1e30})
        for (const double size : {0., 1e-42, 1., 1e15})
          for (const double cohesion : {0., 1e-40, 1e30}) {
            const auto n = this->any_normal();
            const auto law = weakening<Real>(100, 0, distance_m, cohesion, slip_per_pa);
            typename TestFixture::Memory memory{};
            auto s = this->any_stress(size);
            for (int step = 0; step < 3; ++step) {
              correct<typename TypeParam::Correction, TypeParam::D, Real>(law, n, d, s, memory);
              begin<typename TypeParam::Correction, TypeParam::D, Real>(law, n, d, s, memory);
            }
            for (const auto v : s.values) ASSERT_TRUE(std::isfinite(v)) << distance_m << ' ' << slip_per_pa;
            ASSERT_TRUE(std::isfinite(memory[slip_in_memory])) << distance_m << ' ' << slip_per_pa;
          }
}

/// A cell of planes normal to x under a pressure, loaded in shear at a constant strain rate: `steps` steps of
/// `load`.
struct Loaded {
  double pressure = 1e5, load = 1e3;
  int steps = 100;
};
template <class Correction>
double traction_of(const SlipStrength<double>& law, const Loaded& cell, double d, double& slip_m) {
  Stress<2, double> s;
  s(0, 0) = -cell.pressure;
  std::array<double, 8> memory{};
  for (int step = 0; step < cell.steps; ++step) {
    begin<Correction, 2, double>(law, {1, 0}, d, s, memory);
    s(0, 1) += cell.load;
    correct<Correction, 2, double>(law, {1, 0}, d, s, memory);
  }
  slip_m = memory[slip_in_memory];
  return s(0, 1);
}

template <class Correction>
void expect_closed_form() {
  // |tau| = S_s - W (load - |tau|) while slip < D_c, then S_d; W = (q_s - q_d) p h/(mu D_c).
  const double q_s = 0.6, q_d = 0.2, h_over_mu = 1e-9, distance_m = 5e-5;
  const auto law = weakening<double>(q_s, q_d, distance_m, 0, h_over_mu);
  for (const int steps : {30, 59, 61, 65, 69, 72, 90, 150}) {
    Loaded cell;
    cell.steps = steps;
    const double w = (q_s - q_d) * cell.pressure * h_over_mu / distance_m, load = cell.load * steps;
    ASSERT_LT(w, 1);
    const double strong = q_s * cell.pressure, weak = q_d * cell.pressure;
    const double expected = load <= strong ? load : std::max((strong - w * load) / (1 - w), weak);
    double slip_m;
    EXPECT_NEAR(traction_of<Correction>(law, cell, 0, slip_m), expected, 1e-9 * strong) << steps;
    EXPECT_NEAR(slip_m, (load - expected) * h_over_mu, 1e-9 * distance_m) << steps;
  }
}

// Proves (S18).
TEST(SlipWeakening, OfDryPlanesIsItsClosedFormInStepsOfAnyLength) {
  expect_closed_form<FirstOrder>();
  expect_closed_form<SecondOrder>();
  expect_closed_form<Exponential>();
}

// Proves (S18).
TEST(SlipWeakening, FallsToDynamicFrictionAtOnceWhereTheCellIsTooLarge) {
  const auto law = weakening<double>(0.6, 0.2, 2e-5, 0, 1e-9);  // W = 2
  Loaded cell;
  double slip_m;
  for (cell.steps = 55; cell.steps < 70; ++cell.steps) {
    const double load = cell.load * cell.steps, expected = load <= 6e4 ? load : 2e4;
    EXPECT_NEAR(traction_of<FirstOrder>(law, cell, 0, slip_m), expected, 1e-6) << cell.steps;
    EXPECT_NEAR(traction_of<SecondOrder>(law, cell, 0, slip_m), expected, 1e-6) << cell.steps;
    EXPECT_NEAR(traction_of<Exponential>(law, cell, 0, slip_m), expected, 1e-6) << cell.steps;
    EXPECT_NEAR(slip_m, (load - expected) * 1e-9, 1e-15);
  }
}

/// Loading of a viscous plane, and the law as an equation for slip alone.
struct Pulled {
  double mu = 1.2e10, eta = 2e3, q_s = 0.5, q_d = 0.1, cohesion = 50, h = 10, distance_m;
  double rate = 6e5, end = 0.4;
  static double normal(double t) { return -1e5 * (1 + 0.3 * std::sin(2 * std::numbers::pi * 3 * t)); }
  double strength(double t, double slip_m) const {
    return (q_s - (q_s - q_d) * std::min(slip_m / distance_m, 1.)) * -normal(t) + cohesion;
  }
  /// Taken off the traction by the classical Runge-Kutta rule of fourth order.
  double lost(int steps) const {
    const auto speed = [&](double t, double lost) {
      const double over = (rate * t - lost) / strength(t, lost * h / mu) - 1;
      return over > 0 ? mu * over / eta : 0.;
    };
    double y = 0;
    const double dt = end / steps;
    for (int n = 0; n < steps; ++n) {
      const double t = n * dt;
      const double k1 = speed(t, y), k2 = speed(t + dt / 2, y + dt / 2 * k1),
                   k3 = speed(t + dt / 2, y + dt / 2 * k2), k4 = speed(t + dt, y + dt * k3);
      y += dt / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
    }
    return y;
  }
  template <class Correction>
  double computed(int steps) const {
    const double dt = end / steps, d = slip_d(eta, mu, dt);
    const auto law = weakening<double>(q_s, q_d, distance_m, cohesion, h / mu);
    const Traction<2, double> n{0.6, 0.8}, m{-0.8, 0.6};
    Stress<2, double> s;
    std::array<double, 8> memory{};
    const auto add = [&](double shear, double pull) {
      for (int i = 0; i < 2; ++i)
        for (int j = i; j < 2; ++j) s(i, j) += pull * n[i] * n[j] + shear * (n[i] * m[j] + m[i] * n[j]);
    };
    add(0, normal(0));
    for (int step = 0; step < steps; ++step) {
      begin<Correction, 2, double>(law, n, d, s, memory);
      add(rate * dt, normal((step + 1) * dt) - normal(step * dt));
      correct<Correction, 2, double>(law, n, d, s, memory);
    }
    return memory[slip_in_memory] * mu / h;
  }
  template <class Correction>
  std::vector<double> errors(int coarsest, int doublings) const {
    const double exact = lost(400000);
    std::vector<double> found;
    for (int k = 0; k <= doublings; ++k)
      found.push_back(std::abs(computed<Correction>(coarsest << k) - exact) / exact);
    return found;
  }
};

double order(const std::vector<double>& e) { return std::log2(e.front() / e.back()) / double(e.size() - 1); }

// Proves (S18).
TEST(SlipWeakening, ConvergesToTheSolutionOfItsEquationWithTheOrderOfItsCorrection) {
  // While friction falls, and where it has fallen to the dynamic one on the way.
  for (const double distance_m : {4e-4, 6e-5}) {
    const Pulled cell{.distance_m = distance_m};
    const double exact = cell.lost(400000);
    ASSERT_NEAR(cell.lost(200000), exact, 1e-8 * exact);
    EXPECT_EQ(exact * cell.h / cell.mu > distance_m, distance_m < 1e-4);
    const auto first = cell.errors<FirstOrder>(400, 4), second = cell.errors<SecondOrder>(400, 4),
               exponential = cell.errors<Exponential>(400, 4);
    EXPECT_NEAR(order(first), 1, 0.15) << distance_m;
    EXPECT_LT(first.back(), 2e-4) << distance_m;
    EXPECT_NEAR(order(second), 2, 0.3) << distance_m;
    EXPECT_LT(second.back(), 2e-6) << distance_m;
    EXPECT_NEAR(order(exponential), 2, 0.3) << distance_m;
    EXPECT_LT(exponential.back(), 2e-6) << distance_m;
  }
}

// Proves (S18).
TEST(SlipWeakening, OfTwoSystemsIsTheSameInKernelAndJointSolver) {
  // A pair at right angles, by the closed form and by rounds: dry planes, of which the weaker alone slips,
  // and viscous ones.
  std::mt19937 random(11);
  const std::vector<SlipSystem<2>> systems = {
      {{0.6, 0.8}, 0.5, 0, 10, false, FrictionLaw::slip_weakening, 0.1, 1e-4},
      {{-0.8, 0.6}, 0.4, 0, 50, false, FrictionLaw::slip_weakening, 0.2, 3e-4}};
  const auto planes = solver::planes_of<2, double>(systems);
  std::vector<JointSlip<2, double, SlipWeakening>::System> both;
  for (const auto& system : systems)
    both.push_back({{system.normal[0], system.normal[1]}, constants_of<2, double>(system, 1)});
  for (const auto correction : {SlipCorrection::first, SlipCorrection::second, SlipCorrection::exponential})
    for (const double c : {1e3, 1e5, most_relaxation_pa}) {
      const auto kernels =
          solver::slip_kernels<double>({2, 2, correction, false, FrictionLaw::slip_weakening});
      const JointSlip<2, double, SlipWeakening> joint(correction, both);
      const double c_a = c, c_b = std::min(2 * c, most_relaxation_pa), per_pa = 1e-9;
      double slips[2] = {}, joint_slips[2] = {};
      const double relaxation[2] = {c_a, c_b};
      const bool shut[2] = {};
      Stress<2, double> s{{-2e4, -2e4, 0}}, joint_s = s;
      const solver::SlipRows<double> rows = {
          s.values.data(),        1,      {&c_a, &c_b}, nullptr, 0, nullptr, 0, {nullptr, nullptr},
          {&slips[0], &slips[1]}, &per_pa};
      for (int step = 0; step < 200; ++step) {
        for (std::size_t k = 0; k < 3; ++k) {
          const double load = std::uniform_real_distribution<>(-1e4, 1e4)(random);
          s.values[k] = 0.9 * s.values[k] + load - (k < 2 ? 2e3 : 0);
          joint_s.values[k] = s.values[k];
        }
        std::copy(slips, slips + 2, joint_slips);
        kernels.slip(1, planes, rows);
        joint.slip(joint_s, joint_s, {relaxation, shut, joint_slips, per_pa});
        const double close = 1e-2 * 1e4;  // rounds end after 24
        for (std::size_t k = 0; k < 3; ++k)
          ASSERT_NEAR(s.values[k], joint_s.values[k], close) << step << ' ' << c;
        ASSERT_NEAR(slips[0] + slips[1], joint_slips[0] + joint_slips[1], close * per_pa) << step;
        kernels.begin(1, planes, rows);
      }
      EXPECT_GT(slips[0] + slips[1], 1e-5) << c;
    }
}

TEST(SlipWeakening, OfCrossingPlanesOverAnEndlessDistanceIsCoulombToTheBit) {
  std::mt19937 random(13);
  const double endless = std::numeric_limits<double>::infinity();
  std::vector<JointSlip<3, double, Coulomb>::System> coulomb;
  std::vector<JointSlip<3, double, SlipWeakening>::System> weak;
  for (std::size_t n = 0; n < 3; ++n) {
    SlipSystem<3> system{{}, 0.3, 0, 100};
    system.normal[n] = 1;
    Traction<3, double> normal{system.normal[0], system.normal[1], system.normal[2]};
    coulomb.push_back({normal, constants_of<3, double>(system, 1)});
    system.law = FrictionLaw::slip_weakening;
    system.slip_distance_m = endless;
    weak.push_back({normal, constants_of<3, double>(system, 1)});
  }
  for (const auto correction : {SlipCorrection::first, SlipCorrection::second, SlipCorrection::exponential})
    for (const double c : {1e3, most_relaxation_pa}) {
      const double relaxation[] = {c, c, c};
      const bool shut[3] = {};
      double slips[3] = {};
      const JointSlip<3, double, Coulomb> one(correction, coulomb);
      const JointSlip<3, double, SlipWeakening> other(correction, weak);
      Stress<3, double> s, s_weak;
      for (int step = 0; step < 100; ++step) {
        for (auto& value : s.values) value += std::uniform_real_distribution<>(-900, 900)(random);
        s_weak = s;
        one.slip(s, s, {relaxation, shut});
        other.slip(s_weak, s_weak, {relaxation, shut, slips, 1e-9});
        ASSERT_EQ(s, s_weak);
        one.begin(s, s, {relaxation, shut});
        other.begin(s_weak, s_weak, {relaxation, shut, slips, 1e-9});
        ASSERT_EQ(s, s_weak);
      }
      EXPECT_GT(slips[0], 0);
    }
}

}  // namespace
}  // namespace slipwave::fracture_weakening_test
