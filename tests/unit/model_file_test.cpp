// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <map>

#include "build/import.hpp"
#include "grid/grid_netcdf.hpp"
#include "io/netcdf_file.hpp"
#include "model/model_netcdf.hpp"
#include "model_cases.hpp"
#include "scratch.hpp"

namespace slipwave::model_file_test {
namespace {

namespace fs = std::filesystem;

class ModelFile : public ::testing::Test {
 protected:
  Scratch scratch_;
  std::string path_ = scratch_.file("m.nc");
};

template <int D>
void expect_equal(const Model<D>& found, const Model<D>& expected) {
  EXPECT_EQ(found.grid(), expected.grid());
  const auto same = [](const auto& a, const auto& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end());
  };
  EXPECT_TRUE(same(found.medium.vp, expected.medium.vp));
  EXPECT_TRUE(same(found.medium.vs, expected.medium.vs));
  EXPECT_TRUE(same(found.medium.rho, expected.medium.rho));
  EXPECT_TRUE(same(found.fracture, expected.fracture));
  EXPECT_TRUE(same(found.fracture_share, expected.fracture_share));
  ASSERT_EQ(found.fracture_sets.size(), expected.fracture_sets.size());
  for (std::size_t k = 0; k < found.fracture_sets.size(); ++k) {
    EXPECT_EQ(found.fracture_sets[k].name, expected.fracture_sets[k].name);
    const auto& systems = found.fracture_sets[k].systems;
    ASSERT_EQ(systems.size(), expected.fracture_sets[k].systems.size());
    for (std::size_t i = 0; i < systems.size(); ++i) {
      EXPECT_EQ(systems[i].normal, expected.fracture_sets[k].systems[i].normal);
      EXPECT_EQ(systems[i].friction, expected.fracture_sets[k].systems[i].friction);
      EXPECT_EQ(systems[i].viscosity_s, expected.fracture_sets[k].systems[i].viscosity_s);
      EXPECT_EQ(systems[i].strength_pa, expected.fracture_sets[k].systems[i].strength_pa);
      EXPECT_EQ(systems[i].opens, expected.fracture_sets[k].systems[i].opens);
      EXPECT_EQ(systems[i].law, expected.fracture_sets[k].systems[i].law);
      EXPECT_EQ(systems[i].dynamic_friction, expected.fracture_sets[k].systems[i].dynamic_friction);
      EXPECT_EQ(systems[i].slip_distance_m, expected.fracture_sets[k].systems[i].slip_distance_m);
    }
  }
  ASSERT_EQ(found.prestress_pa.size(), expected.prestress_pa.size());
  for (std::size_t c = 0; c < found.prestress_pa.size(); ++c)
    EXPECT_TRUE(same(found.prestress_pa[c], expected.prestress_pa[c]));
  EXPECT_EQ(found.title, expected.title);
  EXPECT_EQ(found.source, expected.source);
  EXPECT_EQ(found.history, expected.history);
}

}  // namespace

TEST_F(ModelFile, BringsBackATwoDimensionalModelBitForBit) {
  auto model = water_over_rock(grid_of(7, 5, 0.1), 2);
  for (std::size_t cell = 0; cell < model.medium.vp.size(); ++cell)
    model.medium.vp[cell] += 0.1f * float(cell);
  model.fracture = Field<2, std::uint8_t>(model.grid());
  model.fracture({3, 4}) = 2;
  model.fracture({4, 4}) = 1;
  model.fracture_sets = {{"one", {{{0.6, 0.8}, 0.1, 1e-3, 5}}},
                         {"two", {{{1, 0}, 0.2, 0, 0}, {{0, 1}, 0.3, 7, 1e6}}}};
  model.title = "a title";
  model.source = "a source";
  model.history = "first\nsecond";
  write_model(model, path_);
  expect_equal(read_model<2>(path_), model);
}

TEST_F(ModelFile, BringsBackStaticStressAndPlanesThatOpen) {
  auto model = water_over_rock(grid_of(4, 3, 10), 1);
  model.fracture = Field<2, std::uint8_t>(model.grid(), 0);
  model.fracture({1, 2}) = 1;
  model.fracture_sets = {{"one", {{{1, 0}, 0.2, 0, 0, true}, {{0, 1}, 0.3, 7, 1e6, false}}}};
  for (const float value : {-1e6f, -2.5e6f, 1e3f}) {
    model.prestress_pa.emplace_back(model.grid());
    model.prestress_pa.back()({1, 2}) = value;
  }
  write_model(model, path_);
  expect_equal(read_model<2>(path_), model);
}

TEST_F(ModelFile, BringsBackSharesOfCellsThatEdgesCut) {
  auto model = water_over_rock(grid_of(7, 5, 12.5), 0);
  model.fracture = Field<2, std::uint8_t>(model.grid(), 0);
  model.fracture({1, 2}) = model.fracture({2, 2}) = 1;
  model.fracture_sets = {{"one", {{{1, 0}, 0.2, 0, 0}}}};
  model.fracture_share = Field<2>(model.grid(), 1);
  model.fracture_share({2, 2}) = 0.375;
  write_model(model, path_);
  expect_equal(read_model<2>(path_), model);
}

TEST_F(ModelFile, BringsBackFrictionLaws) {
  auto model = water_over_rock(grid_of(4, 3, 10), 1);
  model.fracture = Field<2, std::uint8_t>(model.grid(), 0);
  model.fracture({1, 2}) = 1;
  model.fracture_sets = {
      {"one", {{{1, 0}, 0.6, 0, 0}, {{0, 1}, 0.6, 0, 0, false, FrictionLaw::slip_weakening, 0.2, 1e-4}}}};
  write_model(model, path_);
  expect_equal(read_model<2>(path_), model);
}

TEST_F(ModelFile, WritesNeitherWhereThereIsNone) {
  auto model = water_over_rock(grid_of(4, 3, 10), 1);
  model.fracture = Field<2, std::uint8_t>(model.grid(), 0);
  model.fracture({1, 2}) = 1;
  model.fracture_sets = {{"one", {{{1, 0}, 0.2, 0, 0}}}};
  write_model(model, path_);
  const auto file = NetcdfFile::open(path_);
  EXPECT_FALSE(file.has_variable("slip_opening"));
  EXPECT_FALSE(file.has_variable("slip_law"));
  EXPECT_FALSE(file.has_variable("prestress_sxx"));
}

TEST_F(ModelFile, BringsBackAThreeDimensionalModelBitForBit) {
  Grid<3> grid;
  grid.shape = {3, 4, 5};
  grid.spacing_m = 1.0 / 3;
  grid.origin_m = {620000.5, -10, 0};
  Model<3> model;
  model.medium = {Field<3>(grid, 3000), Field<3>(grid, 1500), Field<3>(grid, 2000)};
  for (std::size_t cell = 0; cell < model.medium.vp.size(); ++cell) model.medium.vp[cell] += float(cell);
  write_model(model, path_);
  const auto found = read_model<3>(path_);
  EXPECT_EQ(found.grid().shape, grid.shape);
  EXPECT_NEAR(found.grid().spacing_m, grid.spacing_m, 1e-9);
  EXPECT_NEAR(found.grid().origin_m[0], grid.origin_m[0], 1e-9);
  EXPECT_TRUE(std::equal(found.medium.vp.begin(), found.medium.vp.end(), model.medium.vp.begin()));
}

TEST_F(ModelFile, KeepsItsStepAndOriginThroughManyPasses) {
  for (const double step : {5.0, 0.1, 12.5, 1.0 / 3}) {
    auto model = water_over_rock(grid_of(300, 2, step), 1);
    write_model(model, path_);
    for (int pass = 0; pass < 3; ++pass) {
      auto again = read_model<2>(path_);
      EXPECT_EQ(again.grid(), model.grid()) << step;
      write_model(again, path_);
    }
  }
}

TEST_F(ModelFile, SaysWhatAFileLacks) {
  write_model(water_over_rock(grid_of(3, 2, 5), 1), path_);
  EXPECT_EQ(sentence_of([&] { read_model<3>(path_); }),
            path_ + ": vp: found dimensions (z, x), expected (z, y, x)");
  const auto other = scratch_.file("other.nc");
  {
    auto file = NetcdfFile::create(other, other);
    define_grid(file, grid_of(3, 2, 5));
    file.define_variable("vp", NetcdfFile::Type::f32, {"z", "x"});
    put_grid(file, grid_of(3, 2, 5));
    file.close();
  }
  EXPECT_EQ(sentence_of([&] { read_model<2>(other); }), other + ": found no variable 'vs', expected a model");
}

TEST_F(ModelFile, RefusesUnevenUnequalOrLoweredGrids) {
  const auto with = [&](const std::vector<double>& x, const std::vector<double>& z) {
    auto file = NetcdfFile::create(path_, "m.nc");
    file.define_dimension("z", z.size());
    file.define_dimension("x", x.size());
    file.define_variable("x", NetcdfFile::Type::f64, {"x"});
    file.define_variable("z", NetcdfFile::Type::f64, {"z"});
    file.put("x", x.data());
    file.put("z", z.data());
    const auto sentence = sentence_of([&] { read_grid<2>(file); });
    file.close();
    return sentence;
  };
  EXPECT_EQ(with({5, 15, 25}, {5, 15}), "no error");
  EXPECT_NE(with({5, 15, 26}, {5, 15}).find("x: found unevenly spaced"), std::string::npos);
  EXPECT_NE(with({25, 15, 5}, {5, 15}).find("x: found cells from 25 to 5 m, expected ascending ones"),
            std::string::npos);
  EXPECT_EQ(with({5, 15, 25}, {2.5, 7.5}),
            "m.nc: found a step of 10 m along x and of 5 m along z, expected equal steps");
  EXPECT_EQ(with({5, 15, 25}, {0, 10}), "m.nc: z begins at 0, expected 5, half a step below the surface");
}

/// A model of 3 x 2 cells of 10 m as other programs may write it, with these attributes, coordinates and
/// values.
struct Foreign {
  std::map<std::string, std::map<std::string, std::string>> attributes = {};
  std::vector<double> x = {5, 15, 25}, z = {5, 15};
  std::vector<float> vp = {1000, 1100, 1200, 2000, 2100, 2200};
  double x_scale = 1, x_offset = 0;
};

TEST_F(ModelFile, HasTheUnitsAndDirectionsThatItNames) {
  const auto read = [&](const Foreign& foreign) {
    {
      auto file = NetcdfFile::create(path_, path_);
      file.define_dimension("z", 2);
      file.define_dimension("x", 3);
      file.define_variable("x", NetcdfFile::Type::f64, {"x"});
      file.define_variable("z", NetcdfFile::Type::f64, {"z"});
      for (const char* name : {"vp", "vs", "rho"})
        file.define_variable(name, NetcdfFile::Type::f32, {"z", "x"});
      for (const auto& [variable, texts] : foreign.attributes)
        for (const auto& [name, text] : texts) file.put_attribute(variable, name, text);
      if (foreign.x_scale != 1) {
        file.put_attribute("x", "scale_factor", std::vector<double>{foreign.x_scale});
        file.put_attribute("x", "add_offset", std::vector<double>{foreign.x_offset});
      }
      file.put("x", foreign.x.data());
      file.put("z", foreign.z.data());
      file.put("vp", foreign.vp.data());
      file.put("vs", std::vector<float>(6, 0).data());
      file.put("rho", std::vector<float>(6, 1000).data());
      file.close();
    }
    return read_model<2>(path_);
  };
  const auto expected = read({});
  EXPECT_EQ(expected.grid(), grid_of(3, 2, 10));
  Foreign other;
  other.attributes = {{"x", {{"units", "km"}}}, {"z", {{"positive", "up"}, {"units", "m"}}}};
  other.attributes["vp"]["units"] = "km s-1";
  other.x = {0.005, 0.015, 0.025};
  other.z = {-5, -15};
  other.vp = {1, 1.1F, 1.2F, 2, 2.1F, 2.2F};
  const auto found = read(other);
  EXPECT_EQ(found.grid(), expected.grid());
  for (std::size_t cell = 0; cell < 6; ++cell)
    EXPECT_FLOAT_EQ(found.medium.vp[cell], expected.medium.vp[cell]);
  Foreign packed;
  packed.x_scale = 0.5;
  packed.x_offset = -100;
  packed.x = {210, 230, 250};
  EXPECT_EQ(read(packed).grid(), expected.grid());
  const auto refused = [&](const std::string& variable, const std::string& name, const std::string& text) {
    Foreign wrong;
    wrong.attributes[variable][name] = text;
    return sentence_of([&] { read(wrong); }).substr(path_.size() + 2);
  };
  EXPECT_EQ(refused("vp", "units", "degrees"),
            "vp: found the unit 'degrees', expected one of speed, as m s-1, km s-1 or ft s-1");
  EXPECT_EQ(refused("rho", "units", "kg"),
            "rho: found the unit 'kg', expected one of density, as kg m-3 or g cm-3");
  EXPECT_EQ(refused("z", "positive", "up"),
            "z: found cells from -5 to -15 m deep, expected them from the top down: ncpdq -a -z FILE "
            "reverses them");
}

TEST(RawField, RunsDownTheColumnsWhenZIsFast) {
  // 3 columns of 2: the values 0 .. 5 as little-endian floats.
  std::vector<char> bytes;
  for (int i = 0; i < 6; ++i) {
    const float value = float(i);
    const auto* raw = reinterpret_cast<const char*>(&value);
    bytes.insert(bytes.end(), raw, raw + 4);
  }
  const auto z_fast = field_from_raw(bytes, grid_of(3, 2, 5), FastAxis::z);
  EXPECT_EQ(z_fast({0, 1}), 1);
  EXPECT_EQ(z_fast({2, 0}), 4);
  const auto x_fast = field_from_raw(bytes, grid_of(3, 2, 5), FastAxis::x);
  EXPECT_EQ(x_fast({2, 0}), 2);
  EXPECT_EQ(x_fast({0, 1}), 3);
  EXPECT_EQ(sentence_of([&] { field_from_raw(bytes, grid_of(3, 3, 5), FastAxis::z); }),
            "found 24 bytes, expected 36 for 3 x 3 cells of 5 m, 4 bytes each");
}

TEST_F(ModelFile, ForeignSectionsComeInWithTheirUnitsAndDirections) {
  {
    // speed(x, elevation) in km/s, elevation in km upwards, from the bottom.
    auto file = NetcdfFile::create(path_, path_);
    file.define_dimension("x", 2);
    file.define_dimension("elevation", 3);
    file.define_variable("elevation", NetcdfFile::Type::f64, {"elevation"});
    file.put_attribute("elevation", "units", "km");
    file.put_attribute("elevation", "positive", "up");
    file.put("elevation", std::vector<double>{-0.05, -0.03, -0.01}.data());
    file.define_variable("speed", NetcdfFile::Type::f64, {"x", "elevation"});
    file.put_attribute("speed", "units", "km/s");
    file.put("speed", std::vector<double>{4, 3, 2, 4.5, 3.5, 2.5}.data());
    file.close();
  }
  const auto field = field_of<2>(field_from_netcdf(NetcdfFile::open(path_), row_of(Property::vp), "", {}));
  EXPECT_EQ(field.grid(), grid_of(2, 3, 20));
  EXPECT_EQ(field({0, 0}), 2000);
  EXPECT_EQ(field({1, 0}), 2500);
  EXPECT_EQ(field({0, 2}), 4000);
  EXPECT_NE(sentence_of([&] {
              field_from_netcdf(NetcdfFile::open(path_), row_of(Property::vp), "", 10);
            }).find("found a step of 20 m"),
            std::string::npos);
}

}  // namespace slipwave::model_file_test
