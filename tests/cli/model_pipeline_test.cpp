// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cstdlib>
#include <filesystem>

#include "shell.hpp"

namespace slipwave::model_pipeline_test {
namespace {

const std::string layers =
    "sw-layers --size 200x100 --step 5 --layer 0:1500:0:1000 --layer 40:3000:1500:2200 ";
const std::string fracture =
    "sw-fracture - --box 50:150,50:80 --dip 60 --friction 0.1 --viscosity 1e-3 --strength 1e5 ";

using ModelPipeline = Shell;

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

std::string shared_folder() {
  const char* given = std::getenv("SLIPWAVE_SHARED");
  return given ? given : SLIPWAVE_SHARED_DEFAULT;
}

}  // namespace

TEST_F(ModelPipeline, GoesFromLayersThroughFracturesToInfoWithoutAFile) {
  const auto text = done(layers + "| " + fracture + "| sw-info -");
  EXPECT_TRUE(has(text, "standard input: model\n")) << text;
  EXPECT_TRUE(has(text, "40 x 20 cells of 5 m")) << text;
  EXPECT_TRUE(has(text, "fluid cells   320\n")) << text;
  EXPECT_TRUE(has(text, "solid cells   480\n")) << text;
  EXPECT_TRUE(has(text, "cells 120, ")) << text;
  EXPECT_EQ(files(), "");
}

TEST_F(ModelPipeline, GivesTheSameBytesEveryTimeAndWherever) {
  done(layers + "-o a.nc");
  done(layers + "> b.nc");
  done("next_second; " + layers + "-v -o ./c.nc 2> /dev/null");
  done("cmp a.nc b.nc && cmp a.nc c.nc");
  done("cat a.nc | " + fracture + "> d.nc; next_second; " + fracture + "-o e.nc < a.nc; cmp d.nc e.nc");
  EXPECT_EQ(files(), "a.nc b.nc c.nc d.nc e.nc");
}

TEST_F(ModelPipeline, ChainsTheHistoryOldestFirst) {
  done(layers + "| " + fracture + "-o m.nc");
  const auto json = done("sw-info --json m.nc");
  EXPECT_TRUE(has(json,
                  "\"history\": \"sw-layers --size 200x100 --step 5 --layer 0:1500:0:1000 --layer "
                  "40:3000:1500:2200\\u000asw-fracture --box 50:150,50:80 --dip 60 "))
      << json;
  EXPECT_FALSE(has(json, "m.nc\\u000a")) << "where the output goes is no part of the history";
}

TEST_F(ModelPipeline, LaterFracturesTakeCellsFromEarlierOnes) {
  const auto text =
      done(layers + "| " + fracture + "--name first | " +
           "sw-fracture - --box 100:200,50:80 --normal 1,0 --dip 0 --friction 0.3 --viscosity 0 -q "
           "--name second | sw-info -");
  EXPECT_TRUE(has(text, "name first, cells 60, slip normal 0.866025,-0.5, friction 0.1")) << text;
  EXPECT_TRUE(
      has(text,
          "name second, cells 120, slip normal 0,-1, friction 0.3, viscosity 0 s, strength 0 Pa, slip "
          "normal 1,0, "))
      << text;
}

TEST_F(ModelPipeline, WarnsOfFluidInTheRegionUnlessQuiet) {
  const std::string line =
      layers + "| sw-fracture --box 0:50,20:60 --dip 90 --friction 0.1 --viscosity 1 -o m.nc";
  const Ran ran = run(line);
  EXPECT_EQ(ran.code, 0);
  EXPECT_EQ(
      ran.err,
      "sw-fracture: warning: 40 fluid or void cells in the region stay intact, 40 cells are fractured; a "
      "region within rock (--box, --polygon) has none\n");
  done(line + " -q");
}

TEST_F(ModelPipeline, InfoTellsSeveralFilesAndJsonIsOneLineEach) {
  done(layers + "-o a.nc; cp a.nc b.nc");
  EXPECT_TRUE(has(done("sw-info a.nc b.nc"), "b.nc: model\n"));
  EXPECT_EQ(done("sw-info --json a.nc b.nc | wc -l"), "2\n");
}

TEST_F(ModelPipeline, AnIndependentReaderFindsTheValuesWhereTheyBelong) {
  if (run("/usr/bin/python3 -c 'import netCDF4'").code != 0) {
    GTEST_SKIP() << "no /usr/bin/python3 with netCDF4 (Debian: python3-netcdf4)";
  }
  done("sw-layers --size 200x100 --step 5 --layer 0:1500:0:1000 --layer 40:3000:1500:2200:10 --fit none | " +
       fracture + "-q -o m.nc");
  write("check.py", R"(
import netCDF4, numpy as np
m = netCDF4.Dataset('m.nc'); m.set_auto_mask(False)
x, z = m['x'][:], m['z'][:]
assert np.array_equal(x, 2.5 + 5 * np.arange(40)) and np.array_equal(z, 2.5 + 5 * np.arange(20))
X, Z = np.meshgrid(x, z)
rock = 40 + X * np.tan(np.radians(10)) <= Z
assert np.array_equal(m['vp'][:], np.where(rock, 3000, 1500))
assert np.array_equal(m['vs'][:], np.where(rock, 1500, 0))
assert np.array_equal(m['rho'][:], np.where(rock, 2200, 1000))
box = (X >= 50) & (X <= 150) & (Z >= 50) & (Z <= 80)
assert np.array_equal(m['fracture'][:], (box & rock).astype('u1')) and (box & rock).sum() > 0
dip = np.radians(60)
assert np.allclose(m['slip_normal'][:], [[np.sin(dip), -np.cos(dip)]], atol=1e-15)
assert abs(np.dot(m['slip_normal'][0], [np.cos(dip), np.sin(dip)])) < 1e-15
assert m['slip_friction'][0] == 0.1 and m['slip_viscosity'][0] == 1e-3 and m['slip_strength'][0] == 1e5
assert list(m['vp'].actual_range) == [1500, 3000] and m['vp'].units == 'm s-1' and m['z'].positive == 'down'
assert m.Conventions == 'CF-1.10'
)");
  const Ran checked = run("/usr/bin/python3 check.py");
  EXPECT_EQ(checked.code, 0) << checked.err;
}

TEST_F(ModelPipeline, ImportsRawFilesOfEitherOrderAlike) {
  done(
      "printf "
      "'\\0\\0\\172\\105\\0\\0\\372\\105\\0\\200\\273\\105\\0\\0\\172\\105\\0\\0\\172\\105\\0\\0\\172\\105' "
      "> z.raw");
  // The same 3 x 2 cells row by row: 4000 6000 4000 over 8000 4000 4000.
  done(
      "printf "
      "'\\0\\0\\172\\105\\0\\200\\273\\105\\0\\0\\172\\105\\0\\0\\372\\105\\0\\0\\172\\105\\0\\0\\172\\105' "
      "> x.raw");
  const std::string rest =
      " --shape 3x2 --step 10 --vs-from-vp castagna --rho-from-vp gardner --allow-auxetic ";
  done("sw-import --vp z.raw --order z-fast" + rest + "-o a.nc");
  done("sw-import --vp x.raw --order x-fast" + rest + "-o b.nc");
  EXPECT_EQ(done("ncdump -v vp a.nc | sed -n '/^ vp =/,$p'"),
            done("ncdump -v vp b.nc | sed -n '/^ vp =/,$p'"));
  EXPECT_TRUE(has(done("ncdump -v vp a.nc"), "4000, 6000, 4000,\n  8000, 4000, 4000 ;"))
      << done("ncdump -v vp a.nc");
}

TEST_F(ModelPipeline, ImportsItsOwnModelsBackUnchanged) {
  done(
      "sw-layers --size 200x100 --step 5 --layer 0:1500:0:1000 --layer 40:3000:1500:2200:10 --fit none -o "
      "m.nc");
  done("sw-import --vp m.nc --vs m.nc:vs --rho m.nc -o n.nc");
  const std::string values = " | sed -n '/^data:/,$p' | grep -v history";
  EXPECT_EQ(done("ncdump -v x,z,vp,vs,rho m.nc" + values), done("ncdump -v x,z,vp,vs,rho n.nc" + values));
}

TEST_F(ModelPipeline, CropsWithDepthFromTheNewTop) {
  const auto text = done(layers +
                         "| sw-import --vp - --vs-from-vp castagna --rho-from-vp gardner --crop "
                         "50:150,30:90 | sw-info -");
  EXPECT_TRUE(has(text, "x             50 to 150 m")) << text;
  EXPECT_TRUE(has(text, "z             0 to 60 m")) << text;
  EXPECT_TRUE(has(text, "fluid cells   40\n")) << text;
}

TEST_F(ModelPipeline, ImportsTheRealMarmousiTwoWithASharpSeaFloor) {
  const std::string folder = shared_folder() + "/data/marmousi2/";
  if (!std::filesystem::exists(folder + "marmousi_II_marine.vp")) {
    GTEST_SKIP() << "no " << folder << "; SLIPWAVE_SHARED names the folder of shared data";
  }
  const std::string stem = "'" + folder + "marmousi_II_marine";
  const auto text = done("sw-import --vp " + stem + ".vp' --vs " + stem + ".vs' --rho " + stem +
                         ".rho' --shape 500x174 --step 20 --resample 5 -o m.nc; sw-info m.nc");
  EXPECT_TRUE(has(text, "2000 x 696 cells of 5 m")) << text;
  // 22 of 174 rows of 20 m are water: 88 of 696 rows of 5 m.
  EXPECT_TRUE(has(text, "fluid cells   176000\n")) << text;
  EXPECT_TRUE(has(text, "vp            1500 to ")) << text;
}

TEST_F(ModelPipeline, FracturesRockUnderItsWeightAndSaysSo) {
  done(layers +
       "| sw-fracture - --box 50:150,50:80 --dip 60 --friction 0.6 --viscosity 1 --block --opening "
       "--prestress lithostatic -o m.nc");
  const auto text = done("sw-info m.nc");
  EXPECT_TRUE(has(text, "slip normal 0.866025,-0.5,")) << text;
  EXPECT_TRUE(has(text, "slip normal 0.5,0.866025,")) << text;
  EXPECT_TRUE(has(text, "opens under tension")) << text;
  // -9.80665 (40 m of water + 12.5 and 37.5 m of rock).
  EXPECT_TRUE(has(text, "prestress szz  -1201315 to -661948.9 Pa")) << text;
  const std::string shot =
      "sw-shoot m.nc --source 100,45 --wavelet ricker:25 --receivers 0:200:10,45 --time 0.15 -o ";
  const auto plan = done(shot + "- --plan -v");
  for (const char* effect : {"blocks", "prestress", "opening"}) EXPECT_TRUE(has(plan, effect)) << plan;
  const auto bare = done(shot + "- --plan -v --without prestress,opening");
  for (const char* effect : {"prestress:", "opening:"}) EXPECT_FALSE(has(bare, effect)) << bare;
  const auto strong = run(shot + "g.sgy --amplitude 1e14 --balance");
  EXPECT_EQ(strong.code, 0);
  EXPECT_TRUE(has(strong.err, "sw-shoot: shot 1: 120 of 120 fractured cells slipped (100 %); of "))
      << strong.err;
  const auto weak = run(shot + "w.sgy --amplitude 1e-3 --balance");
  EXPECT_TRUE(has(weak.err, "shot 1: 0 of 120 fractured cells slipped (0 %)")) << weak.err;
  done(shot + "e.sgy --amplitude 1e-3 --without slip");
  done("sw-compare w.sgy e.sgy --tolerance 0.001");
}

TEST_F(ModelPipeline, TakesVolumesInAsTheyWentOut) {
  done(
      "sw-layers -q --size 60x40x30 --step 10 --layer 0:2000:1000:2000 --layer 10:3000:1500:2300:20 --fit "
      "none -o "
      "v.nc");
  for (const std::string format : {"", "--su ", "--revision 0 "}) {
    done("sw-export v.nc --property vp " + format + "-o v.sgy");
    done("sw-import --vp v.sgy --vs v.nc --rho v.nc --step 10 -o w.nc; sw-export w.nc --property vp " +
         format + "-o w.sgy");
    EXPECT_TRUE(has(done("sw-diff v.sgy w.sgy | sw-info -"), "amplitude 0,")) << format;
  }
  expect_refused("sw-import --vp v.sgy --vs v.nc --rho v.nc --step 5 -o w.nc", 1,
                 "sw-import: v.sgy: traces of an in-line are 10 m apart (bytes 181 to 188), expected 5 m as "
                 "--step says: "
                 "give --step 10, then --resample for other cells; --allow-rough takes --step all the same");
}

TEST_F(ModelPipeline, TakesAWellLogWithOneLineOfReport) {
  std::string log = "DEPTH.M;VP.KM/S;VS.KM/S;RHO.G/CC\n";
  for (int n = 0; n < 2400; ++n)
    log += std::to_string(0.15 * n) + (n % 3 == 0 ? ";2.5;1.1;2.2\n" : ";3;1.6;2.3\n");
  write("well.csv", log);
  const auto ran = run("sw-layers --size 50x400 --step 5 --log well.csv --backus -o m.nc");
  EXPECT_EQ(ran.code, 0) << ran.err;
  EXPECT_TRUE(
      ran.err.starts_with("sw-layers: well.csv: 2400 samples from 0 to 359.85 m, depth (M), vp (KM/S), vs "
                          "(KM/S), rho (G/CC): 72 Backus averages from 0 m on, vp "))
      << ran.err;
  EXPECT_EQ(std::count(ran.err.begin(), ran.err.end(), '\n'), 1) << ran.err;
  EXPECT_TRUE(has(done("sw-info m.nc"), "10 x 80 cells of 5 m"));
}

}  // namespace slipwave::model_pipeline_test
