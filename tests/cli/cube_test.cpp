// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <sstream>

#include "shell.hpp"

namespace slipwave::cube_test {
namespace {

/// From a model to pictures in three dimensions.
class Cube : public Shell {
 protected:
  const std::string layers =
      "--step 10 --layer 0:1500:0:1000 --layer sine,50,8,200:2500:1300:2100 --fit none ";
  const std::string planes = "--friction 0.1 --viscosity 500 ";
  const std::string shot =
      "--source 95,65,85 --kind force:1,0,2 --wavelet ricker:15 --amplitude 1e9 --time 0.15 --dt 0.005 -q ";
};

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

}  // namespace

TEST_F(Cube, OfLayersIsTheSectionExtrudedAlongY) {
  done("sw-layers --size 200x120x150 " + layers + "-o deep.nc");
  done("sw-layers --size 200x150 " + layers + "-o flat.nc");
  done("sw-import --vp flat.nc --vs flat.nc --rho flat.nc --extrude 120 -o extruded.nc");
  for (const char* name : {"vp", "vs", "rho", "x", "y", "z"})
    done("diff <(ncdump -v " + std::string(name) + " deep.nc | sed '1,/^data:/d') <(ncdump -v " + name +
         " extruded.nc | sed '1,/^data:/d')");
  expect_refused("sw-import --vp flat.nc --vs flat.nc --rho flat.nc --extrude 125 -o no.nc", 2,
                 "sw-import: --extrude: 125 m are 12.5 steps of 10 m, expected a whole number");
}

TEST_F(Cube, OfElasticConstantsIsTheSameByLayersAndByImport) {
  const std::pair<const char*, double> constants[] = {
      {"c11", 20.7}, {"c22", 22.6}, {"c33", 13.7}, {"c44", 4.6}, {"c55", 3.7},  {"c66", 5},   {"c12", 8.3},
      {"c13", 5.2},  {"c23", 5.5},  {"c14", 0.7},  {"c25", 0.4}, {"c46", -0.3}, {"c56", 0.5}, {"c36", 0.3}};
  std::ostringstream named, options;
  for (const auto& [name, value] : constants)
    named << ' ' << name << '=' << value, options << " --" << name << ' ' << value;
  done("sw-layers --size 100x80x60 --step 10 --units GPa --layer '0:-:-:2300" + named.str() + "' -o one.nc");
  done("sw-import --rho one.nc --units GPa" + options.str() + " -o other.nc");
  for (const char* name : {"vp", "vs", "rho", "c11", "c14", "c15", "c46", "c66"})
    done("diff <(ncdump -v " + std::string(name) + " one.nc | sed '1,/^data:/d') <(ncdump -v " + name +
         " other.nc | sed '1,/^data:/d')");
  const auto info = done("sw-info other.nc");
  EXPECT_TRUE(has(info, "c46") && !has(info, "epsilon")) << info;
  for (const std::string model : {"one", "other"})
    done("sw-shoot " + model + ".nc --source 55,45,35 --kind force:1,0,2 --wavelet ricker:15 --time 0.05 " +
         "--receivers 35,25,25 -q -o " + model + ".sgy");
  EXPECT_TRUE(has(done("sw-diff one.sgy other.sgy | sw-info -"), "amplitude 0 Pa"));
  done("sw-plot one.nc --at 55,45,35 -o rock.png; sw-export one.nc --property c46 -o c46.sgy");
}

TEST_F(Cube, IsFracturedInBoxesEllipsoidsAndSlabs) {
  done("sw-layers --size 200x120x150 --step 10 --layer 0:2500:1300:2100 -o m.nc");
  const auto cells = [&](const std::string& region) {
    const auto text = done("sw-fracture m.nc " + region + " --dip 30:90 " + planes + "| sw-info -");
    EXPECT_TRUE(has(text, "slip normal 0,0.5,-0.866025")) << text;
    // Of cells that edges cut the shares count.
    const auto set = text.find("fractures"), shares = text.find("as whole cells ", set);
    return shares != std::string::npos ? std::stod(text.substr(shares + 15))
                                       : std::stod(text.substr(text.find("cells ", set) + 6));
  };
  EXPECT_EQ(cells("--box 50:150,20:80,60:120"), 10 * 6 * 6);
  EXPECT_NEAR(cells("--ellipse 100,60,75:60,50,40"), 4. / 3 * std::acos(-1.) * 6 * 5 * 4, 2);
  // A vertical slab, which the azimuth turns from the x-z into the y-z plane.
  EXPECT_EQ(cells("--slab 95,55,75:60,30,80"), cells("--slab 95,55,75:60,30,80:0:180"));
  EXPECT_EQ(cells("--slab 95,55,75:50,10,30:0:90"), cells("--slab 95,55,75:10,50,30"));
  const double few = cells("--box 0:200,0:120,0:150 --count 3 --body 60,20"),
               more = cells("--box 0:200,0:120,0:150 --count 9 --body 60,20");
  EXPECT_GT(few, 20);
  EXPECT_GT(more, few);
  expect_refused("sw-fracture m.nc --box 0:50,0:50 --dip 0 " + planes + "-o no.nc", 2,
                 "sw-fracture: --box: found '0:50,0:50', expected a box X0:X1,Y0:Y1,Z0:Z1");
  expect_refused("sw-fracture m.nc --polygon p --dip 0 " + planes + "-o no.nc", 2,
                 "sw-fracture: --polygon needs a model in 2-D; in 3-D use --box, --ellipse or --slab");
}

TEST_F(Cube, IsShotIntoAnAreaOfReceivers) {
  done("sw-layers --size 200x120x150 " + layers + "| sw-fracture - --box 50:150,20:80,90:120 --dip 30:60 " +
       "--dip 70:150 --normal 1,1,0 " + planes + "-q -o m.nc");
  done("sw-shoot m.nc " + shot + "--receivers 20:180:20,30:90:20,5 --record vx,vy,vz -o a.sgy");
  const auto text = done("sw-info a.sgy");
  EXPECT_TRUE(has(text, "traces           108\n")) << text;
  EXPECT_TRUE(has(text, "receiver y       30 to 90 m")) << text;
  // Midpoints lie 10 m apart, as wide as a bin; those of the second line of receivers at y = 57.5 m.
  const auto lines = done("sw-select a.sgy --where 'iline=7 and component=vy' | sw-info -");
  EXPECT_TRUE(has(lines, "traces           9\n")) << lines;
  done("sw-shoot m.nc " + shot + "--receivers 20:180:20,30:90:20,5 --record vx,vy,vz --threads 1 -o b.sgy");
  done("cmp a.sgy b.sgy");
  const auto plan = done("sw-shoot m.nc " + shot + "--plan -v");
  EXPECT_TRUE(has(plan, "slip, centred"));
  EXPECT_TRUE(has(plan, "% (cells that no wave has reached")) << plan;
  const auto measured = done("sw-shoot m.nc " + shot + "--receivers 20,30,5 --plan --measure");
  EXPECT_TRUE(has(measured, "  measured error")) << measured;
  expect_refused("sw-shoot m.nc --source 95,85 --wavelet ricker:15 --time 0.1 --receivers 5,5,5 -o no.sgy", 2,
                 "sw-shoot: --source: found '95,85', expected points X0:X1:DX,Y,Z or X,Y,Z");
}

TEST_F(Cube, ShowsSlicesOfSnapshotsAndModels) {
  done("sw-layers --size 200x120x150 " + layers + "-o m.nc");
  const std::string snapshots = "sw-shoot m.nc " + shot + "--every 0.05 --fields vy,curlz ";
  done(snapshots + "--snapshots volume.nc");
  done(snapshots + "--snapshots slice.nc --slice y=64");
  EXPECT_TRUE(has(done("sw-info slice.nc"), "20 x 1 x 15 cells of 10 m"));
  // Pictures of the same values in the same colours.
  done("sw-plot volume.nc --slice y=65 --field vy -o a.svg && sw-plot slice.nc --field vy -o b.svg");
  EXPECT_GT(std::stoi(done("grep -c '<image' a.svg")), 0);
  done("cmp <(grep -o 'base64,[^\"]*' a.svg) <(grep -o 'base64,[^\"]*' b.svg)");
  done("sw-plot m.nc --slice z=55 -o map.png && sw-plot slice.nc --over m.nc --movie -o film.png");
  EXPECT_TRUE(exists("film-0003.png"));
  // Without a plane: three, on which the numbers are those of the sections alone.
  done("sw-plot m.nc -o three.svg && sw-plot volume.nc --over m.nc --field vy -o wave.png");
  EXPECT_EQ(done("grep -c '<image' three.svg"), "4\n");  // and the colour bar
  expect_refused("sw-plot m.nc --x 0:50 -o no.png", 2,
                 "sw-plot: --x: three sections are drawn; choose one by --slice, such as y=500");
  expect_refused("sw-plot m.nc --slice y=130 -o no.png", 2,
                 "sw-plot: m.nc: found y=130, expected it from 0 to 120");
  const auto cube = done("sw-export m.nc --property vp | sw-info -");
  EXPECT_TRUE(has(cube, "traces           240\n")) << cube;
  EXPECT_TRUE(has(cube, "receiver y       5 to 115 m\n")) << cube;
}

TEST_F(Cube, ShowsSlicesOfFittedGridsAtTrueDepths) {
  done("sw-layers -q --size 200x120x150 --step 10 --layer sine,30,12,150:2500:1250:2000 -o m.nc");
  EXPECT_TRUE(has(done("sw-info m.nc"), "role surface"));
  const std::string snapshots =
      "sw-shoot m.nc --source 105,65,95 --wavelet ricker:15 --receivers 55,65,95 --time 0.1 --every 0.05 "
      "--fields vz,div -q -o /dev/null ";
  done(snapshots + "--snapshots volume.nc");
  for (const std::string plane : {"x=105", "y=65", "z=37"}) {
    if (!long_form() && plane[0] == 'y') continue;
    done(snapshots + "--snapshots slice.nc --slice " + plane);
    EXPECT_EQ(has(done("ncdump -h slice.nc"), "vz:coordinates = \"depth\""), plane[0] != 'z');
    done("sw-plot volume.nc --over m.nc --slice " + plane +
         " --field div -o a.svg && sw-plot slice.nc --over m.nc --field div -o b.svg");
    done("cmp <(grep -o 'base64,[^\"]*' a.svg) <(grep -o 'base64,[^\"]*' b.svg)");
  }
  expect_refused("sw-plot m.nc --slice z=151 -o no.png", 2,
                 "sw-plot: m.nc: found z=151, expected it from 0 to 150");
}

TEST_F(Cube, GoesOnFromACheckpoint) {
  done("sw-layers --size 200x120x150 " + layers + "-o m.nc");
  const std::string run = "sw-shoot m.nc " + shot + "--source 60,60,60 --receivers 20:180:40,30:90:20,5 ";
  done(run + "-o a.sgy");
  done(run + "--checkpoint c -o b.sgy");
  done("cmp a.sgy b.sgy");
}

}  // namespace slipwave::cube_test
