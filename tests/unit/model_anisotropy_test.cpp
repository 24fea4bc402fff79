// SPDX-License-Identifier: BSD-3-Clause
#include "rock/anisotropy.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <random>
#include <string>

#include "build/import.hpp"
#include "geology/layers.hpp"
#include "model/fracture.hpp"
#include "model/model.hpp"
#include "model/model_report.hpp"
#include "refusal.hpp"
#include "rock/coefficients.hpp"
#include "rock/relations.hpp"
#include "scene/anisotropy_check.hpp"

namespace slipwave::model_anisotropy_test {
namespace {

const Material shale{3000, 1600, 2300, 0.2, 0.1}, crossed{3200, 1700, 2400, -0.05, 0.2},
    rock{2500, 1200, 2100};

Model<2> one_cell(const Material& of) {
  const Grid<2> grid{{1, 1}, 5, {0, 0}};
  Model<2> model;
  model.medium = Medium<2>(grid);
  model.medium[Property::epsilon] = model.medium[Property::delta] = Field<2>(grid);
  put(model.medium, 0, of);
  return model;
}

// Proves (V2).
TEST(Stiffness, IsThatOfThomsen) {
  for (const auto& of : {shale, crossed}) {
    const auto c = upright_elasticity<2>(of);
    const double c11 = c(1, 1), c13 = c(1, 3), c33 = c(3, 3), c55 = c(5, 5);
    EXPECT_DOUBLE_EQ(c33, of.rho * of.vp * of.vp);
    EXPECT_DOUBLE_EQ(c55, of.rho * of.vs * of.vs);
    // Thomsen (1986), eqs. 8a and 17.
    EXPECT_NEAR((c11 - c33) / (2 * c33), of.epsilon, 1e-12);
    EXPECT_NEAR((std::pow(c13 + c55, 2) - std::pow(c33 - c55, 2)) / (2 * c33 * (c33 - c55)), of.delta, 1e-12);
    const auto back = material_of(c, of.rho);
    EXPECT_NEAR(back.vp, of.vp, 1e-9);
    EXPECT_NEAR(back.vs, of.vs, 1e-9);
    EXPECT_NEAR(back.epsilon, of.epsilon, 1e-12);
    EXPECT_NEAR(back.delta, of.delta, 1e-12);
  }
  const auto isotropic = upright_elasticity<2>(rock);
  EXPECT_EQ(isotropic(1, 1), isotropic(3, 3));
  EXPECT_EQ(isotropic(1, 3), isotropic(3, 3) - 2 * isotropic(5, 5));
}

// Proves (V3).
TEST(PhaseSpeeds, AreRootsOfTheChristoffelEquation) {
  for (const auto& of : {shale, crossed, rock})
    for (const double degrees : {0., 17., 45., 71., 90.}) {
      const double angle = degrees * std::numbers::pi / 180, x = std::sin(angle), z = std::cos(angle);
      const auto c = upright_elasticity<2>(of);
      const auto speeds = phase_speeds<2>(c, of.rho, {x, z});
      EXPECT_GT(speeds[0], speeds[1]);
      for (const double speed : speeds) {
        const double inertia = of.rho * speed * speed;
        const double xx = c(1, 1) * x * x + c(5, 5) * z * z - inertia,
                     zz = c(5, 5) * x * x + c(3, 3) * z * z - inertia, xz = (c(1, 3) + c(5, 5)) * x * z;
        EXPECT_NEAR((xx * zz - xz * xz) / (c(3, 3) * c(3, 3)), 0, 1e-12);
      }
    }
  // Where anisotropy is weak: Thomsen's eqs. 16a, 16b.
  const Material weak{3000, 1500, 2300, 0.02, 0.01};
  const double angle = 0.7, s = std::pow(std::sin(angle), 2), c = 1 - s;
  const auto speeds =
      phase_speeds<2>(upright_elasticity<2>(weak), weak.rho, {std::sin(angle), std::cos(angle)});
  EXPECT_NEAR(speeds[0], 3000 * (1 + 0.01 * s * c + 0.02 * s * s), 1);
  EXPECT_NEAR(speeds[1], 1500 * (1 + 4 * 0.01 * s * c), 1);
}

// Proves (V3).
TEST(PhaseSpeeds, AreSlowestAndFastestInSomeDirection) {
  // Along the vertical, and where delta is above epsilon on the way to the horizontal.
  EXPECT_NEAR(slowest_speeds<2>(shale).p, 3000, 1e-9);
  EXPECT_NEAR(slowest_speeds<2>(shale).s, 1600, 1e-9);
  EXPECT_NEAR(fastest_p_speed<2>(shale), 3000 * std::sqrt(1.4), 1e-6);
  EXPECT_LT(slowest_speeds<2>(crossed).s, 1500);
  EXPECT_GT(fastest_p_speed<2>(crossed), 3250);
  const auto slow = in_slowest_directions(one_cell(crossed).medium);
  EXPECT_EQ(anisotropic_cells(slow), 0);
  EXPECT_FLOAT_EQ(slow.vs[0], float(slowest_speeds<2>(material_of(one_cell(crossed).medium, 0)).s));
}

// Proves (V1).
TEST(Coefficients, AreThoseOfTheAxis) {
  const auto medium = one_cell(shale).medium;
  EXPECT_NEAR(wave_speed(medium, 0, 0, wave_p), 3000 * std::sqrt(1.4), 1e-3);
  EXPECT_EQ(wave_speed(medium, 0, 1, wave_p), 3000);
  EXPECT_EQ(wave_speed(medium, 0, 0, wave_s), 1600);
  EXPECT_NEAR(fastest_speed(medium), 3000 * std::sqrt(1.4), 1e-3);
}

/// Flat layers of equal strain along x and equal stress across, solved by themselves.
Elasticity<2> of_layers(const std::vector<Material>& parts) {
  // Of exx and szz in all layers: the mean of sxx and ezz.
  const auto means = [&](double exx, double szz) {
    double sxx = 0, ezz = 0;
    for (const auto& part : parts) {
      const auto c = upright_elasticity<2>(part);
      const double strain = (szz - c(1, 3) * exx) / c(3, 3);
      sxx += (c(1, 1) * exx + c(1, 3) * strain) / double(parts.size());
      ezz += strain / double(parts.size());
    }
    return std::array{sxx, ezz};
  };
  const auto pressed = means(0, 1), stretched = means(1, 0);
  const double c33 = 1 / pressed[1], c13 = c33 * pressed[0], c11 = stretched[0] - c13 * stretched[1];
  double compliance = 0;
  for (const auto& part : parts) compliance += 1 / (part.rho * part.vs * part.vs) / double(parts.size());
  return vertical_symmetry(c11, c13, c33, 1 / compliance);
}

// Proves (V5).
TEST(MaterialMean, OfAnisotropicPartsIsThatOfFlatLayers) {
  for (const auto& parts : {std::vector{shale, rock}, {crossed, shale, rock}}) {
    MaterialMean mean(parts[0]);
    for (const auto& part : parts) EXPECT_TRUE(mean.add(part, 2));
    const auto found = upright_elasticity<2>(mean.mean()), wanted = of_layers(parts);
    EXPECT_NEAR(found(1, 1), wanted(1, 1), 1e-9 * wanted(1, 1));
    EXPECT_NEAR(found(1, 3), wanted(1, 3), 1e-9 * wanted(1, 1));
    EXPECT_NEAR(found(3, 3), wanted(3, 3), 1e-9 * wanted(1, 1));
    EXPECT_NEAR(found(5, 5), wanted(5, 5), 1e-9 * wanted(1, 1));
  }
  // Speeds along the vertical are those that isotropic parts of the same speeds have.
  MaterialMean isotropic(rock), anisotropic(rock);
  isotropic.add(rock, 1), isotropic.add({shale.vp, shale.vs, shale.rho}, 1);
  anisotropic.add(rock, 1), anisotropic.add(shale, 1);
  EXPECT_NEAR(anisotropic.mean().vp, isotropic.mean().vp, 1e-9);
  EXPECT_NEAR(anisotropic.mean().vs, isotropic.mean().vs, 1e-9);
  EXPECT_FALSE(isotropic.mean().is_anisotropic());
}

TEST(LayeredMedium, HasTheAnisotropyOfItsLayers) {
  const auto grid = grid_of_size<2>({10, 40}, 10);
  const auto medium = layered_medium(
      grid, {parse_layer("0:1500:0:1000"), parse_layer("10:3000:1600:2300 epsilon=0.2 delta=0.1"),
             parse_layer("25:2500:1200:2100")});
  EXPECT_EQ(medium[Property::epsilon][0], 0);
  EXPECT_FLOAT_EQ(medium[Property::epsilon][1], 0.2F);
  EXPECT_FLOAT_EQ(medium[Property::delta][1], 0.1F);
  MaterialMean mean(shale);
  mean.add(shale, 1), mean.add(rock, 1);
  EXPECT_FLOAT_EQ(medium[Property::epsilon][2], float(mean.mean().epsilon));
  EXPECT_FLOAT_EQ(medium[Property::delta][2], float(mean.mean().delta));
  EXPECT_EQ(medium[Property::epsilon][3], 0);
  // One is enough; means of cells have both.
  EXPECT_TRUE(layered_medium(grid, {parse_layer("0:3000:1600:2300 epsilon=0.2")}).has(Property::delta));
}

TEST(ImportedConstants, OfAnisotropyAreThoseOfSolids) {
  const Grid<2> grid{{2, 1}, 5, {0, 0}};
  Medium<2> medium(grid);
  put(medium, 0, {1500, 0, 1000}), put(medium, 1, rock);
  add_constant(medium, Property::epsilon, 0.2);
  EXPECT_EQ(medium[Property::epsilon][0], 0);
  EXPECT_FLOAT_EQ(medium[Property::epsilon][1], 0.2F);
  EXPECT_TRUE(medium.has(Property::delta));
}

// Proves (V2).
TEST(ModelCheck, RefusesAnisotropyThatNoRockHas) {
  const auto told = [](const Material& of) { return refusal([&] { check(one_cell(of)); }); };
  EXPECT_EQ(told(shale), "");
  EXPECT_EQ(told({3000, 1600, 2300, 0.2, -0.4}),
            "delta at x=2.5 z=2.5 is -0.4, expected at least -(1 - (vs/vp)^2)/2 = -0.3578 with vp 3000 and "
            "vs 1600");
  EXPECT_EQ(
      told({3000, 1600, 2300, -0.45, 0.1}),
      "epsilon at x=2.5 z=2.5 is -0.45, expected above -0.3622 with a delta of 0.1: c11 c33 must be more "
      "than c13^2, or the rock would give energy; raise epsilon or lower delta");
  EXPECT_EQ(told({1500, 0, 1000, 0.1, 0}),
            "epsilon at x=2.5 z=2.5 is 0.1, expected 0 in fluid, which is isotropic; set it to 0 or vs above "
            "0 there");
  EXPECT_EQ(told({3000, 1600, 2300, -0.6, 0}),
            "epsilon at x=2.5 z=2.5 is -0.6, expected a finite number from -0.5 to 20");
}

TEST(ModelEffect, OfAnisotropyCanBeTakenOut) {
  auto model = one_cell(shale);
  remove_effect(model, model_effect_named("anisotropy"));
  EXPECT_FALSE(model.medium.has(Property::epsilon));
  EXPECT_FALSE(model.medium.has(Property::delta));
}

TEST(ModelReport, SaysTheSlowestSpeedOfAllDirections) {
  // Of SV waves where vp and the vertical vs are 3000 and 1500 m/s: at 45 degrees (V3) is
  // 2 rho c^2 = (c11 + c33)/2 + c55 - sqrt(((c11 - c33)/2)^2 + (c13 + c55)^2), in units of rho of c33 = 9.
  const double c11 = 9 * 0.8, c33 = 9, c55 = 2.25,
               coupled = std::sqrt(2 * c33 * (c33 - c55) * 0.2 + 6.75 * 6.75);
  const double at_45 = 1000 * std::sqrt(((c11 + c33) / 2 + c55 - std::hypot((c11 - c33) / 2, coupled)) / 2);
  const auto report = report_of(one_cell({3000, 1500, 2200, -0.1, 0.2})).lines();
  const std::string name = "slowest wave";
  const auto place = report.find(name);
  ASSERT_NE(place, std::string::npos);
  const double said = std::stod(report.substr(place + name.size()));
  EXPECT_LE(said, at_45);
  EXPECT_GT(said, 0.98 * at_45);
}

Scene<2> scene_of(const Material& of) {
  Scene<2> scene;
  scene.model = one_cell(of);
  scene.survey.sources = {{{2.5, 2.5}, parse_mechanism<2>("explosion"), parse_wavelet("ricker:20"), 1}};
  return scene;
}

// Proves (S34b).
TEST(SceneCheck, RefusesWhatDoesNotGoWithAnisotropy) {
  const auto told = [](const Scene<2>& scene) { return refusal([&] { check_anisotropy(scene); }); };
  EXPECT_EQ(told(scene_of(shale)), "");
  auto plane = scene_of(shale);
  plane.survey.sources[0].mechanism = parse_mechanism<2>("plane:20");
  EXPECT_EQ(told(plane), "");
  auto lossy = scene_of(shale);
  lossy.model.medium[Property::qs] = Field<2>(lossy.model.grid(), 40);
  set_attenuation(lossy);
  EXPECT_EQ(told(lossy), "");
  auto cracked = scene_of(shale);
  cracked.model.fracture = Field<2, std::uint8_t>(cracked.model.grid(), 1);
  cracked.model.fracture_sets = {{"upright", {{{1, 0}, 0.5, 0, 0}}}};
  EXPECT_EQ(told(cracked), "");
  cracked.model.fracture_sets = {{"oblique", {{{0.6, 0.8}, 0.5, 0, 0}}}};
  EXPECT_EQ(told(cracked), "");
  auto& system = cracked.model.fracture_sets[0].systems[0];
  system.compliance = {1e-12, 1e-12, 0, 0, 1};
  EXPECT_EQ(told(cracked),
            "the cell at x=2.5 z=2.5 is anisotropic (epsilon 0.2, delta 0.1) and the planes of its fracture "
            "set 'oblique' are springs that slide or have dashpots and lie askew to the axes of rock, "
            "expected along both or in isotropic rock; use --without slip or --without anisotropy");
  system.law = FrictionLaw::none;
  EXPECT_EQ(told(cracked), "");
  system.compliance = {1e-12, 1e-12, 1e3, 1e3, 1};
  EXPECT_NE(told(cracked).find("slide or have dashpots and lie askew"), std::string::npos);
  system.normal = {0, 1};
  EXPECT_EQ(told(cracked), "");
  cracked.model.medium[Property::tilt] = Field<2>(cracked.model.grid(), 20);
  EXPECT_NE(told(cracked).find("have dashpots in rock whose axes are tilted, expected axes along the grid"),
            std::string::npos);
  system.opens = true;
  EXPECT_NE(told(cracked).find("open, expected closed ones; use --without opening"), std::string::npos);
  cracked.with_slip = false;
  EXPECT_EQ(told(cracked), "");
}

// Proves (O5), (S34b).
TEST(SceneCheck, RefusesWhatDoesNotGoWithAnisotropyInThreeDimensions) {
  Scene<3> deep;
  const auto told = [&] { return refusal([&] { check_anisotropy(deep); }); };
  deep.model.medium = extruded(one_cell(shale).medium, 5);
  deep.survey.sources = {{{2.5, 2.5, 2.5}, parse_mechanism<3>("explosion"), parse_wavelet("ricker:20"), 1}};
  EXPECT_EQ(told(), "");
  deep.model.fracture = Field<3, std::uint8_t>(deep.model.grid(), 1);
  deep.model.fracture_sets = {{"level", {{{0, 0, 1}, 0.5, 0, 0}}}};
  EXPECT_EQ(told(), "");
  deep.model.fracture_sets = {{"upright", {{{1, 0, 0}, 0.5, 0, 0}}}};
  EXPECT_EQ(told(), "");
  auto& system = deep.model.fracture_sets[0].systems[0];
  system.compliance = {1e-12, 1e-12, 0, 0, 1};
  const std::string of =
      "the cell at x=2.5 y=2.5 z=2.5 is anisotropic (epsilon 0.2, delta 0.1, gamma 0) and ";
  const std::string expected =
      ", expected one level family in rock of level beds with gamma2 = gamma, or isotropic rock; use "
      "--without "
      "slip or --without anisotropy";
  const std::string springs_that = "the planes of its fracture set 'upright' are springs ";
  EXPECT_EQ(told(), of + springs_that + "that slide or have dashpots" + expected);
  system.law = FrictionLaw::none;
  EXPECT_EQ(told(), "");
  system.compliance = {1e-12, 1e-12, 1e3, 1e3, 1};
  EXPECT_EQ(told(), of + springs_that + "that slide or have dashpots" + expected);
  system.compliance = {1e-12, 1e-12, 0, 0, 1};
  deep.model.fracture_sets[0].traces = {{{0, 0, 1}, {5, 0, 1}, {5, 5, 4}, {0, 5, 4}}};
  EXPECT_EQ(told(), of + springs_that +
                        "of single fractures, expected isotropic rock; use --without slip or --without "
                        "anisotropy");
  deep.model.fracture_sets[0].traces = {};
  system.law = FrictionLaw::coulomb;
  system.normal = {0, 0, 1};
  EXPECT_EQ(told(), "");
  auto& sets = deep.model.fracture_sets;
  sets = {{"both", {{{1, 0, 0}, 0.5, 0, 0}, {{0, 0, 1}, 0.5, 0, 0}}}};
  EXPECT_EQ(told(), "");
  set_friction_law(sets[0].systems[1], "slip-weakening:0.1:0.01");
  EXPECT_EQ(told(), of + "the planes of its fracture set 'both' cross and weaken with slip" + expected);
  sets = {{"level", {{{0, 0, 1}, 0.5, 0, 0}}}};
  deep.model.medium[Property::tilt] = Field<3>(deep.model.grid(), 30);
  deep.model.medium[Property::azimuth] = Field<3>(deep.model.grid(), 40);
  EXPECT_EQ(told(), "");
  sets[0].systems[0].opens = true;
  EXPECT_NE(
      told().find("(epsilon 0.2, delta 0.1, gamma 0, tilt 30, azimuth 40) and the planes of its fracture "
                  "set 'level' open, expected closed ones; use --without opening"),
      std::string::npos);
  deep.with_slip = false;
  EXPECT_EQ(told(), "");
  deep.numerics.monotone = true;
  deep.survey.receivers_m = {{2.5, 2.5, 2.5}};
  deep.recording = {{Component::vz}, 0.01, 0.001};
  EXPECT_EQ(refusal([&] { check(deep); }),
            "found --monotone in a model with rock whose axes are tilted, expected axes along the grid; use "
            "--without anisotropy");
}

/// Vosges-like orthorhombic rock: stiffnesses over density that Schoenberg and Helbig (1997) give for cracked
/// shale.
const auto cracked = orthorhombic({9, 9.84, 5.9375, 2, 1.6, 2.182, 3.6, 2.25, 2.4});

// Proves (O2).
TEST(StiffnessInSpace, IsThatOfThomsenAndTsvankin) {
  // As Tsvankin (1997, table 1) has them of that rock.
  const auto of = material_of(cracked, 1);
  EXPECT_NEAR(of.vp, 2.437, 5e-4);
  EXPECT_NEAR(of.vs, 1.265, 5e-4);
  EXPECT_NEAR(of.epsilon, 0.258, 5e-4);
  EXPECT_NEAR(of.delta, -0.078, 6e-4);
  EXPECT_NEAR(of.gamma, 0.182, 5e-4);
  ASSERT_TRUE(of.orthorhombic);
  EXPECT_NEAR(of.orthorhombic->epsilon1, 0.329, 5e-4);
  EXPECT_NEAR(of.orthorhombic->delta1, 0.083, 6e-4);
  EXPECT_NEAR(of.orthorhombic->delta3, -0.106, 5e-4);
  EXPECT_NEAR(of.orthorhombic->gamma2, 0.0455, 5e-4);
  const auto back = upright_elasticity<3>(of);
  for (int one = 0; one < 3; ++one)
    for (int other = 0; other < 3; ++other) {
      EXPECT_NEAR(back(one, one, other, other), cracked(one, one, other, other), 1e-12);
      if (one == other) continue;
      EXPECT_NEAR(back(one, other, one, other), cracked(one, other, one, other), 1e-12);
    }
  // Rock that is alike in all horizontal directions, and isotropic rock.
  auto layered = shale;
  layered.gamma = 0.15;
  const auto c = upright_elasticity<3>(layered);
  EXPECT_NEAR(c(6, 6), 1.3 * c(5, 5), 1);
  EXPECT_NEAR(c(1, 2), c(1, 1) - 2 * c(6, 6), 1);
  EXPECT_FALSE(material_of(c, layered.rho).orthorhombic);
  EXPECT_EQ(upright_elasticity<3>(rock)(1, 2), upright_elasticity<2>(rock)(1, 3));
}

// Proves (F16).
TEST(PhaseSpeedsInSpace, AreFastestInSomeDirection) {
  std::mt19937 engine(5);
  std::uniform_real_distribution<double> uniform(-0.3, 0.6);
  for (int n = 0; n < 12; ++n) {
    Material rock{3000, 1600, 2300, uniform(engine), uniform(engine), 0, uniform(engine)};
    if (n % 2) rock.orthorhombic = Orthorhombic{uniform(engine), uniform(engine), 0.3 * uniform(engine), 0.1};
    if (fault_of_anisotropy(rock, true)) continue;
    rock.tilt = 30, rock.azimuth = 50;
    const auto stiffness = elasticity_of<3>(rock);
    double fastest = 0;
    for (int ring = 0; ring <= 90; ++ring)
      for (int around = 0; around < 180; ++around) {
        const double t = ring * std::numbers::pi / 180, a = around * std::numbers::pi / 90;
        const Point<3> direction = {std::sin(t) * std::cos(a), std::sin(t) * std::sin(a), std::cos(t)};
        fastest = std::max(fastest, phase_speeds<3>(stiffness, rock.rho, direction)[0]);
      }
    EXPECT_GE(fastest_in_3d(rock), fastest * (1 - 1e-9)) << n;
    // Of other rock it is a bound.
    EXPECT_NEAR(fastest_in_3d(rock), fastest, (rock.orthorhombic ? 2e-4 : 0.2) * fastest) << n;
    EXPECT_GE(fastest_in_3d(rock), fastest_along_grid(rock));
  }
}

// Proves (O3).
TEST(PhaseSpeedsInSpace, AreRootsOfTheChristoffelEquation) {
  // In its planes of symmetry those of (V3), and the shear across them.
  const double angle = 0.6, s = std::sin(angle), c = std::cos(angle);
  const auto along_x = phase_speeds<3>(cracked, 1, {s, 0, c});
  const auto plane = phase_speeds<2>(
      vertical_symmetry(cracked(1, 1), cracked(1, 3), cracked(3, 3), cracked(5, 5)), 1, {s, c});
  std::array<double, 3> wanted = {plane[0], plane[1],
                                  std::sqrt(cracked(6, 6) * s * s + cracked(4, 4) * c * c)};
  std::sort(wanted.begin(), wanted.end(), std::greater());
  for (const std::size_t n : {0, 1, 2}) EXPECT_NEAR(along_x[n], wanted[n], 1e-9);
  // Anywhere: the determinant of the matrix less rho c^2 vanishes.
  const std::array<double, 3> n = {0.48, 0.6, 0.64};
  const auto speeds = phase_speeds<3>(cracked, 1, n);
  for (const double speed : speeds) {
    std::array<std::array<double, 3>, 3> m{};
    for (int i = 0; i < 3; ++i)
      for (int k = 0; k < 3; ++k) {
        auto& of = m[std::size_t(i)][std::size_t(k)];
        const double both = n[std::size_t(i)] * n[std::size_t(k)];
        of = (cracked(i, i, k, k) + (i == k ? 0 : cracked(i, k, i, k))) * both;
        for (int j = 0; i == k && j < 3; ++j)
          if (j != i) of += cracked(i, j, i, j) * n[std::size_t(j)] * n[std::size_t(j)];
        if (i == k) of -= speed * speed;
      }
    const double determinant = m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[1][2]) -
                               m[0][1] * (m[0][1] * m[2][2] - m[1][2] * m[0][2]) +
                               m[0][2] * (m[0][1] * m[1][2] - m[1][1] * m[0][2]);
    EXPECT_NEAR(determinant, 0, 1e-9);
  }
  const auto material = material_of(cracked, 1);
  EXPECT_LE(slowest_speeds<3>(material).s, std::min(speeds[2], std::sqrt(cracked(5, 5))));
  EXPECT_GE(fastest_p_speed<3>(material), std::sqrt(cracked(2, 2)) - 1e-9);
}

// Proves (O3).
TEST(BackwardGroupVelocity, InSpaceIsThatOfThePlanesOfSymmetry) {
  for (const int axis : {0, 1})
    EXPECT_NEAR(backward_group_velocity(upright_elasticity<3>(crossed), 2 * axis),
                backward_group_velocity(upright_elasticity<2>(crossed), axis), 1e-9);
  // Directions of the plane in which it dips are among those in space; none of them is tried first.
  auto dipping = crossed;
  dipping.tilt = 17.3;
  for (const int axis : {0, 1})
    EXPECT_GT(backward_group_velocity(elasticity_of<3>(dipping), 2 * axis),
              backward_group_velocity(elasticity_of<2>(dipping), axis) - 1e-9);
  EXPECT_EQ(backward_group_velocity(upright_elasticity<3>(rock), 1), 0);
  // Of this rock only waves within a few degrees of the horizontal turn.
  const Material stiff{3600, 1900, 2450, 0.15, 0.1, -15};
  const double in_plane = backward_group_velocity(elasticity_of<2>(stiff), 1);
  EXPECT_GT(in_plane, 1e-3);
  EXPECT_GT(backward_group_velocity(elasticity_of<3>(stiff), 2), in_plane - 1e-9);
  // Of any axis it is that of the last, once rock is turned.
  Material any{3600, 1775, 2450, 0.228, -0.067, -65.7};
  any.azimuth = 93.6;
  const auto as_it_is = elasticity_of<3>(any);
  auto turning = as_it_is;
  for (const int axis : {1, 0}) {
    turning = turned<3>(turning, {{{0, 1, 0}, {0, 0, 1}, {1, 0, 0}}});
    EXPECT_NEAR(backward_group_velocity(as_it_is, axis), backward_group_velocity(turning, 2), 1e-6) << axis;
  }
}

// Proves (O5).
TEST(MaterialMean, OfAnisotropicPartsInSpaceIsThatOfFlatLayers) {
  auto other = material_of(cracked, 1);
  other = {other.vp * 1000, other.vs * 1000,   2300, other.epsilon, other.delta, 0,
           other.gamma,     other.orthorhombic};
  auto layered = shale;
  layered.gamma = 0.15;
  MaterialMean mean(other);
  mean.add(other, 3), mean.add(layered, 1), mean.add(rock, 2);
  // Backus: in layers stresses on the level and strains along it are the same.
  const std::pair<Elasticity<3>, double> parts[] = {{upright_elasticity<3>(other), 0.5},
                                                    {upright_elasticity<3>(layered), 1. / 6},
                                                    {upright_elasticity<3>(rock), 1. / 3}};
  double s33 = 0, s44 = 0, s55 = 0, c66 = 0, x = 0, y = 0, xx = 0, yy = 0, xy = 0;
  for (const auto& [c, w] : parts) {
    s33 += w / c(3, 3), s44 += w / c(4, 4), s55 += w / c(5, 5), c66 += w * c(6, 6);
    x += w * c(1, 3) / c(3, 3), y += w * c(2, 3) / c(3, 3);
    xx += w * (c(1, 1) - c(1, 3) * c(1, 3) / c(3, 3)), yy += w * (c(2, 2) - c(2, 3) * c(2, 3) / c(3, 3));
    xy += w * (c(1, 2) - c(1, 3) * c(2, 3) / c(3, 3));
  }
  const auto found = upright_elasticity<3>(mean.mean());
  const double wanted[] = {xx + x * x / s33, yy + y * y / s33, 1 / s33, 1 / s44, 1 / s55, c66,
                           xy + x * y / s33, x / s33,          y / s33};
  const double of[] = {found(1, 1), found(2, 2), found(3, 3), found(4, 4), found(5, 5),
                       found(6, 6), found(1, 2), found(1, 3), found(2, 3)};
  for (int n = 0; n < 9; ++n) EXPECT_NEAR(of[n], wanted[n], 1e-9 * wanted[n]) << n;
}

TEST(Layers, OfOrthorhombicRockLeaveOthersAlikeInAllHorizontalDirections) {
  const Grid<3> grid{{1, 1, 4}, 5, {0, 0, 0}};
  const auto medium = layered_medium(grid, {parse_layer("0:3000:1600:2300 epsilon=0.2 delta=0.1 gamma=0.15"),
                                            parse_layer("10:3000:1600:2300 epsilon=0.2 epsilon1=0.1")});
  ASSERT_TRUE(medium.has(Property::gamma2));
  EXPECT_FALSE(is_orthorhombic(medium, 0));
  EXPECT_FLOAT_EQ(medium[Property::gamma2][0], 0.15F);
  EXPECT_TRUE(is_orthorhombic(medium, 3));
  EXPECT_FLOAT_EQ(medium[Property::epsilon1][3], 0.1F);
  EXPECT_TRUE(layered_medium(grid, {parse_layer("0:3000:1600:2300 epsilon=0.2")}).has(Property::gamma));
}

// Proves (O2).
TEST(ModelCheck, RefusesAnisotropyInSpaceThatNoRockHas) {
  const auto told = [](const Material& of) {
    Model<3> model;
    model.medium = Medium<3>(Grid<3>{{1, 1, 1}, 2, {0, 0, 0}});
    model.medium[Property::epsilon1] = Field<3>(model.medium.grid());
    complete_anisotropy(model.medium);
    put(model.medium, 0, of);
    return refusal([&] { check(model); });
  };
  auto of = shale;
  of.gamma = 0.15;
  EXPECT_EQ(told(of), "");
  of.gamma = 2;
  EXPECT_EQ(told(of),
            "gamma at x=1 y=1 z=1 is 2, expected below 1.477 with an epsilon of 0.2 and a delta of 0.1: (c11 "
            "- c66) "
            "c33 must be more than c13^2, or the rock would give energy; lower gamma or raise epsilon");
  of.gamma = -0.5;
  EXPECT_EQ(told(of), "gamma at x=1 y=1 z=1 is -0.5, expected above -0.5: c66 must be more than 0");
  of.gamma = 0.15, of.orthorhombic = {0.2, 0.1, 0.1, 0.15};
  EXPECT_EQ(told(of), "");
  of.orthorhombic->delta1 = -0.45;
  EXPECT_NE(told(of).find("delta1 at x=1 y=1 z=1 is -0.45, expected above -0.35"), std::string::npos);
  of.orthorhombic = {-0.45, 0.1, 0, 0.15};
  EXPECT_NE(told(of).find("epsilon1 at x=1 y=1 z=1 is -0.45, expected above"), std::string::npos);
  of.orthorhombic = {0.2, 0.1, 0.9, 0.15};
  EXPECT_NE(told(of).find("lower delta3"), std::string::npos);
  EXPECT_NE(told({1500, 0, 1000, 0, 0, 0, 0.1}).find("gamma at x=1 y=1 z=1 is 0.1, expected 0 in fluid"),
            std::string::npos);
}

}  // namespace
}  // namespace slipwave::model_anisotropy_test
