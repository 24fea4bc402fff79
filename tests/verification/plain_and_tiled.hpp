// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string>
#include <utility>
#include <vector>

#include "cube.hpp"
#include "parallel/threads.hpp"

namespace slipwave::solver {

/// All that comes out of a shot: samples, snapshots, energies and the fields at its end.
struct Outcome {
  std::vector<double> samples, energies;
  std::vector<float> snapshots;
};

template <int D>
Outcome outcome_of(const Scene<D>& scene) {
  Outcome outcome;
  const SnapshotSink<D> sink = [&](double, const FieldReader<D>& read) {
    for (const Component component : {Component::vx, Component::szz}) {
      const auto field = read(component);
      outcome.snapshots.insert(outcome.snapshots.end(), field.begin(), field.end());
    }
    const auto slip = read(SlipField::slip);
    outcome.snapshots.insert(outcome.snapshots.end(), slip.begin(), slip.end());
  };
  ShotReport report;
  outcome.samples = samples_of(shoot(scene, 1, {}, scene.snapshot_every_s ? sink : SnapshotSink<D>(), nullptr,
                                     scene.slip_diary ? &report : nullptr));
  const auto slip = report.slip.value_or(SlipTotals{});
  outcome.energies = {report.energy_left, report.source_work.value_or(0), slip.dissipated, slip.out_of_waves};
  return outcome;
}

/// Expects the tiled executor to give what the plain one does: each kind of tiles by one thread or by three,
/// in the long form by both.
template <int D>
void expect_same(Scene<D> scene) {
  check(scene);
  scene.numerics.tiling = {};
  scene.numerics.tiling.plain = true;
  const auto plain = outcome_of(scene);
  double largest = 0;
  for (const double sample : plain.samples) largest = std::max(largest, std::abs(sample));
  ASSERT_GT(largest, 0);
  const bool long_form = std::getenv("SLIPWAVE_LONG") != nullptr;
  const std::vector<std::pair<Tiling, int>> kinds = {{{}, 3}, {{2, 48, true}, 1}, {{3, 16}, 3}};
  for (const auto& [tiling, of_threads] : kinds)
    for (const int threads : {1, 3}) {
      if (threads != of_threads && !long_form) continue;
      const ThreadLimit limit(threads);
      scene.numerics.tiling = tiling;
      SCOPED_TRACE(std::to_string(tiling.steps) + " steps, " + std::to_string(tiling.stripe_cells) +
                   " cells, " + std::to_string(threads) + " threads");
      const auto tiled = outcome_of(scene);
      EXPECT_TRUE(tiled.samples == plain.samples);
      EXPECT_TRUE(tiled.snapshots == plain.snapshots);
      // Energies are sums over the pieces of rows.
      for (std::size_t n = 0; n < plain.energies.size(); ++n)
        EXPECT_NEAR(tiled.energies[n], plain.energies[n], 1e-9 * plain.energies[0]) << n;
    }
}

}  // namespace slipwave::solver
