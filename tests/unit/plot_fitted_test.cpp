// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "curvilinear_grid.hpp"
#include "plot/model_picture.hpp"
#include "plot/snapshot_picture.hpp"
#include "plot_cases.hpp"
#include "plot_pixels.hpp"

namespace slipwave::plot::plot_fitted_test {
namespace {

Grid<2> level(Grid<2> grid) {
  return bent<2>(grid, [](double, double, double zeta) { return zeta; });
}

/// Rows under a surface that waves between 30 and 70 m, down to 200 m, in 40 columns.
Grid<2> hills() {
  return bent<2>({{40, 20}, 10, {0, 0}}, [](double x, double, double zeta) {
    const double top = 50 + 20 * std::sin(x / 60);
    return top + zeta / 200 * (200 - top);
  });
}

/// Whatever grid it is on, with the grid replaced.
template <class Value>
Field<2, Value> on(const Grid<2>& grid, const Field<2, Value>& field) {
  Field<2, Value> other(grid);
  std::copy(field.begin(), field.end(), other.begin());
  return other;
}

TEST(PlotFitted, PixelsShowTheCellTheyAreIn) {
  const auto grid = hills();
  Field<2> rows(grid);
  for (std::size_t cell = 0; cell < rows.size(); ++cell) rows[cell] = float(cell / 40);
  const auto axes = axes_of(grid, {});
  EXPECT_EQ(axes.depth.low, 0);
  EXPECT_EQ(axes.depth.high, 200);
  const auto page = page_of_size("900x700px");
  const Panel panel({"", axes.x, axes.depth}, {0, 0, page.width_pt, page.height_pt}, page);
  for (const auto take : {Take::mean, Take::extreme, Take::greatest}) {
    const auto raster = reduced(rows, pixels_of(panel, page, grid), take);
    const auto& plot = panel.plot();
    int above = 0;
    for (int row = 0; row < raster.height; ++row) {
      for (int column = 0; column < raster.width; ++column) {
        const double x = panel.x_scale().value(plot.x + (column + 0.5) * plot.width / raster.width);
        const double z = panel.y_scale().value(plot.y + (row + 0.5) * plot.height / raster.height);
        // Faces are straight between corners: off the sine by h^2/8 times its curvature at most.
        const double top = 50 + 20 * std::sin(x / 60), place = (z - top) / (200 - top) * 20;
        if (std::abs(place - std::round(place)) < 0.03) continue;
        const float found = raster.at(column, row);
        above += place < 0;
        if (place < 0)
          EXPECT_TRUE(std::isnan(found)) << x << ' ' << z;
        else
          EXPECT_EQ(found, float(std::floor(place))) << x << ' ' << z;
      }
    }
    EXPECT_GT(above, 1000);
  }
}

TEST(PlotFitted, MoreColumnsThanPixelsAreReduced) {
  const Grid<2> regular{{2000, 10}, 1, {0, 0}};
  const auto grid = bent<2>(regular, [](double, double, double zeta) { return 0.5 * zeta; });
  Field<2> spikes(grid, 1);
  for (std::int64_t k = 0; k < 10; ++k) spikes({1234, k}) = -7;
  const auto axes = axes_of(grid, {});
  EXPECT_EQ(axes.depth.high, 5);
  const auto page = page_of_size("600x400px");
  const Panel panel({"", axes.x, axes.depth}, {0, 0, page.width_pt, page.height_pt}, page);
  const auto raster = reduced(spikes, pixels_of(panel, page, grid), Take::extreme);
  EXPECT_EQ(std::count(raster.values.begin(), raster.values.end(), -7.f), raster.height);
}

TEST(PlotFitted, AModelOnLevelRowsHasThePictureOfTheRegularOne) {
  for (const bool as_sets : {false, true}) {
    auto section = fractured_blocks();
    const SurveyMarks marks{{{100, 60}}, {{0, 50}, {200, 55}}};
    const auto page = page_of_size("800x600px", "title");
    const auto regular = draw_model(section, as_sets, marks, {}, page);
    section.values = on(level(section.grid()), section.values);
    section.fracture = on(section.grid(), section.fracture);
    EXPECT_TRUE(draw_model(section, as_sets, marks, {}, page).bytes == regular.bytes);
  }
}

TEST(PlotFitted, ASnapshotOnLevelRowsHasThePictureOfTheRegularOne) {
  Snapshot snapshot{"vz", "m/s", 0.1, Field<2>({{40, 20}, 10, {0, 0}})};
  for (std::size_t cell = 0; cell < snapshot.values.size(); ++cell)
    snapshot.values[cell] = float(std::sin(0.1 * double(cell)));
  const auto page = page_of_size("800x600px");
  for (const bool over : {false, true}) {
    auto model = fractured_blocks();
    const auto draw = [&] {
      return draw_snapshot(snapshot, 1, over ? std::optional(model) : std::nullopt, {}, {}, page).bytes;
    };
    const auto regular = draw();
    const auto values = snapshot.values;
    snapshot.values = on(level(values.grid()), values);
    EXPECT_TRUE(draw() == regular);
    model.values = on(level(values.grid()), model.values);
    model.fracture = on(model.grid(), model.fracture);
    EXPECT_TRUE(draw() == regular);
    snapshot.values = values;
  }
}

TEST(PlotFitted, NothingIsAboveTheSurface) {
  const auto grid = hills();
  const auto page = page_of_size("800x600px");
  ModelSection model;
  model.property = "vp";
  model.unit = "m/s";
  model.values = Field<2>(grid, 2000);
  const Snapshot snapshot{"vz", "m/s", 0.1, Field<2>(grid, 0.5)};
  for (const auto& picture :
       {draw_model(model, false, {}, {}, page), draw_snapshot(snapshot, 1, std::nullopt, {}, {}, page),
        draw_snapshot(snapshot, 1, model, {}, {}, page)}) {
    const auto pixels = decoded(picture.bytes);
    // The mean of the surface is at a depth of (integral of 50 + 20 sin(x/60) over 400 m)/400 m of 200 m.
    const double share = (50 + 20 * 60 * (1 - std::cos(400. / 60)) / 400) / 200;
    const auto nothing = patch_of(pixels, 0xdbdbdb);
    std::int64_t count = 0;
    for (int y = nothing.top; y <= nothing.bottom; ++y)
      for (int x = nothing.left; x <= nothing.right; ++x) count += pixels.at(x, y) == 0xdbdbdb;
    const double width = nothing.right - nothing.left + 1;
    EXPECT_GT(width, 400);
    // Down to the deepest hollow, at 70 m.
    const double height = (nothing.bottom - nothing.top + 1) / 0.35;
    EXPECT_NEAR(double(count) / (width * height), share, 0.01);
  }
}

}  // namespace
}  // namespace slipwave::plot::plot_fitted_test
