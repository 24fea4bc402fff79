// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>

#include "base/error.hpp"
#include "output/snapshot_netcdf.hpp"
#include "output/snapshot_reader.hpp"
#include "plot/colour_map.hpp"
#include "plot/snapshot_picture.hpp"
#include "plot_cases.hpp"
#include "plot_pixels.hpp"

namespace slipwave::plot_snapshot_test {
namespace {

class PlotSnapshot : public testing::Test {
 protected:
  PlotSnapshot()
      : path_(std::filesystem::temp_directory_path() / ("plot_snapshot_" + std::to_string(::getpid()))) {}
  ~PlotSnapshot() override { std::filesystem::remove(path_); }

  /// vz and p at 0, 0.1 and 0.2 s: cell number plus ten thousand times the time's, p negative.
  SnapshotReader<2> written() {
    SnapshotWriter<2> writer(path_.string(), grid_, {"vz", "p"}, {});
    for (int time = 0; time < 3; ++time) {
      std::vector<Field<2>> fields(2, Field<2>(grid_));
      for (std::size_t cell = 0; cell < fields[0].size(); ++cell) {
        fields[0][cell] = float(cell) + 1e4f * float(time);
        fields[1][cell] = -fields[0][cell];
      }
      writer.write(0.1 * time, fields);
    }
    writer.commit();
    return SnapshotReader<2>(NetcdfFile::open(path_.string()));
  }

  Grid<2> grid_{{8, 5}, 2.5, {10, 0}};
  std::filesystem::path path_;
};

TEST_F(PlotSnapshot, IsReadBackTimeByTime) {
  const auto reader = written();
  EXPECT_EQ(reader.grid(), grid_);
  EXPECT_EQ(reader.fields(), (std::vector<std::string>{"vz", "p"}));
  EXPECT_EQ(reader.times_s(), (std::vector<double>{0, 0.1, 0.2}));
  EXPECT_EQ(reader.unit("vz"), "m s-1");
  const auto field = reader.read("p", 2);
  for (std::size_t cell = 0; cell < field.size(); ++cell) EXPECT_EQ(field[cell], -float(cell) - 2e4f);
}

TEST_F(PlotSnapshot, TakesTheNearestTime) {
  const auto reader = written();
  EXPECT_EQ(reader.nearest(0), 0u);
  EXPECT_EQ(reader.nearest(0.06), 1u);
  EXPECT_EQ(reader.nearest(0.2), 2u);
  for (const double outside : {-1., 7.}) EXPECT_THROW(reader.nearest(outside), Error) << outside;
}

TEST_F(PlotSnapshot, NamesTheFieldsThereAre) {
  const auto reader = written();
  try {
    reader.read("div", 0);
    FAIL() << "read";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("'div', it holds vz, p"), std::string::npos) << error.what();
  }
}

TEST_F(PlotSnapshot, HalvesOfOppositeSignHaveOppositeColours) {
  plot::Snapshot snapshot{"vz", "m/s", 0.25, Field<2>(grid_)};
  for (std::size_t cell = 0; cell < snapshot.values.size(); ++cell)
    snapshot.values[cell] = grid_.index(std::int64_t(cell))[0] < 4 ? -2.0f : 2.0f;
  const auto picture = plot::draw_snapshot(snapshot, 2, {}, {}, {}, plot::page_of_size("800x600px"));
  const auto pixels = decoded(picture.bytes);
  const plot::ColourMap map("blue-red");
  const auto at = [&](int x) { return pixels.at(x, 300); };
  int x = 0, blue = 0, red = 0;
  while (x < 800 && at(x) != (map.pixel(0) & 0xffffff)) ++x;
  for (; x < 800 && at(x) == (map.pixel(0) & 0xffffff); ++x) ++blue;
  for (; x < 800 && at(x) == (map.pixel(1) & 0xffffff); ++x) ++red;
  EXPECT_GT(blue, 200);
  EXPECT_NEAR(blue, red, 2);
}

TEST_F(PlotSnapshot, OneCellAmongMillionsIsSeen) {
  plot::Snapshot snapshot{"vz", "m/s", 0.25, Field<2>(Grid<2>{{3000, 1000}, 1, {0, 0}})};
  snapshot.values[1234567] = -1;
  const auto page = plot::page_of_size("800x400px");
  const auto with = decoded(plot::draw_snapshot(snapshot, 1, {}, {}, {}, page).bytes);
  snapshot.values[1234567] = 0;
  const auto without = decoded(plot::draw_snapshot(snapshot, 1, {}, {}, {}, page).bytes);
  int different = 0;
  for (int y = 0; y < with.height; ++y) {
    for (int x = 0; x < with.width; ++x) {
      if (with.at(x, y) == without.at(x, y)) continue;
      ++different;
      EXPECT_EQ(with.at(x, y), plot::ColourMap("blue-red").pixel(0) & 0xffffff);  // in full
    }
  }
  EXPECT_EQ(different, 1);
}

TEST_F(PlotSnapshot, WhatIsStillShowsTheModelBelow) {
  const auto model = plot::three_blocks();
  plot::Snapshot still{"vz", "m/s", 0, Field<2>(model.grid())};
  const auto page = plot::page_of_size("800x600px");
  const auto pixels = decoded(plot::draw_snapshot(still, 1, model, {}, {}, page).bytes);
  // Blocks of 1000, 2000 and 3000 m/s: 70, 85 and 100 % white.
  const auto slow = patch_of(pixels, 0xb3b3b3), middle = patch_of(pixels, 0xd9d9d9);
  EXPECT_GT(slow.count, 15000);
  EXPECT_NEAR(double(middle.count) / double(slow.count), 2, 0.05);
  const auto svg = plot::draw_snapshot(still, 1, model, {}, {}, plot::page_of(plot::Format::svg, {})).bytes;
  EXPECT_NE(std::string(svg.begin(), svg.end()).find(">vp 1000 to 3000 m/s<"), std::string::npos);
  plot::Snapshot loud = still;
  for (auto& value : loud.values) value = 1;
  const auto covered = decoded(plot::draw_snapshot(loud, 1, model, {}, {}, page).bytes);
  EXPECT_EQ(patch_of(covered, 0xb3b3b3).count, 0);
}

}  // namespace
}  // namespace slipwave::plot_snapshot_test
