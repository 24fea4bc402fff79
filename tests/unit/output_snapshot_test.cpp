// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "base/error.hpp"
#include "curvilinear_grid.hpp"
#include "grid/grid_netcdf.hpp"
#include "grid/slice.hpp"
#include "output/snapshot_netcdf.hpp"
#include "output/snapshot_reader.hpp"
#include "scratch.hpp"

namespace slipwave::output_snapshot_test {
namespace {

class Snapshots : public testing::Test {
 protected:
  std::string path(const std::string& name) { return scratch_.file(name); }

  static float value(std::size_t field, int time, std::size_t cell) {
    return float(field + 1) * 1e-3f * float(std::sin(0.1 * double(cell) + time));
  }
  /// Three times of two fields on a 7 x 4 grid, at 0, 0.05 and 0.1 s.
  void write_to(const std::string& name) {
    SnapshotWriter<2> writer(path(name), grid_, {"vz", "div"},
                             {"a title", "slipwave test", "sw-shoot -o s.nc"});
    for (int time = 0; time < 3; ++time) {
      std::vector<Field<2>> fields(2, Field<2>(grid_));
      for (std::size_t field = 0; field < 2; ++field)
        for (std::size_t cell = 0; cell < fields[field].size(); ++cell)
          fields[field][cell] = value(field, time, cell);
      writer.write(0.05 * time, fields);
    }
    EXPECT_EQ(writer.times(), 3u);
    writer.commit();
  }

  Grid<2> grid_{{7, 4}, 2.5, {100, 0}};
  Scratch scratch_;
};

TEST_F(Snapshots, OfRegularGridsHaveNoDepthsOfTheirOwn) {
  write_to("s.nc");
  const auto file = NetcdfFile::open(path("s.nc"));
  for (const char* name : {"depth", "depth_bounds"}) EXPECT_FALSE(file.has_variable(name));
  EXPECT_FALSE(file.text_attribute("vz", "coordinates"));
  EXPECT_EQ(file.text_attribute("z", "standard_name"), "depth");
}

TEST_F(Snapshots, OfFittedGridsKnowTheirDepths) {
  grid_ = bent<2>(grid_, [](double x, double, double zeta) { return 1 + 0.01 * x + 0.8 * zeta; });
  write_to("s.nc");
  const auto file = NetcdfFile::open(path("s.nc"));
  for (const char* name : {"vz", "div"}) EXPECT_EQ(file.text_attribute(name, "coordinates"), "depth");
  EXPECT_EQ(file.variable("depth").dimensions, (std::vector<std::string>{"z", "x"}));
  const auto depths = file.get<double>("depth");
  for (std::int64_t cell = 0; cell < grid_.size(); ++cell)
    EXPECT_NEAR(depths[std::size_t(cell)], grid_.depth(grid_.index(cell)), 1e-5);
  EXPECT_EQ(SnapshotReader<2>(NetcdfFile::open(path("s.nc"))).grid(), grid_);
}

TEST_F(Snapshots, OfSlicesOfFittedVolumesKnowTheirDepths) {
  const auto volume = bent<3>({{6, 5, 4}, 10, {0, 0, 0}}, [](double x, double y, double zeta) {
    return 5 + 0.1 * x + 0.2 * y + 0.8 * zeta;
  });
  const auto field = at_centres<3>(volume, [](const auto& p) { return p[2]; });
  for (const auto& slice : {Slice{0, 25}, Slice{1, 25}, Slice{2, 21}}) {
    const auto part = layer_of(field, layer_on(volume, slice));
    SnapshotWriter<3> writer(path("s.nc"), part.grid(), {"vz"}, {});
    writer.write(0, std::vector{part});
    writer.commit();
    const SnapshotReader<3> reader(NetcdfFile::open(path("s.nc")));
    EXPECT_EQ(reader.grid(), part.grid()) << slice.axis;
    const auto found = reader.read("vz", 0);
    for (std::int64_t cell = 0; cell < part.grid().size(); ++cell) {
      const double depth = reader.grid().depth(reader.grid().index(cell));
      // On a level plane the depth of the cell it runs through, of a height of 8 m.
      EXPECT_NEAR(found[std::size_t(cell)], depth, slice.axis == 2 ? 4.01 : 1e-5);
    }
  }
}

TEST_F(Snapshots, ComeBackAsTheyWereWritten) {
  write_to("s.nc");
  const auto file = NetcdfFile::open(path("s.nc"));
  EXPECT_EQ(read_grid<2>(file), grid_);
  EXPECT_EQ(file.get<double>("time"), (std::vector<double>{0, 0.05, 0.1}));
  const std::string names[] = {"vz", "div"};
  for (std::size_t field = 0; field < 2; ++field) {
    const auto variable = file.variable(names[field]);
    EXPECT_EQ(variable.dimensions, (std::vector<std::string>{"time", "z", "x"}));
    EXPECT_EQ(variable.shape, (std::vector<std::size_t>{3, 4, 7}));
    const auto values = file.get<float>(names[field]);
    for (int time = 0; time < 3; ++time)
      for (std::size_t cell = 0; cell < 28; ++cell)
        EXPECT_EQ(values[std::size_t(time) * 28 + cell], value(field, time, cell));
  }
}

TEST_F(Snapshots, SayWhatTheyAre) {
  write_to("s.nc");
  const auto file = NetcdfFile::open(path("s.nc"));
  EXPECT_EQ(file.text_attribute("", "Conventions"), "CF-1.10");
  EXPECT_EQ(file.text_attribute("", "title"), "a title");
  EXPECT_EQ(file.text_attribute("", "history"), "sw-shoot -o s.nc");
  EXPECT_EQ(file.text_attribute("time", "units"), "s");
  EXPECT_EQ(file.text_attribute("vz", "units"), "m s-1");
  EXPECT_EQ(file.text_attribute("div", "units"), "s-1");
  EXPECT_EQ(file.number_attribute("time", "actual_range"), (std::vector<double>{0, 0.1}));
  float low = 0, high = 0;
  for (int time = 0; time < 3; ++time)
    for (std::size_t cell = 0; cell < 28; ++cell) {
      low = std::min(low, value(1, time, cell));
      high = std::max(high, value(1, time, cell));
    }
  EXPECT_EQ(file.number_attribute("div", "actual_range"), (std::vector<double>{low, high}));
}

TEST_F(Snapshots, AreTheSameBytesEveryTime) {
  write_to("a.nc");
  write_to("b.nc");
  const auto bytes = [&](const std::string& name) {
    std::ifstream file(path(name), std::ios::binary);
    return std::string(std::istreambuf_iterator<char>(file), {});
  };
  EXPECT_FALSE(bytes("a.nc").empty());
  EXPECT_TRUE(bytes("a.nc") == bytes("b.nc"));
}

TEST_F(Snapshots, LeaveNothingBehindUnlessCommitted) {
  {
    SnapshotWriter<2> writer(path("s.nc"), grid_, {"p"}, {});
    writer.write(0, std::vector<Field<2>>{Field<2>(grid_)});
  }
  EXPECT_TRUE(std::filesystem::is_empty(scratch_.path()));
}

TEST_F(Snapshots, OfThreeDimensionsHaveAllTheirAxes) {
  const Grid<3> grid{{3, 4, 5}, 10, {}};
  SnapshotWriter<3> writer(path("s.nc"), grid, {"syz"}, {});
  Field<3> field(grid);
  for (std::size_t cell = 0; cell < field.size(); ++cell) field[cell] = float(cell);
  writer.write(1, std::vector<Field<3>>{field});
  writer.commit();
  const auto file = NetcdfFile::open(path("s.nc"));
  EXPECT_EQ(read_grid<3>(file), grid);
  EXPECT_EQ(file.variable("syz").shape, (std::vector<std::size_t>{1, 5, 4, 3}));
  EXPECT_EQ(file.get<float>("syz"), std::vector<float>(field.begin(), field.end()));
}

TEST_F(Snapshots, AreReadByAnotherReader) {
  if (std::system("/usr/bin/python3 -c 'import netCDF4' 2>/dev/null") != 0)
    GTEST_SKIP() << "python3-netcdf4 is not installed; it is the second reader of this test";
  write_to("s.nc");
  std::ofstream(path("check.py")) << R"(
import sys
import netCDF4
import numpy as np
d = netCDF4.Dataset(sys.argv[1])
assert d.data_model == 'NETCDF4' and d.Conventions == 'CF-1.10'
assert d.dimensions['time'].isunlimited()
assert not d.dimensions['x'].isunlimited() and not d.dimensions['z'].isunlimited()
assert np.array_equal(d['time'][:], [0, 0.05, 0.05 * 2])
assert np.allclose(d['x'][:], 101.25 + 2.5 * np.arange(7)) and d['x'].axis == 'X'
assert np.allclose(d['z'][:], 1.25 + 2.5 * np.arange(4)) and d['z'].positive == 'down'
for field, name in enumerate(['vz', 'div']):
    v = d[name]
    assert v.dimensions == ('time', 'z', 'x') and v.dtype == np.float32
    assert v.chunking() == [1, 4, 7], v.chunking()
    f = v.filters()
    assert f['zlib'] and f['shuffle'] and f['complevel'] == 1, f
    t, cell = np.meshgrid(np.arange(3), np.arange(28), indexing='ij')
    expected = (field + 1) * 1e-3 * np.sin(0.1 * cell + t)
    assert np.allclose(v[:].reshape(3, 28), expected, rtol=1e-5, atol=1e-9)
    assert np.isnan(v._FillValue) and v.actual_range.dtype == np.float32
    assert v.actual_range[0] == v[:].min() and v.actual_range[1] == v[:].max()
)";
  const std::string command = "/usr/bin/python3 '" + path("check.py") + "' '" + path("s.nc") + "'";
  EXPECT_EQ(std::system(command.c_str()), 0);
}

TEST(SnapshotFields, AreChosenByName) {
  EXPECT_EQ(parse_snapshot_fields<2>("vz,curl"), (std::vector<std::string>{"vz", "curl"}));
  EXPECT_EQ(parse_snapshot_fields<3>("curly"), (std::vector<std::string>{"curly"}));
  for (const auto& text : {"", "vy", "vz,", "vz,vz", "VZ", "vz, vx"}) {
    try {
      parse_snapshot_fields<2>(text);
      ADD_FAILURE() << text;
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::usage);
      EXPECT_NE(std::string(error.what()).find("expected"), std::string::npos);
    }
  }
}

}  // namespace
}  // namespace slipwave::output_snapshot_test
