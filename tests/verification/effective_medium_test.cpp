// SPDX-License-Identifier: BSD-3-Clause
// Rock full of planes that give way, as springs in its cells and as the effective medium of Schoenberg &
// Sayers, against plane-wave (wave number) solutions for the closed form of its stiffness (docs/theory.md
// (S26)).
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "anisotropic_stack.hpp"
#include "complex_system.hpp"
#include "lab.hpp"
#include "long_form.hpp"
#include "model/effective_medium.hpp"
#include "solver/simulation.hpp"

namespace slipwave::solver::effective_medium_test {
namespace {

const Material rock{3370, 1830, 2500};
constexpr double peak_hz = 20;
const double mu = rock.rho * rock.vs * rock.vs, modulus = rock.rho * rock.vp * rock.vp;

/// Planes that make the modulus across them and that of shear this much less: weaknesses of theirs.
SlipSystem<2> planes(const Point<2>& normal, double weak_n, double weak_t) {
  SlipSystem<2> system{normal};
  system.law = FrictionLaw::none;
  system.compliance = {weak_n / (1 - weak_n) / modulus, weak_t / (1 - weak_t) / mu, 0, 0, 1};
  return system;
}
const auto level = planes({0, 1}, 0.2, 0.35), upright = planes({1, 0}, 0.15, 0.1);

const std::vector<AnisotropicStack::Receiver> receivers = {
    {0, 160}, {80, 140}, {130, 100}, {160, 45}, {150, -60}};

Scene<2> scene_with(double h) {
  Scene<2> scene;
  const Grid<2> grid{{std::llround(900 / h), std::llround(900 / h)}, h, {0, 0}};
  scene.model.medium = Medium<2>(grid);
  for (std::size_t cell = 0; cell < scene.model.medium.vp.size(); ++cell) put(scene.model.medium, cell, rock);
  const double middle = 450;
  scene.survey.sources = {
      {{middle, middle}, parse_mechanism<2>("force:0.6,0.8"), parse_wavelet("ricker:20"), 1e6}};
  for (const auto& at : receivers) scene.survey.receivers_m.push_back({middle + at.x, middle + at.z});
  scene.edges = edges_all(EdgeLaw::absorbing);
  scene.numerics.order = 7;
  // Until waves come back from the edges, beyond which rock has no planes.
  scene.recording = {{Component::vx, Component::vz}, 0.24, 0.001};
  return scene;
}
const auto everywhere = [](const Point<2>&) { return true; };

/// Of all traces, against the closed form of all planes together.
double error_of(const Scene<2>& scene, const Elasticity<2>& exact_stiffness) {
  AnisotropicStack stack{{{exact_stiffness, rock.rho}}, {}};
  stack.force = {0.6, 0.8};
  const auto gather = shoot(scene, 1);
  const auto exact = stack.ricker(peak_hz, 0.001, std::size_t(gather.axis.count), receivers);
  std::vector<double> found, wanted;
  for (std::size_t n = 0; n < gather.traces.size(); ++n) {
    const auto& samples = gather.traces[n].samples;
    found.insert(found.end(), samples.begin(), samples.end());
    for (const double value : exact[n % receivers.size()][n / receivers.size()])
      wanted.push_back(1e6 * value);
  }
  return relative_error(found, wanted);
}
double error_of(const Scene<2>& scene, const std::vector<SlipSystem<2>>& all) {
  return error_of(scene, effective_elasticity(upright_elasticity<2>(rock), all));
}
double error_of_medium(double h, const std::vector<SlipSystem<2>>& all) {
  auto scene = scene_with(h);
  make_effective(scene.model, all, everywhere);
  return error_of(scene, all);
}
/// Some of the planes are in the rock already.
double error_of_springs(double h, const std::vector<SlipSystem<2>>& springs,
                        const std::vector<SlipSystem<2>>& in_rock = {}) {
  auto scene = scene_with(h);
  if (!in_rock.empty()) make_effective(scene.model, in_rock, everywhere);
  add_fractures<2>(scene.model, {"planes", springs}, everywhere);
  auto all = springs;
  all.insert(all.end(), in_rock.begin(), in_rock.end());
  return error_of(scene, all);
}

// Proves (S26).
TEST(EffectiveStiffness, OfLevelPlanesIsThatOfSchoenbergAndSayers) {
  // c33 and c13 fall by the weakness across the planes, c55 by that along them, c11 by (lambda/modulus)^2 of
  // the first.
  const double lambda = modulus - 2 * mu;
  const auto found = effective_elasticity(upright_elasticity<2>(rock), {level});
  EXPECT_NEAR(found(3, 3) / modulus, 1 - 0.2, 1e-12);
  EXPECT_NEAR(found(1, 3) / lambda, 1 - 0.2, 1e-12);
  EXPECT_NEAR(found(5, 5) / mu, 1 - 0.35, 1e-12);
  EXPECT_NEAR(found(1, 1) / modulus, 1 - 0.2 * std::pow(lambda / modulus, 2), 1e-12);
  const auto turned = effective_elasticity(upright_elasticity<2>(rock), {planes({-1, 0}, 0.2, 0.35)});
  EXPECT_NEAR(turned(1, 1) / found(3, 3), 1, 1e-12);
  EXPECT_NEAR(turned(3, 3) / found(1, 1), 1, 1e-12);
  // Thomsen's parameters of few planes: epsilon = 2 g (1 - g) D_N, delta = 2 g (D_N - D_T), g = (vs/vp)^2.
  const double g = mu / modulus, few = 1e-4;
  const auto weak = material_of(
      effective_elasticity(upright_elasticity<2>(rock), {planes({0, 1}, 2 * few, few)}), rock.rho);
  EXPECT_NEAR(weak.epsilon / (2 * g * (1 - g) * 2 * few), 1, 1e-3);
  EXPECT_NEAR(weak.delta / (2 * g * few), 1, 1e-3);
}

TEST(EffectiveMedium, HasTheTracesOfItsClosedFormAndSoHaveSprings) {
  for (const auto& all : {std::vector{level}, std::vector{upright}, std::vector{level, upright}}) {
    SCOPED_TRACE(all.size() == 2 ? "both" : all[0].normal[0] == 0 ? "level" : "upright");
    EXPECT_LT(error_of_medium(5, all), 0.01);
    if (all.size() < 2 && !long_form()) continue;
    EXPECT_LT(error_of_springs(2.5, all), 0.025);
  }
}

/// The stiffness of isotropic rock with planes of any dip: compliances add up as tensors (Schoenberg & Sayers
/// 1995, eq. 5), inverted. Strains are xx, zz and twice xz.
Elasticity<2> stiffness_with(const std::vector<SlipSystem<2>>& systems) {
  const double lambda = modulus - 2 * mu;
  const auto inverse = [](const std::array<std::array<double, 3>, 3>& of) {
    std::array<std::array<double, 3>, 3> columns{};
    for (std::size_t column = 0; column < 3; ++column) {
      ComplexSystem system;
      for (std::size_t row = 0; row < 3; ++row)
        system.push_back({of[row][0], of[row][1], of[row][2], row == column ? 1. : 0.});
      const auto found = solved(std::move(system));
      for (std::size_t row = 0; row < 3; ++row) columns[row][column] = found[row].real();
    }
    return columns;
  };
  auto compliance = inverse({{{modulus, lambda, 0}, {lambda, modulus, 0}, {0, 0, mu}}});
  for (const auto& system : systems) {
    const auto [x, z] = system.normal;
    // s_n and tau of a stress, and the same weights for the strains they make.
    const std::array<double, 3> across{x * x, z * z, 2 * x * z}, along{-x * z, x * z, x * x - z * z};
    for (std::size_t a = 0; a < 3; ++a)
      for (std::size_t b = 0; b < 3; ++b)
        compliance[a][b] += system.compliance.normal_m_per_pa * across[a] * across[b] +
                            system.compliance.tangential_m_per_pa * along[a] * along[b];
  }
  return {inverse(compliance)};
}

// Proves (S26).
TEST(EffectiveMedium, OfPlanesThatDipIsTiltedRockAndSoAreTheirSprings) {
  const auto dipping = planes(normal_of_dip(30), 0.2, 0.35), across = planes(normal_of_dip(-60), 0.15, 0.1);
  const auto both = std::vector{dipping, across};
  auto scene = scene_with(5);
  make_effective(scene.model, both, everywhere);
  EXPECT_EQ(scene.model.medium[Property::tilt][0], 30);
  EXPECT_LT(error_of(scene, stiffness_with(both)), 0.02);
  // Their springs in isotropic rock have its traces, too.
  auto among = scene_with(5);
  add_fractures<2>(among.model, {"planes", both}, everywhere);
  EXPECT_LT(error_of(among, stiffness_with(both)), 0.1);
}

// Proves (S34b).
TEST(EffectiveMedium, OfTiltedRockIsThatOfSpringsAskewInIt) {
  // Rock of dipping planes, and springs at other angles in it: compliances of all add up.
  const auto dipping = planes(normal_of_dip(30), 0.2, 0.35), askew = planes(normal_of_dip(-10), 0.1, 0.15),
             steep = planes(normal_of_dip(70), 0.1, 0.1);
  const auto error_in = [&](double h, const std::vector<SlipSystem<2>>& springs) {
    auto scene = scene_with(h);
    make_effective(scene.model, {dipping}, everywhere);
    add_fractures<2>(scene.model, {"planes", springs}, everywhere);
    auto all = springs;
    all.push_back(dipping);
    return error_of(scene, stiffness_with(all));
  };
  for (const auto& springs : {std::vector{askew}, std::vector{askew, steep}}) {
    const double coarse = error_in(5, springs);
    EXPECT_LT(coarse, 0.08) << springs.size();
    if (!long_form()) continue;
    const double fine = error_in(2.5, springs);
    EXPECT_LT(fine, 0.02) << springs.size();
    EXPECT_GT(observed_order(coarse, fine), 1.5) << springs.size();
  }
}

// Proves (S26).
TEST(EffectiveMedium, IsWhatSpringsConvergeToWithSecondOrder) {
  const std::vector all = {level, upright};
  EXPECT_GT(observed_order(error_of_springs(10, all), error_of_springs(5, all)), 1.5);
  // So do those of planes in a rock that is anisotropic by others.
  EXPECT_LT(error_of_springs(5, {level}, {upright}), 0.08);
  EXPECT_LT(error_of_springs(5, {upright}, {level}), 0.025);
}

// Proves (S26a).
TEST(EffectiveMedium, IsWhatMomentsActOnAmongSprings) {
  // Planes that took part of a moment for strain of the rock would weaken it by as much as the stiffness.
  const std::vector all = {level, upright};
  const auto difference = [&](double h, const char* mechanism) {
    auto scene = scene_with(h), among = scene;
    make_effective(scene.model, all, everywhere);
    add_fractures<2>(among.model, {"planes", all}, everywhere);
    std::vector<double> samples[2];
    for (auto* each : {&scene, &among}) {
      each->survey.sources[0].mechanism = parse_mechanism<2>(mechanism);
      for (const auto& trace : shoot(*each, 1).traces) {
        auto& of = samples[each == &among];
        of.insert(of.end(), trace.samples.begin(), trace.samples.end());
      }
    }
    return relative_error(samples[1], samples[0]);
  };
  for (const char* mechanism : {"explosion", "moment:0,0,1"}) {
    const double coarse = difference(6, mechanism), fine = difference(3, mechanism);
    EXPECT_LT(fine, 0.05) << mechanism;
    EXPECT_GT(observed_order(coarse, fine), 1.5) << mechanism;
  }
}

// Proves (S26b).
TEST(EffectiveMedium, OfSpringsAndViscousPlanesContinuesBeyondAbsorbingEdges) {
  auto creeping = level;
  creeping.compliance = {}, creeping.law = FrictionLaw::coulomb, creeping.viscosity_s = 0.02;
  const auto dipping = planes(normal_of_dip(30), 0.2, 0.35);
  // Of planes in all cells of a model that ends 60 m from the receivers, and of one that waves do not cross.
  const auto traces = [](const SlipSystem<2>& system, double beyond_m) {
    auto scene = scene_with(5);
    const double size = 340 + 2 * beyond_m, shift = size / 2 - 450;
    const auto cells = std::llround(size / 5);
    scene.model.medium = uniform_medium(cells, cells, 5, {rock.vp, rock.vs, rock.rho});
    for (auto& at : scene.survey.receivers_m) at[0] += shift, at[1] += shift;
    for (auto& along : scene.survey.sources[0].position_m) along += shift;
    scene.recording.duration_s = 0.4;
    add_fractures<2>(scene.model, {"planes", {system}}, everywhere);
    std::vector<double> samples;
    for (const auto& trace : shoot(scene, 1).traces)
      samples.insert(samples.end(), trace.samples.begin(), trace.samples.end());
    return samples;
  };
  for (const auto& system : {level, dipping, creeping})
    EXPECT_LT(relative_error(traces(system, 60), traces(system, 600)), 0.01) << system.normal[0];
}

}  // namespace
}  // namespace slipwave::solver::effective_medium_test
