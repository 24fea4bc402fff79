// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>

#include "base/error.hpp"
#include "io/netcdf_file.hpp"
#include "model/model_netcdf.hpp"
#include "plot/derived_property.hpp"
#include "plot/model_picture.hpp"
#include "plot_cases.hpp"
#include "plot_pixels.hpp"

namespace slipwave::plot::plot_model_test {
namespace {

const Look in_grey{.map = "grey"};
// Half way from black to white as the eye sees it, lightness 128/255 of Oklab: its cube is the linear light,
// of which sRGB makes 1.055 (128/255)^(3/2.4) - 0.055 = 0.391.
constexpr std::uint32_t half_grey = 0x646464;

TEST(PlotModel, ASectionIsReadWithItsVoidAndItsFractures) {
  const auto path =
      (std::filesystem::temp_directory_path() / ("plot_model_" + std::to_string(::getpid()))).string();
  const auto blocks = fractured_blocks();
  Model<2> model;
  model.medium = {blocks.values, blocks.values, blocks.values};
  for (std::size_t cell = 0; cell < blocks.values.size(); ++cell) {
    const bool nothing = std::isnan(blocks.values[cell]);
    model.medium.vp[cell] = nothing ? 0 : blocks.values[cell];
    model.medium.vs[cell] =
        nothing || blocks.values[cell] == 1000 ? 0 : blocks.values[cell] / 2;  // fluid, rock
    model.medium.rho[cell] = nothing ? 0 : 2000;
  }
  model.fracture = blocks.fracture;
  model.fracture_sets = blocks.sets;
  write_model(model, path);
  for (const char* property : {"vp", "vs", "rho"}) {
    const auto section = read_model_section(NetcdfFile::open(path), property);
    const auto& field = property[0] == 'r'   ? model.medium.rho
                        : property[1] == 'p' ? model.medium.vp
                                             : model.medium.vs;
    EXPECT_EQ(section.grid(), model.grid());
    for (std::size_t cell = 0; cell < field.size(); ++cell) {
      EXPECT_EQ(std::isnan(section.values[cell]), model.medium.is_void(cell));
      EXPECT_TRUE(model.medium.is_void(cell) || section.values[cell] == field[cell]);
      EXPECT_EQ(section.fracture[cell], blocks.fracture[cell]);
    }
    ASSERT_EQ(section.sets.size(), 1u);
    EXPECT_EQ(section.sets[0].name, "cluster");
  }
  EXPECT_THROW(read_model_section(NetcdfFile::open(path), "q"), Error);
  std::filesystem::remove(path);
}

TEST(PlotModel, EveryCellHasTheColourOfItsValue) {
  const auto picture = draw_model(three_blocks(), false, {}, in_grey, page_of_size("800x600px"));
  const auto pixels = decoded(picture.bytes);
  ASSERT_EQ(pixels.width, 800);
  ASSERT_EQ(pixels.height, 600);
  // 1000 to 3000 m/s is black to white: 2000 is the middle grey, half as wide as the model and, below the
  // void, three quarters as high; the void is light grey and as wide as the model.
  const auto middle = patch_of(pixels, half_grey), nothing = patch_of(pixels, 0xdbdbdb);
  const int width = nothing.right - nothing.left + 1, void_rows = nothing.bottom - nothing.top + 1;
  const int rows = middle.bottom - middle.top + 1;
  EXPECT_GT(width, 500);
  EXPECT_NEAR(rows / double(rows + void_rows), 0.75, 0.01);
  EXPECT_EQ(middle.top, nothing.bottom + 1);
  // Where the bar is left out, the middle grey is one rectangle.
  int columns = 0;
  while (pixels.at(middle.left + columns, middle.top + 3) == half_grey) ++columns;
  EXPECT_NEAR(columns, width / 2, 2);
  EXPECT_NEAR(middle.left - nothing.left, width / 4, 2);
  EXPECT_EQ(pixels.at(middle.left - 4, middle.top + 3), 0x000000u);
  EXPECT_EQ(pixels.at(middle.left + columns + 3, middle.top + 3), 0xffffffu);
}

TEST(PlotModel, BothAxesHaveOneScaleWhereTheSizeIsNotGiven) {
  const auto pixels = decoded(draw_model(three_blocks(), false, {}, in_grey, page_of_size("")).bytes);
  const auto middle = patch_of(pixels, half_grey), nothing = patch_of(pixels, 0xdbdbdb);
  const double metre_across = (nothing.right - nothing.left + 1) / 400.0;
  const double metre_down = (middle.bottom - middle.top + 1) / 150.0;
  EXPECT_NEAR(metre_across / metre_down, 1, 0.02);
}

TEST(PlotModel, TheRangeSaysWhatTheColoursMean) {
  Look look = in_grey;
  look.colours = Limits{2000, 4000};
  const auto pixels = decoded(draw_model(three_blocks(), false, {}, look, page_of_size("800x600px")).bytes);
  const auto middle = patch_of(pixels, half_grey);  // 3000 m/s, the right quarter
  const auto nothing = patch_of(pixels, 0xdbdbdb);
  EXPECT_NEAR(middle.left, nothing.left + 3 * (nothing.right - nothing.left) / 4, 3);
}

TEST(PlotModel, FracturesAreMarkedWhereTheyAreAndNowhereElse) {
  const auto page = page_of_size("800x600px");
  const auto intact = decoded(draw_model(three_blocks(), false, {}, in_grey, page).bytes);
  const auto marked = decoded(draw_model(fractured_blocks(), false, {}, in_grey, page).bytes);
  const auto nothing = patch_of(intact, 0xdbdbdb), middle = patch_of(intact, half_grey);
  const double metre_x = (nothing.right - nothing.left + 1) / 400.0;
  const double metre_z = (middle.bottom - middle.top + 1) / 150.0;
  Patch changed{0, 800, -1, 600, -1};
  std::int64_t inside = 0;
  for (int y = 0; y < 600; ++y) {
    for (int x = 0; x < 800; ++x) {
      if (intact.at(x, y) == marked.at(x, y)) continue;
      ++changed.count;
      changed = {changed.count, std::min(changed.left, x), std::max(changed.right, x),
                 std::min(changed.top, y), std::max(changed.bottom, y)};
    }
  }
  EXPECT_NEAR(changed.left, nothing.left + 120 * metre_x, 2);
  EXPECT_NEAR(changed.right, nothing.left + 280 * metre_x, 2);
  EXPECT_NEAR(changed.top, nothing.top + 100 * metre_z, 2);
  EXPECT_NEAR(changed.bottom, nothing.top + 150 * metre_z, 2);
  // Hatched along the planes, which are vertical: columns are marked all the way or not at all.
  const int middle_row = (changed.top + changed.bottom) / 2;
  for (int x = changed.left + 5; x < changed.right - 4; ++x) {
    const bool on = intact.at(x, middle_row) != marked.at(x, middle_row);
    inside += on;
    for (const int y : {changed.top + 6, changed.bottom - 6})
      EXPECT_EQ(intact.at(x, y) != marked.at(x, y), on) << x;
  }
  EXPECT_GT(inside, 10);
  EXPECT_LT(inside, (changed.right - changed.left) / 2);
}

TEST(PlotModel, OneValueAloneHasAWordInsteadOfABar) {
  const auto svg_of = [](const ModelSection& section, const Look& look) {
    const auto bytes = draw_model(section, true, {}, look, page_of(Format::svg, {})).bytes;
    return std::string(bytes.begin(), bytes.end());
  };
  auto alike = fractured_blocks();
  for (auto& value : alike.values) value = std::isnan(value) ? value : 2000;
  EXPECT_NE(svg_of(alike, {}).find(">vp 2000 m/s<"), std::string::npos);
  EXPECT_EQ(svg_of(alike, {}).find(">vp (m/s)<"), std::string::npos);
  EXPECT_NE(svg_of(alike, {.colours = Limits{1000, 3000}}).find(">vp (m/s)<"), std::string::npos);
  EXPECT_NE(svg_of(fractured_blocks(), {}).find(">vp (m/s)<"), std::string::npos);
}

TEST(PlotModel, SetsHaveColoursOfTheirOwn) {
  const auto picture = draw_model(fractured_blocks(), true, {}, {}, page_of_size("800x600px"));
  const auto set = patch_of(decoded(picture.bytes), pixel_of(line_colour(0)) & 0xffffff);
  EXPECT_GT(set.count, 3000);
}

TEST(PlotModel, SourcesAndReceiversStandAtTheirPlaces) {
  const auto page = page_of_size("800x600px");
  const SurveyMarks marks{{{100, 120}}, {}};
  const auto pixels = decoded(draw_model(three_blocks(), false, marks, in_grey, page).bytes);
  const auto nothing = patch_of(pixels, 0xdbdbdb), middle = patch_of(pixels, half_grey);
  Patch star{0, 800, -1, 600, -1};
  for (int y = nothing.top; y <= middle.bottom; ++y) {  // not the legend's
    for (int x = 0; x < 800; ++x) {
      if (!alike(pixels.at(x, y), 0xcc1a1a)) continue;
      star = {star.count + 1, std::min(star.left, x), std::max(star.right, x), std::min(star.top, y),
              std::max(star.bottom, y)};
    }
  }
  ASSERT_GT(star.count, 20);
  EXPECT_NEAR((star.left + star.right) / 2.0, nothing.left + (nothing.right - nothing.left + 1) / 4.0, 2);
  const double metre_z = (middle.bottom - middle.top + 1) / 150.0;
  EXPECT_NEAR((star.top + star.bottom) / 2.0, nothing.top + 120 * metre_z, 3);
}

TEST(PlotModel, APartOfTheAxesIsThatPart) {
  Look look = in_grey;
  look.x = Limits{100, 300};
  look.y = Limits{50, 200};
  const auto pixels = decoded(draw_model(three_blocks(), false, {}, look, page_of_size("800x600px")).bytes);
  EXPECT_EQ(patch_of(pixels, 0xdbdbdb).count, 0);
  const auto middle = patch_of(pixels, half_grey);
  EXPECT_EQ(pixels.at(middle.left + 250, middle.top + 200), half_grey);
}

TEST(PlotModel, AllSourcesOfASurveyAreDrawn) {
  SurveyMarks marks;
  for (int n = 0; n < 21; ++n) marks.sources.push_back({100 + 4.0 * n, 120});
  const auto pixels =
      decoded(draw_model(three_blocks(), false, marks, in_grey, page_of_size("800x600px")).bytes);
  const auto nothing = patch_of(pixels, 0xdbdbdb);
  const double metre = (nothing.right - nothing.left + 1) / 400.0;
  for (const auto& source : marks.sources) {
    const int x = int(std::lround(nothing.left + metre * source[0]));
    int red = 0;
    for (int y = nothing.bottom; y < 500; ++y)
      for (const int off : {-1, 0, 1}) red += alike(pixels.at(x + off, y), 0xcc1a1a);
    EXPECT_GT(red, 0) << source[0];
  }
}

TEST(PlotModel, APlaneWaveIsAFrontAndNoStar) {
  SurveyMarks marks{{{200, 120}}, {}, true, 0};
  const auto page = page_of_size("800x600px");
  const auto red = [&](const Pixels& pixels) {
    const auto nothing = patch_of(pixels, 0xdbdbdb), middle = patch_of(pixels, half_grey);
    Patch found{0, 800, -1, 600, -1};
    for (int y = nothing.top; y <= middle.bottom; ++y)
      for (int x = nothing.left; x <= nothing.right; ++x)
        if (alike(pixels.at(x, y), 0xcc1a1a))
          found = {found.count + 1, std::min(found.left, x), std::max(found.right, x), std::min(found.top, y),
                   std::max(found.bottom, y)};
    return found;
  };
  const auto front = red(decoded(draw_model(three_blocks(), false, marks, in_grey, page).bytes));
  const int width = front.right - front.left, height = front.bottom - front.top;
  EXPECT_GT(width, 2 * height);  // a level line with an arrow down
  EXPECT_GT(height, 20);
  marks.plane_angle_deg.reset();
  EXPECT_EQ(red(decoded(draw_model(three_blocks(), false, marks, in_grey, page).bytes)).count, 0);
}

TEST(PlotModel, DerivedPropertiesFollowFromTheOthers) {
  const auto value = [](const char* name, const ElasticCell& cell) {
    return find_derived_property(name)->value(cell);
  };
  const ElasticCell rock{3000, 3000 / std::sqrt(3.0), 2500}, water{1500, 0, 1000};
  EXPECT_NEAR(value("vp/vs", rock), std::sqrt(3.0), 1e-12);
  EXPECT_NEAR(value("poisson", rock), 0.25, 1e-12);
  EXPECT_EQ(value("impedance", rock), 7.5e6);
  EXPECT_NEAR(value("shear-impedance", rock), 7.5e6 / std::sqrt(3.0), 1e-3);
  EXPECT_TRUE(std::isnan(value("vp/vs", water)));
  EXPECT_EQ(value("poisson", water), 0.5);
  EXPECT_EQ(value("shear-impedance", water), 0);
  // vs = vp / sqrt 2: lateral strain stays the same.
  EXPECT_NEAR(value("poisson", {2000, 2000 / std::sqrt(2.0), 1}), 0, 1e-12);
}

TEST(PlotModel, ArrowsShowThatColoursEndBeforeTheValues) {
  ColourBar bar{ColourMap("grey"), {"", "", 10, 20}};
  const Rect rect{5, 100, 8, 200};
  EXPECT_EQ(bar.body(rect).height, 200);
  bar.point_beyond(10, 20.5);
  EXPECT_FALSE(bar.below);
  EXPECT_TRUE(bar.above);
  EXPECT_NEAR(bar.body(rect).bottom(), 300, 1e-9);
  EXPECT_GT(bar.body(rect).y, 105);
  // In the picture the bar's white end becomes a triangle: narrower the higher.
  Look look = in_grey;
  look.colours = Limits{1000, 2500};
  const auto pixels = decoded(draw_model(three_blocks(), false, {}, look, page_of_size("800x600px")).bytes);
  const auto nothing = patch_of(pixels, 0xdbdbdb);
  int rows = 0, last = 1000;
  for (int y = nothing.top + 12; y > nothing.top; --y) {
    int dark = 0, first = -1, end = -1;
    for (int x = nothing.right + 6; x < nothing.right + 40; ++x)
      if ((pixels.at(x, y) & 0xff) < 0x60) first = first < 0 ? x : first, end = x, ++dark;
    if (dark == 0 || end - first > last) continue;
    rows += end - first < last;
    last = end - first;
  }
  EXPECT_GE(rows, 4);
  EXPECT_LT(last, 8);
}

/// Sections of 400 x 200 x 160 m, each of one value; the one across `grey` is drawn in the middle grey.
Patch slice_of_volume(int grey, const std::string& size) {
  std::vector<ModelSection> sections;
  std::vector<Slice> planes;
  const std::int64_t cells[] = {40, 20, 16};
  for (const int axis : {0, 1, 2}) {
    const auto [across, down] = axes_left(axis);
    ModelSection section;
    section.property = "vp";
    section.axes = section_axes(axis);
    section.values =
        Field<2>(Grid<2>{{cells[across], cells[down]}, 10, {0, 0}}, axis == grey             ? 2000.0f
                                                                    : axis == (grey + 1) % 3 ? 1000.0f
                                                                                             : 3000.0f);
    sections.push_back(section);
    planes.push_back({axis, 50});
  }
  return patch_of(decoded(draw_model_volume(sections, planes, false, std::vector<SurveyMarks>(3), in_grey,
                                            page_of_size(size))
                              .bytes),
                  half_grey);
}

TEST(PlotModel, AVolumeIsThreeSlicesOnOneScale) {
  const auto span = [](const Patch& patch) {
    return std::pair(patch.right - patch.left + 1.0, patch.bottom - patch.top + 1.0);
  };
  for (const std::string size : {"", "900x700px"}) {
    const auto x = slice_of_volume(0, size), y = slice_of_volume(1, size), z = slice_of_volume(2, size);
    const auto [y_width, y_height] = span(y);
    EXPECT_NEAR(y_width / y_height, 2.5, 0.05) << size;
    EXPECT_NEAR(span(z).first / y_width, 1, 0.02);
    EXPECT_NEAR(span(z).second / y_height, 1.25, 0.03);
    EXPECT_NEAR(span(x).first / y_height, 1.25, 0.03);
    EXPECT_NEAR(span(x).second / y_height, 1, 0.03);
    EXPECT_EQ(z.left, y.left);  // the level one above the other
    EXPECT_LT(z.bottom, y.top);
    EXPECT_NEAR(x.top, y.top, 1);  // these two side by side
    EXPECT_GT(x.left, y.right);
  }
}

TEST(PlotModel, PlanesOfAVolumeRunThroughTheSourceOrTheMiddle) {
  const Grid<3> grid{{40, 20, 10}, 10, {0, 0, 0}};
  const auto middle = planes_of(grid, {});
  ASSERT_EQ(middle.size(), 3u);
  EXPECT_EQ(middle[0].at_m, 205);  // the middle lies between two cells
  EXPECT_EQ(middle[2].at_m, 55);
  const auto source = planes_of(grid, {.source = Point<3>{77, 123, 5}});
  EXPECT_EQ(source[0].at_m, 75);
  EXPECT_EQ(source[1].at_m, 125);
  EXPECT_EQ(source[2].at_m, 55);
  EXPECT_EQ(planes_of(grid, {.source = Point<3>{770, 123, 5}})[0].at_m, 205);  // far outside
  EXPECT_EQ(planes_of(grid, {.through = Point<3>{77, 123, 5}})[2].at_m, 5);
  EXPECT_THROW(planes_of(grid, {.through = Point<3>{770, 123, 5}}), Error);
  EXPECT_EQ(planes_of(grid, {.slice = Slice{1, 88}}).size(), 1u);
  EXPECT_EQ(planes_of({{40, 1, 10}, 10, {}}, {}).size(), 1u);
}

}  // namespace
}  // namespace slipwave::plot::plot_model_test
