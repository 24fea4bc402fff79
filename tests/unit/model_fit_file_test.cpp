// SPDX-License-Identifier: BSD-3-Clause
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <limits>

#include "base/report.hpp"
#include "build/import.hpp"
#include "geology/layers.hpp"
#include "grid/grid_netcdf.hpp"
#include "io/netcdf_file.hpp"
#include "model/model_netcdf.hpp"
#include "model/model_report.hpp"
#include "model_cases.hpp"
#include "scratch.hpp"

namespace slipwave::model_fit_file_test {
namespace {

namespace fs = std::filesystem;

const std::vector<Layer> layers = {{0, 1500, 0, 1000}, {53, 3000, 1500, 2000, 10}};

template <int D>
Model<D> fitted_model(const Grid<D>& grid, const std::vector<Layer>& pile = layers) {
  const auto fit = fit_layers(grid, pile, FitChoice());
  Model<D> model;
  model.medium = layered_medium(fit.grid, pile, Average::isotropic, fit.rows);
  return model;
}

class FittedModelFile : public ::testing::Test {
 protected:
  std::string bytes() const {
    std::ifstream file(path_, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }
  /// What reading the grid of a file says, whose values `damage` has changed.
  std::string grid_error(const std::function<void(NetcdfFile&, const Grid<2>&)>& damage) const {
    const auto grid = fitted_model(grid_of(20, 40, 5)).grid();
    {
      auto file = NetcdfFile::create(path_, path_);
      define_grid(file, grid);
      put_grid(file, grid);
      damage(file, grid);
      file.close();
    }
    const auto sentence = sentence_of([&] { read_grid<2>(NetcdfFile::open(path_)); });
    return sentence.starts_with(path_ + ": ") ? sentence.substr(path_.size() + 2) : sentence;
  }

  Scratch scratch_;
  std::string path_ = scratch_.file("m.nc");
};

}  // namespace

// Proves (F1).
TEST_F(FittedModelFile, ReadsBackWhatWasWritten) {
  const auto model = fitted_model(grid_of(20, 40, 5));
  ASSERT_NE(model.grid().rows, nullptr);
  write_model(model, path_);
  const auto found = read_model<2>(path_);
  EXPECT_EQ(found.grid(), model.grid());
  EXPECT_EQ(found.medium.vp.grid(), model.grid());
  EXPECT_TRUE(std::equal(found.medium.rho.begin(), found.medium.rho.end(), model.medium.rho.begin()));
  check(found);
}

TEST_F(FittedModelFile, ReadsBackWhatWasWrittenInThreeDimensions) {
  const auto model = fitted_model(grid_of_size<3>({200, 60, 300}, 10));
  ASSERT_NE(model.grid().rows, nullptr);
  write_model(model, path_);
  EXPECT_EQ(read_model<3>(path_).grid(), model.grid());
}

TEST_F(FittedModelFile, ReadsATopThatIsNoMultipleOfACell) {
  const auto model = fitted_model(grid_of(20, 40, 5), {{Horizon(52, 5), {3000, 1500, 2000}}});
  ASSERT_NE(model.grid().rows, nullptr);
  write_model(model, path_);
  const auto found = read_model<2>(path_);
  EXPECT_EQ(found.grid(), model.grid());
  EXPECT_EQ(found.grid().rows->horizons().front().role, "surface");
}

TEST_F(FittedModelFile, HasTheDepthsOfCellsForReadersThatKnowNothingOfIt) {
  const auto model = fitted_model(grid_of(20, 40, 5));
  const auto& grid = model.grid();
  write_model(model, path_);
  const auto file = NetcdfFile::open(path_);
  for (const char* name : {"vp", "vs", "rho"}) EXPECT_EQ(file.text_attribute(name, "coordinates"), "depth");
  EXPECT_EQ(file.text_attribute("depth", "standard_name"), "depth");
  EXPECT_EQ(file.text_attribute("depth", "positive"), "down");
  EXPECT_FALSE(file.text_attribute("z", "standard_name"));
  const auto depths = file.get<double>("depth");
  for (std::int64_t cell = 0; cell < grid.size(); ++cell)
    EXPECT_NEAR(depths[std::size_t(cell)], grid.depth(grid.index(cell)), 1e-4);
  const auto floor = file.get<double>("horizon_floor");
  for (std::int64_t i = 0; i < 20; ++i)
    EXPECT_NEAR(floor[std::size_t(i)], layers[1].top.at(grid.centre(0, i)), 1e-9);
}

TEST_F(FittedModelFile, GivesItsPartsTheDepthsOfTheWhole) {
  const auto model = fitted_model(grid_of(20, 40, 5));
  write_model(model, path_);
  const auto file = NetcdfFile::open(path_);
  const auto part = read_model_rows<2>(file, 10, 25);
  EXPECT_EQ(part.grid().shape, (Index<2>{20, 15}));
  ASSERT_NE(part.grid().rows, nullptr);
  EXPECT_EQ(*part.grid().rows, *model.grid().rows);
  EXPECT_EQ(part.grid().depth({3, 2}), model.grid().depth({3, 12}));
  EXPECT_EQ(part.medium.vp({3, 2}), model.medium.vp({3, 12}));
  check(part);
}

TEST_F(FittedModelFile, HasTheBytesOfARegularOneWhereHorizonsLieOnFaces) {
  const auto grid = grid_of(20, 40, 5);
  const std::vector<Layer> flat = {{0, 1500, 0, 1000}, {50, 3000, 1500, 2000}, {120, 3500, 1800, 2200}};
  write_model(fitted_model(grid, flat), path_);
  const auto fitted = bytes();
  Model<2> regular;
  regular.medium = layered_medium(grid, flat);
  write_model(regular, path_);
  EXPECT_TRUE(fitted == bytes());
}

TEST_F(FittedModelFile, WithDamagedDepthsIsRefusedInOneSentence) {
  const auto put_corner = [](double depth) {
    return [depth](NetcdfFile& file, const Grid<2>&) { file.put("depth_bounds", {3, 4}, {1, 1}, &depth); };
  };
  EXPECT_EQ(grid_error([](NetcdfFile&, const Grid<2>&) {}), "no error");
  EXPECT_EQ(grid_error(put_corner(std::numeric_limits<double>::quiet_NaN())),
            "depth_bounds[3,4] is missing (NaN or its _FillValue), expected a number");
  EXPECT_TRUE(grid_error(put_corner(0))
                  .starts_with("depth_bounds: found a depth of 0 m at row 3, column 4 of the corners, "
                               "expected it below the one above"));
  EXPECT_TRUE(grid_error(put_corner(13)).starts_with("depth is "));
  EXPECT_EQ(grid_error([](NetcdfFile& file, const Grid<2>&) {
              file.put_attribute("horizon_floor", "role", "ceiling");
            }),
            "horizon_floor: found role 'ceiling', expected surface, floor or layer");
  EXPECT_EQ(grid_error([](NetcdfFile& file, const Grid<2>&) {
              file.put_attribute("horizon_floor", "row", std::vector<int>{41});
            }),
            "horizon_floor: found no row from 0 to 40 that follows it, expected the attribute row");
  const auto put_horizon = [](double depth) {
    return [depth](NetcdfFile& file, const Grid<2>&) { file.put("horizon_floor", {6}, {1}, &depth); };
  };
  EXPECT_EQ(grid_error(put_horizon(std::numeric_limits<double>::quiet_NaN())),
            "horizon_floor[6] is missing (NaN or its _FillValue), expected a number");
  EXPECT_TRUE(grid_error(put_horizon(77)).starts_with("horizon_floor is 77 m deep at x=32.5, but row "));
  EXPECT_TRUE(grid_error([](NetcdfFile& file, const Grid<2>&) {
                file.put_attribute("depth_bounds", "units", "degree");
              }).starts_with("depth_bounds: found the unit 'degree', expected one of length"));
}

TEST_F(FittedModelFile, WithCornersOfAnotherGridIsRefused) {
  {
    auto file = NetcdfFile::create(path_, path_);
    const auto grid = grid_of(20, 40, 5);
    define_grid(file, grid);
    file.define_dimension("z_face", 40);
    file.define_dimension("x_face", 21);
    file.define_variable("depth_bounds", NetcdfFile::Type::f64, {"z_face", "x_face"});
    put_grid(file, grid);
    file.close();
  }
  EXPECT_EQ(
      sentence_of([&] { read_grid<2>(NetcdfFile::open(path_)); }),
      path_ + ": depth_bounds: found 40 x 21 corners, expected 41 x 21, one more than cells along each axis");
}

TEST_F(FittedModelFile, IsDescribedWithItsHorizons) {
  const auto model = fitted_model(grid_of(20, 40, 5));

  const auto text = report_of(model).lines();
  EXPECT_NE(text.find("fitted horizons"), std::string::npos) << text;
  EXPECT_NE(text.find("role floor"), std::string::npos) << text;
}

TEST_F(FittedModelFile, IsNotImportedAsIfItWereRegular) {
  write_model(fitted_model(grid_of(20, 40, 5)), path_);
  const auto file = NetcdfFile::open(path_);
  EXPECT_EQ(sentence_of([&] { field_from_netcdf(file, row_of(Property::vp), "", {}); }),
            path_ +
                ": vp: found rows that follow horizons (depth_bounds), expected a regular grid; build the "
                "model with --fit none");
}

}  // namespace slipwave::model_fit_file_test
