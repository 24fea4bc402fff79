// SPDX-License-Identifier: BSD-3-Clause
// Source and receiver exchanged: beside and on interfaces and surfaces.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <utility>

#include "drawn_scene.hpp"
#include "model/fracture.hpp"

namespace slipwave::solver::exchange_test {
namespace {

/// Relative differences of the traces of a force along x or z at each of `from`, recorded along it at `to`,
/// and of the exchanged shot, which is one for all.
std::vector<double> asymmetries(Scene<2> scene, const std::vector<Point<2>>& from, const Point<2>& to,
                                bool along_x) {
  scene.recording.components = {along_x ? Component::vx : Component::vz};
  const char* const mechanism = along_x ? "force:1,0" : "force:0,1";
  shoot_from(scene, to, mechanism, from);
  const auto back = shoot(scene, 1);
  std::vector<double> all;
  for (std::size_t n = 0; n < from.size(); ++n) {
    shoot_from(scene, from[n], mechanism, {to});
    all.push_back(difference(back.traces[n].samples, traces_of(scene)));
  }
  return all;
}

/// Cells of the upper rock above row `face`.
Scene<2> two(const Rock& upper, const Rock& lower, std::int64_t face) {
  return scene_of(110, 100, [=](auto, auto k) { return k < face ? upper : lower; });
}

TEST(Exchange, AcrossAContrastOfDensityHoldsAsInOneRock) {
  for (const unsigned seed : seeds(1)) {
    Draw draw(seed);
    const Rock rock = draw.rock(20);
    Rock dense = rock;
    dense.rho *= draw.between(1.6, 4);
    const double near_face_m = 50 + draw.between(-2, 2) * double(draw.whole(0, 1));
    for (const bool along_x : {false, true}) {
      EXPECT_LT(asymmetries(two(rock, dense, 50), {{40.2, near_face_m}}, {70.3, 31.6}, along_x)[0], 0.002)
          << "seed " << seed << " at " << near_face_m;
    }
  }
}

TEST(Exchange, BesideAnInterfaceOfRocksHoldsToTheOrderOfTheScheme) {
  for (const unsigned seed : seeds(1)) {
    Draw draw(seed);
    const Rock upper = draw.rock(22), lower = draw.rock(draw.between(32, 40));
    const double away_m = draw.between(1, 3);
    for (const bool along_x : {false, true})
      EXPECT_LT(asymmetries(two(upper, lower, 50), {{40.2, 50 + away_m}}, {70.3, 31.6}, along_x)[0], 0.01)
          << "seed " << seed << ", " << away_m << " m away" << (along_x ? ", x" : ", z");
  }
}

/// Of second order for nearly all pairs of rocks.
TEST(Exchange, OnAnInterfaceOfRocksHoldsTheBetterTheFinerTheCells) {
  for (const unsigned seed : seeds(1)) {
    Draw draw(seed);
    const Rock upper = draw.rock(22), lower = draw.rock(draw.between(32, 40));
    for (const bool along_x : {false, true}) {
      // Rocks so many times as fast in so many times as many cells: cells are that much finer.
      const auto found = [&](int times) {
        const auto faster = [=](Rock rock) { return rock.vp *= times, rock.vs *= times, rock; };
        const auto scene = scene_of(
            70 * times, 60 * times, [&](auto, auto k) { return faster(k < 30 * times ? upper : lower); },
            0.04);
        return asymmetries(scene, {{22.2 * times, 30. * times}}, {45.3 * times, 15.6 * times}, along_x)[0];
      };
      const double coarse = found(1), fine = found(2);
      EXPECT_GT(std::log2(coarse / fine), 0.5)
          << "seed " << seed << (along_x ? ", x: " : ", z: ") << coarse << ", " << fine;
    }
  }
}

// Proves (A23).
TEST(Exchange, BelowVoidHoldsToTheOrderOfTheScheme) {
  for (const unsigned seed : seeds(1)) {
    Draw draw(seed);
    const Rock rock = draw.rock(20);
    const auto scene = two(nothing, rock, 30);
    const double below_m[] = {0, 0.5, draw.between(1, 3)};
    std::vector<Point<2>> from;
    for (const double below : below_m) from.push_back({40.2, 30 + below});
    for (const bool along_x : {false, true}) {
      const auto found = asymmetries(scene, from, {70.3, 55.6}, along_x);
      for (std::size_t n = 0; n < found.size(); ++n)
        EXPECT_LT(found[n], 0.01) << "seed " << seed << ", " << below_m[n] << " m below"
                                  << (along_x ? ", x" : ", z");
    }
  }
}

/// A moment of rate w moves a point as fast as a force w there strains the place of the moment. Appends both,
/// for an explosion and each component of a moment.
void exchange_moments(Scene<2> scene, const Point<2>& from, const Point<2>& to, std::vector<double>& motions,
                      std::vector<double>& strains) {
  struct Kind {
    const char* mechanism;
    Component strain;
    double times;
  };
  const Kind kinds[] = {{"explosion", Component::div, 1},
                        {"moment:1,0,0", Component::exx, 1},
                        {"moment:0,1,0", Component::ezz, 1},
                        {"moment:0,0,1", Component::exz, 2}};
  scene.recording.interval_s = 0.0001;
  for (const auto& kind : kinds) {
    scene.recording.components = {kind.strain};
    shoot_from(scene, to, "force:0.4,1", {from});
    double sum = 0, before = 0;
    for (const double rate : traces_of(scene)) {
      sum += kind.times * scene.recording.interval_s * (rate + std::exchange(before, rate)) / 2;
      strains.push_back(sum);
    }
    scene.recording.components = {Component::vx, Component::vz};
    shoot_from(scene, from, kind.mechanism, {to});
    const auto moved = shoot(scene, 1);
    for (std::size_t n = 0; n < moved.traces[0].samples.size(); ++n)
      motions.push_back(0.4 * moved.traces[0].samples[n] + moved.traces[1].samples[n]);
  }
}

// Proves (A23a).
TEST(Exchange, OfMomentsAndStrainsBelowVoidHoldsToTheOrderOfTheScheme) {
  for (const unsigned seed : seeds(1)) {
    Draw draw(seed);
    const auto scene = two(nothing, draw.rock(25), 30);
    for (const double below_m : {0.25, draw.between(0.5, 1), draw.between(1, 3)}) {
      // Together, since shear vanishes at the surface, and its errors do not.
      std::vector<double> strains, motions;
      exchange_moments(scene, {40.2, 30 + below_m}, {70.3, 55.6}, motions, strains);
      // Of first order within a cell of the surface.
      EXPECT_LT(difference(motions, strains), 0.03) << "seed " << seed << ", " << below_m << " m below";
    }
  }
}

// Proves (S26a).
TEST(Exchange, OfMomentsAndStrainsAmongSpringsHoldsToTheOrderOfTheScheme) {
  for (const unsigned seed : seeds(1)) {
    Draw draw(seed);
    const auto rock = draw.rock(25);
    auto scene = scene_of(110, 100, [=](auto, auto) { return rock; });
    const double dip = draw.between(0, std::numbers::pi), mu = rock.rho * rock.vs * rock.vs;
    SlipSystem<2> springs{{std::sin(dip), std::cos(dip)}};
    springs.law = FrictionLaw::none;
    springs.compliance = {.normal_m_per_pa = draw.between(0, 0.5) / mu,
                          .tangential_m_per_pa = draw.between(0.2, 1) / mu,
                          .spacing_m = 1};
    add_fractures<2>(scene.model, {"planes", {springs}},
                     [](const Point<2>& at) { return at[0] > 25 && at[0] < 60; });
    std::vector<double> strains, motions;
    exchange_moments(scene, {40.2, 43.7}, {70.3, 55.6}, motions, strains);
    EXPECT_LT(difference(motions, strains), 0.02) << "seed " << seed;
  }
}

TEST(Exchange, OfPressureAndExplosionOnTheSeaFloorTakesTheWatersSide) {
  for (const unsigned seed : seeds()) {
    Draw draw(seed);
    const Rock rock = draw.rock(30), water{2000, 0, 1000};
    auto scene = two(water, rock, 50);
    scene.recording.components = {Component::p};
    const Point<2> on_floor{40.2, 50}, above{40.2, 50 - 1e-4}, in_water{70.3, 31.6};
    shoot_from(scene, in_water, "explosion", {on_floor, above});
    const auto found = traces_of(scene);
    const std::vector<double> floor(found.begin(), found.begin() + std::ptrdiff_t(found.size() / 2)),
        beside(found.begin() + std::ptrdiff_t(found.size() / 2), found.end());
    EXPECT_LT(difference(floor, beside), 0.001) << "seed " << seed;
    shoot_from(scene, on_floor, "explosion", {in_water});
    // First order within half a cell of the floor.
    EXPECT_LT(difference(traces_of(scene), floor), 0.05) << "seed " << seed;
  }
}

}  // namespace
}  // namespace slipwave::solver::exchange_test
