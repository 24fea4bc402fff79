// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "plot/magnitudes.hpp"
#include "plot/raster.hpp"

namespace slipwave::plot::plot_raster_test {
namespace {

std::vector<Cells> pixels_over(std::int64_t cells, int pixels) {
  const Scale scale({"", "", 0, double(cells)}, 0, 100);
  return cells_of_pixels(scale, 0, 100, pixels, even_edges(0, 1, cells));
}

TEST(PlotRaster, EveryCellIsInOnePixelWhereCellsAreMore) {
  for (const int pixels : {1, 7, 64, 999}) {
    const auto cells = pixels_over(1000, pixels);
    EXPECT_EQ(cells.front().first, 0);
    EXPECT_EQ(cells.back().last, 1000);
    for (std::size_t n = 1; n < cells.size(); ++n) EXPECT_EQ(cells[n].first, cells[n - 1].last);
  }
}

TEST(PlotRaster, EveryPixelShowsTheCellItsMiddleLiesInWhereCellsAreFewer) {
  const auto cells = pixels_over(3, 10);
  for (int n = 0; n < 10; ++n) {
    const auto expected = std::int64_t((n + 0.5) * 0.3);
    EXPECT_EQ(cells[std::size_t(n)].first, expected) << n;
    EXPECT_EQ(cells[std::size_t(n)].last, expected + 1) << n;
  }
}

TEST(PlotRaster, PixelsOutsideTheCellsAreEmpty) {
  const Scale scale({"", "", -10, 20}, 0, 30);
  const auto cells = cells_of_pixels(scale, 0, 30, 30, even_edges(0, 1, 10));
  for (int n = 0; n < 30; ++n)
    EXPECT_EQ(cells[std::size_t(n)].last - cells[std::size_t(n)].first, n >= 10 && n < 20 ? 1 : 0) << n;
}

TEST(PlotRaster, AnAxisThatPointsUpTurnsTheRowsRound) {
  const Scale scale({"", "", 0, 5}, 100, 0);
  const auto cells = cells_of_pixels(scale, 0, 100, 5, even_edges(0, 1, 5));
  for (int n = 0; n < 5; ++n) EXPECT_EQ(cells[std::size_t(n)].first, 4 - n);
}

TEST(PlotRaster, ASingleSpikeIsSeenHoweverManyCellsThereAre) {
  const std::int64_t nx = 2000, nz = 500;
  std::vector<float> values(std::size_t(nx * nz), 0.0f);
  const auto columns = pixels_over(nx, 37), rows = pixels_over(nz, 11);
  std::mt19937 random(4);
  for (int trial = 0; trial < 50; ++trial) {
    const auto cell = std::size_t(random() % values.size());
    values[cell] = -1;
    const auto raster =
        reduced<float>([&](std::int64_t k) { return values.data() + k * nx; }, columns, rows, Take::extreme);
    EXPECT_EQ(std::count(raster.values.begin(), raster.values.end(), -1.0f), 1);
    const int column = int(std::int64_t(cell) % nx * 37 / nx), row = int(std::int64_t(cell) / nx * 11 / nz);
    float found = 0;  // the pixel or, at an edge, its neighbour
    for (int c = std::max(0, column - 1); c <= std::min(36, column + 1); ++c)
      for (int r = std::max(0, row - 1); r <= std::min(10, row + 1); ++r)
        found = std::min(found, raster.at(c, r));
    EXPECT_EQ(found, -1.0f);
    values[cell] = 0;
  }
}

TEST(PlotRaster, TheMeanOfALinearFieldIsItsMiddle) {
  const std::int64_t n = 120;
  std::vector<float> values;
  for (int k = 0; k < n; ++k)
    for (int i = 0; i < n; ++i) values.push_back(float(2 * (i + 0.5) + 3 * (k + 0.5)));
  const auto raster = reduced<float>([&](std::int64_t k) { return values.data() + k * n; },
                                     pixels_over(n, 10), pixels_over(n, 12), Take::mean);
  for (int row = 0; row < 12; ++row)
    for (int column = 0; column < 10; ++column)
      EXPECT_NEAR(raster.at(column, row), 2 * (12 * column + 6) + 3 * (10 * row + 5), 1e-3);
}

TEST(PlotRaster, WhatIsNoNumberDoesNotCount) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const std::vector<float> values = {nan, 4, nan, nan, -6, 2};
  const auto row = [&](std::int64_t) { return values.data(); };
  const std::vector<Cells> columns = {{0, 2}, {2, 4}, {3, 6}}, rows = {{0, 1}};
  const auto mean = reduced<float>(row, columns, rows, Take::mean);
  EXPECT_EQ(mean.values[0], 4);
  EXPECT_TRUE(std::isnan(mean.values[1]));
  EXPECT_EQ(mean.values[2], -2);
  EXPECT_EQ(reduced<float>(row, columns, rows, Take::extreme).values[2], -6);
  EXPECT_EQ(reduced<float>(row, columns, rows, Take::greatest).values[2], 2);
}

TEST(PlotRaster, UnevenPlacesReachHalfWayToTheirNeighbours) {
  EXPECT_EQ(cells_round({0, 10, 24}).edges, (std::vector<double>{-5, 5, 17, 29}));
  EXPECT_EQ(cells_round({3}).edges, (std::vector<double>{2.5, 3.5}));
  // A spread may be wider farther out.
  const auto wider = cells_round({0, 10, 20, 30, 40, 50, 60, 100, 140, 180, 220, 260, 300});
  EXPECT_EQ(wider.place.size(), 13u);
  EXPECT_EQ(wider.edges[7], 80);
}

TEST(PlotRaster, WhereAPlaceIsMissingThereIsAGap) {
  const auto cells = cells_round({0, 10, 20, 40, 50, 350, 360});
  const auto gap = PlaceCells::gap;
  EXPECT_EQ(cells.place, (std::vector<std::int64_t>{0, 1, 2, gap, 3, 4, gap, 5, 6}));
  EXPECT_EQ(cells.edges, (std::vector<double>{-5, 5, 15, 25, 35, 45, 55, 345, 355, 365}));
  EXPECT_EQ(cells.middles[6], 200);
}

TEST(PlotMagnitudes, PercentilesAreThoseOfSortedMagnitudes) {
  std::mt19937 random(5);
  std::normal_distribution<float> normal;
  std::vector<float> values(20001);
  for (auto& value : values) value = 1e-9f * normal(random);
  Magnitudes magnitudes;
  magnitudes.add({values.data(), 7000});
  magnitudes.add({values.data() + 7000, values.size() - 7000});
  std::vector<double> sorted;
  for (const float value : values) sorted.push_back(std::fabs(double(value)));
  std::sort(sorted.begin(), sorted.end());
  for (const double percent : {1.0, 50.0, 90.0, 99.0, 99.9}) {
    const double expected = sorted[std::size_t(percent / 100 * double(sorted.size() - 1))];
    EXPECT_NEAR(magnitudes.percentile(percent), expected, 0.006 * expected) << percent;
  }
  EXPECT_EQ(magnitudes.percentile(100), sorted.back());
}

TEST(PlotMagnitudes, LeaveOutWhatIsStillOrNoNumber) {
  const std::vector<float> values = {0,
                                     0,
                                     0,
                                     0,
                                     0,
                                     0,
                                     0,
                                     -3,
                                     3,
                                     3,
                                     std::numeric_limits<float>::quiet_NaN(),
                                     std::numeric_limits<float>::infinity()};
  Magnitudes magnitudes;
  EXPECT_EQ(magnitudes.percentile(99), 0);
  magnitudes.add(values);
  EXPECT_NEAR(magnitudes.percentile(10), 3, 0.02);
  EXPECT_EQ(magnitudes.largest(), 3);
}

/// 12 x 5 unit cells whose values are linear in place, drawn on pixels that are finer or coarser than they.
Raster linear_field(int width, int height, Take take) {
  std::vector<float> values;
  for (int k = 0; k < 5; ++k)
    for (int i = 0; i < 12; ++i) values.push_back(float(2 * (i + 0.5) - 7 * (k + 0.5)));
  const auto mixes = [](int cells, int pixels) {
    const auto edges = even_edges(0, 1, cells);
    return mixes_of_pixels(Scale({"", "", 0, double(cells)}, 0, 100), 0, 100, pixels, edges,
                           middles_of(edges));
  };
  return interpolated([&](std::int64_t k) { return values.data() + 12 * k; }, mixes(12, width),
                      mixes(5, height), take);
}

TEST(PlotRaster, InterpolationIsExactForWhatIsLinear) {
  const int width = 120, height = 45;
  const auto raster = linear_field(width, height, Take::extreme);
  for (int row = 0; row < height; ++row) {
    for (int column = 0; column < width; ++column) {
      // Beyond the outermost middles their values stay.
      const double x = std::clamp((column + 0.5) * 12 / width, 0.5, 11.5);
      const double z = std::clamp((row + 0.5) * 5 / height, 0.5, 4.5);
      EXPECT_NEAR(raster.at(column, row), 2 * x - 7 * z, 1e-5);
    }
  }
}

TEST(PlotRaster, InterpolationStillTakesAllCellsOfACoarsePixel) {
  const auto raster = linear_field(3, 45, Take::mean);  // four cells a pixel across
  for (int row = 0; row < 45; ++row) {
    const double z = std::clamp((row + 0.5) / 9, 0.5, 4.5);
    for (int column = 0; column < 3; ++column)
      EXPECT_NEAR(raster.at(column, row), 2 * (4 * column + 2) - 7 * z, 1e-5);
  }
}

TEST(PlotRaster, InterpolationLeavesWhatHasNoValueItsCells) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const std::vector<float> values = {1, nan, 3};
  const auto value = [&](std::int64_t n) { return values[std::size_t(n)]; };
  EXPECT_EQ(mixed(value, {{0, 2}, 0.4}, Take::mean), 1);
  EXPECT_TRUE(std::isnan(mixed(value, {{0, 2}, 0.6}, Take::mean)));
  EXPECT_EQ(mixed(value, {{1, 3}, 0.6}, Take::mean), 3);
}

}  // namespace
}  // namespace slipwave::plot::plot_raster_test
