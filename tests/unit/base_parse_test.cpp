// SPDX-License-Identifier: BSD-3-Clause
#include "base/parse.hpp"

#include <gtest/gtest.h>

#include <functional>

#include "base/error.hpp"

namespace slipwave::base_parse_test {
namespace {

/// The sentence of the usage Error that `body` throws.
std::string refusal(const std::function<void()>& body) {
  try {
    body();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::usage);
    return error.what();
  }
  return "nothing was refused";
}

}  // namespace

TEST(Parse, ReadsANumberAndNothingAfterIt) {
  EXPECT_EQ(parse_number("-1.5e3"), -1500);
  EXPECT_EQ(parse_number("+2"), 2);
  EXPECT_EQ(parse_number("0"), 0);
  for (const char* text : {"", " 1", "1 ", "1m", "one", "1,5", "--1", "+-1", "0x10", "nan", "inf"}) {
    EXPECT_EQ(refusal([&] { parse_number(text); }), "found '" + std::string(text) + "', expected a number");
  }
}

TEST(Parse, TellsNumbersThatNoDoubleHoldsFromWords) {
  for (const char* text : {"1e999", "-1e400", "1e-400"})
    EXPECT_EQ(refusal([&] { parse_number(text); }),
              "found '" + std::string(text) + "', expected a number from 1e-307 to 1e308 in size");
  EXPECT_EQ(refusal([] { parse_point<2>("1,1e400"); }),
            "found '1,1e400', expected a point X,Z ('1e400' is too large or too small)");
}

TEST(Parse, ReadsWholeNumbersExactly) {
  EXPECT_EQ(parse_integer("-9007199254740993"), -9007199254740993);
  for (const char* text : {"", "1.0", "1e3", "9223372036854775808"}) {
    EXPECT_EQ(refusal([&] { parse_integer(text); }),
              "found '" + std::string(text) + "', expected a whole number");
  }
}

TEST(Parse, ReadsPointsOfItsDimension) {
  EXPECT_EQ(parse_point<2>("-10,5"), (std::array<double, 2>{-10, 5}));
  EXPECT_EQ(parse_point<3>("1,2,3.5"), (std::array<double, 3>{1, 2, 3.5}));
  EXPECT_EQ(refusal([] { parse_point<2>("1,2,3"); }), "found '1,2,3', expected a point X,Z");
  EXPECT_EQ(refusal([] { parse_point<3>("1,2"); }), "found '1,2', expected a point X,Y,Z");
  EXPECT_EQ(refusal([] { parse_point<2>("1,z"); }),
            "found '1,z', expected a point X,Z ('z' is not a number)");
}

TEST(Parse, IncludesBothEndsOfALine) {
  const auto line = parse_line<2>("0:4000:25,5");
  ASSERT_EQ(line.size(), 161u);
  EXPECT_EQ(line.front(), (std::array<double, 2>{0, 5}));
  EXPECT_EQ(line[1], (std::array<double, 2>{25, 5}));
  EXPECT_EQ(line.back(), (std::array<double, 2>{4000, 5}));
}

TEST(Parse, EndsALineExactlyThoughTheStepIsRounded) {
  const auto line = parse_line<2>("0:1:0.1,0");
  ASSERT_EQ(line.size(), 11u);
  EXPECT_EQ(line.back()[0], 1.0);
}

TEST(Parse, WalksALineDownwardsAndAlongDepth) {
  const auto down = parse_line<2>("100:0:-50,5");
  ASSERT_EQ(down.size(), 3u);
  EXPECT_EQ(down[1][0], 50);
  const auto well = parse_line<2>("300,0:20:10");
  ASSERT_EQ(well.size(), 3u);
  EXPECT_EQ(well[2], (std::array<double, 2>{300, 20}));
  EXPECT_EQ(parse_line<2>("7,8").size(), 1u);
  EXPECT_EQ(parse_line<2>("7:7:1,8").size(), 1u);
}

TEST(Parse, MakesALatticeOfSeveralRangesWithXFastest) {
  const auto lattice = parse_line<3>("0:20:10,0:5:5,1");
  ASSERT_EQ(lattice.size(), 6u);
  EXPECT_EQ(lattice[2], (std::array<double, 3>{20, 0, 1}));
  EXPECT_EQ(lattice[3], (std::array<double, 3>{0, 5, 1}));
}

TEST(Parse, SaysWhenAStepDoesNotDivideALine) {
  EXPECT_EQ(refusal([] { parse_line<2>("0:100:30,5"); }),
            "in '0:100:30,5' found 3.333 steps of 30 from 0 to 100, expected a whole number");
  EXPECT_EQ(refusal([] { parse_line<2>("0:100:0,5"); }),
            "in '0:100:0,5' a step of 0 does not lead from 0 to 100");
  EXPECT_EQ(refusal([] { parse_line<2>("0:100:-10,5"); }),
            "in '0:100:-10,5' a step of -10 does not lead from 0 to 100");
  EXPECT_EQ(refusal([] { parse_line<2>("0:100,5"); }), "found '0:100,5', expected points X0:X1:DX,Z or X,Z");
}

TEST(Parse, RefusesMorePointsThanMemoryHolds) {
  EXPECT_EQ(refusal([] { parse_line<2>("0:1e9:1e-3,5"); }),
            "in '0:1e9:1e-3,5' found 1000000000001 points, expected at most 1e+07");
  EXPECT_EQ(refusal([] { parse_line<3>("0:9999:1,0:9999:1,5"); }),
            "found '0:9999:1,0:9999:1,5' with 1e+08 points, expected at most 1e+07");
}

TEST(Parse, ReadsBoxesWithOrderedEnds) {
  const auto box = parse_box<2>("-5:10,0:2.5");
  EXPECT_EQ(box.low_m, (std::array<double, 2>{-5, 0}));
  EXPECT_EQ(box.high_m, (std::array<double, 2>{10, 2.5}));
  EXPECT_TRUE(box.contains({-5, 2.5}));
  EXPECT_FALSE(box.contains({-5.1, 1}));
  EXPECT_EQ(refusal([] { parse_box<2>("0:1,2:1"); }),
            "found '0:1,2:1', expected a box X0:X1,Z0:Z1 with each low end below its high end");
  EXPECT_EQ(refusal([] { parse_box<2>("0:1:2,2:1"); }), "found '0:1:2,2:1', expected a box X0:X1,Z0:Z1");
}

TEST(Parse, ReadsSizesAndShapes) {
  EXPECT_EQ(parse_size<2>("2500x3000.5"), (std::array<double, 2>{2500, 3000.5}));
  EXPECT_EQ(parse_size<3>("1x2x3"), (std::array<double, 3>{1, 2, 3}));
  EXPECT_EQ(refusal([] { parse_size<2>("0x3"); }), "found '0x3', expected a size LXxLZ above zero");
  EXPECT_EQ(parse_shape<2>("500x174"), (std::array<std::int64_t, 2>{500, 174}));
  EXPECT_EQ(refusal([] { parse_shape<2>("500x17.4"); }),
            "found '500x17.4', expected whole numbers NXxNZ above zero");
}

}  // namespace slipwave::base_parse_test
