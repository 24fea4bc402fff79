// SPDX-License-Identifier: BSD-3-Clause
// Several slip systems in one cell, planes that open, and the functions slip is solved with.
#include <gtest/gtest.h>

#include <random>

#include "fracture_slip_cell.hpp"

namespace slipwave::fracture_block_test {
namespace {

template <class Real>
class Smooth : public testing::Test {};
using Reals = testing::Types<float, double>;
TYPED_TEST_SUITE(Smooth, Reals);

TYPED_TEST(Smooth, DecayAndLogarithmAreThoseOfTheLibrary) {
  const double eps = std::numeric_limits<TypeParam>::epsilon();
  for (double x = 1e-12; x < 80; x *= 1.01) {
    const auto rounded = TypeParam(x);
    const double exact = std::exp(-double(rounded));
    const auto decay = smooth::decay(rounded);
    EXPECT_NEAR(decay.left, exact, 4 * eps * exact) << x;
    const double lost = -std::expm1(-double(rounded));
    EXPECT_NEAR(decay.lost, lost, 4 * eps * lost) << x;
    const double logarithm = std::log1p(double(rounded));
    EXPECT_NEAR(smooth::logarithm_of_one_more(rounded), logarithm, 4 * eps * logarithm) << x;
    if (rounded >= smooth::near_zero<TypeParam>) continue;
    const double mean = lost / double(rounded);
    EXPECT_NEAR(decay.mean, mean, 4 * eps * mean) << x;
  }
  EXPECT_EQ(smooth::decay(TypeParam(0)).left, 1);
  EXPECT_LT(smooth::decay(TypeParam(1e30)).left, 1e-37);
}

// Proves (S11).
TEST(Block, TwoSystemsShareTheLoadAsTheirRuleSays) {
  // |tau| + c_a (|tau|/S_a - 1)_+ + c_b (|tau|/S_b - 1)_+ = |tau_e|, whatever the strengths.
  std::mt19937 random(3);
  const auto any = [&](double low, double high) {
    return std::exp(std::uniform_real_distribution<>(std::log(low), std::log(high))(random));
  };
  for (int trial = 0; trial < 10000; ++trial) {
    const double size = any(1, 1e6), a = any(1, 1e6), b = any(1, 1e6), c_a = any(1e-2, 1e8),
                 c_b = any(1e-2, 1e8);
    double loss_b;
    const double tau = slip::relaxed_by_two(size, a, b, c_a, c_b, loss_b);
    const double sum = tau + c_a * std::max(tau / a - 1, 0.) + c_b * std::max(tau / b - 1, 0.);
    // What rounding of tau does to the sum.
    const double rounding = tau * 1e-15 * (1 + c_a / a + c_b / b);
    EXPECT_NEAR(sum, size, 1e-12 * size + 10 * rounding);
    EXPECT_NEAR(loss_b, c_b * std::max(tau / b - 1, 0.), 1e-12 * size + 10 * rounding);
  }
  double loss_b;
  EXPECT_EQ(slip::relaxed_by_two(5., 0., 3., 1., 1., loss_b), 0);
  EXPECT_EQ(slip::relaxed_by_two(5., 3., 2., most_relaxation_pa, most_relaxation_pa, loss_b), 2);
  EXPECT_EQ(slip::relaxed_by_two(5., 7., 6., 1., 1., loss_b), 5);
}

template <int D>
JointSlip<D, double, Coulomb> blocks(SlipCorrection correction, const std::vector<double>& strengths) {
  std::vector<typename JointSlip<D, double, Coulomb>::System> systems;
  for (std::size_t n = 0; n < strengths.size(); ++n) {
    systems.push_back({{}, {.cohesion_pa = strengths[n]}});
    systems.back().normal[n] = 1;
  }
  return {correction, systems};
}

// Proves (S34).
TEST(JointSlip, OfPlanesAskewInTheirRockHoldsTheStrengthUnderTheNormalStressItLeaves) {
  // Slip changes the normal stress, too, by kappa of what it takes off the traction.
  const Traction<2, double> normal{0.6, 0.8};
  const double friction = 0.2;
  for (const auto correction : {SlipCorrection::first, SlipCorrection::second})
    for (const double kappa : {0., 0.4, -0.4}) {
      const JointSlip<2, double, Coulomb> dry(correction, {{normal, {.friction = friction}}});
      // n tau + tau n with tau along (-n_z, n_x), and kappa n n.
      PlaneResponse<2, double> response;
      response.stress.values = {-2 * 0.48 + kappa * 0.36, 2 * 0.48 + kappa * 0.64,
                                0.36 - 0.64 + kappa * 0.48};
      const double relaxation[] = {most_relaxation_pa};
      const bool shut[] = {false};
      Stress<2, double> s, plain;
      s.values = plain.values = {-900, -500, -700};
      dry.slip(s, s, {relaxation, shut, nullptr, 0, &response});
      dry.slip(plain, plain, {relaxation, shut});
      Traction<2, double> tau;
      const double s_n = resolve<2, double>(normal, s, tau);
      EXPECT_NEAR((length<2, double>(tau)), friction * -s_n, 1e-3) << kappa;
      for (std::size_t c = 0; c < 3 && kappa == 0; ++c) EXPECT_NEAR(s.values[c], plain.values[c], 1e-9);
      if (kappa != 0) {
        EXPECT_GT(std::abs(s.values[0] - plain.values[0]), 1);
      }
    }
}

// Proves (S34a).
TEST(JointSlip, OfPlanesAskewInSpaceSolvesTheImplicitRule) {
  // Slip along what is left of the traction, g = (|tau|/S - 1) tau/(eta |tau|), takes another share of itself
  // off the traction along each of two directions: tau_e - tau = dt M g.
  const double strength = 300, shares[] = {1, 0.6};
  PlaneResponse<3, double> response;
  response.along = {{{0.6, 0.8, 0}, {-0.8, 0.6, 0}}};
  response.share = {shares[0], shares[1]};
  const Traction<3, double> normal{0, 0, 1};
  for (std::size_t k = 0; k < 2; ++k) {
    add_shear<3, double>(response.stress[k], 1, response.along[k], normal);
    response.stress[k](0, 1) = 0.2;
  }
  const bool shut[] = {false};
  const auto resolved = [&](const Stress<3, double>& s) {
    Traction<3, double> tau;
    resolve<3, double>(normal, s, tau);
    return response.components(tau);
  };
  std::mt19937 random(5);
  for (const double relaxation : {20., 400., 1e5, double(most_relaxation_pa)})
    for (int trial = 0; trial < 20; ++trial) {
      const JointSlip<3, double, Coulomb> joint(SlipCorrection::first, {{normal, {.cohesion_pa = strength}}});
      Stress<3, double> s;
      for (auto& value : s.values) value = std::uniform_real_distribution<>(-2000, 2000)(random);
      const auto before = s;
      joint.slip(s, s, {&relaxation, shut, nullptr, 0, &response});
      const auto elastic = resolved(before), left = resolved(s);
      const double size = std::hypot(left[0], left[1]), all = std::hypot(elastic[0], elastic[1]);
      if (all < strength) {
        EXPECT_EQ(s.values, before.values);
        continue;
      }
      if (relaxation > 1e20) {
        // Dry friction; slip still is along the traction.
        EXPECT_NEAR(size, strength, 1e-9 * strength);
        EXPECT_NEAR((elastic[0] - left[0]) / left[0] * shares[1], (elastic[1] - left[1]) / left[1],
                    1e-9 * all / strength);
        continue;
      }
      for (std::size_t k = 0; k < 2; ++k)
        EXPECT_NEAR(elastic[k] - left[k], shares[k] * relaxation * (size / strength - 1) * left[k] / size,
                    1e-9 * all)
            << relaxation;
      EXPECT_NEAR(s(0, 1) - before(0, 1), 0.2 * (left[0] - elastic[0]) + 0.2 * (left[1] - elastic[1]),
                  1e-9 * all);
    }
}

// Proves (S12).
TEST(JointSlip, OfTwoSystemsIsTheClosedForm) {
  const auto pair = blocks<2>(SlipCorrection::first, {300, 700});
  const bool shut[2] = {};
  for (const double relaxation : {10., 1e3, 1e5}) {
    const double relaxations[2] = {relaxation, 2 * relaxation};
    Stress<2, double> s;
    s(0, 1) = 2000;
    pair.slip(s, s, {relaxations, shut});
    double loss_b;
    EXPECT_NEAR(s(0, 1), slip::relaxed_by_two(2000., 300., 700., relaxation, 2 * relaxation, loss_b), 2)
        << relaxation;
  }
}

// Proves (S12).
TEST(JointSlip, OfThreeSystemsInSpaceSolvesTheImplicitRule) {
  // s_ij + sum over the systems k = i, j of s_ij G_k/|tau_k| = the elastic s_ij, G_k = c_k (|tau_k|/S_k -
  // 1)_+.
  const double strengths[] = {300, 500, 800}, relaxations[] = {200, 400, 300};
  const bool shut[3] = {};
  const auto joint = blocks<3>(SlipCorrection::first, {300, 500, 800});
  std::mt19937 random(5);
  for (int trial = 0; trial < 100; ++trial) {
    Stress<3, double> s;
    for (auto& value : s.values) value = std::uniform_real_distribution<>(-2000, 2000)(random);
    const auto elastic = s;
    joint.slip(s, s, {relaxations, shut});
    double rate[3];
    for (int k = 0; k < 3; ++k) {
      const double tau = std::hypot(s(k, (k + 1) % 3), s(k, (k + 2) % 3));
      rate[k] = relaxations[k] * std::max(tau / strengths[k] - 1, 0.) / tau;
    }
    for (int i = 0; i < 3; ++i) {
      EXPECT_EQ(s(i, i), elastic(i, i));
      for (int j = i + 1; j < 3; ++j)
        EXPECT_NEAR(s(i, j) * (1 + rate[i] + rate[j]), elastic(i, j), 1e-3 * std::abs(elastic(i, j)) + 1);
    }
  }
}

double size_of(const Stress<3, double>& s) {
  double sum = 0;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) sum += s(i, j) * s(i, j);
  return sum;
}

// Proves (S12).
TEST(JointSlip, NeverAddsEnergyAndObeysDryFriction) {
  const bool shut[3] = {};
  std::mt19937 random(9);
  for (const auto correction : {SlipCorrection::first, SlipCorrection::second, SlipCorrection::exponential})
    for (const double relaxation : {1e-3, 10., 1e3, 1e6, most_relaxation_pa}) {
      const auto joint = blocks<3>(correction, {300, 500, 800});
      const double relaxations[] = {relaxation, relaxation, relaxation};
      Stress<3, double> s;
      for (int step = 0; step < 300; ++step) {
        for (auto& value : s.values)
          value = 0.8 * value + std::uniform_real_distribution<>(-900, 900)(random);
        const double before = size_of(s);
        joint.slip(s, s, {relaxations, shut});
        const double after = size_of(s);
        ASSERT_LE(after, before * (1 + 1e-14));
        for (int k = 0; k < 3 && relaxation == most_relaxation_pa; ++k) {
          const double strength = k == 0 ? 300 : k == 1 ? 500 : 800;
          ASSERT_LE(std::hypot(s(k, (k + 1) % 3), s(k, (k + 2) % 3)), strength * (1 + 1e-12));
        }
        joint.begin(s, s, {relaxations, shut});
        ASSERT_LE(size_of(s), after * (1 + 1e-14));
      }
    }
}

// Proves (S11).
TEST(PairKernel, IsTheSameForEitherOrderOfItsSystems) {
  for (const auto correction : {SlipCorrection::first, SlipCorrection::second}) {
    const std::vector<SlipSystem<2>> one = {{{0.6, 0.8}, 0.3, 0, 10}, {{-0.8, 0.6}, 0.1, 0, 50}};
    const std::vector<SlipSystem<2>> other = {one[1], one[0]};
    const auto kernels = solver::slip_kernels<double>({2, 2, correction});
    const auto run = [&](const std::vector<SlipSystem<2>>& systems, double relaxation_a,
                         double relaxation_b) {
      Stress<2, double> s{{-500, -900, 400}};
      const auto planes = solver::planes_of<2, double>(systems);
      const solver::SlipRows<double> rows = {s.values.data(),
                                             1,
                                             {&relaxation_a, &relaxation_b},
                                             nullptr,
                                             0,
                                             nullptr,
                                             0,
                                             {nullptr, nullptr},
                                             {nullptr, nullptr},
                                             nullptr};
      kernels.slip(1, planes, rows);
      kernels.begin(1, planes, rows);
      return s;
    };
    const auto a = run(one, 100, 300), b = run(other, 300, 100);
    EXPECT_LT(a(0, 1), 400);
    for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(a.values[c], b.values[c], 1e-10);
  }
}

// Proves (S13).
TEST(Gap, PartsPlanesUnderTensionAndRemembersHowFar) {
  // n along x: pulled by a strain of 2e-6, then pushed back by 5e-6.
  const double lambda = 1e10, modulus = 3e10;
  const auto planes = solver::planes_of<2, double>({{{1, 0}, 0.5, 0, 0}});
  const auto open = solver::gap_kernel<double>(2);
  Stress<2, double> s;
  double gap = 0, prestress = 0;
  const auto strain = [&](double e) {
    s(0, 0) += modulus * e;
    s(1, 1) += lambda * e;
    open(1, planes, 0, {s.values.data(), 1, &gap, &lambda, &modulus, &prestress});
  };
  strain(2e-6);
  EXPECT_NEAR(s(0, 0), 0, 1e-9);
  EXPECT_NEAR(s(1, 1), 0, 1e-9);
  EXPECT_NEAR(gap, 2e-6, 1e-18);
  strain(-1e-6);
  EXPECT_NEAR(s(0, 0), 0, 1e-9);
  EXPECT_NEAR(gap, 1e-6, 1e-18);
  strain(-4e-6);
  EXPECT_EQ(gap, 0);
  EXPECT_NEAR(s(0, 0), -modulus * 3e-6, 1e-6);
  EXPECT_NEAR(s(1, 1), -lambda * 3e-6, 1e-6);
}

}  // namespace
}  // namespace slipwave::fracture_block_test
