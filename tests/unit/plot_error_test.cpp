// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.hpp"
#include "plot/colour_map.hpp"
#include "plot/error_picture.hpp"
#include "plot/error_series.hpp"
#include "plot_cases.hpp"
#include "plot_pixels.hpp"

namespace slipwave::plot::plot_error_test {
namespace {

AccuracyRow row_of(int order, double spacing_m, double error, double seconds) {
  AccuracyRow row;
  row.order = order;
  row.courant = 0.9;
  row.spacing_m = spacing_m;
  row.error = error;
  row.seconds = seconds;
  return row;
}

/// Two orders; the setting of order 3 and 5 m has exactly the error of 1 % that is wanted.
AccuracyTable table() {
  AccuracyTable table;
  table.title = "Case";
  table.rows = {row_of(1, 5, 0.2, 20), row_of(1, 10, 0.4, 2.5), row_of(3, 10, 0.09, 5),
                row_of(3, 5, 0.01, 40)};
  return table;
}

Pixels drawn(const AccuracyTable& table) {
  return decoded(draw_error({table}, false, {}, page_of_size("1200x700px")).bytes);
}

/// Red as of the line at the wanted error and the ring.
bool is_red(std::uint32_t pixel) {
  return (pixel >> 16) > 0xa8 && (pixel >> 8 & 0xff) < 0x50 && (pixel & 0xff) < 0x50;
}

/// The colour of order 3's lines and markers.
bool is_third_order(std::uint32_t pixel) { return alike(pixel, pixel_of(line_colour(1)) & 0xffffff); }

TEST(PlotError, MethodsBecomeLinesFromCoarseToFineCells) {
  auto rows = table();
  rows.rows[1].slip_order = 2;
  const auto series = series_of(rows);
  ASSERT_EQ(series.size(), 3u);
  EXPECT_EQ(series[2].points[0].spacing_m, 10);
  EXPECT_EQ(series[2].points[1].spacing_m, 5);
  EXPECT_DOUBLE_EQ(series[2].points[1].error, 1);  // percent
}

TEST(PlotError, WhatIsNotKnownIsNotNamed) {
  AccuracyTable peer;
  AccuracyRow row;
  row.spacing_m = row.courant = std::nan("");
  for (const double error : {0.01, 0.001})
    row.error = error, row.seconds = 1 / error, peer.rows.push_back(row);
  const auto series = series_of(peer);
  ASSERT_EQ(series.size(), 1u);
  EXPECT_EQ(series[0].points.size(), 2u);
  EXPECT_EQ(name_of(series[0].method, {series[0].method, {5, 2, 0, 0.9}}), "order 5");
}

TEST(PlotError, NamesSayWhatDiffers) {
  const Method one{3, 2, 0, 0.9}, faster{3, 2, 0, 1}, finer{3, 4, 1, 0.9};
  EXPECT_EQ(name_of(one, {one, {5, 2, 0, 0.9}}), "order 3");
  EXPECT_EQ(name_of(faster, {one, faster}), "order 3, Courant 1");
  EXPECT_EQ(name_of(finer, {one, finer}), "order 3, 4 in time, slip order 1");
  EXPECT_EQ(name_of(one, {one, finer}), "order 3, 2 in time, no slip");
}

TEST(PlotError, TheWantedErrorIsALineAtItsHeight) {
  auto with = table();
  const auto without = drawn(with);
  EXPECT_EQ(patch_where(without, is_red).count, 0);
  with.wanted_error = 0.01;
  const auto pixels = drawn(with);
  const auto line = patch_where(pixels, is_red);
  ASSERT_GT(line.count, 300);
  // Of the marks in the colour of order 3, the lowest is the setting with just that error.
  int lowest = 0;
  for (int y = 0; y < pixels.height; ++y) {
    for (int x = 0; x < pixels.width; ++x) {
      if (is_third_order(pixels.at(x, y))) lowest = std::max(lowest, y);
    }
  }
  int row = 0, most = 0;
  for (int y = 0; y < pixels.height; ++y) {
    int red = 0;
    for (int x = 0; x < pixels.width; ++x) red += is_red(pixels.at(x, y));
    if (red > most) most = red, row = y;
  }
  EXPECT_GT(most, 150);
  EXPECT_NEAR(lowest, row + 5, 3);  // half a marker of 6 points at 150 dpi
}

TEST(PlotError, OnlyTheChosenSettingHasARing) {
  auto with = table();
  with.chosen = 3;
  const auto ring = patch_where(drawn(with), is_red);
  EXPECT_GT(ring.count, 60);
}

TEST(PlotError, SettingsWithoutErrorOrTimeAreLeftOut) {
  auto partly = table();
  partly.rows.insert(partly.rows.begin(),
                     row_of(7, 1.25, 0, 1e9));  // the reference itself, in the legend neither
  partly.rows.push_back(row_of(3, 2.5, std::numeric_limits<double>::quiet_NaN(), 300));
  const auto bytes = [](const AccuracyTable& of) {
    return draw_error({of}, false, {}, page_of_size("")).bytes;
  };
  EXPECT_TRUE(bytes(partly) == bytes(table()));
  AccuracyTable none;
  none.rows = {row_of(7, 1.25, 0, 10)};
  EXPECT_THROW(drawn(none), Error);
}

}  // namespace
}  // namespace slipwave::plot::plot_error_test
