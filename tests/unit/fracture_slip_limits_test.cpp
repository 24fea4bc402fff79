// SPDX-License-Identifier: BSD-3-Clause
// Slip at the ends of the range of its constants: dry, rigid, open, absurd.
#include "fracture_slip_cases.hpp"

namespace slipwave::fracture_slip_limits_test {
namespace {

template <class Case>
class SlipLimits : public SlipLaw<Case> {};
TYPED_TEST_SUITE(SlipLimits, SlipCases);

// Proves (S2), (S7).
TYPED_TEST(SlipLimits, WithoutViscosityIsDryCoulombFriction) {
  using Real = typename TypeParam::Real;
  for (const double eta : {0., 1e-300}) {
    const auto n = this->any_normal();
    const double d = slip_d(eta, 1e10, 1e-3);
    typename TestFixture::Memory memory{};
    typename TestFixture::Cell s{};
    for (int step = 0; step < 200; ++step) {
      const auto load = this->any_stress(2e4);
      for (int k = 0; k < s.components; ++k) s.values[k] += load.values[k];
      const double before = shear_magnitude(n, s);
      const double strength = 0.3 * std::max(-double(normal_stress(n, s)), 0.) + 1e3;
      s = this->after(s, {Real(0.3), Real(1e3)}, n, d, memory);
      ASSERT_NEAR(shear_magnitude(n, s), std::min(before, strength), 20 * this->eps * 2e5);
    }
  }
}

TYPED_TEST(SlipLimits, UnderEndlessViscosityDoesNotSlip) {
  using Real = typename TypeParam::Real;
  for (const double eta : {1e22, 1e300, 1.7e308}) {
    const auto n = this->any_normal();
    const auto s = this->any_stress();
    this->expect_near(this->after(s, {Real(0.3), Real(1)}, n, slip_d(eta, 1e10, 1e-3)), s,
                      8 * this->eps * 1e5);
  }
}

TYPED_TEST(SlipLimits, LeavesNoShearOnPlanesWithoutStrength) {
  for (const double eta : {0., 1e-300, 1., 1e300}) {
    const auto n = this->any_normal();
    const auto s = this->after(this->any_stress(), {0, 0}, n, slip_d(eta, 1e10, 1e-3));
    EXPECT_LT(shear_magnitude(n, s), 10 * this->eps * 1e5) << eta;
  }
}

// Proves (S2).
TYPED_TEST(SlipLimits, TreatsAnOpenPlaneAsOneWithoutFriction) {
  using Real = typename TypeParam::Real;
  Traction<TypeParam::D, Real> n{};
  n[0] = 1;
  typename TestFixture::Cell s{};
  s(0, 0) = 1e5;
  s(0, 1) = 3e4;
  s = this->after(s, {Real(0.5), 0}, n, Real(1e-3));
  EXPECT_EQ(s(0, 0), Real(1e5));
  EXPECT_EQ(s(0, 1), Real(0));
}

TYPED_TEST(SlipLimits, LeavesStressBelowTheStrengthAloneToTheLastBit) {
  using Real = typename TypeParam::Real;
  const auto n = this->any_normal();
  const auto s = this->any_stress();
  EXPECT_EQ(this->after(s, {0, Real(1e6)}, n, Real(1e-4)), s);
}

// Proves (S4).
TYPED_TEST(SlipLimits, KeepsAllNumbersFinite) {
  using Real = typename TypeParam::Real;
  for (const double eta : {0., 1e-300, 1e-30, 1., 1e30, 1e300})
    for (const double mu : {0., 1e-300, 1e10, 1e300})
      for (const double dt : {0., 1e-300, 1e-3})
        for (const double size : {0., 1e-42, 1e-25, 1., 1e5, 1e15})
          for (const double cohesion : {0., 1e-40, 1e-15, 1e5, 1e30}) {
            const double d = slip_d(eta, mu, dt);
            ASSERT_TRUE(std::isfinite(slip::relaxation_pa(eta, mu, dt)));
            const auto n = this->any_normal();
            typename TestFixture::Memory memory{};
            auto s = this->any_stress(size);
            for (int step = 0; step < 3; ++step)
              s = this->after(s, {Real(0.1), Real(cohesion)}, n, d, memory);
            for (const auto v : s.values)
              ASSERT_TRUE(std::isfinite(v))
                  << eta << ' ' << mu << ' ' << dt << ' ' << size << ' ' << cohesion;
          }
}

TEST(RelaxationStress, IsWhatAStepOfSlipTakesOffAtTwiceTheStrength) {
  EXPECT_DOUBLE_EQ(slip::relaxation_pa(3.8e3, 1.2656e10, 1e-3), 1.2656e7 / 3.8e3);
  EXPECT_EQ(slip::relaxation_pa(0, 0, 0), most_relaxation_pa);
  EXPECT_EQ(slip::relaxation_pa(1, 0, 1e-3), 0);
  EXPECT_EQ(slip::relaxation_pa(1e-300, 1e10, 1e-3), most_relaxation_pa);
}

// Proves (S7).
TEST(SecondOrderSlip, DoesNotRingWhereTheStepIsMuchLongerThanTheRelaxation) {
  // Under a steadily growing load of strong planes tau - S must stay R t_r; the plain trapezoidal rule leaves
  // a start-up error that changes its sign at every step and hardly decays.
  const SlipStrength<double> law{0, 1e4};
  const double d = 1e-8, load = 5e3;  // d S = 1e-4
  Stress<2, double> s;
  SecondOrder::Memory<2, double> memory{};
  for (int step = 0; step < 50; ++step) {
    begin<SecondOrder, 2, double>(law, {1, 0}, d, s, memory);
    s(0, 1) += load;
    correct<SecondOrder, 2, double>(law, {1, 0}, d, s, memory);
    if (step > 3) {
      ASSERT_NEAR(s(0, 1), 1e4 + d * 1e4 * load, 1e-3 * d * 1e4 * load);
    }
  }
}

}  // namespace
}  // namespace slipwave::fracture_slip_limits_test
