// SPDX-License-Identifier: BSD-3-Clause
// What the slip corrections must hold whatever the numbers: symmetry, invariance, energy.
#include "fracture_slip_cases.hpp"

namespace slipwave::fracture_slip_law_test {
namespace {

TYPED_TEST_SUITE(SlipLaw, SlipCases);

// Proves (S1).
TYPED_TEST(SlipLaw, TurnsWithTheFrame) {
  constexpr int D = TypeParam::D;
  using Real = typename TypeParam::Real;
  for (int trial = 0; trial < 50; ++trial) {
    const auto q = random_rotation<D>(this->random);
    Matrix<D, Real> r;
    for (int i = 0; i < D; ++i)
      for (int j = 0; j < D; ++j) r[i][j] = Real(q[i][j]);
    const auto n = this->any_normal();
    Traction<D, Real> n_turned{};
    for (int i = 0; i < D; ++i)
      for (int j = 0; j < D; ++j) n_turned[i] += r[i][j] * n[j];
    typename TestFixture::Memory memory{}, memory_turned{};
    auto s = this->any_stress();
    auto s_turned = rotated<D, Real>(r, s);
    for (int step = 0; step < 5; ++step) {
      const auto load = this->any_stress(3e4);
      const auto load_turned = rotated<D, Real>(r, load);
      for (int k = 0; k < s.components; ++k) {
        s.values[k] += load.values[k];
        s_turned.values[k] += load_turned.values[k];
      }
      s = this->after(s, {Real(0.2), Real(3e3)}, n, Real(2e-4), memory);
      s_turned = this->after(s_turned, {Real(0.2), Real(3e3)}, n_turned, Real(2e-4), memory_turned);
      this->expect_near(rotated<D, Real>(r, s), s_turned, 200 * this->eps * 1e5);
    }
  }
}

// Proves (S4).
TYPED_TEST(SlipLaw, LeavesNormalStressAndWhatDoesNotShearThePlanesAlone) {
  constexpr int D = TypeParam::D;
  using Real = typename TypeParam::Real;
  for (int trial = 0; trial < 50; ++trial) {
    // In the frame of the planes (axis 0 along n) only the components (0, j) may change.
    const auto q = random_rotation<D>(this->random);
    Matrix<D, Real> r;
    Traction<D, Real> n;
    for (int i = 0; i < D; ++i)
      for (int j = 0; j < D; ++j) r[i][j] = Real(q[i][j]);
    for (int j = 0; j < D; ++j) n[j] = r[0][j];
    const auto s = this->any_stress();
    const auto before = rotated<D, Real>(r, s);
    const auto after = rotated<D, Real>(r, this->after(s, {Real(0.1), 0}, n, Real(1e-6)));
    EXPECT_NEAR(before(0, 0), after(0, 0), 20 * this->eps * 1e5);
    for (int i = 1; i < D; ++i)
      for (int j = i; j < D; ++j) EXPECT_NEAR(before(i, j), after(i, j), 20 * this->eps * 1e5);
  }
}

// Proves (S4).
TYPED_TEST(SlipLaw, HoldsNormalStressOverManySlippingSteps) {
  using Real = typename TypeParam::Real;
  const auto n = this->any_normal();
  typename TestFixture::Memory memory{};
  auto s = this->any_stress();
  s(0, 0) -= Real(3e5);
  const double before = normal_stress(n, s);
  auto load = s;
  for (int k = 0; k < load.components; ++k) load.values[k] = 0;
  // A pure shear load of the planes: m perpendicular to n.
  Traction<TypeParam::D, Real> m{};
  m[0] = -n[1], m[1] = n[0];
  for (int i = 0; i < TypeParam::D; ++i)
    for (int j = i; j < TypeParam::D; ++j) load(i, j) = Real(1e3) * (n[i] * m[j] + m[i] * n[j]);
  const int steps = 5000;
  for (int step = 0; step < steps; ++step) {
    for (int k = 0; k < load.components; ++k) s.values[k] += load.values[k];
    s = this->after(s, {Real(0.1), 0}, n, Real(1e-5), memory);
  }
  // Without slip tau would be 5e6 Pa. Rounding of the additions alone walks by sqrt(steps) eps |s|, at worst
  // steps eps |s|.
  EXPECT_LT(shear_magnitude(n, s), 5e5);
  EXPECT_NEAR(normal_stress(n, s), before, 0.1 * steps * this->eps * 4e5);
}

TYPED_TEST(SlipLaw, IsOddInTheShearDirection) {
  constexpr int D = TypeParam::D;
  using Real = typename TypeParam::Real;
  Traction<D, Real> n{};
  n[D - 1] = 1;
  typename TestFixture::Memory memory{}, memory_mirrored{};
  typename TestFixture::Cell s{}, mirrored{};
  for (int step = 0; step < 20; ++step) {
    const auto load = this->any_stress(5e4);
    for (int i = 0; i < D; ++i)
      for (int j = i; j < D; ++j) {
        const int sign = (i == D - 1) != (j == D - 1) ? -1 : 1;
        s(i, j) += load(i, j);
        mirrored(i, j) += Real(sign) * load(i, j);
      }
    s = this->after(s, {Real(0.3), Real(1e3)}, n, Real(1e-4), memory);
    mirrored = this->after(mirrored, {Real(0.3), Real(1e3)}, n, Real(1e-4), memory_mirrored);
    for (int i = 0; i < D; ++i)
      for (int j = i; j < D; ++j) {
        const int sign = (i == D - 1) != (j == D - 1) ? -1 : 1;
        EXPECT_EQ(s(i, j), Real(sign) * mirrored(i, j));
      }
  }
}

// Proves (S1).
TYPED_TEST(SlipLaw, DoesNotCareWhichSideTheNormalPointsTo) {
  using Real = typename TypeParam::Real;
  const auto n = this->any_normal();
  auto opposite = n;
  for (auto& component : opposite) component = -component;
  const auto s = this->any_stress();
  EXPECT_EQ(this->after(s, {Real(0.2), Real(10)}, n, Real(1e-4)),
            this->after(s, {Real(0.2), Real(10)}, opposite, Real(1e-4)));
}

TYPED_TEST(SlipLaw, DryFrictionKnowsNoUnit) {
  // With eta = 0 and no cohesion the law is homogeneous: stress in other units, the same answer in those
  // units.
  using Real = typename TypeParam::Real;
  const auto n = this->any_normal();
  const auto s = this->any_stress();
  const auto expected = this->after(s, {Real(0.1), Real(0)}, n, Real(0));
  for (const double unit : {1e-30, 1e-20, 1e20, 1e30}) {
    auto scaled = s;
    for (auto& value : scaled.values) value *= Real(unit);
    const auto found = this->after(scaled, {Real(0.1), Real(0)}, n, Real(0));
    for (int k = 0; k < s.components; ++k)
      EXPECT_NEAR(found.values[k] / unit, expected.values[k], 20 * this->eps * 1e5) << unit;
  }
}

// Proves (S7), (S10).
TYPED_TEST(SlipLaw, NeverAddsEnergy) {
  // The shear traction enters the elastic energy as |tau|^2/(2 mu), apart from all that slip leaves alone.
  using Real = typename TypeParam::Real;
  for (const double d : {0., 1e-6, 1e-4, 1e-2}) {
    const auto n = this->any_normal();
    typename TestFixture::Memory memory{};
    typename TestFixture::Cell s{};
    int slipped = 0;
    for (int step = 0; step < 1000; ++step) {
      const auto load = this->any_stress(5e4);  // reverses all the time
      for (int k = 0; k < s.components; ++k) s.values[k] = Real(0.8) * s.values[k] + load.values[k];
      const double before = shear_magnitude(n, s);
      s = this->after(s, {Real(0.3), Real(1e3)}, n, Real(d), memory);
      const double after = shear_magnitude(n, s);
      ASSERT_LE(after, before + 20 * this->eps * 1e5);
      slipped += after < before;
      begin<typename TypeParam::Correction, TypeParam::D, Real>({Real(0.3), Real(1e3)}, n, d, s, memory);
      ASSERT_LE(shear_magnitude(n, s), after + 20 * this->eps * 1e5);
    }
    EXPECT_GT(slipped, 300);
  }
}

}  // namespace
}  // namespace slipwave::fracture_slip_law_test
