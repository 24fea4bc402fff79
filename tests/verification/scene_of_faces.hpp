// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "plain_and_tiled.hpp"
#include "shared_out.hpp"

namespace slipwave::solver {

/// Two rocks, one upon the other, without fractures: 480 m by 800 m, for those on faces between their cells.
inline Scene<2> two_rocks() {
  constexpr Rock rock{4500, 2250, 2500}, soft{2500, 1200, 2000};
  constexpr std::int64_t nx = 96, nz = 160;
  Scene<2> scene;
  scene.model.medium = uniform_medium(nx, nz, 5, rock);
  for (std::int64_t k = 100; k < nz; ++k)
    for (std::int64_t i = 0; i < nx; ++i) put(scene.model.medium, {i, k}, soft);
  scene.survey.sources = {{{203, 261}, parse_mechanism<2>("force:1,2"), parse_wavelet("ricker:40"), 1e6}};
  scene.survey.receivers_m = {{100, 33}, {402.5, 201.3}, {220, 400}, {227, 703.3}, {33, 641}};
  scene.edges = edges_all(EdgeLaw::absorbing);
  scene.edges[1][0] = EdgeLaw::free;
  scene.numerics.order = 7;
  scene.recording = {{Component::vx, Component::vz, Component::sxz}, 0.12, 0.001};
  return scene;
}

/// Expects tiles to give what the plain executor does, with the diary of slip, and at order 1 in double
/// precision.
inline void expect_same_in_tiles(Scene<2> scene) {
  scene.slip_diary = true;
  expect_same(scene);
  scene.numerics.order = 1;
  scene.numerics.double_precision = true;
  scene.recording.duration_s = 0.06;
  expect_same(scene);
}

/// Expects two and three ranks to give those samples of one.
inline void expect_same_on_ranks(const Scene<2>& scene, const std::vector<double>& alone) {
  for (const int count : {2, 3})
    EXPECT_TRUE(all_samples(shared_out(scene, count, 2)) == alone) << count << " ranks";
}

/// Expects single precision to be as near to double precision as rounding leaves it.
inline void expect_same_in_double_precision(Scene<2> scene) {
  scene.recording.duration_s = 0.3;
  const auto single = all_samples(shoot(scene, 1));
  scene.numerics.double_precision = true;
  const auto precise = all_samples(shoot(scene, 1));
  // Stresses and velocities have scales of their own: each by the largest of its trace.
  const std::size_t a_trace = precise.size() / 15;
  for (std::size_t n = 0; n < precise.size(); n += a_trace) {
    double off = 0, largest = 0;
    for (auto k = n; k < n + a_trace; ++k) {
      off = std::max(off, std::abs(single[k] - precise[k]));
      largest = std::max(largest, std::abs(precise[k]));
    }
    EXPECT_LT(off, 1e-4 * largest) << n / a_trace;
  }
}

}  // namespace slipwave::solver
