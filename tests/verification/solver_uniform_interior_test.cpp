// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "lab.hpp"
#include "solver/sweep/domain.hpp"
#include "solver/sweep/state.hpp"

namespace slipwave::solver::solver_uniform_interior_test {
namespace {

constexpr Rock rock{4500, 2250, 2500}, water{1500, 0, 1000}, soft{2500, 1200, 2000}, nothing{0, 0, 0};

/// A dipping interface, blocks, single cells of another rock, a fluid, a cave.
Medium<2> ground(std::int64_t nx, std::int64_t nz) {
  auto medium = uniform_medium(nx, nz, 5, rock);
  for (std::int64_t k = 0; k < nz; ++k)
    for (std::int64_t i = 0; i < nx; ++i) {
      if (k < 10) put(medium, {i, k}, water);
      if (k > 60 + i / 8) put(medium, {i, k}, soft);
      if (k >= 20 && k < 30 && i >= 100 && i < 190) put(medium, {i, k}, soft);
      if (k == 40 && (i == 77 || i == 150)) put(medium, {i, k}, water);
      if (k >= 45 && k < 50 && i >= 200 && i < 290) put(medium, {i, k}, nothing);
    }
  return medium;
}

// Proves (E9a).
TEST(UniformInterior, HoldsCellsWithNeighboursOfTheirOwnMaterialInWholeBlocks) {
  constexpr std::int64_t block = Layout<2>::block, nx = 333, nz = 120, stretch = 64;
  const auto medium = ground(nx, nz);
  EdgeLaws<2> edges = edges_all(EdgeLaw::mirror);
  const auto domain = make_domain(medium, edges, 0);
  auto state = make_state<2, float>(domain.grid.shape);
  fill_material(state, domain, medium, 1e-3);
  const auto same = [&](std::int64_t i, std::int64_t k, std::int64_t other_i, std::int64_t other_k) {
    if (std::min({i, k, other_i, other_k}) < 0 || std::max(i, other_i) >= nx || std::max(k, other_k) >= nz)
      return false;
    const auto one = medium.grid().flat({i, k}), other = medium.grid().flat({other_i, other_k});
    return medium.vp[std::size_t(one)] > 0 && medium.vp[std::size_t(one)] == medium.vp[std::size_t(other)] &&
           medium.vs[std::size_t(one)] == medium.vs[std::size_t(other)] &&
           medium.rho[std::size_t(one)] == medium.rho[std::size_t(other)];
  };
  for (const int axis : {0, 1}) {
    std::int64_t inside_in_all = 0;
    for (std::int64_t k = 0; k < nz; ++k) {
      std::vector<bool> inside(nx);
      for (const auto& run : state.uniform_interior[std::size_t(axis)].of(k)) {
        EXPECT_EQ(run.first % block, 0);
        EXPECT_EQ(run.last % block, 0);
        for (auto i = run.first; i < run.last; ++i) inside[std::size_t(i)] = true;
      }
      const auto alone = [&](std::int64_t i) {
        return axis == 0 ? same(i, k, i - 1, k) && same(i, k, i + 1, k)
                         : same(i, k, i, k - 1) && same(i, k, i, k + 1);
      };
      // Cells of the same material without a gap on a line around cell i.
      const auto around = [&](std::int64_t i, std::int64_t row) {
        std::int64_t first = i, last = i + 1;
        while (same(first - 1, row, i, row)) --first;
        while (same(last, row, i, row)) ++last;
        return last - first;
      };
      const auto long_enough = [&](std::int64_t i) {
        return around(i, k) >= stretch &&
               (axis == 0 || (around(i, k - 1) >= stretch && around(i, k + 1) >= stretch));
      };
      for (std::int64_t i = 0; i < nx; ++i) {
        if (inside[std::size_t(i)]) {
          EXPECT_TRUE(alone(i)) << axis << ": " << i << ' ' << k;
        }
        inside_in_all += inside[std::size_t(i)];
      }
      // None is left out that could be one: two whole blocks of such cells.
      for (std::int64_t i = 0; i + 2 * block <= nx; i += block) {
        bool all = true;
        for (auto j = i; j < i + 2 * block; ++j) all &= same(j, k, i, k) && alone(j) && long_enough(j);
        if (all) {
          EXPECT_TRUE(inside[std::size_t(i)]) << axis << ": " << i << ' ' << k;
        }
      }
    }
    EXPECT_GT(inside_in_all, nx * nz / 2);
  }
}

TEST(UniformInterior, SplitsColumnsIntoRunsAndTheRest) {
  const IndexRange runs[] = {{16, 64}, {96, 160}};
  const auto cut = [&](const IndexRange& columns, std::int64_t less) {
    std::vector<std::array<std::int64_t, 3>> parts;
    split_by_runs(
        runs, less, columns,
        [&](const IndexRange& part) {
          parts.push_back({part.first, part.last, 1});
        },
        [&](const IndexRange& part) {
          parts.push_back({part.first, part.last, 0});
        });
    return parts;
  };
  using Parts = std::vector<std::array<std::int64_t, 3>>;
  EXPECT_EQ(cut({0, 200}, 0), (Parts{{0, 16, 0}, {16, 64, 1}, {64, 96, 0}, {96, 160, 1}, {160, 200, 0}}));
  EXPECT_EQ(cut({20, 100}, 0), (Parts{{20, 64, 1}, {64, 96, 0}, {96, 100, 1}}));
  EXPECT_EQ(cut({0, 200}, 1), (Parts{{0, 17, 0}, {17, 64, 1}, {64, 97, 0}, {97, 160, 1}, {160, 200, 0}}));
  EXPECT_EQ(cut({16, 17}, 1), (Parts{{16, 17, 0}}));
  EXPECT_EQ(cut({70, 80}, 0), (Parts{{70, 80, 0}}));
  EXPECT_EQ(cut({80, 80}, 0), Parts{});
}

}  // namespace
}  // namespace slipwave::solver::solver_uniform_interior_test
