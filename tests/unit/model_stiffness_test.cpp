// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <numbers>

#include "geology/layers.hpp"
#include "refusal.hpp"
#include "rock/anisotropy.hpp"
#include "rock/stiffness_input.hpp"

namespace slipwave {
namespace {

GivenStiffness of_plane(double c11, double c13, double c33, double c55) {
  GivenStiffness given;
  given[Modulus::c11] = c11, given[Modulus::c13] = c13, given[Modulus::c33] = c33, given[Modulus::c55] = c55;
  return given;
}

TEST(GivenStiffness, MakesTheRockThatHasIt) {
  const Material shale{3000, 1600, 2300, 0.2, 0.1};
  const auto c = upright_elasticity<2>(shale);
  const auto found = material_of_given(of_plane(c(1, 1), c(1, 3), c(3, 3), c(5, 5)), 2300);
  EXPECT_NEAR(found.vp, 3000, 1e-6);
  EXPECT_NEAR(found.vs, 1600, 1e-6);
  EXPECT_NEAR(found.epsilon, 0.2, 1e-9);
  EXPECT_NEAR(found.delta, 0.1, 1e-9);
  EXPECT_EQ(found.tilt, 0);
  // Fluid, and rock whose stiffnesses are those of isotropic rock but for the rounding of floats.
  EXPECT_EQ(material_of_given(of_plane(2.25e9, 2.25e9, 2.25e9, 0), 1000), (Material{1500, 0, 1000}));
  const auto isotropic = material_of_given(of_plane(20e9, 8e9 * (1 + 1e-8), 20e9 * (1 - 1e-8), 6e9), 2000);
  EXPECT_FALSE(isotropic.is_anisotropic_in_3d());
}

// Proves (O9).
TEST(GivenStiffness, OfAPlaneFindsItsAxes) {
  for (const double dip : {-80., -30., 12., 45., 70., 90.})
    for (const double delta : {0.1, -0.1, 0.18}) {
      const auto c = elasticity_of<2>({3000, 1600, 2300, 0.18, delta, dip});
      auto given = of_plane(c(1, 1), c(1, 3), c(3, 3), c(5, 5));
      given[Modulus::c15] = c(1, 5), given[Modulus::c35] = c(3, 5);
      EXPECT_FALSE(fault_of_stiffness(given));
      const auto found = elasticity_of<2>(material_of_given(given, 2300));
      EXPECT_NEAR(found(1, 1), c(1, 1), 1e-6 * c(3, 3)) << dip;
      EXPECT_NEAR(found(1, 3), c(1, 3), 1e-6 * c(3, 3)) << dip;
      EXPECT_NEAR(found(1, 5), c(1, 5), 1e-6 * c(3, 3)) << dip;
      EXPECT_NEAR(found(3, 5), c(3, 5), 1e-6 * c(3, 3)) << dip;
      EXPECT_NEAR(found(5, 5), c(5, 5), 1e-6 * c(3, 3)) << dip;
    }
}

TEST(GivenStiffness, ThatNoRockHasIsRefused) {
  const auto told = [](const GivenStiffness& given) {
    const auto fault = fault_of_stiffness(given);
    return fault ? modulus_names()[std::size_t(fault->of)] + " " + fault->text : "";
  };
  EXPECT_EQ(told(of_plane(26e9, 9e9, 20e9, 6e9)), "");
  EXPECT_EQ(
      told(of_plane(26e9, 23e9, 20e9, 6e9)),
      "c13 is 23 GPa, expected less than 22.8035 GPa in size: c11 c33 must be more than its square, or the "
      "rock would give energy");
  EXPECT_EQ(told(of_plane(26e9, -9e9, 20e9, 6e9)),
            "c13 is -9 GPa, expected at least -6 GPa, that is minus the shear modulus of its plane");
  EXPECT_EQ(told(of_plane(26e9, 9e9, 5e9, 6e9)),
            "c33 is 5 GPa, expected more than c55 = 6 GPa, or P waves would be slower than S waves");
  EXPECT_EQ(told(of_plane(26, 9, 20, 6)),
            "c33 is 2e-08 GPa, expected at least 0.001 GPa; if the numbers are in GPa, use --units GPa");
  EXPECT_EQ(told(of_plane(2.3e9, 2.25e9, 2.25e9, 0)),
            "c11 is 2.3 GPa, expected c33 = 2.25 GPa in fluid, where c55 is 0");
  auto tilts = of_plane(26e9, 9e9, 20e9, 6e9);
  tilts[Modulus::c15] = 2e9, tilts[Modulus::c35] = -2e9;
  EXPECT_NE(told(tilts).find("c15 is 2 GPa, expected "), std::string::npos);
  auto deep = of_plane(26e9, 9e9, 20e9, 6e9);
  deep[Modulus::c66] = 22e9;
  EXPECT_EQ(told(deep),
            "c66 is 22 GPa, expected less than 21.95 GPa: (c11 - c66) c33 must be more than c13^2, or the "
            "rock would "
            "give energy");
  deep[Modulus::c66] = 8e9, deep[Modulus::c22] = 28e9, deep[Modulus::c44] = 7e9, deep[Modulus::c12] = 9e9;
  deep[Modulus::c23] = 24e9;
  EXPECT_NE(told(deep).find("c23 is 24 GPa, expected less than 23.66"), std::string::npos);
  deep[Modulus::c23] = 9e9;
  EXPECT_EQ(told(deep), "");
  EXPECT_EQ(refusal([&] { deep.check_kind(); }), "");
  deep[Modulus::c44] = {};
  EXPECT_EQ(refusal([&] { deep.check_kind(); }),
            "c44 is missing; orthorhombic rock has c22, c44, c12, c23 together");
}

TEST(Layers, OfStiffnessesAreThoseOfSpeeds) {
  const auto layer =
      parse_layer("100:-:-:2300 c11=28.98e9 c13=10.6e9 c33=20.7e9 c55=5.888e9 c66=7.6544e9 qp=50");
  EXPECT_NEAR(layer.material.vp, 3000, 1e-6);
  EXPECT_NEAR(layer.material.vs, 1600, 1e-6);
  EXPECT_NEAR(layer.value(Property::epsilon), 0.2, 1e-9);
  EXPECT_NEAR(layer.value(Property::gamma), 0.15, 1e-9);
  EXPECT_EQ(layer.value(Property::qp), 50);
  EXPECT_EQ(parse_layer("0:-:-:2300 c11=26 c13=9 c33=20 c55=6", InputUnits::parse("GPa")).material,
            parse_layer("0:-:-:2300 c11=26e9 c13=9e9 c33=20e9 c55=6e9").material);
  const auto told = [](const std::string& text) { return refusal([&] { parse_layer(text); }); };
  EXPECT_NE(
      told("0:3000:1600:2300 c11=26e9").find("found both speeds and stiffnesses, expected - for VP and VS"),
      std::string::npos);
  EXPECT_NE(told("0:-:-:2300").find("expected speeds, or stiffnesses"), std::string::npos);
  EXPECT_NE(told("0:-:-:2300 c11=26e9").find("c13 is missing; stiffnesses are c11, c13, c33, c55 together"),
            std::string::npos);
  EXPECT_NE(told("0:-:-:2300 c11=26e9 c13=9e9 c33=20e9 c55=6e9 epsilon=1")
                .find("found both stiffnesses and epsilon"),
            std::string::npos);
}

TEST(MediumOfStiffness, NamesTheCellAtFault) {
  const Grid<2> grid{{2, 1}, 10, {0, 0}};
  std::array<std::optional<Field<2>>, modulus_count> given;
  for (const auto& [modulus, value] :
       {std::pair{Modulus::c11, 26e9F}, {Modulus::c13, 9e9F}, {Modulus::c33, 20e9F}, {Modulus::c55, 6e9F}})
    given[std::size_t(modulus)] = Field<2>(grid, value);
  Field<2> rho(grid, 2300);
  EXPECT_NEAR(medium_of_stiffness(given, rho).vp[1], std::sqrt(20e9 / 2300), 1e-3);
  (*given[std::size_t(Modulus::c13)])[1] = 23e9F;
  EXPECT_EQ(
      refusal([&] { medium_of_stiffness(given, rho); }),
      "c13 at x=15 z=5 is 23 GPa, expected less than 22.8035 GPa in size: c11 c33 must be more than its "
      "square, or the rock would give energy");
  rho[1] = 0;  // void
  EXPECT_TRUE(medium_of_stiffness(given, rho).is_void(1));
}

}  // namespace
}  // namespace slipwave
