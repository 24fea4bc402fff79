// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <functional>

#include "acquisition/given_survey.hpp"
#include "acquisition/ground.hpp"
#include "acquisition/place.hpp"
#include "acquisition/sps.hpp"
#include "acquisition/survey_table.hpp"
#include "base/error.hpp"
#include "io/table.hpp"

namespace slipwave::acquisition_given_test {
namespace {

std::string refusal(const std::function<void()>& act) {
  try {
    act();
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(Places, AreCountedFromTheSourceWhereTheirNumbersHaveASign) {
  const auto spread = parse_places<2>("+-100:+100:50,12.5", true);
  ASSERT_EQ(spread.size(), 5U);
  EXPECT_EQ(spread[0].at_m, (std::array{-100., 0., 12.5}));
  EXPECT_EQ(spread[0].relative, 1U);
  EXPECT_EQ(parse_places<2>("100:200:50,+5", true)[0].relative, 4U);
  EXPECT_EQ(parse_places<3>("100,+20,5", true)[0].relative, 2U);
  EXPECT_EQ(parse_places<2>("-300:-100:50,5", true)[0].relative_if_outside, 1U);
  EXPECT_EQ(parse_places<2>("-300:100:50,5", true)[0].relative_if_outside, 0U);
  // Sources stand where they stand.
  EXPECT_EQ(parse_places<2>("+5,5", false)[0].relative, 0U);
}

TEST(Places, HaveDepthsFromSurfaceAndFloor) {
  EXPECT_EQ(parse_depth("surface").from, DepthFrom::surface);
  EXPECT_EQ(parse_depth("surface+2.5").below_m, 2.5);
  EXPECT_EQ(parse_depth("floor-1").from, DepthFrom::floor);
  EXPECT_EQ(parse_depth("floor-1").below_m, -1);
  EXPECT_EQ(parse_depth("-7").below_m, -7);
  EXPECT_EQ(refusal([] { parse_depth("surface2"); }),
            "found 'surface2', expected surface, surface+D or surface-D");
  EXPECT_EQ(refusal([] { parse_depth("bottom"); }),
            "found 'bottom', expected a depth in m, surface+D or floor-D");
  EXPECT_EQ(refusal([] { parse_places<2>("0:5:2,floor-1", true); }),
            "in '0:5:2,floor-1' found 2.5 steps of 2 from 0 to 5, expected a whole number");
}

TEST(Ground, FindsSurfaceAndFloorOfEachColumn) {
  // Columns of nothing, fluid and rock, from the top.
  const std::string columns[] = {"wwr", "awr", "arr", "www", "aaa"};
  Ground<2> ground(Grid<2>{{5, 3}, 10, {100, 0}});
  for (std::int64_t row = 0; row < 3; ++row)
    ground.see_row(row, [&](const Index<2>& at) {
      const char what = columns[at[0]][std::size_t(at[1])];
      return what == 'a' ? Matter::nothing : what == 'w' ? Matter::fluid : Matter::rock;
    });
  EXPECT_EQ(ground.surface_m({105, 0}), 0);
  EXPECT_EQ(ground.floor_m({105, 0}), 20);
  EXPECT_EQ(ground.surface_m({115, 0}), 10);
  EXPECT_EQ(ground.floor_m({115, 0}), 20);
  EXPECT_EQ(ground.surface_m({125, 0}), 10);
  EXPECT_FALSE(ground.floor_m({125, 0}));
  EXPECT_FALSE(ground.floor_m({135, 0}));
  EXPECT_FALSE(ground.surface_m({145, 0}));
}

TEST(Table, IsReadByNamesOrByBlanks) {
  Table csv("t", "\xef\xbb\xbf# c\nb , a\r\n1,\"2,5\"\n\n , \"say \"\"x\"\"\"\n");
  EXPECT_EQ(csv.columns(), (std::vector<std::string>{"b", "a"}));
  ASSERT_TRUE(csv.next());
  EXPECT_EQ(csv.number(0), 1);
  EXPECT_EQ(csv.text(1), "2,5");
  ASSERT_TRUE(csv.next());
  EXPECT_FALSE(csv.has(csv.find("b")));
  EXPECT_EQ(csv.text(1), "say \"x\"");
  EXPECT_FALSE(csv.next());
  Table plain("t", "1\t2\n 3   4 ");
  EXPECT_TRUE(plain.columns().empty());
  EXPECT_TRUE(plain.next());
  EXPECT_TRUE(plain.next());
  EXPECT_EQ(plain.number(1), 4);
  EXPECT_EQ(plain.line(), 2);
  EXPECT_EQ(refusal([] { Table("t", "a,b\n1,\"2\n").next(); }),
            "t: line 2: column b: found no closing quotation mark, expected one on the line");
}

TEST(MapFrame, TurnsTheAzimuthToTheModelsX) {
  const MapFrame north{{1000, 2000}, 0}, oblique{{0, 0}, 30};
  EXPECT_EQ(north.model_m(1000, 2300), (std::array{300., 0.}));
  EXPECT_EQ(north.model_m(990, 2000), (std::array{0., 10.}));
  EXPECT_NEAR(oblique.model_m(5, 5 * std::sqrt(3.))[0], 10, 1e-12);
  EXPECT_EQ(MapFrame().model_m(3, 4), (std::array{3., 4.}));
}

TEST(ReceiverCollector, HoldsSpreadsThatRollAlongOnce) {
  GivenSurvey survey;
  survey.shots.resize(50);
  ReceiverCollector collector(survey);
  for (std::size_t shot = 0; shot < 50; ++shot) {
    collector.begin(shot);
    for (int n = 0; n < 100; ++n) {
      Place place;
      place.at_m[0] = 25. * double(int(shot) + n);
      collector.add(place, n + 1);
    }
    collector.end();
  }
  EXPECT_EQ(survey.places.size(), 149U);
  EXPECT_LE(survey.runs.size(), 100U);
  std::size_t count = 0;
  for (const auto& run : survey.runs_of(49)) count += run.count;
  EXPECT_EQ(count, 100U);
}

TEST(SourceTable, HasUnitsInItsHeader) {
  GivenSurvey survey;
  Table table("s", "X.FT;Z (ft);Delay (ms)\n100;surface+10;20\n");
  read_sources(table, 2, survey);
  const auto& source = survey.shots.at(0).sources.at(0);
  EXPECT_DOUBLE_EQ(source.place.at_m[0], 30.48);
  EXPECT_EQ(source.place.depth_from, DepthFrom::surface);
  EXPECT_DOUBLE_EQ(source.place.at_m[2], 3.048);
  EXPECT_DOUBLE_EQ(source.delay_s, 0.02);
}

TEST(SourceTable, HasDelaysBelowZero) {
  GivenSurvey survey;
  Table table("s", "x,z,delay\n100,10,-0.25\n");
  read_sources(table, 2, survey);
  EXPECT_EQ(survey.shots.at(0).sources.at(0).delay_s, -0.25);
}

/// The columns of SPS 2.1, filled from the left as the standard has them.
std::string point(char kind, int line, double number, double x, double y, double depth, double elevation) {
  char text[128];
  std::snprintf(text, sizeof text, "%c%10.2f%10.2f  1G1   0%4.1f   0 0%6.1f%9.1f%10.1f%6.1f001000000\n", kind,
                double(line), number, depth, 0., x, y, elevation);
  return text;
}
std::string relation(int record, double source, int from, int to, int step, double first, double last) {
  char text[128];
  std::snprintf(text, sizeof text, "XTAPE1 %8d11%10.2f%10.2f1%5d%5d%1d%10.2f%10.2f%10.2f1\n", record, 1.,
                source, from, to, step, 2., first, last);
  return text;
}

TEST(Sps, RelationsMakeShots) {
  std::string sources = "H00 SPS format version num.     SPS 2.1\n", receivers;
  sources += point('S', 1, 101, 1000, 500, 6, 0) + point('S', 1, 102, 1050, 500, 6, 20);
  for (int n = 0; n < 6; ++n) receivers += point('R', 2, 201 + n, 1000 + 25 * n, 500.5, 0, 12);
  const std::string relations = relation(77, 102, 1, 4, 1, 201, 204) + relation(78, 101, 1, 3, 1, 203, 205) +
                                relation(78, 101, 4, 8, 2, 206, 204);
  const auto survey = survey_of_sps({"s", "x", "r"}, {sources, relations, receivers});
  ASSERT_EQ(survey.shots.size(), 2U);
  EXPECT_EQ(survey.shots[0].number, 77);
  EXPECT_EQ(survey.shots[0].sources[0].place.at_m, (std::array{1050., 500., -14.}));
  const auto runs = survey.runs_of(1);
  ASSERT_EQ(runs.size(), 4U);  // backwards: one by one
  EXPECT_EQ(runs[0].count, 3U);
  EXPECT_EQ(survey.places[runs[0].first_place].at_m, (std::array{1050., 500.5, -12.}));
  EXPECT_EQ(runs[2].channel, 6);
  EXPECT_EQ(survey.places[runs[2].first_place].at_m[0], 1100);
}

std::string header(const std::string& label, const std::string& value) {
  std::string text = label;
  text.resize(32, ' ');
  return text + value + '\n';
}

TEST(Sps, LengthsAreInTheGridUnitOfTheHeader) {
  const std::string sources = point('S', 1, 101, 1000, 500, 10, 0),
                    receivers = point('R', 2, 201, 2000, 500, 0, 20),
                    relations = relation(1, 101, 1, 1, 1, 201, 201);
  const auto read = [&](const std::string& head) {
    return survey_of_sps({"a.s", "a.r", "a.x"}, {head + sources, head + receivers, head + relations});
  };
  const auto expect_unit = [&](const std::string& head, double unit_m) {
    const auto survey = read(head);
    EXPECT_DOUBLE_EQ(survey.shots[0].sources[0].place.at_m[0], 1000 * unit_m) << head;
    EXPECT_DOUBLE_EQ(survey.shots[0].sources[0].place.at_m[2], 10 * unit_m) << head;
    EXPECT_DOUBLE_EQ(survey.places[0].at_m[2], -20 * unit_m) << head;
  };
  const auto name = [](const std::string& text) { return header("H20 Description of grid units", text); };
  const auto factor = [](const std::string& text) { return header("H201Factor to metre", text); };
  expect_unit("", 1);
  expect_unit(name("METRES;") + factor("1.00000000;"), 1);
  expect_unit(name("US SURVEY FEET;") + factor("0.30480061;"), 0.30480061);
  expect_unit(factor("0.3048"), 0.3048);
  expect_unit(name("INTERNATIONAL FEET"), 0.3048);
  expect_unit(name("US SURVEY FEET"), 1200. / 3937);
  const auto said = [&](const std::string& head) { return refusal([&] { read(head); }); };
  EXPECT_EQ(said(name("FEET")),
            "a.s: line 1: columns 33-56 (description of grid units): found 'FEET' without a factor to metre "
            "(H201), "
            "expected metres, or H201: 0.3048 of international feet, 0.30480061 of US survey feet");
  EXPECT_EQ(
      said(name("DEGREES")),
      "a.s: line 1: columns 33-56 (description of grid units): found 'DEGREES' without a factor to metre "
      "(H201), expected metres, or H201: 0.3048 of international feet, 0.30480061 of US survey feet");
  EXPECT_EQ(said(name("METRES") + factor("0.3048")),
            "a.s: line 2: columns 33-46 (factor to metre): found 0.3048, expected 1, as the grid units are "
            "'METRES' "
            "(a.s: line 1)");
  EXPECT_EQ(said(factor("0;")), "a.s: line 1: columns 33-46 (factor to metre): found 0, expected it above 0");
  EXPECT_EQ(said(factor("feet")),
            "a.s: line 1: columns 33-46 (factor to metre): found 'FEET', expected a number");
  EXPECT_EQ(refusal([&] {
              survey_of_sps({"a.s", "a.r", "a.x"},
                            {factor("0.3048") + sources, factor("1") + receivers, relations});
            }),
            "a.r: line 1: columns 33-46 (factor to metre): found 1 metres, expected 0.3048 as before (a.s: "
            "line 1)");
}

TEST(Sps, OfTheFirstVersionIsRefusedByItsField) {
  const std::string body = point('S', 1, 101, 1000, 500, 6, 0) + point('R', 2, 201, 1000, 500, 0, 12) +
                           relation(1, 101, 1, 1, 1, 201, 201);
  const auto said = [&](const std::string& version) {
    return refusal([&] { survey_of_sps({"a"}, {header("H00 SPS format version num.", version) + body}); });
  };
  for (const char* version : {"SPS 2.1;", "SPS2.1", "2.1", "sps 2.10", "SPS 2"})
    EXPECT_EQ(said(version), "") << version;
  for (const char* version : {"SPS001,12.02.92", "SPS 1.2;", "SPS 1;", "SPS 3.2", "REVISED 12 MAY"})
    EXPECT_EQ(said(version),
              "a: line 1: columns 33-80 (format version): found '" + std::string(version) +
                  "', expected SPS 2.1, whose lines and points have other columns than those of SPS "
                  "1; export it as SPS 2.1");
}

TEST(Sps, WhatIsWrongIsNamedByColumns) {
  const std::string sources = point('S', 1, 101, 1000, 500, 6, 0),
                    receivers = point('R', 2, 201, 1000, 500, 0, 12);
  const auto said = [&](const std::string& s, const std::string& r, const std::string& x) {
    return refusal([&] { survey_of_sps({"a.s", "a.r", "a.x"}, {s, r, x}); });
  };
  auto bad = sources;
  bad.replace(46, 9, "  1x00.0 ");
  EXPECT_EQ(said(bad, receivers, relation(1, 101, 1, 1, 1, 201, 201)),
            "a.s: line 1: columns 47-55 (map grid easting): found '1x00.0', expected a number");
  EXPECT_EQ(said(sources, receivers, relation(1, 103, 1, 1, 1, 201, 201)),
            "a.x: line 1: columns 28-37 (point number): found line 1 point 103, which has no S record");
  EXPECT_EQ(said(sources, receivers, relation(1, 101, 1, 2, 1, 201, 202)),
            "a.x: line 1: columns 60-69 (from receiver): found line 2 point 202, which has no R record");
  EXPECT_EQ(
      said(sources, receivers, relation(1, 101, 1, 1, 1, 201, 201) + relation(1, 101, 1, 1, 1, 201, 201)),
      "a.x: line 1: found channel 1 twice in field record 1, expected it once");
  EXPECT_EQ(
      said(sources, receivers, relation(1, 101, 5, 1, 1, 201, 201)),
      "a.x: line 1: columns 44-48 (to channel): found channels 5 to 1 in steps of 1, expected whole steps "
      "upwards");
  EXPECT_EQ(said(sources, receivers, "Q\n"),
            "a.x: line 1: column 1: found 'Q', expected a record H, S, R or X");
  EXPECT_EQ(
      said(sources, receivers, ""),
      "a.s, a.r, a.x: found no record X (relations) in SPS, expected --geometry for each of the S, R and X "
      "files");
}

}  // namespace
}  // namespace slipwave::acquisition_given_test
