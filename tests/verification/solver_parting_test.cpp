// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <numbers>
#include <random>

#include "lab.hpp"
#include "solver/effect/slip.hpp"
#include "whole_effect.hpp"

namespace slipwave::solver::solver_parting_test {
namespace {

constexpr Rock rock{4500, 2250, 2500};
using L = Lab<double>;

/// Everything fractured, all edges rigid: stress that is the same everywhere stays as it is.
Scene<2> box(const FractureSet<2>& set) {
  Scene<2> scene;
  scene.model.medium = uniform_medium(24, 20, 5, rock);
  scene.model.fracture = Field<2, std::uint8_t>(scene.model.grid(), 1);
  scene.model.fracture_sets = {set};
  return scene;
}

// Proves (S15).
TEST(SlipOfPrestressedRock, IsThatOfRockWhoseWavesBringTheStress) {
  const double still[] = {-3e5, -5e5, 4e4};  // sxx, szz, sxz
  const FractureSet<2> sets[] = {
      {"layers", {{{0.6, 0.8}, 0.4, 2e3, 2e4}}},
      {"blocks", {{{0.6, 0.8}, 0.4, 2e3, 2e4}, {{0.8, -0.6}, 0.4, 2e3, 2e4}}},
      {"crossing", {{{0.6, 0.8}, 0.4, 2e3, 2e4}, {{0, 1}, 0.4, 0, 2e4}}},
      {"parting", {{{0.6, 0.8}, 0.4, 2e3, 2e4, true}}},
  };
  const double dt_s = 0.9 * 5 / rock.vp;
  for (const auto& set : sets)
    for (const auto correction : {SlipCorrection::first, SlipCorrection::second, SlipCorrection::exponential,
                                  SlipCorrection::centred}) {
      auto with = box(set), without = box(set);
      for (const double value : still) with.model.prestress_pa.emplace_back(with.model.grid(), float(value));
      check(with.model);
      std::vector<std::unique_ptr<L>> labs;
      for (auto* const scene : {&with, &without}) {
        scene->numerics.correction = correction;
        labs.push_back(std::make_unique<L>(scene->model.medium, edges_all(EdgeLaw::rigid), 5, dt_s));
        auto& lab = *labs.back();
        Slip<2, double> slip(lab.state(), lab.domain(), *scene, dt_s);
        std::mt19937 random(3);
        for (std::int64_t k = 0; k < 20; ++k)
          for (std::int64_t i = 0; i < 24; ++i)
            for (int c = 0; c < 3; ++c)
              lab(L::Row(L::sxx + c), i, k) =
                  std::uniform_real_distribution<>(-6e5, 6e5)(random) + (scene == &without ? still[c] : 0);
        // Fields that were set are what the first step begins with.
        run_after_everywhere(slip, {-1, dt_s}, lab.state());
        for (std::int64_t step = 0; step < 30; ++step) {
          lab.step();
          run_everywhere(slip, {step, dt_s}, lab.state());
          run_after_everywhere(slip, {step, dt_s}, lab.state());
        }
      }
      double difference = 0, largest = 0;
      for (std::int64_t k = 0; k < 20; ++k)
        for (std::int64_t i = 0; i < 24; ++i)
          for (int c = 0; c < 3; ++c) {
            const double waves = (*labs[0])(L::Row(L::sxx + c), i, k);
            difference =
                std::max(difference, std::abs(waves + still[c] - (*labs[1])(L::Row(L::sxx + c), i, k)));
            largest = std::max(largest, std::abs(waves));
          }
      EXPECT_GT(largest, 1e4);
      EXPECT_LT(difference, 1e-7 * largest) << set.name << ' ' << name_of(correction);
    }
}

/// A P wave of this largest stress comes down on horizontal planes in `thickness_m`: the largest stresses
/// below them and of what comes back.
struct Passed {
  double through = 0, back = 0;
};

Passed passed(double peak_pa, std::int64_t cells, double h, int order, double still_pa = 0) {
  constexpr double depth_m = 1200, wave_at_m = 300, length_m = 240, layer_at_m = 600;
  Scene<2> scene;
  scene.model.medium = uniform_medium(2, std::int64_t(depth_m / h), h, rock);
  scene.model.fracture = Field<2, std::uint8_t>(scene.model.grid());
  const auto first = std::int64_t(layer_at_m / h), last = first + cells - 1;
  for (std::int64_t k = first; k <= last; ++k)
    for (const std::int64_t i : {0, 1}) scene.model.fracture({i, k}) = 1;
  scene.model.fracture_sets = {{"bed", {{{0, 1}, 0.5, 0, 0, true}}}};
  if (still_pa != 0)
    for (int c = 0; c < 3; ++c)
      scene.model.prestress_pa.emplace_back(scene.model.grid(), c < 2 ? float(still_pa) : 0.f);
  const double dt_s = 0.9 * h / rock.vp, z_p = rock.rho * rock.vp;
  L lab(scene.model.medium, edges_all(EdgeLaw::rigid), order, dt_s);
  Slip<2, double> slip(lab.state(), lab.domain(), scene, dt_s);
  const double share = 1 - 2 * (rock.vs / rock.vp) * (rock.vs / rock.vp);
  for (std::int64_t k = 0; k < std::int64_t(depth_m / h); ++k)
    for (const std::int64_t i : {0, 1}) {
      const double at = (lab.grid().centre(1, k) - wave_at_m) / length_m;
      const double s = std::abs(at) < 0.5 ? peak_pa * std::pow(std::cos(std::numbers::pi * at), 2) : 0;
      lab(L::szz, i, k) = s;
      lab(L::sxx, i, k) = share * s;
      lab(L::vz, i, k) = -s / z_p;
    }
  Passed result;
  const auto note = [&](double& most, std::int64_t k, double direction) {
    const double wave = (lab(L::szz, 0, k) - direction * z_p * lab(L::vz, 0, k)) / 2;
    if (std::abs(wave) > std::abs(most)) most = wave;
  };
  for (std::int64_t n = 0; double(n) * dt_s < 500 / rock.vp; ++n) {
    lab.sweep(1, 1);
    run_everywhere(slip, {n, dt_s}, lab.state());
    note(result.through, last + 4, 1);
    note(result.back, first - 4, -1);
    run_after_everywhere(slip, {n, dt_s}, lab.state());
  }
  return result;
}

// Proves (S13).
TEST(PartingPlanes, LetPressureThroughAsIfTheyWereNotThere) {
  for (const int order : {3, 5, 7}) {
    const auto pressure = passed(-1e5, 4, 2.5, order);
    EXPECT_NEAR(pressure.through, -1e5, 50) << order;
    EXPECT_NEAR(pressure.back, 0, 50) << order;
  }
}

// Proves (S13).
TEST(PartingPlanes, LetTensionThroughAsLongAsStaticStressHoldsThemTogether) {
  EXPECT_NEAR(passed(1e5, 4, 2.5, 5, -1.01e5).through, 1e5, 50);
  EXPECT_LT(passed(1e5, 4, 2.5, 5, -0.5e5).through, 0.8e5);
}

/// Faces between n cells without stress are dashpots (S16) in line with the rock on both sides.
// Proves (S16).
TEST(PartingPlanes, PassAShareOfLongTensionThatFallsWithTheCellsAcrossThem) {
  for (const std::int64_t cells : {1, 2, 4}) {
    const auto tension = passed(1e5, cells, 0.625, 1);
    const double share = 1e5 / double(cells + 1);
    EXPECT_NEAR(tension.through, share, 0.015 * 1e5) << cells;
    EXPECT_NEAR(tension.back, share - 1e5, 0.015 * 1e5) << cells;
  }
}

// Proves (S16).
TEST(PartingPlanes, SendTensionBackAsAFreeSurfaceTheMoreTheFinerTheCells) {
  double through = 1e5, lost = 1e5;
  for (const double h : {5., 2.5, 1.25, 0.625}) {
    const auto tension = passed(1e5, std::int64_t(20 / h), h, 5);
    EXPECT_LT(tension.through, 0.65 * through) << h;
    EXPECT_LT(1e5 + tension.back, 0.85 * lost) << h;
    through = tension.through, lost = 1e5 + tension.back;
  }
}

}  // namespace
}  // namespace slipwave::solver::solver_parting_test
