// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include "cube.hpp"
#include "memory_archive.hpp"
#include "solver/shot_simulation.hpp"

namespace slipwave::solver {

/// Expects a shot that continues from a state kept half way, at an odd step, to record the same bits.
template <int D>
void expect_to_continue(const Scene<D>& scene) {
  ShotSimulation<D, float> whole(scene, 1, {}), begun(scene, 1, {}), continued(scene, 1, {});
  whole.run_to(whole.steps());
  begun.run_to(whole.steps() / 2 | 1);
  std::vector<char> kept;
  ToMemory to(kept);
  begun.serialize(to);
  FromMemory from(kept);
  continued.serialize(from);
  EXPECT_TRUE(from.all_used());
  continued.run_to(continued.steps());
  EXPECT_TRUE(samples_of(continued.take_gather()) == samples_of(whole.take_gather()));
}

}  // namespace slipwave::solver
