// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "cube.hpp"
#include "long_form.hpp"
#include "parallel/threads.hpp"

namespace slipwave::solver {

/// All that comes out of a shot: samples, snapshots, what its diary says of energy and of cells that slip.
struct Outcome {
  std::vector<double> samples, energies;
  std::vector<float> snapshots;
  std::vector<std::int64_t> cells;
};

/// Shoots, and adds snapshots behind those that earlier runs of the same shot took.
template <int D>
void shoot_into(Outcome& outcome, const Scene<D>& scene, Pauses* pauses = nullptr, Ranks* ranks = nullptr) {
  const SnapshotSink<D> sink = [&](double, const FieldReader<D>& read) {
    for (const FieldKey key : {FieldKey(Component::vx), FieldKey(Component::szz), FieldKey(Component::sxz),
                               FieldKey(SlipField::slip), FieldKey(SlipField::opening)}) {
      const auto field = read(key);
      outcome.snapshots.insert(outcome.snapshots.end(), field.begin(), field.end());
    }
  };
  ShotReport report;
  outcome.samples = samples_of(shoot(scene, 1, {}, scene.snapshot_every_s ? sink : SnapshotSink<D>(), pauses,
                                     scene.slip_diary ? &report : nullptr, ranks));
  const auto slip = report.slip.value_or(SlipTotals{});
  outcome.energies = {report.energy_left, report.source_work.value_or(0), slip.dissipated, slip.out_of_waves};
  outcome.cells = {slip.cells, slip.slipped};
}
template <int D>
Outcome outcome_of(const Scene<D>& scene) {
  Outcome outcome;
  shoot_into(outcome, scene);
  return outcome;
}

/// Expects the same diary; energies are sums over the pieces of rows.
inline void expect_same_diary(const Outcome& found, const Outcome& expected) {
  for (std::size_t n = 0; n < expected.energies.size(); ++n)
    EXPECT_NEAR(found.energies[n], expected.energies[n], 1e-9 * expected.energies[0]) << n;
  EXPECT_EQ(found.cells, expected.cells);
}
/// Expects all to be the same, to the last bit where it is no sum.
inline void expect_same_outcome(const Outcome& found, const Outcome& expected) {
  EXPECT_TRUE(found.samples == expected.samples);
  EXPECT_TRUE(found.snapshots == expected.snapshots);
  expect_same_diary(found, expected);
}

/// What the plain executor makes of a scene, which does each entry of the time step on the whole grid.
template <int D>
Outcome plain_outcome_of(Scene<D> scene) {
  check(scene);
  scene.numerics.tiling = {};
  scene.numerics.tiling.plain = true;
  const auto plain = outcome_of(scene);
  const auto is_signal = [](double sample) { return std::isfinite(sample) && sample != 0; };
  EXPECT_TRUE(std::any_of(plain.samples.begin(), plain.samples.end(), is_signal));
  return plain;
}

/// Expects the tiled executor to give that: each kind of tiles by one thread or by three, in the long form by
/// both.
template <int D>
void expect_same_in_tiles(Scene<D> scene, const Outcome& plain,
                          const std::vector<std::pair<Tiling, int>>& kinds) {
  for (const auto& [tiling, of_threads] : kinds)
    for (const int threads : {1, 3}) {
      if (threads != of_threads && !long_form()) continue;
      const ThreadLimit limit(threads);
      scene.numerics.tiling = tiling;
      SCOPED_TRACE(std::to_string(tiling.steps) + " steps, " + std::to_string(tiling.stripe_cells) +
                   " cells, " + std::to_string(threads) + " threads");
      expect_same_outcome(outcome_of(scene), plain);
    }
}
/// In stripes that also cut small models; in the long form in those of the usual size, too.
template <int D>
void expect_same(const Scene<D>& scene) {
  std::vector<std::pair<Tiling, int>> kinds = {{{2, D == 2 ? 48 : 4, true}, 1}, {{3, D == 2 ? 16 : 5}, 3}};
  if (long_form()) kinds.push_back({{}, 3});
  expect_same_in_tiles(scene, plain_outcome_of(scene), kinds);
}

}  // namespace slipwave::solver
