// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "parallel/threads.hpp"
#include "plain_and_tiled.hpp"
#include "ranks_in_threads.hpp"
#include "samples.hpp"
#include "scene/subdomains.hpp"
#include "solver/simulation.hpp"

namespace slipwave::solver {

/// What one of several ranks is given of a scene: in bands of cells all of it.
template <int D>
Scene<D> part_of(const Scene<D>& scene, Ranks& ranks) {
  if (!scene.numerics.bands.empty()) return scene;
  auto part = cut_to(scene, subdomain_for(scene, scene.model.grid(), ranks.number(), ranks.count()));
  join(part, ranks);
  return part;
}

/// What the first of so many ranks gets of the first shot.
template <int D>
Gather shared_out(const Scene<D>& scene, int count, int threads = 1) {
  const ThreadLimit limit(threads);
  Gather found;
  RanksInThreads::run(count, [&](Ranks& ranks) {
    const auto part = part_of(scene, ranks);
    check(part);
    auto gather = shoot(part, 1, {}, {}, nullptr, nullptr, &ranks);
    if (ranks.number() == 0) found = std::move(gather);
  });
  return found;
}

/// Expects ranks to give the outcome of one process, and all of them its diary.
template <int D>
void expect_same_on_ranks(const Scene<D>& scene, const Outcome& alone, int count, int threads) {
  SCOPED_TRACE(std::to_string(count) + " ranks, " + std::to_string(threads) + " threads");
  const ThreadLimit limit(threads);
  RanksInThreads::run(count, [&](Ranks& ranks) {
    const auto part = part_of(scene, ranks);
    check(part);
    Outcome found;
    shoot_into(found, part, nullptr, &ranks);
    if (ranks.number() == 0)
      expect_same_outcome(found, alone);
    else
      expect_same_diary(found, alone);
  });
}

}  // namespace slipwave::solver
