// SPDX-License-Identifier: BSD-3-Clause
// A material property that is nothing but a row of the table (property_table.cpp) goes wherever the others
// go.

#include <algorithm>
#include <cmath>
#include <functional>

#include "base/error.hpp"
#include "build/import.hpp"
#include "build/resample.hpp"
#include "checkpoint/identity.hpp"
#include "grid/grid_netcdf.hpp"
#include "io/netcdf_file.hpp"
#include "model/model_netcdf.hpp"
#include "plot/section.hpp"
#include "rock/averaging.hpp"
#include "scene/subdomains.hpp"
#include "shell.hpp"

namespace slipwave {
namespace {

const Property temperature = find_property("temperature").value();

/// Exact in float where x and z are multiples of 1.25 m below 1000 m.
float temperature_at(double x_m, double z_m) { return float(283 + x_m / 64 + z_m / 32); }

template <int D>
Field<D> temperatures(const Grid<D>& grid) {
  Field<D> field(grid);
  for (std::int64_t n = 0; n < grid.size(); ++n) {
    const auto at = grid.index(n);
    field[std::size_t(n)] = temperature_at(grid.centre(0, at[0]), grid.centre(D - 1, at[D - 1]));
  }
  return field;
}

template <int D>
bool same(const Field<D>& a, const Field<D>& b) {
  return a.grid() == b.grid() && std::equal(a.begin(), a.end(), b.begin(), b.end());
}

/// Water over rock, 200 m by 100 m in cells of 5 m, in a file, and its temperature in another.
class Temperature : public Shell {
 protected:
  Temperature() {
    done("sw-layers --size 200x100 --step 5 --layer 0:1500:0:1000 --layer 20:3000:1500:2200 -o cold.nc");
    const auto cold = read_model<2>(path("cold.nc"));
    write_temperature(temperatures(cold.grid()), "K");
    done(import + "-o hot.nc");
  }
  void write_temperature(const Field<2>& field, const std::string& unit) const {
    auto file = NetcdfFile::create(path("t.nc"), "t.nc");
    define_grid(file, field.grid());
    file.define_variable("T", NetcdfFile::Type::f32, {"z", "x"});
    file.put_attribute("T", "units", unit);
    put_grid(file, field.grid());
    file.put("T", field.data());
    file.close();
  }
  Model<2> model(const std::string& name) const { return read_model<2>(path(name)); }

  const std::string import = "sw-import --vp cold.nc --vs cold.nc --rho cold.nc --temperature t.nc ";
  const std::string shot =
      " --source 100,40 --wavelet ricker:25 --receivers 0:200:10,45 --time 0.15 --amplitude 1e14 -o ";
};

Scene<2> scene_of(Model<2> model) {
  Scene<2> scene;
  scene.survey.sources = {{{100, 40}, parse_mechanism<2>("explosion"), parse_wavelet("ricker:25"), 1}};
  scene.survey.receivers_m = {{50, 45}};
  scene.recording = {{Component::vz}, 0.1, 0.001};
  scene.model = std::move(model);
  return scene;
}

}  // namespace

TEST_F(Temperature, IsImportedAndReportedWithItsUnit) {
  EXPECT_TRUE(same(model("hot.nc").medium[temperature], temperatures(model("cold.nc").grid())));
  const auto text = done("sw-info hot.nc");
  EXPECT_NE(text.find("  temperature   283.1172 to 289.1328 K\n"), std::string::npos) << text;
  EXPECT_NE(done("sw-info --json hot.nc")
                .find("\"temperature\": {\"low\": 283.1171875, \"high\": 289.1328125, \"unit\": \"K\"}"),
            std::string::npos);
  const auto file = NetcdfFile::open(path("hot.nc"));
  EXPECT_EQ(file.text_attribute("temperature", "units"), "K");
  EXPECT_EQ(file.text_attribute("temperature", "long_name"), "temperature");
}

TEST_F(Temperature, IsRefusedByPlaceUnitAndGrid) {
  auto field = temperatures(model("cold.nc").grid());
  field({3, 6}) = 5001;
  write_temperature(field, "K");
  expect_refused(import, 1,
                 "sw-import: temperature at x=17.5 z=32.5 is 5001, expected a finite number from 0 to 5000");
  // Units are converted: what is too hot in degrees is that much hotter still.
  write_temperature(field, "degC");
  expect_refused(
      import, 1,
      "sw-import: temperature at x=17.5 z=32.5 is 5274.15, expected a finite number from 0 to 5000");
  write_temperature(field, "m");
  EXPECT_NE(run(import).code, 0);
  done("sw-import --vp cold.nc --vs cold.nc --rho cold.nc --resample 2.5 -o fine.nc");
  write_temperature(temperatures(model("fine.nc").grid()), "K");
  expect_refused(
      import, 1,
      "sw-import: temperature: found 80 x 40 cells of 2.5 m, expected 40 x 20 cells of 5 m as of vp");
}

TEST_F(Temperature, IsAveragedAndInterpolatedInsideOneKind) {
  done(import + "--resample 10 -o coarse.nc");
  // Four cells of one kind: the mean of a linear field is its value at the centre.
  const auto coarse = model("coarse.nc").medium;
  EXPECT_TRUE(same(coarse[temperature], temperatures(coarse.grid())));
  done(import + "--resample 2.5 -o fine.nc");
  const auto fine = model("fine.nc").medium;
  const auto expected = temperatures(fine.grid());
  for (std::int64_t n = 0; n < fine.grid().size(); ++n) {
    const auto at = fine.grid().index(n);
    // Next to the edges and the sea floor it is not extrapolated.
    if (at[0] < 1 || at[0] > 78 || at[1] < 1 || at[1] > 38 || at[1] == 7 || at[1] == 8) continue;
    ASSERT_FLOAT_EQ(fine[temperature][std::size_t(n)], expected[std::size_t(n)]);
  }
  done(
      "sw-import --vp hot.nc --vs hot.nc --rho hot.nc --temperature hot.nc --crop 50:150,10:90 "
      "--extrude 15 -o cube.nc");
  const auto cube = read_model<3>(path("cube.nc")).medium;
  EXPECT_EQ(cube[temperature]({0, 2, 0}), temperature_at(52.5, 12.5));
}

TEST_F(Temperature, IsDrawnAndExported) {
  done("sw-plot hot.nc --property temperature -o t.png");
  done("sw-plot hot.nc --property vp -o vp.png");
  EXPECT_NE(content("t.png"), content("vp.png"));
  const auto section = plot::read_model_section(NetcdfFile::open(path("hot.nc")), "temperature");
  EXPECT_EQ(section.unit, "K");
  EXPECT_TRUE(same(section.values, temperatures(section.grid())));
  done("sw-export hot.nc --property temperature -o t.sgy");
  done("sw-import --vp cold.nc --vs cold.nc --rho cold.nc --step 5 --temperature t.sgy -o again.nc");
  EXPECT_TRUE(same(model("again.nc").medium[temperature], model("hot.nc").medium[temperature]));
  expect_refused("sw-plot cold.nc --property temperature", 2,
                 "sw-plot: cold.nc: found no variable 'temperature', expected a model with it");
  expect_refused("sw-export cold.nc --property temperature", 2,
                 "sw-export: cold.nc: found no variable 'temperature', expected a model with it");
}

TEST_F(Temperature, StaysWhereRockIsFracturedAndShot) {
  const std::string fracture = " --box 50:150,50:80 --dip 60 --friction 0.1 --viscosity 1e-3 -o ";
  done("sw-fracture hot.nc" + fracture + "broken.nc && sw-fracture cold.nc" + fracture + "cold-broken.nc");
  EXPECT_TRUE(same(model("broken.nc").medium[temperature], model("hot.nc").medium[temperature]));
  // Waves do not feel it.
  done("sw-shoot broken.nc" + shot + "hot.sgy && sw-shoot cold-broken.nc" + shot + "cold.sgy");
  EXPECT_EQ(done("cmp <(tail -c +3601 hot.sgy) <(tail -c +3601 cold.sgy)"), "");
}

TEST_F(Temperature, IsPartOfTheIdentityOfACheckpoint) {
  const auto hot = scene_of(model("hot.nc"));
  auto hotter = hot, cold = hot;
  EXPECT_EQ(difference_of(identity_of(hot), identity_of(hotter)), std::nullopt);
  hotter.model.medium[temperature][7] += 1;
  EXPECT_EQ(difference_of(identity_of(hot), identity_of(hotter)), "another model");
  cold.model.medium[temperature] = {};
  EXPECT_EQ(difference_of(identity_of(hot), identity_of(cold)), "another model");
}

TEST_F(Temperature, IsCutWithTheSubdomainsOfRanks) {
  done(import + "--resample 1.25 -o fine.nc");
  const auto whole = scene_of(model("fine.nc"));
  for (const int number : {0, 1}) {
    const auto subdomain = subdomain_for(whole, whole.model.grid(), number, 2);
    const auto [first, last] = rows_held(subdomain);
    const auto part = cut_to(whole, subdomain).model.medium;
    ASSERT_LT(part.grid().shape[1], whole.model.grid().shape[1]);
    const auto read = read_model_rows<2>(NetcdfFile::open(path("fine.nc")), first, last).medium;
    EXPECT_TRUE(same(part[temperature], read[temperature]));
    for (std::int64_t row = first; row < last; ++row) {
      const auto expected = whole.model.medium[temperature].line(row),
                 found = part[temperature].line(row - first);
      ASSERT_TRUE(std::equal(found.begin(), found.end(), expected.begin(), expected.end())) << row;
    }
  }
}

TEST_F(Temperature, ComesThroughRanksThatShareAShot) {
  if (on_ranks(2).empty()) GTEST_SKIP() << "sw-shoot was built without MPI";
  done(import + "--resample 1.25 -o fine.nc");
  done("sw-shoot fine.nc" + shot + "alone.sgy");
  const auto ran = run(on_ranks(2) + "sw-shoot fine.nc --ranks-per-shot 2" + shot + "together.sgy");
  ASSERT_EQ(ran.code, 0) << ran.err;
  EXPECT_EQ(done("cmp <(tail -c +3601 alone.sgy) <(tail -c +3601 together.sgy)"), "");
}

TEST_F(Temperature, CostsNothingWhereAModelLacksIt) {
  const std::string plain = "sw-import --vp cold.nc --vs cold.nc --rho cold.nc -o -";
  done(plain + " > here.nc && PATH='" SLIPWAVE_USUAL_BIN ":'$PATH " + plain + " > usual.nc");
  EXPECT_EQ(done("cmp here.nc usual.nc"), "");
  const auto medium = model("here.nc").medium;
  EXPECT_FALSE(medium.has(temperature));
  EXPECT_EQ(medium.properties(), (std::vector{Property::vp, Property::vs, Property::rho}));
  EXPECT_EQ(medium.value(temperature, 0), 288);
  // Tools that do not know the property read the others.
  EXPECT_EQ(done("'" SLIPWAVE_USUAL_BIN "/sw-info' hot.nc").find("temperature  "), std::string::npos);
}

TEST(PropertyTable, BeginsWithWhatEveryModelHas) {
  EXPECT_EQ(property_names(),
            (std::vector<std::string>{
                "vp",        "vs",      "rho",    "qp",     "qs",   "epsilon", "delta",    "gamma",
                "epsilon1",  "delta1",  "delta3", "gamma2", "tilt", "azimuth", "rotation", "cut_epsilon",
                "cut_delta", "cut_dip", "c11",    "c12",    "c13",  "c14",     "c15",      "c16",
                "c22",       "c23",     "c24",    "c25",    "c26",  "c33",     "c34",      "c35",
                "c36",       "c44",     "c45",    "c46",    "c55",  "c56",     "c66",      "temperature"}));
  for (const Property property : all_properties()) {
    const auto& row = row_of(property);
    EXPECT_EQ(row.if_absent.has_value(), std::size_t(property) >= required_properties) << row.name;
    EXPECT_FALSE(row.units.empty()) << row.name;
    EXPECT_EQ(find_property(row.name), property);
  }
  EXPECT_EQ(row_of(Property::vp).name, "vp");
  EXPECT_EQ(row_of(Property::vs).name, "vs");
  EXPECT_EQ(row_of(Property::rho).name, "rho");
  EXPECT_EQ(find_property("colour"), std::nullopt);
}

TEST(ScalarMean, WeightsByVolume) {
  ScalarMean arithmetic(Mean::arithmetic, 7), harmonic(Mean::harmonic, 7);
  EXPECT_EQ(arithmetic.mean(), 7);
  for (auto* mean : {&arithmetic, &harmonic}) mean->add(20, 3), mean->add(60, 1);
  EXPECT_DOUBLE_EQ(arithmetic.mean(), (3 * 20 + 60) / 4.);
  EXPECT_DOUBLE_EQ(harmonic.mean(), 4 / (3 / 20. + 1 / 60.));
}

}  // namespace slipwave
