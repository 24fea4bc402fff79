// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <vector>

#include "geology/horizon.hpp"
#include "io/netcdf_file.hpp"
#include "model_cases.hpp"

namespace slipwave::model_grid_horizon_file_test {
namespace {

/// A netCDF file of a surface of 3 x 2 nodes, laid out as a COARDS grid of GMT unless changed.
struct GridFile {
  std::vector<std::string> dimensions = {"y", "x"};
  std::vector<double> x = {0, 100, 250}, y = {-50, 150};
  std::vector<float> depths = {100, 200, 300, 400, 500, 600};
  std::string name = "z", second = {}, units = {}, coordinate_units = {}, positive = {};
  bool coordinates = true;

  void write(const std::string& path) const {
    using Type = NetcdfFile::Type;
    auto file = NetcdfFile::create(path, path);
    const auto length = [&](const std::string& dimension) {
      return dimension == "x" || dimension == "easting" ? x.size() : y.size();
    };
    for (const auto& dimension : dimensions) {
      file.define_dimension(dimension, length(dimension));
      if (!coordinates) continue;
      file.define_variable(dimension, Type::f64, {dimension});
      if (!coordinate_units.empty()) file.put_attribute(dimension, "units", coordinate_units);
      if (dimension == "easting") file.put_attribute(dimension, "axis", "X");
    }
    file.define_variable(name, Type::f32, dimensions);
    file.put_attribute(name, "_FillValue", std::vector<float>{-999});
    if (!second.empty()) file.define_variable(second, Type::f32, dimensions);
    if (!units.empty()) file.put_attribute(name, "units", units);
    if (!positive.empty()) file.put_attribute(name, "positive", positive);
    for (const auto& dimension : dimensions)
      if (coordinates) file.put(dimension, (length(dimension) == x.size() ? x : y).data());
    file.put(name, depths.data());
    file.close();
  }
};

Horizon horizon_of(const GridFile& grid, const std::string& kind = "@") {
  const TextFile file("");
  grid.write(file.path());
  return Horizon::parse(kind + file.path());
}

std::string refused(const GridFile& grid) {
  const TextFile file("");
  grid.write(file.path());
  const auto sentence = sentence_of([&] { Horizon::parse("@" + file.path()); });
  const std::string place = file.path() + ": ";
  return sentence.starts_with(place) ? sentence.substr(place.size()) : "no place: " + sentence;
}

void expect_the_surface(const GridFile& grid) {
  const auto horizon = horizon_of(grid);
  EXPECT_TRUE(horizon.is_grid());
  EXPECT_EQ(horizon.from_m(1), -50);
  EXPECT_EQ(horizon.to_m(0), 250);
  EXPECT_NEAR(horizon.at(0, -50), 100, 1e-4);
  EXPECT_NEAR(horizon.at(100, -50), 200, 1e-4);
  EXPECT_NEAR(horizon.at(250, 150), 600, 1e-4);
  EXPECT_NEAR(horizon.at(50, 50), 300, 1e-4);
}

}  // namespace

TEST(GridHorizonFile, HoldsRowsOfYLikeAGridOfGmt) {
  expect_the_surface({});
  GridFile named;
  named.name = "depth";
  named.second = "z";
  named.units = "m";
  expect_the_surface(named);
}

TEST(GridHorizonFile, MayStandTheOtherWayRound) {
  GridFile transposed;
  transposed.dimensions = {"x", "y"};
  transposed.depths = {100, 400, 200, 500, 300, 600};
  expect_the_surface(transposed);
  transposed.dimensions = {"easting", "northing"};
  expect_the_surface(transposed);
  GridFile descending;
  descending.y = {150, -50};
  descending.depths = {400, 500, 600, 100, 200, 300};
  expect_the_surface(descending);
  GridFile backwards;
  backwards.x = {250, 100, 0};
  backwards.depths = {300, 200, 100, 600, 500, 400};
  expect_the_surface(backwards);
  GridFile upwards;
  upwards.positive = "up";
  for (auto& depth : upwards.depths) depth = -depth;
  expect_the_surface(upwards);
}

TEST(GridHorizonFile, MayCountInKilometres) {
  GridFile file;
  file.units = file.coordinate_units = "km";
  for (auto& x : file.x) x /= 1000;
  for (auto& y : file.y) y /= 1000;
  for (auto& depth : file.depths) depth /= 1000;
  expect_the_surface(file);
}

TEST(GridHorizonFile, SaysWhatIsWrong) {
  GridFile gap;
  gap.depths[4] = -999;
  EXPECT_EQ(refused(gap), "z: the depth at x = 100, y = 150 is NaN, expected a number");
  gap.depths[4] = INFINITY;
  EXPECT_EQ(refused(gap), "z: the depth at x = 100, y = 150 is inf, expected a number");
  GridFile seconds;
  seconds.units = "ms";
  EXPECT_EQ(refused(seconds), "z: found the unit 'ms', expected one of length, as m, km or ft");
  GridFile degrees;
  degrees.coordinate_units = "degrees_east";
  EXPECT_EQ(refused(degrees), "x: found the unit 'degrees_east', expected one of length, as m, km or ft");
  GridFile several;
  several.name = "top";
  several.second = "base";
  EXPECT_EQ(refused(several), "found top, base with two dimensions, expected depth, z or one alone");
  GridFile bare;
  bare.coordinates = false;
  EXPECT_EQ(refused(bare), "z: found no coordinates along x, expected a variable x(x)");
  GridFile back;
  back.x = {0, 100, 100};
  EXPECT_EQ(refused(back), "x: found 100 beside 100, expected coordinates in order");
  GridFile upwards;
  upwards.positive = "up";
  EXPECT_EQ(refused(upwards),
            "z: found depths from -600 to -100 m, expected them to count downwards from the surface");
  GridFile thin;
  thin.y = {0};
  thin.depths.resize(3);
  EXPECT_EQ(refused(thin), "z: found 3 different x and 1 different y, expected at least 2 of each");
}

}  // namespace slipwave::model_grid_horizon_file_test
