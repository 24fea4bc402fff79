// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <cstdlib>

#include "shell.hpp"

namespace slipwave::model_geology_test {
namespace {

using ModelGeology = Shell;

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

}  // namespace

TEST_F(ModelGeology, OfMarmousiGivesTheSameBytesOnAnyNumberOfThreads) {
  const std::string marmousi = "sw-marmousi --step 50 --seed 3 ";
  done(marmousi + "-o a.nc; " + marmousi + "--threads 1 > b.nc; cmp a.nc b.nc");
  done("sw-marmousi --step 50 --seed 4 -o c.nc; ! cmp -s a.nc c.nc");
  const auto text = done("sw-info a.nc");
  EXPECT_TRUE(has(text, "200 x 70 cells of 50 m")) << text;
  // The sea is 450 m deep: nine rows.
  EXPECT_TRUE(has(text, "fluid cells   1800\n")) << text;
  EXPECT_TRUE(has(text, "sw-marmousi --step 50 --seed 3")) << text;
}

TEST_F(ModelGeology, OfMarmousiCanBeShot) {
  done("sw-marmousi --size 1000x400 --step 5 --scale 0.1 --water 50 --vp-over-vs 1.8 -o m.nc");
  done(
      "sw-shoot m.nc --source 500,10 --wavelet ricker:25 --receivers 0:1000:50,10 --record p --time 0.3 -q "
      "-o "
      "g.sgy");
  EXPECT_TRUE(has(done("sw-info g.sgy"), "21")) << done("sw-info g.sgy");
}

TEST_F(ModelGeology, OfLayersFollowsHorizonsFromFiles) {
  // A topography with a hill in the middle, and a lake floor below it.
  write("hill.txt", "# x z\n0 40\n100 10\n200 40\n");
  const auto text = done(
      "sw-layers --size 200x100 --step 10 --layer @hill.txt:3000:1500:2200 --layer 70:4000:2000:2500 --fit "
      "none | "
      "sw-info -");
  // Centres above the hill: 40 - 0.3 x at x = 5 15 ... are 38.5 35.5 ... 11.5, with 4 4 3 3 3 2 2 2 1 1
  // centres 5 15 25 35 above, on either side.
  EXPECT_TRUE(has(text, "void cells    50\n")) << text;
}

TEST_F(ModelGeology, OfLayersFollowsGridsInThreeDimensions) {
  // A roof over y: 40 - 0.3 y down to 10 m in the middle; in each of ten columns along x the same as above.
  write("roof.xyz", "# x y depth\n0 100 10\n100 0 40\n0 0 40\n100 200 40\n0 200 40\n100 100 10\n");
  const std::string rest = " --size 100x200x100 --step 10 --layer 70:4000:2000:2500 --fit none | sw-info -";
  const auto text = done("sw-layers --layer @roof.xyz:3000:1500:2200" + rest);
  EXPECT_TRUE(has(text, "void cells    500\n")) << text;
  // Through a pipe, too.
  const auto piped = done("cat roof.xyz | sw-layers --layer @-:3000:1500:2200" + rest);
  EXPECT_TRUE(has(piped, "void cells    500\n")) << piped;
}

TEST_F(ModelGeology, OfLayersWarnsOfTopsBeyondTheModel) {
  const std::string line = "sw-layers --size 100x50 --step 5 -o m.nc ";
  const std::string meant = "; if that is not meant, change the --layer\n";
  write("heights.txt", "0 -50\n100 -70\n");
  EXPECT_EQ(
      run(line + "--layer @heights.txt:2000:1000:2000").err,
      "sw-layers: warning: the layer at @heights.txt begins up to 69.5 m above the model, whose top cuts "
      "it off: depths count downwards" +
          meant);
  EXPECT_EQ(run(line + "--layer 0:1500:0:1000 --layer 50:2000:1000:2000").err,
            "sw-layers: warning: the layer at 50 m begins below the model, which ends at 50 m" + meant);
  EXPECT_EQ(run(line + "--layer 0:1500:0:1000 --layer 20:2000:1000:2000:30").err.find("begins"),
            std::string::npos);
}

TEST_F(ModelGeology, OfLayersWarnsWhereACurveCutsALayerOff) {
  const std::string line =
      "sw-layers --size 1000x500 --step 10 --layer 0:1500:0:1000 --layer 200:2000:1000:2000 --layer "
      "sine,250,100,1000:3000:1500:2200 -o m.nc";
  const Ran ran = run(line);
  EXPECT_EQ(ran.code, 0);
  EXPECT_EQ(
      ran.err,
      "sw-layers: fitted: floor at 200 m, rows 0.79 to 1.25 of 10 m\n"
      "sw-layers: warning: not fitted: layer at sine,250,100,1000 meets or crosses floor at 200 m at x=590, "
      "z=196.417; --fit says what to follow\n"
      "sw-layers: warning: the layer at 200 m is cut off by the one at sine,250,100,1000 between x=585 and "
      "x=915; if that is not meant, change the --layer\n");
  done(line + " -q");
}

TEST_F(ModelGeology, OfLayersWarnsOfWhatOnlyCountsInThreeDimensions) {
  const std::string layer = " --step 10 --layer '0:3000:1500:2200 epsilon=0.1 gamma=0.2' -o g.nc";
  EXPECT_EQ(run("sw-layers --size 100x50" + layer).err,
            "sw-layers: warning: gamma has no effect in 2-D, where waves travel and move in the section; it "
            "counts in 3-D\n");
  EXPECT_NE(run("sw-layers --size 100x50 --step 10 --layer '0:3000:1500:2200 epsilon1=0.2' -o g.nc")
                .err.find("epsilon1 has no effect"),
            std::string::npos);
  EXPECT_EQ(run("sw-layers --size 100x50x50" + layer).err, "");
}

TEST_F(ModelGeology, OfLayersIsTakenFromAFileOfOptions) {
  write(
      "m.ini",
      "size = 200x100\nstep = 10\nlayer = 0:1500:0:1000\nlayer = sine,40,5,100:1800+0.5:700+0.2:2000+0.1\n");
  const auto text = done("sw-layers --config m.ini --fit none | sw-info -");
  EXPECT_TRUE(has(text, "vp            1500 to 18")) << text;
}

TEST_F(ModelGeology, OfFracturesFillsEllipsesAndSlabs) {
  done("sw-layers --size 1000x1000 --step 5 --layer 0:3000:1500:2200 -o m.nc");
  const std::string rest = " --dip 30 --friction 0.1 --viscosity 1 | sw-info -";
  // pi 200 m 100 m are 2513 cells of 25 m2; 400 m x 50 m are 800.
  EXPECT_TRUE(has(done("sw-fracture m.nc --ellipse 500,500:200,100:20" + rest), "as whole cells 251"));
  EXPECT_TRUE(has(done("sw-fracture m.nc --slab 500,500:400,50" + rest), "cells 800"));
}

TEST_F(ModelGeology, OfFracturesScattersTheSameSlabsForASeed) {
  done("sw-layers --size 1000x1000 --step 5 --layer 0:3000:1500:2200 -o m.nc");
  const std::string line =
      "sw-fracture m.nc --box 200:800,300:700 --count 25 --dip 50 --friction 0.1 --viscosity 1 ";
  done(line + "--seed 2 -o a.nc; " + line + "--seed 2 > b.nc; cmp a.nc b.nc");
  done(line + "--seed 3 -o c.nc; ! cmp -s a.nc c.nc");
  // 25 slabs of 60 m x 6 m on average have 9000 m2 where none overlap, 360 cells.
  const auto json = done("sw-info --json a.nc");
  const std::string name = "\"as_whole_cells\": {\"value\": ";
  const auto at = json.find(name, json.find("fractures-1"));
  ASSERT_NE(at, std::string::npos) << json;
  const int cells = std::atoi(json.c_str() + at + name.size());
  EXPECT_TRUE(cells > 200 && cells < 450) << json;
}

TEST_F(ModelGeology, OfLayersWithAGradientBendsRaysAsInTheClosedForm) {
  // From one point to another in speeds v = v0 + k z it takes acosh(1 + k^2 d^2/(2 v1 v2))/k. Uniform rock in
  // which the straight way takes as long gives the same pulse at the same time.
  const double k = 1, v1 = 2000 + k * 200, v2 = 2000 + k * 800, square = 400. * 400 + 600. * 600;
  const double speed = std::sqrt(square) * k / std::acosh(1 + k * k * square / (2 * v1 * v2));
  const std::string size = "sw-layers --size 1200x1200 --step 5 --layer 0:";
  const std::string shot =
      " | sw-shoot - --source 300,200 --wavelet ricker:15 --receivers 700,800 --top absorbing "
      "--record p --time 0.6 -q -o ";
  done(size + "2000+1:1000+0.5:2000" + shot + "gradient.sgy");
  done(size + std::to_string(speed) + ":1200:2000" + shot + "uniform.sgy");
  const double lag = std::atof(done("sw-compare uniform.sgy gradient.sgy | awk 'END { print $NF }'").c_str());
  EXPECT_LT(std::abs(lag), 1e-4);
  // With a speed that is 1 % higher the lag is 1 % of 0.29 s.
  done(size + std::to_string(1.01 * speed) + ":1200:2000" + shot + "faster.sgy");
  const double late = std::atof(done("sw-compare faster.sgy gradient.sgy | awk 'END { print $NF }'").c_str());
  EXPECT_NEAR(std::abs(late), 0.0029, 3e-4);
}

}  // namespace slipwave::model_geology_test
