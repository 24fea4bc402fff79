// SPDX-License-Identifier: BSD-3-Clause
// Planes that give way as springs in anisotropic rock of 3-D against isotropic rock, the solver in 2-D, the
// medium that both are to long waves, the same experiment turned, and their own energy.
#include <gtest/gtest.h>

#include <cmath>

#include "askew_cluster.hpp"
#include "model/fracture.hpp"
#include "parallel/threads.hpp"
#include "plain_and_tiled.hpp"
#include "shared_out.hpp"
#include "solver/effect/linear_slip.hpp"
#include "whole_effect.hpp"

namespace slipwave::solver {
namespace {

constexpr double usual_mu = 5e9;

/// Springs by dip and azimuth, whose compliances times that modulus are these.
FractureSet<3> springs(const std::vector<std::array<double, 2>>& dips, double normal, double tangential) {
  FractureSet<3> set{"springs", {}};
  for (const auto& [dip, azimuth] : dips) {
    set.systems.push_back({normal_of_dip(dip, azimuth)});
    set.systems.back().law = FrictionLaw::none;
    set.systems.back().compliance = {normal / usual_mu, tangential / usual_mu, 0, 0, 1};
  }
  return set;
}

// Proves (S34b).
TEST(AskewSpringsInSpace, OfNextToIsotropicRockAreThoseOfIsotropicRock) {
  const ThreadLimit one_thread(1);
  const Material plain{3000, 1600, 2300};
  auto next = plain;
  next.gamma = 1e-6;
  auto welded = cluster(plain, {});
  welded.with_slip = false;
  const auto traces = samples_of(shoot(welded, 1));
  for (const auto& dips :
       {std::vector<std::array<double, 2>>{{40, 25}}, {{40, 25}, {90, -50}}, {{40, 25}, {90, -50}, {0, 0}}}) {
    const auto set = springs(dips, 0.3, 0.8);
    auto isotropic = cluster(plain, set), other = cluster(next, set);
    isotropic.numerics.double_precision = other.numerics.double_precision = true;
    ASSERT_TRUE(lie_askew(set, other.model.medium, 0));
    const auto wanted = of_slip(isotropic);
    EXPECT_GT(relative_error(difference(traces, wanted), traces), 0.05);
    EXPECT_LT(relative_error(of_slip(other), wanted), 1e-5) << dips.size();
  }
}

// Proves (S34b).
TEST(AskewSpringsInSpace, OfASliceAreThoseInTwoDimensions) {
  const ThreadLimit one_thread(1);
  const auto upper = turned_by(shale, 30, 0),
             lower = turned_by({3600, 1900, 2450, 0.15, 0.1, 0, 0.1}, -50, 0);
  const auto flat = [](Material rock) {
    rock.gamma = 0;
    return rock;
  };
  auto both = slice({0, 2}, upper, lower, flat(upper), flat(lower));
  both.flat.recording.duration_s = both.deep.recording.duration_s = 0.12;
  both.flat.model.fracture = Field<2, std::uint8_t>(both.flat.model.grid());
  both.deep.model.fracture = Field<3, std::uint8_t>(both.deep.model.grid());
  for (std::int64_t k = 30; k < 45; ++k)
    for (std::int64_t i = 35; i < 60; ++i)
      both.flat.model.fracture({i, k}) = 1, both.deep.model.fracture(both.deep_cell(i, k)) = 1;
  const auto deep = springs({{30, 0}, {90, 0}}, 0.3, 0.6);
  FractureSet<2> planes{"springs", {{normal_of_dip(30)}, {{1, 0}}}};
  for (std::size_t n = 0; n < 2; ++n) {
    planes.systems[n].law = FrictionLaw::none;
    planes.systems[n].compliance = deep.systems[n].compliance;
  }
  both.flat.model.fracture_sets = {planes};
  both.deep.model.fracture_sets = {deep};
  EXPECT_LT(largest_error(both), 1e-5);
  const auto with = samples_of(shoot(both.flat, 1));
  both.flat.with_slip = false;
  EXPECT_GT(relative_error(with, samples_of(shoot(both.flat, 1))), 0.03);
}

/// Rock of level beds with families of upright planes at right angles, one of whose normals points along x,
/// as an orthorhombic rock: compliances add up (Schoenberg & Sayers 1995). Of one family C loses
/// Z/(1 + Z c_aa) (C e)(C e), e being its strain, and shear in planes with its normal gives way besides.
Elasticity<3> with_upright_planes(Elasticity<3> c, int axis, double normal, double tangential) {
  const double share = normal / (1 + normal * c(axis, axis, axis, axis));
  const auto of_strain = c.voigt[std::size_t(axis)];
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) c.voigt[i][j] -= share * of_strain[i] * of_strain[j];
  for (const int shear : {axis == 0 ? 5 : 4, 6})
    c.set(shear, shear, c(shear, shear) / (1 + tangential * c(shear, shear)));
  return c;
}

// Proves (S34b).
TEST(AskewSpringsInSpace, AreToLongWavesTheMediumOfSchoenbergAndSayers) {
  const ThreadLimit one_thread(1);
  // Upright planes 30 degrees from x and across them in a shale of level beds.
  constexpr double azimuth = 30, normal = 0.1, tangential = 0.2;
  const auto error_in = [&](double spacing_m, const std::vector<std::array<double, 2>>& dips) {
    auto stiffness = upright_elasticity<3>(shale);
    for (int axis = 0; axis < int(dips.size()); ++axis)
      stiffness = with_upright_planes(stiffness, axis, normal / usual_mu, tangential / usual_mu);
    const auto wanted = turned_by(material_of(stiffness, shale.rho), 0, azimuth);
    const auto cells = std::int64_t(std::llround(180 / spacing_m));
    const auto shot = [&](const Material& rock, bool gives) {
      auto scene =
          scene_of(uniform_rock({cells, cells, cells}, spacing_m, rock), edges_all_3d(EdgeLaw::rigid),
                   {95, 85, 90}, "force:1,0.5,0.7", "ricker:20", {{140, 110, 80}, {80, 130, 120}},
                   {Component::vx, Component::vy, Component::vz}, 0.08, 0.001);
      scene.model.fracture = Field<3, std::uint8_t>(scene.model.grid(), gives);
      scene.model.fracture_sets = {springs(dips, normal, tangential)};
      if (!gives) scene.with_slip = false;
      check(scene);
      return samples_of(shoot(scene, 1));
    };
    const auto effective = shot(wanted, false);
    EXPECT_GT(relative_error(shot(shale, false), effective), 0.1);
    return relative_error(shot(shale, true), effective);
  };
  for (const auto& dips : {std::vector<std::array<double, 2>>{{90, azimuth}}, {{90, azimuth}, {90, 120}}}) {
    const double coarse = error_in(10, dips);
    EXPECT_LT(coarse, 0.07) << dips.size();
    if (!long_form()) continue;
    const double fine = error_in(5, dips);
    EXPECT_LT(fine, 0.02) << dips.size();
    EXPECT_GT(std::log2(coarse / fine), 1.5) << dips.size();
  }
}

// Proves (S34b).
TEST(AskewSpringsInSpace, AreTurnedWithTheirRock) {
  const ThreadLimit one_thread(1);
  const auto set = [](double azimuth) { return springs({{35, azimuth}, {70, azimuth + 110}}, 0.4, 0.7); };
  EXPECT_LT(error_of_turned(cracked, set), 0.02);
}

// Proves (S34b).
TEST(AskewSpringsInSpace, NeverAddEnergyHoweverStiffOrSoft) {
  const ThreadLimit one_thread(1);
  // Any stiffness about any axes from block to block, any planes.
  std::mt19937 engine(8);
  std::uniform_real_distribution<double> uniform(0, 1);
  const auto between = [&](double low, double high) { return low + (high - low) * uniform(engine); };
  int number = 0;
  for (const double softness : {1e-3, 1., 30., 1e4, 1e9})
    for (const std::int64_t block : {1, 5}) {
      std::vector<std::array<double, 2>> dips;
      for (int k = 0; k <= number % 3; ++k) dips.push_back({between(0, 90), between(-180, 180)});
      const Index<3> shape = {12, 10, 11};
      auto scene = cluster(turned_by(cracked, 20, 30, 40),
                           springs(dips, number % 4 == 3 ? 0 : softness, softness), shape);
      auto& medium = scene.model.medium;
      std::vector<Material> rocks;
      for (int k = 0; k < 27; ++k) rocks.push_back(any_turned_rock(between));
      for (std::size_t cell = 0; cell < medium.vp.size(); ++cell) {
        const auto at = medium.grid().index(std::int64_t(cell));
        const auto of = at[0] / 5 + 3 * (at[1] / 5) + 9 * (at[2] / 5);
        put(medium, cell, block == 1 ? any_turned_rock(between) : rocks[std::size_t(of) % rocks.size()]);
        scene.model.fracture[cell] = number % 2 == 0 || uniform(engine) < 0.7;
      }
      const auto edges = edges_all_3d(number % 3 ? EdgeLaw::rigid : EdgeLaw::mirror);
      const int all[] = {5, 7, 3, 11, 9};
      const int order = all[number % 5];
      const double dt_s = 0.99 * stable_time_step_s(scene);
      Cube<double> cube(medium, edges, order, dt_s);
      const auto domain = make_domain(medium, edges, 1, {}, order);
      LinearSlip<3, double> effect(cube.state(), domain, scene, dt_s);
      cube.shake(unsigned(number) + 4);
      const double first = cube.energy();
      const int steps = long_form() ? 4000 : 40;
      for (std::int64_t step = 0; step < steps; ++step) {
        cube.steps(1);
        run_everywhere(effect, {step, dt_s}, cube.state());
        run_after_everywhere(effect, {step, dt_s}, cube.state());
        if (step > 40 && step % 20) continue;
        const double now = cube.energy() + effect.stored_energy();
        ASSERT_LT(now, first * (1 + 1e-11))
            << "run " << number << ", softness " << softness << ", order " << order << ", step " << step;
      }
      ++number;
    }
}

}  // namespace
}  // namespace slipwave::solver
