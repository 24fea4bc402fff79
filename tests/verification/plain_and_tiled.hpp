// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
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

/// Expects the tiled executor to give what the plain one does.
template <int D>
void expect_same(Scene<D> scene) {
  check(scene);
  scene.numerics.tiling = {};
  scene.numerics.tiling.plain = true;
  const auto plain = outcome_of(scene);
  double largest = 0;
  for (const double sample : plain.samples) largest = std::max(largest, std::abs(sample));
  ASSERT_GT(largest, 0);
  for (const auto& tiling : {Tiling{}, Tiling{2, 48, true}, Tiling{3, 16}})
    for (const int threads : {1, 3}) {
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
