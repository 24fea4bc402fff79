// SPDX-License-Identifier: BSD-3-Clause
#include "rock/averaging.hpp"

#include <cmath>

#include "geology/layers.hpp"
#include "model_cases.hpp"
#include "rock/cut_cell.hpp"

namespace slipwave::model_averaging_test {
namespace {

const Material soft{2500, 1200, 2000}, hard{4500, 2250, 2500}, water{1500, 0, 1000}, air{};

/// Shares by looking at 400 x 400 points of the cell.
std::vector<double> counted_shares(const std::vector<Cut>& tops) {
  constexpr int n = 400;
  std::vector<double> shares(tops.size() + 1, 0.);
  for (int a = 0; a < n; ++a)
    for (int b = 0; b < n; ++b) {
      const double x = (a + 0.5) / n, z = (b + 0.5) / n;
      std::size_t i = tops.size();
      while (i > 0 && tops[i - 1].low + (tops[i - 1].high - tops[i - 1].low) * x > z) --i;
      shares[i > 0 ? i - 1 : tops.size()] += 1. / (n * n);
    }
  return shares;
}

/// The same in 3-D, by 200 x 200 x 400 points.
std::vector<double> counted_shares(const std::vector<Cut3D>& tops) {
  constexpr int n = 200, deep = 400;
  std::vector<double> shares(tops.size() + 1, 0.), depths(tops.size());
  for (int a = 0; a < n; ++a)
    for (int b = 0; b < n; ++b) {
      const double x = (a + 0.5) / n, y = (b + 0.5) / n;
      for (std::size_t i = 0; i < tops.size(); ++i) {
        const Cut &low = tops[i].low_y, &high = tops[i].high_y;
        depths[i] = low.low + (low.high - low.low) * x + (high.low - low.low) * y;
      }
      for (int c = 0; c < deep; ++c) {
        std::size_t i = tops.size();
        while (i > 0 && depths[i - 1] > (c + 0.5) / deep) --i;
        shares[i > 0 ? i - 1 : tops.size()] += 1. / (double(n) * n * deep);
      }
    }
  return shares;
}

/// A plane by its depth at x = y = 0 and what it gains across the cell along x and along y.
Cut3D plane(double depth, double along_x, double along_y) {
  return {{depth, depth + along_x}, {depth + along_y, depth + along_x + along_y}};
}

}  // namespace

// Proves (M1), (M2).
TEST(MaterialMean, AveragesDensityAndCompliances) {
  MaterialMean mean(soft);
  mean.add(soft, 3);
  mean.add(hard, 1);
  const auto found = mean.mean();
  const auto p = [](const Material& m) { return m.rho * m.vp * m.vp; };
  const auto s = [](const Material& m) { return m.rho * m.vs * m.vs; };
  EXPECT_NEAR(found.rho, 2125, 1e-9);
  EXPECT_NEAR(1 / p(found), 0.75 / p(soft) + 0.25 / p(hard), 1e-14 / p(soft));
  EXPECT_NEAR(1 / s(found), 0.75 / s(soft) + 0.25 / s(hard), 1e-14 / s(soft));
}

TEST(MaterialMean, OfOneMaterialIsThatMaterialBitForBit) {
  const Material odd{3123.456789, 1234.567891, 2345.678912};
  MaterialMean mean(odd);
  for (const double volume : {0.1, 0.2, 0.7, 1e-9}) mean.add(odd, volume);
  EXPECT_EQ(mean.mean(), odd);
}

// Proves (M1).
TEST(MaterialMean, CountsOnlyWhatIsOfTheKindOfTheCentre) {
  for (const auto& centre : {soft, water, air}) {
    MaterialMean mean(centre);
    for (const auto& part : {soft, water, air}) mean.add(part, 1);
    EXPECT_EQ(mean.mean(), centre);
  }
  MaterialMean nothing(hard);
  nothing.add(soft, 0);
  EXPECT_EQ(nothing.mean(), hard);
}

// Proves (M2).
TEST(MaterialMean, OfAdmissibleMaterialsIsAdmissible) {
  // vs <= vp/sqrt(2) is 1/mu >= 2/(lambda + 2 mu), which holds for sums where it holds for all parts.
  const Material limit{3000, 3000 / std::sqrt(2.0), 1800}, slow{1600, 10, 2600};
  for (const double share : {0.01, 0.3, 0.9}) {
    MaterialMean mean(limit);
    mean.add(limit, share);
    mean.add(slow, 1 - share);
    EXPECT_LE(mean.mean().vs, mean.mean().vp / std::sqrt(2.0));
    EXPECT_GT(mean.mean().vs, 0);
  }
}

// Proves (M1).
TEST(CutCell, SharesAreExactAreas) {
  // A corner of legs 0.5 and 0.25 below a top that leaves the cell through its lower edge.
  const auto corner = shares_of_cell(std::vector<Cut>{{0.75, 1.25}});
  EXPECT_NEAR(corner[0], 0.5 * 0.25 / 2, 1e-15);
  EXPECT_NEAR(corner[1], 1 - 0.0625, 1e-15);
  // Steep: from above the cell to below it.
  EXPECT_NEAR(shares_of_cell(std::vector<Cut>{{-3, 4}})[0], 0.5, 1e-14);
  EXPECT_EQ(shares_of_cell(std::vector<Cut>{{-2, 0}}), (std::vector<double>{1, 0}));
  EXPECT_EQ(shares_of_cell(std::vector<Cut>{{1, 7}}), (std::vector<double>{0, 1}));
}

// Proves (M1).
TEST(CutCell, SharesInSpaceAreExactVolumes) {
  // A corner of the cell's floor: legs of 0.5, 0.8 and 0.25.
  const auto corner = shares_of_cell(std::vector<Cut3D>{plane(0.75, 0.5, 0.25 / 0.8)});
  EXPECT_NEAR(corner[0], 0.5 * 0.8 * 0.25 / 6, 1e-15);
  EXPECT_NEAR(corner[1], 1 - 0.1 / 6, 1e-15);
  // Through the middle at any slope, also from above the cell to below it.
  for (const double slope : {0.3, 2., 50.})
    EXPECT_NEAR(shares_of_cell(std::vector<Cut3D>{plane(0.5 - slope, 1.5 * slope, slope / 2)})[0], 0.5,
                1e-14);
  EXPECT_EQ(shares_of_cell(std::vector<Cut3D>{plane(-2, 1, 1)}), (std::vector<double>{1, 0}));
  EXPECT_EQ(shares_of_cell(std::vector<Cut3D>{plane(1, 7, 1)}), (std::vector<double>{0, 1}));
  // A seam between two parallel planes, cut off by nothing; and the same plane twice, which leaves nothing
  // between.
  const auto seam = shares_of_cell(std::vector<Cut3D>{plane(0.3, 0.1, 0.2), plane(0.4, 0.1, 0.2)});
  EXPECT_NEAR(seam[0], 0.1, 1e-15);
  EXPECT_NEAR(seam[2], 0.45, 1e-15);
  EXPECT_NEAR(shares_of_cell(std::vector<Cut3D>(2, plane(0.3, 0.1, 0.2)))[0], 0, 1e-15);
}

TEST(CutCell, SharesInSpaceAreThoseOfTheSectionWhereTopsAre) {
  // Along y instead of x: as the section, but for rounding.
  const std::vector<Cut> section = {{-0.5, 1.5}, {0.4, 0.4}, {1.4, -0.2}};
  std::vector<Cut3D> along_x, along_y;
  for (const auto& cut : section) {
    along_x.push_back({cut, cut});
    along_y.push_back({{cut.low, cut.low}, {cut.high, cut.high}});
  }
  const auto expected = shares_of_cell(section), turned = shares_of_cell(along_y);
  EXPECT_EQ(shares_of_cell(along_x), expected);
  for (std::size_t i = 0; i < expected.size(); ++i) EXPECT_NEAR(turned[i], expected[i], 1e-15) << i;
}

TEST(CutCell, SharesInSpaceAreThoseOfManyPoints) {
  const std::vector<std::vector<Cut3D>> piles = {
      {plane(0.2, 0.1, 0.3), plane(0.6, 0.2, -0.3)},
      {plane(-0.5, 2, 0.7), plane(0.4, 0, 0), plane(1.4, -1.2, -0.9)},
      {plane(0.7, 0.2, -0.4), plane(0.3, -0.5, 1.1), plane(0.5, 0.9, -1.3), plane(0.9, 0.1, 0.1)},
  };
  for (const auto& tops : piles) {
    const auto found = shares_of_cell(tops), counted = counted_shares(tops);
    double sum = 0;
    for (std::size_t i = 0; i < found.size(); ++i) {
      EXPECT_NEAR(found[i], counted[i], 2e-4) << i;
      EXPECT_GE(found[i], 0);
      sum += found[i];
    }
    EXPECT_NEAR(sum, 1, 1e-14);
  }
}

TEST(CutCell, SharesOfManyTopsAreThoseOfManyPoints) {
  const std::vector<std::vector<Cut>> piles = {
      {{0.2, 0.3}, {0.6, 0.8}},  {{0.2, 0.9}, {0.8, 0.1}},      {{-0.5, 1.5}, {0.4, 0.4}, {1.4, -0.2}},
      {{0.7, 0.7}, {0.3, 0.35}}, {{-4, 1}, {-1, 2}, {-0.5, 3}}, {{-1, -1}, {0.5, 0.1}, {0.9, 2}},
  };
  for (const auto& tops : piles) {
    const auto found = shares_of_cell(tops), counted = counted_shares(tops);
    double sum = 0;
    for (std::size_t i = 0; i < found.size(); ++i) {
      EXPECT_NEAR(found[i], counted[i], 2e-3) << i;  // a point in 400 each way
      EXPECT_GE(found[i], 0);
      sum += found[i];
    }
    EXPECT_NEAR(sum, 1, 1e-14);
  }
}

TEST(Layers, CellsCutByATopTakeTheMeanOverTheirParts) {
  // A top at 13 of cells of 10: the second is 0.3 soft and 0.7 hard.
  const std::vector<Layer> layers = {{0, 2500, 1200, 2000, 0}, {13, 4500, 2250, 2500, 0}};
  const auto medium = layered_medium(grid_of(1, 3, 10), layers);
  MaterialMean mean(hard);
  mean.add(soft, 0.3);
  mean.add(hard, 0.7);
  EXPECT_FLOAT_EQ(medium.vp[1], float(mean.mean().vp));
  EXPECT_FLOAT_EQ(medium.vs[1], float(mean.mean().vs));
  EXPECT_FLOAT_EQ(medium.rho[1], 2350);
  EXPECT_EQ(medium.vp[0], 2500);
  EXPECT_EQ(medium.vp[2], 4500);
  EXPECT_EQ(layered_medium(grid_of(1, 3, 10), layers, Average::none).vp[1], 4500);
}

// Proves (M1).
TEST(Layers, KeepMassUnderADippingTop) {
  // A top through the middle of the model, from side to side: half of it is soft, half hard.
  const double rise = 400 * std::tan(0.4);
  const auto grid = grid_of(40, 40, 10);
  const auto medium = layered_medium(
      grid, {{-500, 2500, 1200, 2000, 0}, {200 - rise / 2, 4500, 2250, 2500, 0.4 * 180 / std::acos(-1.0)}});
  double mass = 0;
  for (const double rho : medium.rho) mass += rho / 1600;
  EXPECT_NEAR(mass, 2250, 1e-4);
}

TEST(Layers, AreNeverAveragedAcrossAFluidSolidInterface) {
  const auto grid = grid_of(40, 60, 5);
  const std::vector<Layer> layers = {{40, 1500, 0, 1000, 10}, {100, 3000, 1500, 2000, 30}};
  const auto mean = layered_medium(grid, layers), centre = layered_medium(grid, layers, Average::none);
  for (std::size_t cell = 0; cell < mean.vp.size(); ++cell) {
    EXPECT_EQ(mean.vp[cell], centre.vp[cell]);
    EXPECT_EQ(mean.vs[cell], centre.vs[cell]);
    EXPECT_EQ(mean.rho[cell], centre.rho[cell]);
  }
}

}  // namespace slipwave::model_averaging_test
