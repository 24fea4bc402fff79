// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.hpp"
#include "plot/colour_map.hpp"

namespace slipwave::plot::plot_colour_test {
namespace {

/// CIE 1976 L*a*b* of an sRGB colour under D65 (IEC 61966-2-1, ISO 11664-4): not the space the maps are made
/// in.
struct Lab {
  double l, a, b;
};

Lab lab_of(const Colour& colour) {
  const auto linear = [](double part) {
    return part <= 0.04045 ? part / 12.92 : std::pow((part + 0.055) / 1.055, 2.4);
  };
  const double r = linear(colour.red), g = linear(colour.green), b = linear(colour.blue);
  const auto f = [](double t) { return t > 216.0 / 24389 ? std::cbrt(t) : (24389.0 / 27 * t + 16) / 116; };
  const double x = f((0.4124 * r + 0.3576 * g + 0.1805 * b) / 0.9505);
  const double y = f(0.2126 * r + 0.7152 * g + 0.0722 * b);
  const double z = f((0.0193 * r + 0.1192 * g + 0.9505 * b) / 1.0890);
  return {116 * y - 16, 500 * (x - y), 200 * (y - z)};
}

double distance(const Colour& one, const Colour& other) {
  const Lab p = lab_of(one), q = lab_of(other);
  return std::hypot(p.l - q.l, p.a - q.a, p.b - q.b);
}

TEST(PlotColours, TheUniformMapGetsLighterInEvenSteps) {
  const ColourMap map("uniform");
  std::vector<double> steps;
  for (int n = 0; n < 16; ++n) {
    const Colour here = map.at(n / 16.0), next = map.at((n + 1) / 16.0);
    EXPECT_GT(lab_of(next).l, lab_of(here).l + 2) << n;
    steps.push_back(distance(here, next));
  }
  const auto [least, most] = std::minmax_element(steps.begin(), steps.end());
  // Two spaces of "even" colours agree to about this; the hues of a rainbow differ tenfold.
  EXPECT_LT(*most / *least, 2.2);
  EXPECT_GT(lab_of(map.at(1)).l - lab_of(map.at(0)).l, 70);
}

TEST(PlotColours, ZeroIsWhiteAndSidesAreEquallyStrong) {
  for (const char* name : {"blue-red", "red-blue"}) {
    const ColourMap map(name);
    EXPECT_TRUE(map.diverging());
    EXPECT_EQ(map.pixel(0.5), 0xffffffffu);
    EXPECT_EQ(map.pixel(0.4999), 0xffffffffu);
    for (const double off : {0.1, 0.25, 0.4, 0.5}) {
      const Lab low = lab_of(map.at(0.5 - off)), high = lab_of(map.at(0.5 + off));
      EXPECT_NEAR(low.l, high.l, 6) << off;
      EXPECT_LT(low.l, 100 - 60 * off) << off;
    }
    const bool blue_first = std::string(name) == "blue-red";
    const Colour first = map.at(0.2), last = map.at(0.8);
    EXPECT_EQ(first.blue > first.red, blue_first);
    EXPECT_EQ(last.red > last.blue, blue_first);
  }
}

TEST(PlotColours, GreysRunFromBlackToWhiteOrBack) {
  EXPECT_EQ(ColourMap("grey").pixel(0), 0xff000000u);
  EXPECT_EQ(ColourMap("grey").pixel(1), 0xffffffffu);
  EXPECT_EQ(ColourMap("white-black").pixel(0), 0xffffffffu);
  EXPECT_EQ(ColourMap("white-black").pixel(1), 0xff000000u);
}

TEST(PlotColours, BeyondTheEndsTheyStayAndNothingIsGrey) {
  for (const auto& name : ColourMap::names()) {
    const ColourMap map(name);
    EXPECT_EQ(map.pixel(-3), map.pixel(0));
    EXPECT_EQ(map.pixel(1e30), map.pixel(1));
    EXPECT_EQ(map.at(std::numeric_limits<double>::quiet_NaN()), no_data);
  }
}

TEST(PlotColours, AnUnknownMapIsRefusedWithTheNames) {
  try {
    ColourMap("parula");
    FAIL() << "accepted";
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::usage);
    for (const auto& name : ColourMap::names())
      EXPECT_NE(std::string(error.what()).find(name), std::string::npos);
  }
}

TEST(PlotColours, NeighbouringLinesCanBeToldApart) {
  for (std::size_t one = 0; one < 8; ++one) {
    for (std::size_t other = 0; other < one; ++other)
      EXPECT_GT(distance(line_colour(one), line_colour(other)), 20) << one << " and " << other;
    EXPECT_GT(distance(line_colour(one), white), 30);
  }
}

TEST(PlotColours, MapsOfOthersHaveTheirColours) {
  const auto differ = [](const Colour& one, std::uint32_t rgb) {
    const Colour other{double(rgb >> 16 & 0xff) / 255, double(rgb >> 8 & 0xff) / 255,
                       double(rgb & 0xff) / 255};
    return std::max(
        {std::abs(one.red - other.red), std::abs(one.green - other.green), std::abs(one.blue - other.blue)});
  };
  // matplotlib 3.6, entries 64, 128 and 192 of 256 of viridis, which lie between the colours it is made of.
  const ColourMap viridis("viridis"), seismic("seismic");
  EXPECT_LT(differ(viridis.at(64 / 255.0), 0x3b528b), 0.012);
  EXPECT_LT(differ(viridis.at(128 / 255.0), 0x21918c), 0.012);
  EXPECT_LT(differ(viridis.at(192 / 255.0), 0x5ec962), 0.012);
  EXPECT_LT(differ(viridis.at(0), 0x440154), 0.004);
  EXPECT_LT(differ(viridis.at(1), 0xfde725), 0.004);
  EXPECT_EQ(seismic.pixel(0.5), 0xffffffffu);
  EXPECT_LT(differ(seismic.at(0.25), 0x0000ff), 0.02);
  EXPECT_LT(differ(seismic.at(0.75), 0xff0000), 0.02);
  EXPECT_LT(differ(seismic.at(0.625), 0xff8080), 0.02);
  EXPECT_LT(differ(seismic.at(1), 0x800000), 0.004);
}

TEST(PlotColours, JetIsRefusedWithItsReason) {
  for (const char* name : {"jet", "rainbow", "hsv"}) {
    try {
      const ColourMap map(name);
      ADD_FAILURE() << name;
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find("edges that are not in the data"), std::string::npos);
    }
  }
}

}  // namespace
}  // namespace slipwave::plot::plot_colour_test
