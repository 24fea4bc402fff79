// SPDX-License-Identifier: BSD-3-Clause
#include <filesystem>
#include <map>

#include "build/import.hpp"
#include "grid/grid_netcdf.hpp"
#include "io/netcdf_file.hpp"
#include "model_cases.hpp"

namespace slipwave::model_import_axis_test {
namespace {

using Attributes = std::map<std::string, std::string>;

/// A section of 2 columns and 3 rows whose speed is 1000 in the top row, 1001 and 1002 below it, with the
/// heights or depths of its rows as a file may have them.
class ImportedAxis : public ::testing::Test {
 protected:
  void TearDown() override { std::filesystem::remove(path_); }

  ImportedField read(const std::string& name, const std::vector<double>& places, const Attributes& attributes,
                     const std::vector<float>& rows) const {
    {
      auto file = NetcdfFile::create(path_, path_);
      file.define_dimension(name, rows.size());
      file.define_dimension("x", 2);
      file.define_variable(name, NetcdfFile::Type::f64, {name});
      for (const auto& [key, text] : attributes) file.put_attribute(name, key, text);
      file.put(name, places.data());
      file.define_variable("vp", NetcdfFile::Type::f32, {name, "x"});
      std::vector<float> values;
      for (const float row : rows) values.insert(values.end(), {row, row});
      file.put("vp", values.data());
      file.close();
    }
    return field_from_netcdf(NetcdfFile::open(path_), row_of(Property::vp), "", {});
  }
  std::string said(const std::string& name, const std::vector<double>& places,
                   const Attributes& attributes) const {
    auto sentence = sentence_of([&] { read(name, places, attributes, {1000, 1001, 1002}); });
    if (sentence.starts_with(path_)) sentence.erase(0, path_.size() + 2);
    return sentence;
  }
  static void expect_upright(const ImportedField& field, double top_m) {
    ASSERT_EQ(field.values.size(), 6U);
    EXPECT_EQ(field.values[0], 1000);
    EXPECT_EQ(field.values[5], 1002);
    EXPECT_NEAR(field.values.grid().origin_m[2], top_m, 1e-9);
    EXPECT_EQ(field.values.grid().spacing_m, 10);
  }

  const std::string path_ =
      (std::filesystem::temp_directory_path() / ("slipwave_axis_" + std::to_string(getpid()) + ".nc"))
          .string();
};

const std::vector<float> from_top = {1000, 1001, 1002}, from_bottom = {1002, 1001, 1000};

}  // namespace

TEST_F(ImportedAxis, OfDepthsRunsDownHoweverItIsStored) {
  for (const Attributes& attributes :
       {Attributes{}, {{"positive", "down"}}, {{"positive", "DOWN "}}, {{"standard_name", "depth"}}}) {
    expect_upright(read("z", {5, 15, 25}, attributes, from_top), 0);
    expect_upright(read("z", {25, 15, 5}, attributes, from_bottom), 0);
    expect_upright(read("depth", {105, 115, 125}, attributes, from_top), 100);
  }
  expect_upright(read("depth", {-95, -85, -75}, {{"positive", "down"}}, from_top), -100);
  expect_upright(read("z", {0.005, 0.015, 0.025}, {{"units", "km"}}, from_top), 0);
}

TEST_F(ImportedAxis, OfHeightsIsTurnedHoweverItIsNamedAndStored) {
  const Attributes none;
  for (const auto& [name, attributes] : {std::pair<std::string, Attributes>("z", {{"positive", "up"}}),
                                         {"z", {{"positive", "Up"}}},
                                         {"depth", {{"positive", "UP"}}},
                                         {"elevation", none},
                                         {"Altitude", none},
                                         {"height", none},
                                         {"z", {{"standard_name", "height_above_mean_sea_level"}}},
                                         {"z", {{"long_name", "Elevation of cells"}}},
                                         {"lev", {{"axis", "Z"}, {"standard_name", "altitude"}}}}) {
    expect_upright(read(name, {-5, -15, -25}, attributes, from_top), 0);
    expect_upright(read(name, {-25, -15, -5}, attributes, from_bottom), 0);
    expect_upright(read(name, {275, 285, 295}, attributes, from_bottom), -300);
  }
}

TEST_F(ImportedAxis, ThatMayCountEitherWayIsRefused) {
  const std::string remedy =
      ": found -25 to -5 m without the attribute positive, expected it to say whether they count up (5 to 25 "
      "m "
      "deep) or down: ncatted -a positive,";
  EXPECT_EQ(said("z", {-25, -15, -5}, {}), "z" + remedy + "z,c,c,up FILE");
  EXPECT_EQ(said("depth", {-5, -15, -25}, {}), "depth" + remedy + "depth,c,c,up FILE");
  EXPECT_NE(said("lev", {5, 15, 25}, {{"axis", "Z"}}).find("lev: found 5 to 25 m without the attribute"),
            std::string::npos);
  EXPECT_EQ(
      said("z", {-5, -15, -25}, {{"positive", "up"}, {"standard_name", "depth"}}),
      "z: found positive 'up' and standard_name 'depth', which counts downwards, expected them to agree (CF "
      "4.3): correct one, as with ncatted");
  EXPECT_EQ(said("z", {5, 15, 25}, {{"positive", "sideways"}}),
            "z: found positive 'sideways', expected up or down");
  EXPECT_EQ(said("z", {5, 15, 25}, {{"units", "degrees"}}),
            "z: found the unit 'degrees', expected one of length, as m, km or ft");
  EXPECT_EQ(said("z", {5, std::nan(""), 25}, {}),
            "z[1] is missing (NaN or its _FillValue), expected a number");
}

TEST_F(ImportedAxis, ThatIsNoDepthIsNotTakenForOne) {
  EXPECT_EQ(
      said("y", {5, 15, 25}, {}),
      "vp: found no vertical dimension among (y, x), expected one called z or depth, or whose coordinate has "
      "axis = \"Z\"");
  EXPECT_NE(said("row", {5, 15, 25}, {}).find("row: found 5 to 25 m without the attribute positive"),
            std::string::npos);
}

TEST_F(ImportedAxis, OfThreeDimensionsIsAVolume) {
  {
    // y, x, elevation: z fastest and from the bottom up.
    auto file = NetcdfFile::create(path_, path_);
    for (const auto& [name, count] : {std::pair("y", 3), {"x", 4}, {"elevation", 2}}) {
      file.define_dimension(name, std::size_t(count));
      file.define_variable(name, NetcdfFile::Type::f64, {name});
      std::vector<double> places;
      for (int n = 0; n < count; ++n)
        places.push_back(name == std::string("elevation") ? 20. * n - 30 : 20. * n + 10);
      file.put(name, places.data());
    }
    file.define_variable("vp", NetcdfFile::Type::f32, {"y", "x", "elevation"});
    file.put_attribute("vp", "units", "km.s-1");
    std::vector<float> values;
    for (int y = 0; y < 3; ++y)
      for (int x = 0; x < 4; ++x)
        for (int k = 1; k >= 0; --k) values.push_back(float(1000 + 100 * k + 10 * y + x) / 1000);
    file.put("vp", values.data());
    file.close();
  }
  const auto field = field_from_netcdf(NetcdfFile::open(path_), row_of(Property::vp), "", {});
  EXPECT_FALSE(field.is_section);
  EXPECT_EQ(field.values.grid().shape, (Index<3>{4, 3, 2}));
  for (std::int64_t n = 0; n < field.values.grid().size(); ++n) {
    const auto at = field.values.grid().index(n);
    EXPECT_FLOAT_EQ(field.values[std::size_t(n)], float(1000 + 100 * at[2] + 10 * at[1] + at[0]));
  }
}

TEST_F(ImportedAxis, OfTimesIsNoPlace) {
  const auto refusal = [&](const std::string& name, const Attributes& attributes) {
    {
      auto file = NetcdfFile::create(path_, path_);
      for (const auto& [dimension, count] : {std::pair(name, 2), {std::string("z"), 3}, {"x", 2}})
        file.define_dimension(dimension, std::size_t(count));
      if (!attributes.empty()) file.define_variable(name, NetcdfFile::Type::f64, {name});
      for (const auto& [key, text] : attributes) file.put_attribute(name, key, text);
      file.define_variable("vp", NetcdfFile::Type::f32, {name, "z", "x"});
      const std::vector<float> values(12, 2000);
      file.put("vp", values.data());
      file.close();
    }
    return sentence_of([&] { field_from_netcdf(NetcdfFile::open(path_), row_of(Property::vp), "", 10.); });
  };
  for (const auto& [name, attributes] : {std::pair<std::string, Attributes>{"time", {}},
                                         {"t", {{"units", "hours since 2020-01-01"}}},
                                         {"record", {{"axis", "T"}}},
                                         {"step", {{"units", "s"}}},
                                         {"realization", {}}})
    EXPECT_EQ(refusal(name, attributes), path_ + ": vp: found the dimension " + name +
                                             ", expected places alone: take one out, as with ncwa -a " +
                                             name + " -d " + name + ",0 FILE OUT");
  EXPECT_EQ(refusal("line", {}), "no error");
}

TEST_F(ImportedAxis, CalledDepthAllBelowZeroSaysTooLittle) {
  EXPECT_EQ(
      said("z", {-25, -15, -5}, {{"standard_name", "depth"}}),
      "z: found -25 to -5 m without the attribute positive, expected it to say whether they count up (5 to "
      "25 m deep) or down: ncatted -a positive,z,c,c,up FILE");
  EXPECT_EQ(said("z", {-10, 0, 10}, {{"standard_name", "depth"}}), "no error");
}

}  // namespace slipwave::model_import_axis_test
