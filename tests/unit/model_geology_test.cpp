// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "build/model_in_cells.hpp"
#include "build/resample.hpp"
#include "geology/well_log.hpp"
#include "io/netcdf_file.hpp"
#include "model/model_netcdf.hpp"
#include "model_cases.hpp"

namespace slipwave::model_geology_test {
namespace {

/// As sw-layers makes it.
template <int D>
Model<D> built(const Geology& geology, const Point<D>& size_m, double spacing_m) {
  Model<D> model;
  model.medium = medium_of(geology, grid_of_size<D>(size_m, spacing_m));
  model.geology = geology;
  return model;
}

template <int D>
void expect_same_cells(const Model<D>& found, const Model<D>& expected) {
  ASSERT_EQ(found.grid(), expected.grid());
  ASSERT_EQ(found.medium.properties(), expected.medium.properties());
  for (const auto property : expected.medium.properties())
    for (std::size_t n = 0; n < expected.medium.vp.size(); ++n)
      ASSERT_EQ(found.medium[property][n], expected.medium[property][n]) << row_of(property).name << ' ' << n;
}

/// A file that is there for one test.
class ModelFile {
 public:
  template <int D>
  explicit ModelFile(const Model<D>& model) {
    write_model(model, text_.path());
  }
  std::string path() const { return text_.path(); }

 private:
  TextFile text_{""};
};

/// Tops of every kind, gradients, attenuating and anisotropic rock, stiffnesses.
Geology of_all_kinds() {
  const TextFile curve("0 150\n130 170\n400 160\n");
  Geology geology{.maker = Maker::sw_layers, .fit = parse_fit("floor"), .average = Average::isotropic};
  for (const std::string text :
       {"0:1500:0:1000", "sine,60,5,200,30:1800+0.6:600+0.4:2100", "@@:2500:1300:2200:2 qp=80 qs=inf",
        "smooth@@:2600:1300:2250 epsilon=0.2 delta=0.1 tilt=10",
        "230:-:-:2300 c11=26e9 c13=9e9 c33=20e9 c55=6e9"}) {
    auto with_file = text;
    if (const auto at = text.find("@@"); at != std::string::npos)
      with_file = text.substr(0, at + 1) + curve.path() + text.substr(at + 2);
    geology.layers.push_back(parse_layer(with_file));
  }
  auto lower = geology.layers[3].top.shape();
  lower.depth_m = 40;
  geology.layers[3].top = Horizon(lower);
  return geology;
}

const Geology flat = {.maker = Maker::sw_layers,
                      .layers = {{0, 1500, 0, 1000}, {103, 3000, 1600, 2200, 10}, {203, 4000, 2300, 2400}}};

FractureSet<2> planes() {
  SlipSystem<2> system;
  system.normal = {0, 1};
  return {"planes", {system}};
}

}  // namespace

TEST(Geology, OfAFileBuildsTheModelAgain) {
  const auto model = built<2>(of_all_kinds(), {400, 300}, 10);
  const ModelFile file(model);
  const auto read = read_model<2>(file.path());
  EXPECT_EQ(read.geology.maker, Maker::sw_layers);
  ASSERT_EQ(read.geology.layers.size(), 5u);
  EXPECT_EQ(read.geology.layers[1].top.name(), "sine,60,5,200,30");
  EXPECT_TRUE(read.geology.fit.floors);
  EXPECT_FALSE(read.geology.fit.layers);
  EXPECT_EQ(read.geology.layers[4].material, model.geology.layers[4].material);
  expect_same_cells(built<2>(read.geology, {400, 300}, 4), built<2>(model.geology, {400, 300}, 4));
  EXPECT_TRUE(ModelInCells(read).as_built());
}

TEST(Geology, OfAFileHasGridsOfTopsIn3D) {
  const TextFile nodes("0 0 50\n0 80 60\n90 0 70\n90 80 55\n");
  Geology geology{.maker = Maker::sw_layers};
  geology.layers = {parse_layer("0:1500:0:1000"), parse_layer("@" + nodes.path() + ":2500:1300:2200")};
  const auto model = built<3>(geology, {90, 80, 100}, 10);
  const ModelFile file(model);
  const auto read = read_model<3>(file.path());
  expect_same_cells(in_cells_of(read, 5), built<3>(geology, {90, 80, 100}, 5));
}

TEST(Geology, OfMarmousiComesFromItsSettings) {
  Geology geology{.maker = Maker::sw_marmousi, .average = Average::isotropic};
  geology.marmousi = {.seed = 18446744073709551615u, .water_m = 47, .scale = 0.1, .vp_over_vs = 1.9};
  const auto model = built<2>(geology, {300, 200}, 5);
  const ModelFile file(model);
  expect_same_cells(in_cells_of(read_model<2>(file.path()), 4), built<2>(geology, {300, 200}, 4));
}

TEST(Geology, OfAnImportSaysHowItsCellsCameAbout) {
  auto model = water_over_rock(grid_of(8, 8, 5), 3);
  model.geology = {.maker = Maker::sw_import, .sampled_m = 20, .resampling = CellResampling::interpolated};
  const ModelFile file(model);
  const auto read = read_model<2>(file.path()).geology;
  EXPECT_EQ(read.maker, Maker::sw_import);
  EXPECT_EQ(read.sampled_m, 20);
  EXPECT_EQ(read.resampling, CellResampling::interpolated);
  EXPECT_FALSE(read.knows_places());
}

TEST(Geology, OfAFileWithoutIsUnknown) {
  const ModelFile file(water_over_rock(grid_of(8, 8, 5), 3));
  EXPECT_FALSE(NetcdfFile::open(file.path()).has_variable("geology"));
  EXPECT_EQ(read_model<2>(file.path()).geology.maker, Maker::unknown);
}

TEST(Geology, ThatIsDamagedIsRefusedWithItsPlace) {
  auto model = built<2>(of_all_kinds(), {400, 300}, 10);
  auto& first = model.geology.layers[0];
  first.material.vp = std::nan("");
  const ModelFile file(model);
  EXPECT_EQ(sentence_of([&] { read_model<2>(file.path()); }),
            file.path() + ": layer_vp: found nan, expected a finite number");
}

TEST(CellsOfSize, AreFilledFromTheLayersAtAnySize) {
  const auto model = built<2>(flat, {400, 300}, 10);
  // 7 m is no part of 10, and 400 and 300 m no whole number of it: 58 x 43 cells cover them.
  const auto found = in_cells_of(model, 7);
  expect_same_cells(found, built<2>(flat, {406, 301}, 7));
  expect_same_cells(in_cells_of(found, 10), built<2>(flat, {410, 310}, 10));
}

TEST(CellsOfSize, AreFilledFromTheLogItself) {
  WellLog log;
  log.name = "well";
  for (int n = 0; n < 1000; ++n) {
    log.depths_m.push_back(41 + 0.15 * n);
    const double bed = std::sin(0.4 * n);
    log.materials.push_back({3000 + 500 * bed, 1600 + 300 * bed, 2300 + 100 * bed});
  }
  for (const bool backus : {false, true}) {
    const auto geology_in = [&](double spacing_m) {
      LogChoice choice;
      choice.layered = backus;
      return Geology{.maker = Maker::sw_layers,
                     .layers = {{0, 1500, 0, 1000}, layer_of_log(log, spacing_m, false, choice)}};
    };
    const ModelFile file(built<2>(geology_in(10), {20, 200}, 10));
    const auto read = read_model<2>(file.path());
    ASSERT_TRUE(ModelInCells(read).as_built());
    // Finer than the log's own step, finer, and coarser.
    for (const double size_m : {0.1, 2.5, 20.}) {
      Model<2> direct;
      direct.medium =
          layered_medium(grid_of_size<2>({20, 200}, size_m), geology_in(size_m).layers, Average::tilted);
      expect_same_cells(in_cells_of(read, size_m), direct);
    }
    EXPECT_NE(in_cells_of(read, 2.5).medium.vp({1, 60}), regridded(read, 2.5).medium.vp({1, 60}));
  }
}

TEST(CellsOfSize, HoldLevelTopsAsThoseOfTheModelDo) {
  Geology geology{.maker = Maker::sw_layers, .fit = parse_fit("none")};
  geology.layers = {parse_layer("0:3000:1500:2200"), parse_layer("103:2000:1000:2000")};
  const auto model = built<2>(geology, {200, 300}, 10);
  const ModelInCells in_cells(model);
  EXPECT_TRUE(in_cells.tops_cut_cells());
  EXPECT_EQ(in_cells.lie_otherwise(10, 10), 0);
  // 103 m are 10.3, 6.866... and 6.3 cells.
  EXPECT_NEAR(in_cells.lie_otherwise(10, 15), 0.3 + 1 - 103. / 15 + 6, 1e-9);
  EXPECT_NEAR(in_cells.lie_otherwise(10, 103 / 6.3), 0, 1e-9);
  // Rows that follow do so in all cells, those on faces too.
  geology.fit = {};
  const auto fitted = built<2>(geology, {200, 300}, 10);
  EXPECT_FALSE(ModelInCells(fitted).tops_cut_cells());
  EXPECT_EQ(ModelInCells(fitted).lie_otherwise(10, 15), 0);
  geology.fit = parse_fit("none");
  geology.layers[1] = parse_layer("100:2000:1000:2000");
  const auto level = built<2>(geology, {200, 300}, 10);
  EXPECT_FALSE(ModelInCells(level).tops_cut_cells());
  EXPECT_EQ(ModelInCells(level).lie_otherwise(10, 15), 0);
}

TEST(CellsOfSize, HoldFacesOfMatterWhereNothingElseIsKnown) {
  auto model = water_over_rock(grid_of(40, 30, 10), 8);
  EXPECT_EQ(ModelInCells(model).lie_otherwise(10, 20), 0);
  EXPECT_NEAR(ModelInCells(model).lie_otherwise(10, 15), 1. / 3, 1e-9);
  const auto rock = water_over_rock(grid_of(40, 30, 10), 0);
  EXPECT_EQ(ModelInCells(rock).lie_otherwise(10, 15), 0);
}

TEST(CellsOfSize, AreCutByTopsThatRowsLeaveOut) {
  Geology geology{.maker = Maker::sw_layers, .fit = parse_fit("surface")};
  geology.layers = {parse_layer("20:3000:1500:2200:5"), parse_layer("100:2000:1000:2000:5")};
  const auto some = built<2>(geology, {200, 300}, 10);
  ASSERT_TRUE(some.grid().rows);
  EXPECT_TRUE(ModelInCells(some).tops_cut_cells());
  geology.fit = {};
  const auto all = built<2>(geology, {200, 300}, 10);
  EXPECT_FALSE(ModelInCells(all).tops_cut_cells());
}

TEST(Geology, OfALogThatIsDamagedIsRefusedWithItsPlace) {
  WellLog log;
  log.depths_m = {1, 3, 5, 7};
  log.materials.assign(4, {3000, 1600, 2300});
  const auto refused = [](const LayerLog& written) {
    Geology geology{.maker = Maker::sw_layers, .layers = {{0, 3000, 1600, 2300}}};
    auto model = built<2>(geology, {20, 20}, 5);
    model.geology.layers[0].log = written;
    const ModelFile file(model);
    const auto sentence = sentence_of([&] { read_model<2>(file.path()); });
    return sentence.substr(std::min(sentence.size(), file.path().size() + 2));
  };
  const auto& rock = log.materials;
  EXPECT_EQ(refused({log.depths_m, rock, {}, false}), "");
  EXPECT_EQ(refused({{1, 3, 3, 7}, rock, {}, false}),
            "layer_log_depth: found 3 after 3, expected depths to ascend");
  EXPECT_EQ(refused({log.depths_m, rock, -5, false}), "layer_log_block: found -5, expected it not below 0");
  auto wet = rock;
  wet[2].vs = 0;
  EXPECT_EQ(refused({log.depths_m, wet, {}, false}),
            "layer_log_vs: found fluid beside rock, expected one of them");
  wet[2].vp = 0;
  EXPECT_EQ(refused({log.depths_m, wet, {}, false}), "layer_log_vp: found 0, expected a speed or density");
}

TEST(CellsOfSize, AreLevelBeyondTheEndsOfACurve) {
  const TextFile curve("5 100\n395 150\n");
  Geology geology{.maker = Maker::sw_layers, .fit = parse_fit("none")};
  geology.layers = {parse_layer("0:1500:0:1000"), parse_layer("@" + curve.path() + ":2500:1300:2200")};
  const auto found = in_cells_of(built<2>(geology, {400, 300}, 10), 7);
  ASSERT_EQ(found.grid().shape, (Index<2>{58, 43}));
  const auto fluid = [&](std::int64_t column) {
    std::int64_t rows = 0;
    while (found.medium.is_fluid(std::size_t(found.grid().flat({column, rows})))) ++rows;
    return double(rows);
  };
  EXPECT_NEAR(7 * fluid(57), 150, 3.5);
}

TEST(CellsOfSize, FollowHorizonsThatLieOnFacesNow) {
  Geology geology{.maker = Maker::sw_layers, .fit = parse_fit("none")};
  geology.layers = {{0, 1500, 0, 1000}, {100, 3000, 1600, 2200}, {200, 4000, 2300, 2400}};
  const auto model = built<2>(geology, {400, 300}, 10);
  ASSERT_EQ(model.grid().rows, nullptr);
  const ModelInCells cells(model);
  ASSERT_NE(cells.of(6).grid().rows, nullptr);
  EXPECT_EQ(cells.left_out(6), 0u);
  geology.layers[1].top = Horizon(103);
  const auto cut = built<2>(geology, {400, 300}, 10);
  EXPECT_EQ(ModelInCells(cut).of(6).grid().rows, nullptr);
  EXPECT_TRUE(ModelInCells(cut).could_be_fitted());
  EXPECT_NE(ModelInCells(cut).fitted(6).grid().rows, nullptr);
}

TEST(CellsOfSize, AreThoseOfTheOldCellsWhereTheGeologyDoesNotGiveThem) {
  auto model = built<2>(flat, {400, 300}, 10);
  EXPECT_TRUE(ModelInCells(model).as_built());
  model.medium.vp[7] = 1501;
  EXPECT_FALSE(ModelInCells(model).as_built());
  expect_same_cells(in_cells_of(model, 5), regridded(model, 5));
}

TEST(CellsOfSize, AreInterpolatedWhereAnImportWas) {
  auto model = water_over_rock(grid_of(8, 8, 5), 3);
  for (std::size_t cell = 0; cell < model.medium.vp.size(); ++cell) model.medium.vp[cell] += float(cell);
  model.geology = {.maker = Maker::sw_import, .sampled_m = 5};
  expect_same_cells(in_cells_of(model, 2.5), regridded(model, 2.5));
  model.geology = {.maker = Maker::sw_import, .sampled_m = 20, .resampling = CellResampling::interpolated};
  expect_same_cells(in_cells_of(model, 2.5), resampled(model, 2.5));
}

TEST(CellsOfSize, AttenuateWithTheSpeedsOfTheirUnrelaxedRock) {
  auto geology = flat;
  geology.layers[1].others = {{Property::qp, 60}, {Property::qs, 30}};
  const Attenuation attenuation{Mechanisms(3, 3, 40), 15};
  auto model = built<2>(geology, {400, 300}, 10), expected = built<2>(geology, {400, 300}, 5);
  unrelax(model.medium, attenuation);
  unrelax(expected.medium, attenuation);
  EXPECT_FALSE(ModelInCells(model).as_built());
  expect_same_cells(in_cells_of(model, 5, attenuation), expected);
  // Attenuation that was taken out stays out.
  auto elastic = built<2>(geology, {400, 300}, 10);
  elastic.medium[Property::qp] = {}, elastic.medium[Property::qs] = {};
  EXPECT_FALSE(in_cells_of(elastic, 5).medium.has(Property::qp));
}

TEST(CellsOfSize, KeepClustersInRock) {
  auto geology = flat;
  geology.fit = parse_fit("none");
  auto model = built<2>(geology, {400, 300}, 10);
  model.fracture = Field<2, std::uint8_t>(model.grid());
  model.fracture_sets = {planes()};
  // A box of 100 x 50 m whose upper edge is at the dipping floor.
  for (std::int64_t n = 0; n < model.grid().size(); ++n) {
    const auto at = model.grid().index(n);
    const bool inside = at[0] >= 10 && at[0] < 20 && at[1] >= 11 && at[1] < 16;
    if (inside && model.medium.is_solid(std::size_t(n))) model.fracture[std::size_t(n)] = 1;
  }
  const auto found = in_cells_of(model, 4);
  std::int64_t marked = 0;
  for (std::size_t cell = 0; cell < found.fracture.size(); ++cell) {
    marked += found.fracture[cell] != 0;
    ASSERT_TRUE(found.fracture[cell] == 0 || found.medium.is_solid(cell)) << cell;
  }
  // The floor cuts it at x from 100 to 200 m, where it lies at 120.6 to 138.3 m.
  EXPECT_NEAR(double(marked) * 16, 100 * (160 - 129.4), 100 * 8);
}

TEST(CellsOfSize, FollowHorizonsThatAreOnlyInTheCells) {
  const std::vector<Layer> sea = {{0, 1500, 0, 1000},
                                  {Horizon::parse("sine,102,6,100"), {2000, 1000, 2000}, {}}};
  const auto fit = fit_layers(grid_of(40, 60, 5), sea, FitChoice());
  Model<2> model;
  model.medium = layered_medium(fit.grid, sea, Average::isotropic, fit.rows);
  const auto found = in_cells_of(model, 3.5);
  ASSERT_NE(found.grid().rows, nullptr);
  EXPECT_EQ(found.grid().shape[0], 58);
  EXPECT_NEAR(found.grid().end(1), 301, 1e-9);
  const auto floor = found.grid().rows->horizons().front().row;
  for (std::int64_t i = 0; i <= 57; ++i)
    EXPECT_NEAR(found.grid().rows->corner({i, floor}), sea[1].top.at(3.5 * double(i)), 0.05) << i;
  for (std::int64_t n = 0; n < found.grid().size(); ++n)
    ASSERT_EQ(found.medium.is_fluid(std::size_t(n)), found.grid().index(n)[1] < floor) << n;
}

}  // namespace slipwave::model_geology_test
