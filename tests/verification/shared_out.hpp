// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <utility>
#include <vector>

#include "parallel/threads.hpp"
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

}  // namespace slipwave::solver
