#include "model/anisotropy.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "model/coefficients.hpp"
#include "model/fracture.hpp"
#include "model/import.hpp"
#include "model/layers.hpp"
#include "model/model.hpp"
#include "model/model_report.hpp"
#include "model/relations.hpp"
#include "refusal.hpp"
#include "scene/anisotropy_check.hpp"

namespace slipwave {
namespace {

constexpr Material shale{3000, 1600, 2300, 0.2, 0.1}, crossed{3200, 1700, 2400, -0.05, 0.2},
    rock{2500, 1200, 2100};

Model<2> one_cell(const Material& of) {
  const Grid<2> grid{{1, 1}, 5, {0, 0}};
  Model<2> model;
  model.medium = Medium<2>(grid);
  model.medium[Property::epsilon] = model.medium[Property::delta] = Field<2>(grid);
  put(model.medium, 0, of);
  return model;
}

TEST(Stiffness, IsThatOfThomsen) {
  for (const auto& of : {shale, crossed}) {
    const auto [c11, c13, c33, c55] = stiffness_of(of);
    EXPECT_DOUBLE_EQ(c33, of.rho * of.vp * of.vp);
    EXPECT_DOUBLE_EQ(c55, of.rho * of.vs * of.vs);
    // Thomsen (1986), eqs. 8a and 17.
    EXPECT_NEAR((c11 - c33) / (2 * c33), of.epsilon, 1e-12);
    EXPECT_NEAR((std::pow(c13 + c55, 2) - std::pow(c33 - c55, 2)) / (2 * c33 * (c33 - c55)), of.delta, 1e-12);
    const auto back = material_of_stiffness({c11, c13, c33, c55}, of.rho);
    EXPECT_NEAR(back.vp, of.vp, 1e-9);
    EXPECT_NEAR(back.vs, of.vs, 1e-9);
    EXPECT_NEAR(back.epsilon, of.epsilon, 1e-12);
    EXPECT_NEAR(back.delta, of.delta, 1e-12);
  }
  const auto isotropic = stiffness_of(rock);
  EXPECT_EQ(isotropic.c11, isotropic.c33);
  EXPECT_EQ(isotropic.c13, isotropic.c33 - 2 * isotropic.c55);
}

TEST(PhaseSpeeds, AreRootsOfTheChristoffelEquation) {
  for (const auto& of : {shale, crossed, rock})
    for (const double degrees : {0., 17., 45., 71., 90.}) {
      const double angle = degrees * std::numbers::pi / 180, x = std::sin(angle), z = std::cos(angle);
      const auto c = stiffness_of(of);
      const auto speeds = phase_speeds(c, of.rho, angle);
      EXPECT_GT(speeds.p, speeds.s);
      for (const double speed : {speeds.p, speeds.s}) {
        const double inertia = of.rho * speed * speed;
        const double xx = c.c11 * x * x + c.c55 * z * z - inertia,
                     zz = c.c55 * x * x + c.c33 * z * z - inertia, xz = (c.c13 + c.c55) * x * z;
        EXPECT_NEAR((xx * zz - xz * xz) / (c.c33 * c.c33), 0, 1e-12);
      }
    }
  // Where anisotropy is weak: Thomsen's eqs. 16a, 16b.
  const Material weak{3000, 1500, 2300, 0.02, 0.01};
  const double angle = 0.7, s = std::pow(std::sin(angle), 2), c = 1 - s;
  const auto speeds = phase_speeds(stiffness_of(weak), weak.rho, angle);
  EXPECT_NEAR(speeds.p, 3000 * (1 + 0.01 * s * c + 0.02 * s * s), 1);
  EXPECT_NEAR(speeds.s, 1500 * (1 + 4 * 0.01 * s * c), 1);
}

TEST(PhaseSpeeds, AreSlowestAndFastestInSomeDirection) {
  // Along the vertical, and where delta is above epsilon on the way to the horizontal.
  EXPECT_NEAR(slowest_speeds(shale).p, 3000, 1e-9);
  EXPECT_NEAR(slowest_speeds(shale).s, 1600, 1e-9);
  EXPECT_NEAR(fastest_p_speed(shale), 3000 * std::sqrt(1.4), 1e-6);
  EXPECT_LT(slowest_speeds(crossed).s, 1500);
  EXPECT_GT(fastest_p_speed(crossed), 3250);
  const auto slow = in_slowest_directions(one_cell(crossed).medium);
  EXPECT_EQ(anisotropic_cells(slow), 0);
  EXPECT_FLOAT_EQ(slow.vs[0], float(slowest_speeds(material_of(one_cell(crossed).medium, 0)).s));
}

TEST(Coefficients, AreThoseOfTheAxis) {
  const auto medium = one_cell(shale).medium;
  EXPECT_NEAR(wave_speed(medium, 0, 0, wave_p), 3000 * std::sqrt(1.4), 1e-3);
  EXPECT_EQ(wave_speed(medium, 0, 1, wave_p), 3000);
  EXPECT_EQ(wave_speed(medium, 0, 0, wave_s), 1600);
  EXPECT_NEAR(fastest_speed(medium), 3000 * std::sqrt(1.4), 1e-3);
}

/// Flat layers of equal strain along x and equal stress across, solved by themselves.
Stiffness of_layers(const std::vector<Material>& parts) {
  // Of exx and szz in all layers: the mean of sxx and ezz.
  const auto means = [&](double exx, double szz) {
    double sxx = 0, ezz = 0;
    for (const auto& part : parts) {
      const auto c = stiffness_of(part);
      const double strain = (szz - c.c13 * exx) / c.c33;
      sxx += (c.c11 * exx + c.c13 * strain) / double(parts.size());
      ezz += strain / double(parts.size());
    }
    return std::array{sxx, ezz};
  };
  const auto pressed = means(0, 1), stretched = means(1, 0);
  Stiffness c;
  c.c33 = 1 / pressed[1];
  c.c13 = c.c33 * pressed[0];
  c.c11 = stretched[0] - c.c13 * stretched[1];
  double compliance = 0;
  for (const auto& part : parts) compliance += 1 / (part.rho * part.vs * part.vs) / double(parts.size());
  c.c55 = 1 / compliance;
  return c;
}

TEST(MaterialMean, OfAnisotropicPartsIsThatOfFlatLayers) {
  for (const auto& parts : {std::vector{shale, rock}, {crossed, shale, rock}}) {
    MaterialMean mean(parts[0]);
    for (const auto& part : parts) EXPECT_TRUE(mean.add(part, 2));
    const auto found = stiffness_of(mean.mean()), wanted = of_layers(parts);
    EXPECT_NEAR(found.c11, wanted.c11, 1e-9 * wanted.c11);
    EXPECT_NEAR(found.c13, wanted.c13, 1e-9 * wanted.c11);
    EXPECT_NEAR(found.c33, wanted.c33, 1e-9 * wanted.c11);
    EXPECT_NEAR(found.c55, wanted.c55, 1e-9 * wanted.c11);
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
            "epsilon at x=2.5 z=2.5 is -0.6, expected a finite number of at least -0.5");
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
  EXPECT_EQ(
      told(cracked),
      "the cell at x=2.5 z=2.5 is anisotropic (epsilon 0.2, delta 0.1) and the planes of its fracture set "
      "'oblique' are springs and lie askew to the axes of rock, expected along both or in isotropic rock; "
      "use --without slip or --without anisotropy");
  system.normal = {0, 1};
  EXPECT_EQ(told(cracked), "");
  cracked.model.medium[Property::tilt] = Field<2>(cracked.model.grid(), 20);
  EXPECT_NE(told(cracked).find("are springs and lie askew"), std::string::npos);
  system.opens = true;
  EXPECT_NE(told(cracked).find("open, expected closed ones; use --without opening"), std::string::npos);
  cracked.with_slip = false;
  EXPECT_EQ(told(cracked), "");
}

TEST(SceneCheck, RefusesAnisotropyInThreeDimensions) {
  Scene<3> deep;
  deep.model.medium = extruded(one_cell(shale).medium, 5);
  EXPECT_NE(refusal([&] { check_anisotropy(deep); }).find("found epsilon or delta in a model in 3-D"),
            std::string::npos);
}

}  // namespace
}  // namespace slipwave
