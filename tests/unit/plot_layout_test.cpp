// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>

#include "base/error.hpp"
#include "long_form.hpp"
#include "plot/error_picture.hpp"
#include "plot/gather_picture.hpp"
#include "plot/model_picture.hpp"
#include "plot/snapshot_picture.hpp"
#include "plot/spectrum_picture.hpp"
#include "plot_cases.hpp"
#include "plot_pixels.hpp"

namespace slipwave::plot::plot_layout_test {
namespace {

const std::string long_title =
    "A title that is far too long for any picture, so that it must be broken into lines and, where even "
    "three of "
    "them do not hold it, shortened at its end";

AccuracyTable table_of(const std::string& title) {
  AccuracyTable table;
  table.title = title;
  table.wanted_error = 0.01;
  for (const int order : {1, 3, 5}) {
    for (const double spacing : {20.0, 10.0, 5.0}) {
      AccuracyRow row;
      row.order = order;
      row.spacing_m = spacing;
      row.error = std::pow(spacing / 30, order);
      row.seconds = order * 1000 / (spacing * spacing);
      table.rows.push_back(row);
    }
  }
  table.chosen = 8;
  return table;
}

Spectra spectra_of(const std::string& unit) {
  Spectra spectra{"a.nc", "amplitude", {}, {{"vz", unit, {}}, {"p", "Pa/Hz", {}}}, {}};
  for (int n = 0; n < 100; ++n) {
    spectra.frequencies_hz.push_back(n);
    spectra.lines[0].values.push_back(1e-7 * std::exp(-0.01 * n * n));
    spectra.lines[1].values.push_back(3e4 * std::exp(-0.02 * n * n));
  }
  return spectra;
}

Spectra fk_spectra() {
  Spectra spectra{"a.nc", "amplitude", {0, 10, 20, 30}, {}, {}, Spectra::Place::wavenumber};
  for (int j = -20; j < 20; ++j) {
    spectra.places.push_back(0.00125 * j);
    spectra.lines.push_back({"vz", "m²/s/Hz", {0, 1e-9 * j * j, 2e-9 * j * j, 0}});
  }
  return spectra;
}

/// Every kind of picture.
std::vector<std::pair<std::string, std::function<Picture(const Page&)>>> kinds() {
  const SurveyMarks marks{{{200, 20}}, {{0, 10}, {100, 10}, {400, 10}}};
  auto large = fractured_blocks();
  large.values = Field<2>(Grid<2>{{40, 20}, 1000, {12345, 0}}, 2e5f);  // wide numbers
  large.values[7] = 3e5f;
  large.fracture = {};
  Snapshot snapshot{"vx", "m/s", 0.123, Field<2>(Grid<2>{{40, 20}, 10, {0, 0}}, 1e-12f)};
  GatherStyle lines;
  lines.density = false;
  lines.wiggle = true;
  return {
      {"model", [=](const Page& page) { return draw_model(fractured_blocks(), false, marks, {}, page); }},
      {"sets", [=](const Page& page) { return draw_model(fractured_blocks(), true, marks, {}, page); }},
      {"wide numbers", [=](const Page& page) { return draw_model(large, false, {}, {}, page); }},
      {"gather", [=](const Page& page) { return draw_gather(with_spike(41, 3, 3, -1e-9f), {}, {}, page); }},
      {"lines", [=](const Page& page) { return draw_gather(with_spike(41, 3, 3, 1), lines, {}, page); }},
      {"snapshot",
       [=](const Page& page) { return draw_snapshot(snapshot, 1e-12, fractured_blocks(), marks, {}, page); }},
      {"error", [=](const Page& page) { return draw_error({table_of("One")}, false, {}, page); }},
      {"spectra", [=](const Page& page) { return draw_spectra({spectra_of("m/s/Hz")}, false, {}, page); }},
      {"f-k spectra", [=](const Page& page) { return draw_spectra({fk_spectra()}, false, {}, page); }},
      {"f-k spectra in dB", [=](const Page& page) { return draw_spectra({fk_spectra()}, true, {}, page); }},
      {"log spectra", [=](const Page& page) { return draw_spectra({spectra_of("Pa/Hz")}, true, {}, page); }},
  };
}

/// Those of several panels, or with names of shots above the data.
std::vector<std::pair<std::string, std::function<Picture(const Page&)>>> wide_kinds() {
  auto shots = with_spike(200, 3, 3, 1);
  for (std::size_t n = 0; n < shots.traces(); ++n) shots.headers[n].shot = std::int64_t(1000 + n / 10);
  shots.shots = 20;
  GatherStyle overlaid, difference;
  overlaid.overlay = difference.difference = true;
  const auto pair = [] {
    return std::vector<NamedGather>{{"a name that is long", with_spike(41, 3, 3, 1)},
                                    {"another", with_spike(41, 3, 9, 2)}};
  };
  std::vector<ModelSection> sections;
  std::vector<Slice> planes;
  for (const int axis : {0, 1, 2}) {
    auto section = fractured_blocks();
    section.axes = section_axes(axis);
    sections.push_back(section);
    planes.push_back({axis, 105});
  }
  const std::vector<SurveyMarks> marks(3, SurveyMarks{{{200, 20}}, {{0, 10}, {100, 10}}});
  auto well = with_spike(41, 3, 3, 1);
  for (std::size_t n = 0; n < well.traces(); ++n) well.headers[n].receiver_m = {5, 0, 10.0 * double(n)};
  const auto components = [] {
    std::vector<NamedGather> gathers;
    for (const auto component : {Component::vx, Component::vz, Component::p}) {
      gathers.push_back({"a", with_spike(41, 3, 3, 1e-7f)});
      gathers.back().section.component = component;
    }
    return gathers;
  };
  return {
      {"well", [=](const Page& page) { return draw_gather(well, {}, {}, page); }},
      {"components", [=](const Page& page) { return draw_gathers(components(), {}, {}, page); }},
      {"shots", [=](const Page& page) { return draw_gather(shots, {}, {.clip_percent = 50}, page); }},
      {"overlay", [=](const Page& page) { return draw_gathers(pair(), overlaid, {}, page); }},
      {"difference", [=](const Page& page) { return draw_gathers(pair(), difference, {}, page); }},
      {"volume",
       [=](const Page& page) { return draw_model_volume(sections, planes, false, marks, {}, page); }},
  };
}

/// Few pixels, which do not matter here.
Page coarse_page(const std::string& size, const std::string& title) {
  return page_of(Format::png, {size, 75.0, title, ""});
}

/// Are all texts on the page, clear of each other, and is the rim of the page white?
void expect_in_order(const Picture& picture, const Page& given, const std::string& what) {
  const auto pixels = decoded(picture.bytes);
  const double width = pixels.width / given.scale(), height = pixels.height / given.scale();
  ASSERT_GE(picture.words.size(), 4u) << what;
  for (std::size_t n = 0; n < picture.words.size(); ++n) {
    const Rect& one = picture.words[n];
    EXPECT_TRUE(one.x > 0 && one.y > 0 && one.right() < width && one.bottom() < height)
        << what << ": text " << n << " leaves the page";
    for (std::size_t m = 0; m < n; ++m)
      EXPECT_FALSE(overlap(one, picture.words[m])) << what << ": texts " << m << " and " << n << " overlap";
  }
  for (int x = 0; x < pixels.width; ++x)
    EXPECT_TRUE(pixels.at(x, 0) == 0xffffff && pixels.at(x, pixels.height - 1) == 0xffffff) << what;
  for (int y = 0; y < pixels.height; ++y)
    EXPECT_TRUE(pixels.at(0, y) == 0xffffff && pixels.at(pixels.width - 1, y) == 0xffffff) << what;
}

TEST(PlotLayout, NothingIsClippedAndNoTextsOverlap) {
  const std::vector<std::string> titles = {"", "Short", long_title};
  std::size_t turn = 0;
  for (const auto& [name, draw] : kinds()) {
    for (const char* size : {"", "16x10cm", "9x7cm", "7x12cm", "30x8cm", "1200x800px"}) {
      ++turn;
      for (std::size_t n = 0; n < titles.size(); ++n) {
        // In the short form each kind has one title in each size, and each size all titles in turn.
        if (!long_form() && (n + turn + turn / 6) % 3 != 0) continue;
        const Page page = coarse_page(size, titles[n]);
        SCOPED_TRACE(name);
        expect_in_order(draw(page), page, name + " " + size + " " + titles[n].substr(0, 5));
      }
    }
  }
}

TEST(PlotLayout, NeitherDoTextsOfSeveralPanels) {
  for (const auto& [name, draw] : wide_kinds()) {
    for (const char* size : {"", "16x12cm", "30x12cm", "12x20cm"}) {
      for (const auto& title : {std::string(), long_title}) {
        const Page page = coarse_page(size, title);
        expect_in_order(draw(page), page, name + " " + size + " " + title.substr(0, 5));
      }
    }
  }
}

TEST(PlotLayout, SeveralPanelsAreReadableOrRefused) {
  int drawn = 0, refused = 0;
  for (const auto& [name, draw] : wide_kinds()) {
    for (const char* size : {"4x3cm", "6x6cm", "9x7cm", "9x20cm", "30x8cm"}) {
      const Page page = coarse_page(size, "Short");
      try {
        expect_in_order(draw(page), page, name + " " + size);
        ++drawn;
      } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::usage) << error.what();
        ++refused;
      }
    }
  }
  EXPECT_GT(drawn, 10);
  EXPECT_GT(refused, 2);
}

TEST(PlotLayout, SmallPicturesAreReadableOrRefused) {
  int drawn = 0;
  for (const auto& [name, draw] : kinds()) {
    for (const char* size : {"4x3cm", "5x4cm", "6x6cm"}) {
      const Page page = coarse_page(size, "");
      try {
        const auto picture = draw(page);
        expect_in_order(picture, page, name + " " + size);
        ++drawn;
      } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::usage) << error.what();
        EXPECT_NE(std::string(size), "6x6cm") << name << ": " << error.what();
      }
    }
  }
  EXPECT_GT(drawn, 16);
}

TEST(PlotLayout, LongLegendsLeaveRoomForTheData) {
  std::vector<Spectra> many(40, spectra_of("m/s/Hz"));
  for (std::size_t n = 0; n < many.size(); ++n) many[n].name = "line-" + std::to_string(n) + ".nc";
  const Page page = coarse_page("", "");
  expect_in_order(draw_spectra(many, false, {}, page), page, "forty spectra");
}

TEST(PlotLayout, PanelsSideBySideKeepClear) {
  for (const char* title : {"", "All of them"}) {
    const Page page = coarse_page("", title);
    const auto picture =
        draw_error({table_of("One"), table_of("Another"), table_of(long_title)}, false, {}, page);
    expect_in_order(picture, page, "three panels");
  }
}

}  // namespace
}  // namespace slipwave::plot::plot_layout_test
