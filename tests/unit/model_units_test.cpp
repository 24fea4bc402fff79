// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <functional>

#include "build/raw_shape.hpp"
#include "geology/layers.hpp"
#include "model_cases.hpp"
#include "rock/input_units.hpp"

namespace slipwave::model_units_test {
namespace {

/// Depth columns, one after the other, of a section whose beds dip and whose speed grows with depth.
std::vector<char> dipping_beds(std::int64_t nx, std::int64_t nz) {
  std::vector<char> bytes;
  for (std::int64_t i = 0; i < nx; ++i)
    for (std::int64_t k = 0; k < nz; ++k) {
      const auto bed = float(1500 + 10 * double(k) + 300 * std::sin(0.3 * (double(k) + 0.2 * double(i))));
      const auto bits = std::bit_cast<std::uint32_t>(bed);
      for (int byte = 0; byte < 4; ++byte) bytes.push_back(char(bits >> (8 * byte) & 0xff));
    }
  return bytes;
}

std::string said_of(std::int64_t nx, std::int64_t nz, FastAxis fast) {
  Grid<2> grid;
  grid.shape = {nx, nz};
  return sentence_of([&] { check_raw_shape(dipping_beds(120, 50), grid, fast); });
}

}  // namespace

TEST(InputUnits, AreMadeSIForThePropertiesThatHaveThem) {
  const auto units = InputUnits::parse("km/s,g/cm3");
  EXPECT_EQ(units.factor(Property::vp), 1000);
  EXPECT_EQ(units.factor(Property::vs), 1000);
  EXPECT_EQ(units.factor(Property::rho), 1000);
  EXPECT_EQ(InputUnits::parse("km/s").factor(Property::rho), 1);
  EXPECT_EQ(InputUnits::parse("ft/s").factor(Property::vp), 0.3048);
  EXPECT_EQ(InputUnits().factor(Property::vp), 1);
  EXPECT_EQ(InputUnits::parse("KM/S,G/CC").factor(Property::rho), 1000);
  EXPECT_EQ(InputUnits::parse("m/s").given(Property::vp), 1.);
  EXPECT_FALSE(InputUnits::parse("m/s").given(Property::rho));
}

TEST(InputUnits, OfALayerLeaveItsGradientPerSecond) {
  const auto layer = parse_layer("0:2+0.5:1:2.1", InputUnits::parse("km/s,g/cm3"));
  EXPECT_EQ(layer.material, (Material{2000, 1000, 2100}));
  EXPECT_EQ(layer.gradient, (Material{0.5, 0, 0}));
}

TEST(InputUnits, ThatNothingHasAreRefused) {
  EXPECT_EQ(
      sentence_of([] { InputUnits::parse("km/s,lb"); }),
      "found 'lb', expected units of speed, density and stiffness: m/s, km/s, ft/s, kg/m3, g/cm3, Pa, GPa");
}

TEST(RawShape, IsTakenWhereNeighboursContinueEachOther) {
  EXPECT_EQ(said_of(120, 50, FastAxis::z), "no error");
  EXPECT_EQ(said_of(50, 120, FastAxis::x), "no error");
}

TEST(RawShape, IsRefusedWhereTheNumbersOfCellsAreExchanged) {
  const auto sentence = said_of(50, 120, FastAxis::z);
  EXPECT_NE(sentence.find("found 50x120 in the order z-fast, in which neighbouring columns do not continue"),
            std::string::npos)
      << sentence;
  EXPECT_NE(sentence.find("expected --shape 120x50 or --order x-fast"), std::string::npos) << sentence;
  EXPECT_NE(said_of(120, 50, FastAxis::x).find("expected --shape 50x120 or --order z-fast"),
            std::string::npos);
}

/// Raw values in the order of a file, of a section given by its values.
std::vector<char> raw_of(const std::function<double(std::int64_t, std::int64_t)>& value, std::int64_t nx,
                         std::int64_t nz, FastAxis order) {
  std::vector<char> bytes;
  for (std::int64_t n = 0; n < nx * nz; ++n) {
    const std::int64_t i = order == FastAxis::z ? n / nz : n % nx, k = order == FastAxis::z ? n % nz : n / nx;
    const auto bits = std::bit_cast<std::uint32_t>(float(value(i, k)));
    for (std::size_t byte = 0; byte < 4; ++byte) bytes.push_back(char(bits >> (8 * byte) & 0xff));
  }
  return bytes;
}

TEST(RawShape, IsToldFromTheOtherOrderWhateverTheLayering) {
  // Beds that dip, a flat layer, a gradient, a body; each in both orders, read in either.
  const std::vector<std::function<double(std::int64_t, std::int64_t)>> sections = {
      [](auto i, auto k) { return 10. * k > 200. + double(i) ? 2000. : 1500.; },
      [](auto, auto k) { return k > 19 ? 2000. : 1500.; },
      [](auto i, auto k) { return 1500. + 10. * double(k) + double(i); },
      [](auto i, auto k) { return std::abs(i - 60) < 30 && k > 19 && k < 40 ? 2500. : 2000.; }};
  for (const auto& [nx, nz] : {std::pair<std::int64_t, std::int64_t>(120, 50), {64, 64}})
    for (std::size_t n = 0; n < sections.size(); ++n)
      for (const auto order : {FastAxis::z, FastAxis::x})
        for (const auto read_as : {FastAxis::z, FastAxis::x}) {
          // A body may stand upright; of equal numbers of cells nothing else tells.
          if (nx == nz && n == 3) continue;
          Grid<2> grid;
          grid.shape = {nx, nz};
          const auto said = sentence_of([&, width = nx, height = nz] {
            check_raw_shape(raw_of(sections[n], width, height, order), grid, read_as);
          });
          EXPECT_EQ(said == "no error", order == read_as) << n << ' ' << nx << ' ' << said;
        }
}

TEST(RawShape, OfVolumesIsToldForAllOrdersOfTheirAxes) {
  Grid<3> grid;
  grid.shape = {30, 12, 20};
  std::array<int, 3> order = {0, 1, 2};  // axes of the file, the slowest first
  do {
    std::vector<float> values;
    Index<3> at{};
    const auto count = [&](int n) { return grid.shape[std::size_t(order[std::size_t(n)])]; };
    const auto place = [&](int n) -> std::int64_t& { return at[std::size_t(order[std::size_t(n)])]; };
    for (place(0) = 0; place(0) < count(0); ++place(0))
      for (place(1) = 0; place(1) < count(1); ++place(1))
        for (place(2) = 0; place(2) < count(2); ++place(2))
          // beds that dip and bend
          values.push_back(1500 + 100 * float(std::floor(0.5 * double(at[2]) + 0.1 * double(at[0]) +
                                                         std::sin(0.4 * double(at[1])))));
    std::vector<char> bytes(values.size() * 4);
    std::copy_n(reinterpret_cast<const char*>(values.data()), bytes.size(), bytes.begin());
    for (const auto fast : {FastAxis::z, FastAxis::x}) {
      const auto right = fast == FastAxis::z ? std::array{0, 1, 2} : std::array{2, 1, 0};
      const auto said = sentence_of([&] { check_raw_shape(bytes, grid, fast); });
      EXPECT_EQ(said == "no error", order == right)
          << order[0] << order[1] << order[2] << (fast == FastAxis::z ? " z: " : " x: ") << said;
    }
  } while (std::next_permutation(order.begin(), order.end()));
}

TEST(RawShape, OfSpeedsThatFallWithDepthIsDoubted) {
  Grid<3> grid;
  grid.shape = {6, 1, 10};
  Field<3> down(grid), up(grid), level(grid);
  for (std::int64_t n = 0; n < grid.size(); ++n) {
    const auto [x, y, k] = grid.index(n);
    down[std::size_t(n)] = float(1500 + 100 * k + 10 * x);
    up[std::size_t(n)] = float(2400 - 100 * k + 10 * x);
    level[std::size_t(n)] = k == 4 ? 3000 : 2000;  // a fast bed in the middle
  }
  EXPECT_EQ(doubt_of_depth(down), "");
  EXPECT_EQ(doubt_of_depth(level), "");
  EXPECT_EQ(
      doubt_of_depth(up),
      "speeds fall with depth, from 2425 in the first row to 1525 in the last, as those of a file from the "
      "bottom up do");
}

TEST(RawShape, OfVolumesIsToldTooWithoutLookingAtY) {
  Grid<3> grid;
  grid.shape = {30, 5, 20};
  std::vector<float> z_fast, x_fast;
  const auto value = [](std::int64_t i, std::int64_t k) { return 1500 + 20 * float(k) + float(i); };
  for (int i = 0; i < 30; ++i)
    for (int j = 0; j < 5; ++j)
      for (int k = 0; k < 20; ++k) z_fast.push_back(value(i, k));
  std::vector<char> bytes(z_fast.size() * 4);
  std::copy_n(reinterpret_cast<const char*>(z_fast.data()), bytes.size(), bytes.begin());
  EXPECT_EQ(sentence_of([&] { check_raw_shape(bytes, grid, FastAxis::z); }), "no error");
  EXPECT_NE(sentence_of([&] {
              check_raw_shape(bytes, grid, FastAxis::x);
            }).find("expected --shape 20x5x30 or --order z-fast"),
            std::string::npos);
}

TEST(RawShape, IsTakenOfWhatHasNoShape) {
  // Noise, and stripes that are upright or level: no shape is smoother than the other by far.
  Grid<2> grid;
  grid.shape = {40, 30};
  for (const int kind : {0, 1, 2}) {
    std::vector<char> bytes(4 * 1200);
    for (std::size_t n = 0; n < 1200; ++n) {
      const std::size_t number = kind == 0 ? n * 7919 % 1201 : kind == 1 ? n / 30 : n % 30;
      const auto bits = std::bit_cast<std::uint32_t>(float(number % 7));
      for (std::size_t byte = 0; byte < 4; ++byte) bytes[4 * n + byte] = char(bits >> (8 * byte) & 0xff);
    }
    EXPECT_EQ(sentence_of([&] { check_raw_shape(bytes, grid, FastAxis::z); }), "no error") << kind;
  }
}

}  // namespace slipwave::model_units_test
