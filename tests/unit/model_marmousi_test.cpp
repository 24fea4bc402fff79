// SPDX-License-Identifier: BSD-3-Clause
#include "geology/marmousi.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "geology/layers.hpp"
#include "long_form.hpp"
#include "model_cases.hpp"
#include "parallel/threads.hpp"

namespace slipwave::model_marmousi_test {
namespace {

Medium<2> medium_of(double length_m, double depth_m, double spacing_m, std::uint64_t seed = 1,
                    bool average = true) {
  MarmousiSettings settings;
  settings.seed = seed;
  return marmousi_medium(grid_of_size<2>({length_m, depth_m}, spacing_m), settings, average);
}

void expect_cells_equal(const Medium<2>& a, std::size_t i, const Medium<2>& b, std::size_t k) {
  EXPECT_EQ(a.vp[i], b.vp[k]);
  EXPECT_EQ(a.vs[i], b.vs[k]);
  EXPECT_EQ(a.rho[i], b.rho[k]);
}

}  // namespace

TEST(Marmousi, IsTheSameGeologyAtEveryStep) {
  // The centre of a cell of 30 m is that of the middle one of its nine cells of 10 m.
  const auto coarse = medium_of(9990, 3480, 30, 1, false), fine = medium_of(9990, 3480, 10, 1, false);
  for (std::int64_t k = 0; k < coarse.grid().shape[1]; ++k)
    for (std::int64_t i = 0; i < coarse.grid().shape[0]; ++i)
      expect_cells_equal(coarse, std::size_t(coarse.grid().flat({i, k})), fine,
                         std::size_t(fine.grid().flat({3 * i + 1, 3 * k + 1})));
}

TEST(Marmousi, HasTheSameMeansAtEveryStep) {
  // Mass is additive: a cell of 20 m weighs what its sixteen cells of 5 m do. Both count by points, 32 in
  // the coarse cell and 512 in the fine ones, so what is left are shares of beds between points.
  const auto coarse = medium_of(10000, 3500, 20), fine = medium_of(10000, 3500, 5);
  double difference = 0, variance = 0, mean = 0;
  for (const double rho : coarse.rho) mean += rho / double(coarse.rho.size());
  for (std::int64_t k = 0; k < coarse.grid().shape[1]; ++k) {
    for (std::int64_t i = 0; i < coarse.grid().shape[0]; ++i) {
      double rho = 0;
      for (std::int64_t n = 0; n < 16; ++n) {
        rho += double(fine.rho[std::size_t(fine.grid().flat({4 * i + n % 4, 4 * k + n / 4}))]) / 16;
      }
      const double found = double(coarse.rho[std::size_t(coarse.grid().flat({i, k}))]);
      // The sea floor at 450 m is a face of the fine cells and runs through coarse ones.
      if (k == 22) continue;
      difference += std::pow(found - rho, 2);
      variance += std::pow(rho - mean, 2);
    }
  }
  EXPECT_LT(std::sqrt(difference / variance), 0.008);
}

TEST(Marmousi, GoesOnWhereASmallerModelEnds) {
  const auto small = medium_of(3000, 2000, 20), large = medium_of(20000, 3500, 20);
  for (std::int64_t k = 0; k < small.grid().shape[1] - 1; ++k)
    for (std::int64_t i = 0; i < small.grid().shape[0]; ++i)
      expect_cells_equal(small, std::size_t(small.grid().flat({i, k})), large,
                         std::size_t(large.grid().flat({i, k})));
}

TEST(Marmousi, DoesNotDependOnTheNumberOfThreads) {
  Medium<2> one;
  {
    const ThreadLimit limit(1);
    one = medium_of(10000, 3500, 50);
  }
  const auto all = medium_of(10000, 3500, 50);
  EXPECT_TRUE(std::equal(one.vp.begin(), one.vp.end(), all.vp.begin()));
  EXPECT_TRUE(std::equal(one.rho.begin(), one.rho.end(), all.rho.begin()));
}

TEST(Marmousi, IsAnotherGeologyForEverySeed) {
  const auto first = medium_of(10000, 3500, 50, 1);
  for (const std::uint64_t seed : {0ULL, 2ULL, 3ULL, ~0ULL}) {
    const auto other = medium_of(10000, 3500, 50, seed);
    int differ = 0;
    for (std::size_t cell = 0; cell < first.vp.size(); ++cell) {
      differ += std::abs(first.vp[cell] - other.vp[cell]) > 50;
    }
    EXPECT_GT(differ, int(first.vp.size()) / 2) << seed;
  }
}

TEST(Marmousi, IsPhysicalForManySeedsAndSizes) {
  for (std::uint64_t seed = 0; seed < (long_form() ? 40 : 12); ++seed) {
    Model<2> model;
    model.medium = medium_of(20000, 6000, 100, seed);
    EXPECT_NO_THROW(check(model)) << seed;
  }
}

TEST(Marmousi, IsWaterDownToTheSeaFloorAndRockBelow) {
  const auto grid = grid_of_size<2>({5000, 2000}, 20);
  for (const double water : {0., 200., 450., 1000., 5000.}) {
    MarmousiSettings settings;
    settings.water_m = water;
    const auto medium = marmousi_medium(grid, settings);
    for (std::int64_t cell = 0; cell < grid.size(); ++cell) {
      const bool wet = grid.centre(1, grid.index(cell)[1]) < water;
      EXPECT_EQ(medium.is_fluid(std::size_t(cell)), wet);
      if (wet) {
        EXPECT_EQ(medium.vp[std::size_t(cell)], 1500);
        EXPECT_EQ(medium.rho[std::size_t(cell)], 1010);
      }
    }
  }
}

TEST(Marmousi, IsTheSamePictureAtEveryScale) {
  MarmousiSettings settings;
  const auto full = marmousi_medium(grid_of_size<2>({10000, 3500}, 50), settings);
  settings.scale = 0.25, settings.water_m /= 4;
  const auto quarter = marmousi_medium(grid_of_size<2>({2500, 875}, 12.5), settings);
  for (std::size_t cell = 0; cell < full.vp.size(); ++cell) expect_cells_equal(full, cell, quarter, cell);
}

TEST(Marmousi, TakesOneRatioOfSpeedsForAllRock) {
  MarmousiSettings settings;
  settings.vp_over_vs = 1.75;
  const auto medium = marmousi_medium(grid_of_size<2>({10000, 3500}, 100), settings, false);
  for (std::size_t cell = 0; cell < medium.vp.size(); ++cell) {
    if (medium.is_solid(cell)) {
      EXPECT_NEAR(medium.vp[cell] / medium.vs[cell], 1.75, 1e-5);
    }
  }
}

TEST(Marmousi, RefusesSettingsWithoutSense) {
  const auto grid = grid_of(2, 2, 10);
  MarmousiSettings settings;
  settings.water_m = -1;
  EXPECT_EQ(sentence_of([&] { marmousi_medium(grid, settings); }),
            "found a depth of water of -1, expected it not below zero");
  settings = {}, settings.scale = 0;
  EXPECT_EQ(sentence_of([&] { marmousi_medium(grid, settings); }),
            "found a scale of 0, expected it above zero");
  settings.scale = 1e-300;
  EXPECT_EQ(sentence_of([&] { marmousi_medium(grid, settings); }),
            "found a length of 20, expected it at most 1e+09 m times the scale");
  settings = {}, settings.vp_over_vs = 1.2;
  EXPECT_EQ(sentence_of([&] { marmousi_medium(grid, settings); }),
            "found a vp/vs of 1.2, expected at least sqrt(2)");
}

}  // namespace slipwave::model_marmousi_test
