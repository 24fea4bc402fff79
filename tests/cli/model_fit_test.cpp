// SPDX-License-Identifier: BSD-3-Clause
#include "shell.hpp"

namespace slipwave::model_fit_test {
namespace {

using ModelFit = Shell;

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

const std::string sea = "sw-layers --size 400x300 --step 5 --layer 0:1500:0:1000 ";

}  // namespace

TEST_F(ModelFit, SaysWhatItFollowsAndHowThinRowsAre) {
  const std::string line = sea + "--layer 102:3000:1500:2000:5 -o m.nc";
  EXPECT_EQ(run(line).err, "sw-layers: fitted: floor at 102 m dip 5, rows 0.76 to 1.23 of 5 m\n");
  done(line + " -q");
  const auto text = done("sw-info m.nc");
  EXPECT_TRUE(has(text, "z                0 to 300 m")) << text;
  EXPECT_TRUE(has(text, "row heights")) << text;
  EXPECT_TRUE(has(text, "name floor, role floor, row 24, depth 102 to 136.99")) << text;
}

TEST_F(ModelFit, KeepsRegularGridsOfHorizonsOnFaces) {
  const std::string layers = sea + "--layer 100:3000:1500:2000 --layer 200:3500:1800:2200 ";
  for (const std::string choice : {"", "--fit none", "--fit all", "--fit surface,floor"})
    done(layers + choice +
         " -o m.nc; ncdump m.nc | grep -v sw-layers > a; ! grep depth_bounds a; [ ! -e b ] || cmp a b; mv a "
         "b");
}

TEST_F(ModelFit, SaysWhatItLeavesOutWithItsPlace) {
  const Ran ran = run(sea + "--layer 102:3000:1500:2000 --layer 200:2000:1000:2000 --layer " +
                      "220:3500:1800:2200:-5 -o m.nc");
  EXPECT_EQ(ran.code, 0);
  EXPECT_EQ(ran.err,
            "sw-layers: fitted: floor at 102 m, layer at 200 m, rows 0.98 to 1.02 of 5 m\n"
            "sw-layers: warning: not fitted: layer at 220 m dip -5 meets or crosses layer at 200 m at x=400, "
            "z=185.005; --fit says what to follow\n");
}

TEST_F(ModelFit, IsKeptThroughAPipeOfFractures) {
  done(sea +
       "--layer 102:3000:1500:2000:5 -q | sw-fracture - --box 100:200,150:170 --dip 30 --friction 0.1 " +
       "--viscosity 1 -o m.nc");
  const auto text = done("sw-info m.nc");
  EXPECT_TRUE(has(text, "role floor")) << text;
  EXPECT_TRUE(has(done("ncdump -h m.nc"), "fracture:coordinates = \"depth\"")) << done("ncdump -h m.nc");
}

TEST_F(ModelFit, OfTheSeaFloorOfMarmousi) {
  const std::string line = "sw-marmousi --size 1000x600 --step 20 --scale 0.1 --water 110 ";
  const Ran ran = run(line + "-o m.nc");
  EXPECT_EQ(ran.err, "sw-marmousi: fitted: floor at 110 m, rows 0.92 to 1.15 of 20 m\n");
  EXPECT_TRUE(has(done("sw-info m.nc"), "fluid cells      300\n")) << done("sw-info m.nc");
  done(line + "--fit none -o a.nc; ! ncdump -h a.nc | grep depth_bounds");
}

TEST_F(ModelFit, IsRefusedByTheImportOfRegularGrids) {
  done(sea + "--layer 102:3000:1500:2000:5 -q -o m.nc");
  expect_refused("sw-import --vp m.nc --vs m.nc --rho m.nc -o n.nc", 1,
                 "sw-import: m.nc: vp: found rows that follow horizons (depth_bounds), expected a regular "
                 "grid; build the model with --fit none");
}

TEST_F(ModelFit, IsReadAtTrueDepthByReadersThatKnowNothingOfIt) {
  if (run("/usr/bin/python3 -c 'import netCDF4'").code != 0) {
    GTEST_SKIP() << "no /usr/bin/python3 with netCDF4 (Debian: python3-netcdf4)";
  }
  done(sea + "--layer sine,102,8,200:3000:1500:2000 -q -o m.nc");
  write("check.py", R"(
import netCDF4, numpy as np
m = netCDF4.Dataset('m.nc'); m.set_auto_mask(False)
assert m['vp'].coordinates == 'depth' and m['depth'].positive == 'down' and m['depth'].units == 'm'
x, depth, corners = m['x'][:], m['depth'][:], m['depth_bounds'][:]
floor = lambda x: 102 + 8 * np.sin(2 * np.pi * x / 200)
edges = 5 * np.arange(81)
row = m['horizon_floor'].row
assert m['horizon_floor'].role == 'floor' and np.allclose(m['horizon_floor'][:], floor(x), atol=2e-3)
assert np.allclose(corners[row], floor(edges), atol=1e-9)
assert np.allclose(depth, (corners[1:, 1:] + corners[1:, :-1] + corners[:-1, 1:] + corners[:-1, :-1]) / 4, atol=1e-4)
rock = depth > floor(x)[None, :]
assert np.array_equal(m['vp'][:], np.where(rock, 3000, 1500)) and np.array_equal(m['vs'][:], np.where(rock, 1500, 0))
assert np.all(corners[0] == 0) and np.all(corners[-1] == 300) and np.all(np.diff(corners, axis=0) > 4)
)");
  const Ran checked = run("/usr/bin/python3 check.py");
  EXPECT_EQ(checked.code, 0) << checked.err;
}

TEST_F(ModelFit, OfImportedStairsFindsTheirFloor) {
  done(sea + "--layer sine,102,12,400:3000:1500:2000 --fit none -o stairs.nc");
  const std::string import = "sw-import --vp stairs.nc --vs stairs.nc --rho stairs.nc ";
  EXPECT_EQ(run(import + "--floor found -o found.nc").err.find("sw-import: fitted: floor found, rows 0."),
            0U);
  EXPECT_TRUE(has(done("sw-info found.nc"), "name floor, role floor, row 20"));
  // A line for each of a few points of the same floor.
  write("floor.txt",
        "0 102\n50 110.49\n100 114\n150 110.49\n200 102\n250 93.51\n300 90\n350 93.51\n400 102\n");
  EXPECT_EQ(run(import + "--floor floor.txt -o given.nc").err,
            "sw-import: fitted: floor at smooth@floor.txt, rows 0.82 to 1.25 of 5 m\n");
  expect_refused(import + "--floor none.txt -o no.nc", 1,
                 "sw-import: --floor: none.txt: No such file or directory");
  done(import + "--floor found --extrude 50 -q -o deep.nc");
  EXPECT_TRUE(has(done("sw-info deep.nc"), "name floor, role floor, row 20"));
}

TEST_F(ModelFit, OfImportedStairsLeavesOutVoidAboveTheSurface) {
  done("sw-layers --size 400x300 --step 5 --layer sine,52,12,400:3000:1500:2000 --fit none -o stairs.nc");
  const Ran ran =
      run("sw-import --vp stairs.nc --vs stairs.nc --rho stairs.nc --surface sine,52,12,400 -o m.nc");
  EXPECT_EQ(ran.err, "sw-import: fitted: surface at sine,52,12,400, rows 0.85 to 1.11 of 5 m\n");
  EXPECT_TRUE(has(done("sw-info m.nc"), "void cells       0\n")) << done("sw-info m.nc");
}

}  // namespace slipwave::model_fit_test
