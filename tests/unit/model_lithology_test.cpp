// SPDX-License-Identifier: BSD-3-Clause
#include "geology/lithology.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace slipwave::model_lithology_test {
namespace {

double bulk_of(const Material& m) { return m.rho * (m.vp * m.vp - 4. / 3 * m.vs * m.vs); }
double shear_of(const Material& m) { return m.rho * m.vs * m.vs; }

/// Sand of a dry frame, full of a fluid: Gassmann's relation the other way round,
/// K = Kd + (1 - Kd/K0)^2 / (phi/Kf + (1 - phi)/K0 - Kd/K0^2).
Material saturated_frame(double porosity, double dry_bulk, double shear, const Fluid& fluid) {
  const double grain = 36.6e9, rest = 1 - dry_bulk / grain;
  const double bulk =
      dry_bulk +
      rest * rest / (porosity / fluid.bulk_modulus_pa + (1 - porosity) / grain - dry_bulk / (grain * grain));
  const double rho = (1 - porosity) * 2650 + porosity * fluid.rho;
  return {std::sqrt((bulk + 4. / 3 * shear) / rho), std::sqrt(shear / rho), rho};
}

}  // namespace

TEST(Lithology, FollowsThePublishedLines) {
  // The mud-rock line is usually written vp = 1.16 vs + 1.36 km/s.
  EXPECT_NEAR(1.16 * vs_of(Lithology::shale, 2520) + 1360, 2520, 1);
  EXPECT_NEAR(vs_of(Lithology::sand, 3000), 0.80416 * 3000 - 855.9, 1e-9);
  EXPECT_NEAR(vs_of(Lithology::limestone, 4000), 1000 * (-0.05508 * 16 + 1.0168 * 4 - 1.0305), 1e-9);
  EXPECT_NEAR(density_of(Lithology::shale, 1000), 1750, 1e-9);
  EXPECT_NEAR(density_of(Lithology::sand, 3000), 1660 * std::exp(0.261 * std::log(3.)), 1e-9);
  EXPECT_NEAR(density_of(Lithology::limestone, 4000), 1359 * std::exp(0.386 * std::log(4.)), 1e-9);
  EXPECT_EQ(density_of(Lithology::evaporite, 4500), 2140);
}

TEST(Lithology, KeepsAllRockPhysical) {
  for (double vp = 1500; vp < 6500; vp += 50) {
    for (const auto rock : {Lithology::shale, Lithology::sand, Lithology::limestone, Lithology::evaporite}) {
      const auto material = brine_saturated(rock, vp);
      EXPECT_GE(material.vs, vp / 5);
      EXPECT_LE(material.vs, vp / std::sqrt(2.)) << vp;
      for (const auto& fluid : {oil, gas}) {
        const auto filled = with_fluid(brine_saturated(Lithology::sand, vp), fluid);
        EXPECT_LE(filled.vs, filled.vp / std::sqrt(2.)) << vp;
      }
    }
  }
}

TEST(FluidSubstitution, IsGassmannsRelation) {
  for (const double porosity : {0.1, 0.2, 0.35}) {
    const double dry = 9e9 * (0.4 - porosity) / 0.4 + 1e9, shear = 0.9 * dry;
    const auto sand = saturated_frame(porosity, dry, shear, brine);
    for (const auto& fluid : {oil, gas}) {
      const auto found = with_fluid(sand, fluid), expected = saturated_frame(porosity, dry, shear, fluid);
      EXPECT_NEAR(found.vp, expected.vp, 1e-6) << porosity;
      EXPECT_NEAR(found.vs, expected.vs, 1e-6) << porosity;
      EXPECT_NEAR(found.rho, expected.rho, 1e-9) << porosity;
    }
  }
}

TEST(FluidSubstitution, OfBrineByBrineChangesNothing) {
  const auto sand = brine_saturated(Lithology::sand, 2800), same = with_fluid(sand, brine);
  EXPECT_NEAR(same.vp, sand.vp, 1e-9);
  EXPECT_NEAR(same.vs, sand.vs, 1e-9);
  EXPECT_EQ(same.rho, sand.rho);
}

TEST(FluidSubstitution, LowersVpAndVpOverVsFromBrineToOilToGas) {
  const auto sand = brine_saturated(Lithology::sand, 2400);
  const auto with_oil = with_fluid(sand, oil), with_gas = with_fluid(sand, gas);
  EXPECT_LT(with_oil.vp, sand.vp);
  EXPECT_LT(with_gas.vp, with_oil.vp);
  EXPECT_LT(with_gas.vp / with_gas.vs, with_oil.vp / with_oil.vs);
  EXPECT_NEAR(shear_of(with_gas), shear_of(sand), 1e-3);
  EXPECT_LT(bulk_of(with_gas), bulk_of(with_oil));
}

}  // namespace slipwave::model_lithology_test
