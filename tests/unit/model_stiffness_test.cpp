// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <numbers>

#include "build/resample.hpp"
#include "geology/layers.hpp"
#include "model/model_netcdf.hpp"
#include "refusal.hpp"
#include "rock/anisotropy.hpp"
#include "rock/stiffness_input.hpp"
#include "scratch.hpp"

namespace slipwave::model_stiffness_test {
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
  tilts[Modulus::c15] = 9e9, tilts[Modulus::c35] = -9e9;
  EXPECT_EQ(told(tilts),
            "c55 is 6 GPa, expected more than 11.8087 GPa beside the constants of lower numbers, or some "
            "strain would cost no energy; raise it, or lower those that couple it to them");
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

/// Those of orthorhombic rock, and others by name.
GivenStiffness of_space(const std::vector<std::pair<Modulus, double>>& others) {
  auto given = of_plane(20.7e9, 5.2e9, 13.7e9, 3.7e9);
  given[Modulus::c66] = 5e9, given[Modulus::c22] = 22.6e9, given[Modulus::c44] = 4.6e9;
  given[Modulus::c12] = 8.3e9, given[Modulus::c23] = 5.5e9;
  for (const auto& [modulus, value] : others) given[modulus] = value;
  return given;
}

TEST(GivenStiffness, WithoutParametersIsKeptAsElasticConstants) {
  auto plane = of_plane(26e9, 9e9, 20e9, 6e9);
  plane[Modulus::c15] = 2.5e9, plane[Modulus::c35] = -2e9;
  EXPECT_EQ(refusal([&] { plane.check_kind(); }), "");
  EXPECT_FALSE(fault_of_stiffness(plane));
  const auto sheared = material_of_given(plane, 2300);
  ASSERT_TRUE(sheared.constants);
  EXPECT_EQ(sheared.tilt, 0);
  EXPECT_NEAR(sheared.vp, std::sqrt(20e9 / 2300), 1e-9);
  EXPECT_NEAR(sheared.vs, std::sqrt(6e9 / 2300), 1e-9);
  const Elasticity<2> wanted = {{{{26e9, 9e9, 2.5e9}, {9e9, 20e9, -2e9}, {2.5e9, -2e9, 6e9}}}};
  EXPECT_TRUE(elasticity_of<2>(sheared) == wanted);
  // Upright rock whose c13 no delta gives.
  plane[Modulus::c15] = plane[Modulus::c35] = 0, plane[Modulus::c13] = -9e9;
  EXPECT_FALSE(fault_of_stiffness(plane));
  EXPECT_TRUE(material_of_given(plane, 2300).constants);

  const auto any = of_space({{Modulus::c14, 0.7e9}, {Modulus::c56, 0.5e9}});
  EXPECT_EQ(refusal([&] { any.check_kind(); }), "");
  EXPECT_FALSE(fault_of_stiffness(any));
  const auto c = elasticity_of<3>(material_of_given(any, 2300));
  EXPECT_EQ(c(4, 1), 0.7e9);
  EXPECT_EQ(c(5, 6), 0.5e9);
  EXPECT_EQ(c(2, 3), 5.5e9);
  EXPECT_EQ(c(1, 6), 0);
}

TEST(GivenStiffness, OfAnyRockThatHasParametersHasThoseAlone) {
  auto plane = of_plane(26e9, 9e9, 20e9, 6e9);
  const auto upright = material_of_given(plane, 2300);
  plane[Modulus::c15] = plane[Modulus::c35] = 0;
  EXPECT_EQ(material_of_given(plane, 2300), upright);
  EXPECT_FALSE(upright.constants);
  EXPECT_EQ(material_of_given(of_space({{Modulus::c14, 0}, {Modulus::c15, 0}}), 2300),
            material_of_given(of_space({}), 2300));
}

TEST(GivenStiffness, OfAnyRockIsRefusedWhereStrainsCostNoEnergyOrSomeAreMissing) {
  const auto fault = fault_of_stiffness(of_space({{Modulus::c14, 11e9}}));
  ASSERT_TRUE(fault);
  EXPECT_EQ(fault->of, Modulus::c44);
  EXPECT_NE(fault->text.find("is 4.6 GPa, expected more than 7."), std::string::npos) << fault->text;
  auto missing = of_space({{Modulus::c14, 1e9}});
  missing[Modulus::c23] = {};
  EXPECT_EQ(refusal([&] { missing.check_kind(); }),
            "c23 is missing; rock with c14 to c56 has c22, c44, c12, c23 together");
  auto half = of_plane(26e9, 9e9, 20e9, 6e9);
  half[Modulus::c15] = half[Modulus::c35] = 1e9, half[Modulus::c66] = 7e9;
  EXPECT_EQ(refusal([&] { half.check_kind(); }),
            "found c15 and c35 with c66 alone, expected c22, c44, c12 and c23 of rock in 3-D, too");
  auto fluid = of_plane(2.25e9, 2.25e9, 2.25e9, 0);
  fluid[Modulus::c15] = 1e9, fluid[Modulus::c35] = 0;
  EXPECT_TRUE(fault_of_stiffness(fluid));
}

/// The textbook's Christoffel matrix of all constants, written out (Auld 1990).
SmallMatrix<3> written_out(const Elasticity<3>& c, const Point<3>& n) {
  const double xx = n[0] * n[0], yy = n[1] * n[1], zz = n[2] * n[2], yz = n[1] * n[2], xz = n[0] * n[2],
               xy = n[0] * n[1];
  const auto row = [&](const std::array<std::array<int, 2>, 3>& squares,
                       const std::array<std::array<int, 4>, 3>& products) {
    const auto product = [&](const std::array<int, 4>& of) { return c(of[0], of[1]) + c(of[2], of[3]); };
    return xx * c(squares[0][0], squares[0][1]) + yy * c(squares[1][0], squares[1][1]) +
           zz * c(squares[2][0], squares[2][1]) + yz * product(products[0]) + xz * product(products[1]) +
           xy * product(products[2]);
  };
  const double a = row({{{1, 1}, {6, 6}, {5, 5}}}, {{{5, 6, 5, 6}, {1, 5, 1, 5}, {1, 6, 1, 6}}}),
               b = row({{{6, 6}, {2, 2}, {4, 4}}}, {{{2, 4, 2, 4}, {4, 6, 4, 6}, {2, 6, 2, 6}}}),
               d = row({{{5, 5}, {4, 4}, {3, 3}}}, {{{3, 4, 3, 4}, {3, 5, 3, 5}, {4, 5, 4, 5}}}),
               ab = row({{{1, 6}, {2, 6}, {4, 5}}}, {{{4, 6, 2, 5}, {1, 4, 5, 6}, {1, 2, 6, 6}}}),
               ad = row({{{1, 5}, {4, 6}, {3, 5}}}, {{{4, 5, 3, 6}, {1, 3, 5, 5}, {1, 4, 5, 6}}}),
               bd = row({{{5, 6}, {2, 4}, {3, 4}}}, {{{4, 4, 2, 3}, {3, 6, 4, 5}, {2, 5, 4, 6}}});
  return {{{a, ab, ad}, {ab, b, bd}, {ad, bd, d}}};
}

// Proves (O3).
TEST(ElasticConstants, HaveTheSpeedsOfTheChristoffelEquation) {
  const auto given = of_space({{Modulus::c14, 0.7e9},
                               {Modulus::c15, -0.9e9},
                               {Modulus::c16, 0.6e9},
                               {Modulus::c24, -0.5e9},
                               {Modulus::c25, 0.4e9},
                               {Modulus::c26, -0.8e9},
                               {Modulus::c34, 0.9e9},
                               {Modulus::c35, -0.6e9},
                               {Modulus::c36, 0.3e9},
                               {Modulus::c45, 0.4e9},
                               {Modulus::c46, -0.3e9},
                               {Modulus::c56, 0.5e9}});
  const auto rock = material_of_given(given, 2300);
  const auto c = elasticity_of<3>(rock);
  const auto slowest = slowest_speeds<3>(rock);
  const double fastest = fastest_in_3d(rock);
  double least = fastest, least_p = fastest, most = 0;
  for (int tilt = 0; tilt <= 90; tilt += 3)
    for (int azimuth = 0; azimuth < 360; azimuth += 4) {
      const double t = tilt * std::numbers::pi / 180, a = azimuth * std::numbers::pi / 180;
      const Point<3> n = {std::sin(t) * std::cos(a), std::sin(t) * std::sin(a), std::cos(t)};
      const auto speeds = phase_speeds<3>(c, rock.rho, n);
      for (const double speed : speeds) {
        auto m = written_out(c, n);
        for (std::size_t i = 0; i < 3; ++i) m[i][i] -= rock.rho * speed * speed;
        const double determinant = m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
                                   m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
                                   m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
        EXPECT_NEAR(determinant, 0, 1e-9 * 20e9 * 20e9 * 20e9);
      }
      least = std::min(least, speeds[2]), least_p = std::min(least_p, speeds[0]);
      most = std::max(most, speeds[0]);
    }
  EXPECT_NEAR(slowest.s, least, 2e-3 * least);
  EXPECT_NEAR(slowest.p, least_p, 2e-3 * least_p);
  EXPECT_GE(fastest, most * (1 - 1e-9));
  EXPECT_NEAR(fastest, most, 2e-3 * most);
  EXPECT_EQ(fastest_p_speed<3>(rock), fastest);
  EXPECT_GE(fastest, fastest_along_grid(rock));
}

TEST(ElasticConstants, ThatDoNotGoWithTheRestOfAModelAreRefused) {
  const Grid<2> grid{{2, 1}, 10, {0, 0}};
  auto plane = of_plane(26e9, 9e9, 20e9, 6e9);
  plane[Modulus::c15] = 2.5e9, plane[Modulus::c35] = -2e9;
  const auto told = [&](Property property, float value, bool in_3d = false) {
    Model<2> model;
    model.medium = Medium<2>(grid);
    model.medium[Property::c33] = Field<2>(grid);
    complete_anisotropy(model.medium);
    put(model.medium, 0, {3000, 1600, 2300}), put(model.medium, 1, material_of_given(plane, 2300));
    if (!model.medium.has(property)) model.medium[property] = Field<2>(grid);
    model.medium[property][1] = value;
    return refusal([&] { check(model, {.in_3d = in_3d}); });
  };
  EXPECT_EQ(told(Property::rho, 2300), "");
  EXPECT_EQ(told(Property::vp, 3500), "c33 at x=15 z=5 is 20 GPa, expected 28.175 GPa as of rho vp^2");
  EXPECT_EQ(told(Property::vs, 0),
            "c11 at x=15 z=5 is 26 GPa, expected all elastic constants to be 0 in fluid");
  EXPECT_EQ(
      told(Property::tilt, 20),
      "tilt at x=15 z=5 is 20, expected 0 where elastic constants, which are along the axes of the grid, "
      "say what the rock is");
  EXPECT_EQ(told(Property::c11, -1e9F),
            "c11 at x=15 z=5 is -1 GPa, expected more than 0 GPa beside the constants of lower numbers, or "
            "some strain would cost no energy; raise it, or lower those that couple it to them");
  EXPECT_NE(told(Property::rho, 2300, true).find("c22 at x=15 z=5 is 0 GPa, expected more in 3-D"),
            std::string::npos);
}

TEST(ElasticConstants, AreLinearBetweenCellsAndSurviveAFile) {
  const Grid<2> grid{{2, 2}, 10, {0, 0}};
  auto plane = of_plane(26e9, 9e9, 20e9, 6e9);
  plane[Modulus::c15] = 2.5e9, plane[Modulus::c35] = -2e9;
  const auto sheared = material_of_given(plane, 2300);
  const Material rock = {2500, 1200, 2100};
  Model<2> model;
  model.medium = Medium<2>(grid);
  model.medium[Property::c33] = Field<2>(grid);
  complete_anisotropy(model.medium);
  for (const std::size_t cell : {0, 1, 2, 3}) put(model.medium, cell, cell < 2 ? rock : sheared);
  // Centres a quarter of an old cell off the old centres.
  const auto fine = resampled(model, 5, true, Extent::kept);
  const auto found = elasticity_of<2>(material_of(fine.medium, std::size_t(fine.grid().flat({1, 1}))));
  const auto one = elasticity_of<2>(rock), other = elasticity_of<2>(sheared);
  for (const auto& [m, n] : {std::pair{1, 1}, {1, 3}, {1, 5}, {3, 3}, {3, 5}, {5, 5}})
    EXPECT_NEAR(found(m, n), 0.75 * one(m, n) + 0.25 * other(m, n), 1e-6 * other(3, 3)) << m << n;
  EXPECT_EQ(material_of(fine.medium, 0), rock);
  EXPECT_EQ(refusal([&] { check(fine); }), "");
  // Means of larger cells are those of layers.
  const auto coarse = resampled(model, 20, true, Extent::kept);
  const auto mean = elasticity_of<2>(material_of(coarse.medium, 0));
  const double determinant = mean(3, 3) * mean(5, 5) - mean(3, 5) * mean(3, 5);
  EXPECT_NEAR(mean(5, 5) / determinant,
              (1 / one(3, 3) + other(5, 5) / (other(3, 3) * other(5, 5) - other(3, 5) * other(3, 5))) / 2,
              1e-6 / mean(3, 3));
  const Scratch scratch;
  const auto path = scratch.file("constants.nc");
  write_model(model, path);
  const auto read = read_model<2>(path);
  for (const auto property : model.medium.properties())
    EXPECT_TRUE(std::equal(read.medium[property].begin(), read.medium[property].end(),
                           model.medium[property].begin()));
  EXPECT_EQ(read.medium.properties(), model.medium.properties());
}

// Proves (O5a).
TEST(MaterialMean, OfPartsWithElasticConstantsIsThatOfLevelLayers) {
  const auto any = material_of_given(of_space({{Modulus::c14, 0.7e9},
                                               {Modulus::c15, -0.9e9},
                                               {Modulus::c34, 0.9e9},
                                               {Modulus::c35, -0.6e9},
                                               {Modulus::c36, 0.3e9},
                                               {Modulus::c45, 0.4e9},
                                               {Modulus::c26, -0.8e9}}),
                                     2300);
  Material tilted = {3000, 1600, 2200, 0.2, 0.1, 35, 0.15}, plain = {2500, 1200, 2100};
  tilted.azimuth = 40;
  MaterialMean mean(plain, true);
  const std::pair<Material, double> parts[] = {{any, 0.3}, {tilted, 0.5}, {plain, 0.2}};
  for (const auto& [rock, share] : parts) mean.add(rock, share);
  const auto found = mean.mean();
  EXPECT_NEAR(found.rho, 0.3 * 2300 + 0.5 * 2200 + 0.2 * 2100, 1e-9);
  const auto c = elasticity_of<3>(found);
  // All layers have the stresses zz, yz and xz and the strains xx, yy and xy; the others differ.
  const std::array<std::size_t, 6> shared = {2, 3, 4, 0, 1, 5};
  for (const std::size_t one : shared) {
    std::array<double, 6> strain{}, stress{};
    for (const auto& [rock, share] : parts) {
      const auto of = elasticity_of<3>(rock).voigt;
      // Unknown are all of both; the shared ones are given.
      SmallMatrix<12> equations{};
      std::array<double, 12> right{};
      for (std::size_t i = 0; i < 6; ++i) {
        for (std::size_t k = 0; k < 6; ++k) equations[i][k] = of[i][k] / 1e10;
        equations[i][6 + i] = -1;
        equations[6 + i][(i < 3 ? 6 : 0) + shared[i]] = 1;
        right[6 + i] = shared[i] == one ? 1 : 0;
      }
      const auto both = solved(equations, right);
      for (std::size_t i = 0; i < 6; ++i) strain[i] += share * both[i], stress[i] += share * both[6 + i];
    }
    for (std::size_t i = 0; i < 6; ++i)
      EXPECT_NEAR(dot_product(c.voigt[i], strain), 1e10 * stress[i], 1e-9 * 1e10) << one << i;
  }
}

TEST(Layers, OfElasticConstantsMeetInCellsAsLevelLayers) {
  const Grid<2> grid{{3, 4}, 10, {0, 0}};
  const std::vector<Layer> layers = {
      parse_layer("0:2500:1200:2100"),
      parse_layer("15:-:-:2300 c11=26 c13=9 c15=2.5 c33=20 c35=-2 c55=6", InputUnits::parse("GPa"))};
  const auto medium = layered_medium(grid, layers, Average::tilted);
  EXPECT_FALSE(medium.has(Property::c22));
  EXPECT_FALSE(has_constants(medium, 0));
  EXPECT_EQ(material_of(medium, 0), (Material{2500, 1200, 2100}));
  EXPECT_EQ(medium[Property::c33][9], 20e9F);
  const auto mixed = elasticity_of<2>(material_of(medium, 3));
  // Compliances across the layers add up.
  const auto soft = elasticity_of<2>(Material{2500, 1200, 2100}), hard = elasticity_of<2>(layers[1].material);
  const auto across = [](const Elasticity<2>& c) {
    return inverse_of(SmallMatrix<2>{{{c(3, 3), c(3, 5)}, {c(3, 5), c(5, 5)}}});
  };
  const auto wanted = times(sum_of(across(soft), across(hard)), 0.5), found = across(mixed);
  for (std::size_t i = 0; i < 2; ++i)
    for (std::size_t k = 0; k < 2; ++k) EXPECT_NEAR(found[i][k], wanted[i][k], 1e-6 * wanted[0][0]);
  EXPECT_NE(refusal([&] {
              parse_layer("0:-:-:2300 c11=26e9 c13=9e9 c15=2e9 c33=20e9 c35=-2e9 c55=6e9 tilt=20");
            }).find("found both stiffnesses and tilt"),
            std::string::npos);
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
  EXPECT_NEAR(medium_of_stiffness<2>(given, rho).vp[1], std::sqrt(20e9 / 2300), 1e-3);
  (*given[std::size_t(Modulus::c13)])[1] = 23e9F;
  EXPECT_EQ(
      refusal([&] { medium_of_stiffness<2>(given, rho); }),
      "c13 at x=15 z=5 is 23 GPa, expected less than 22.8035 GPa in size: c11 c33 must be more than its "
      "square, or the rock would give energy");
  rho[1] = 0;  // void
  EXPECT_TRUE(medium_of_stiffness<2>(given, rho).is_void(1));
}

TEST(MediumOfStiffness, HasElasticConstantsOnlyWhereNoParametersSayIt) {
  const Grid<2> grid{{2, 1}, 10, {0, 0}};
  std::array<std::optional<Field<2>>, modulus_count> given;
  for (const auto& [modulus, value] : {std::pair{Modulus::c11, 26e9F},
                                       {Modulus::c13, 9e9F},
                                       {Modulus::c33, 20e9F},
                                       {Modulus::c55, 6e9F},
                                       {Modulus::c15, 0.F},
                                       {Modulus::c35, 0.F}})
    given[std::size_t(modulus)] = Field<2>(grid, value);
  const Field<2> rho(grid, 2300);
  EXPECT_FALSE(medium_of_stiffness<2>(given, rho).has(Property::c33));
  (*given[std::size_t(Modulus::c15)])[1] = 2e9F;
  const auto one = medium_of_stiffness<2>(given, rho);
  EXPECT_FALSE(has_constants(one, 0));
  EXPECT_NE(one[Property::epsilon][0], 0);
  ASSERT_TRUE(has_constants(one, 1));
  EXPECT_FALSE(one.has(Property::c22));
  EXPECT_EQ(elasticity_of<2>(material_of(one, 1))(1, 5), 2e9);
  (*given[std::size_t(Modulus::c15)])[0] = 2e9F;
  EXPECT_FALSE(medium_of_stiffness<2>(given, rho).has(Property::epsilon));
}

}  // namespace
}  // namespace slipwave::model_stiffness_test
