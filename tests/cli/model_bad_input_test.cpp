#include <vector>

#include "shell.hpp"

namespace {

struct Case {
  std::string line;
  int code;
  std::string message;
};

const std::string layers = "sw-layers --size 200x100 --step 5 -o out.nc ";
const std::string fracture = "sw-fracture m.nc -o out.nc --friction 0.1 --viscosity 1 ";
const std::string import = "sw-import -o out.nc --shape 2x2 --step 5 ";

class ModelBadInput : public Shell {
 protected:
  /// Each case: the exit code, the one line, and an older output that survives.
  void expect_all(const std::vector<Case>& cases) {
    done("sw-layers --size 200x100 --step 5 --layer 0:1500:0:1000 --layer 40:3000:1500:2200 -o m.nc");
    done("printf '\\0\\0\\172\\105%.0s' 1 2 3 4 > 4000.raw");  // four times 4000
    done("printf '\\0\\0\\300\\177%.0s' 1 2 3 4 > nan.raw");
    done("printf '\\0\\0\\172\\305%.0s' 1 2 3 4 > negative.raw");
    done("head -c 16 /dev/zero > zero.raw");
    write("two.txt", "0 0\n10 10 # no third\n");
    write("word.txt", "0 0\n10 ten\n10 0\n");
    write("top.txt", "0 50\n100 60\n150 40\n");
    write("back.txt", "0 50\n100 60 # then back\n90 55\n200 50\n");
    write("nan.txt", "0 50\n100 nan\n200 50\n");
    write("garbage", std::string(5000, 'x'));
    write("empty", "");
    write("out.nc", "older");
    const auto before = files();
    for (const auto& [line, code, message] : cases) {
      expect_refused(line, code, message);
      EXPECT_EQ(content("out.nc"), "older") << line;
      EXPECT_EQ(files(), before) << line;
    }
  }
};

}  // namespace

TEST_F(ModelBadInput, OfLayersIsNamedInOneLine) {
  expect_all({
      {layers, 2, "sw-layers: --layer is missing; expected --layer DEPTH:VP:VS:RHO[:DIP]"},
      {"sw-layers --step 5 --layer 0:1:0:1", 2, "sw-layers: --size is missing; expected --size LXxLZ"},
      {layers + "--layer 0:1500:0", 2,
       "sw-layers: --layer: found '0:1500:0', expected DEPTH:VP:VS:RHO[:DIP]"},
      {layers + "--layer 0:1500:0:water", 2,
       "sw-layers: --layer: '0:1500:0:water': found 'water', expected a number"},
      {layers + "--layer 0:nan:0:1000", 2,
       "sw-layers: --layer: '0:nan:0:1000': found 'nan', expected a number"},
      {layers + "--layer 0:-1500:0:1000", 1,
       "sw-layers: vp at x=2.5 z=2.5 is -1500, expected a finite number not below zero"},
      {layers + "--layer 0:3000:2500:2000", 1,
       "sw-layers: vs at x=2.5 z=2.5 is 2500, expected at most vp/sqrt(2) = 2121.3203 (lambda < 0 "
       "needs "
       "--allow-auxetic)"},
      {layers + "--allow-auxetic --layer 0:3000:2600:2000", 1,
       "sw-layers: vs at x=2.5 z=2.5 is 2600, expected below vp sqrt(3)/2 = 2598.0762 (positive bulk "
       "modulus)"},
      {layers + "--layer 0:1500:0:0", 1,
       "sw-layers: rho at x=2.5 z=2.5 is 0 with vp 1500 and vs 0, expected both 0 in void or a density"},
      {layers + "--layer 0:0:0:1000", 1,
       "sw-layers: vp at x=2.5 z=2.5 is 0, expected a speed above zero outside void"},
      {layers + "--layer 50:1500:0:1000 --layer 0:3000:1500:2000", 2,
       "sw-layers: --layer: the layer at 0 m stands after the one at 50 m, expected them from the top down"},
      {layers + "--layer 0:1500:0:1000:90", 2,
       "sw-layers: --layer: '0:1500:0:1000:90': found a dip of 90 degrees, expected it between -90 and 90"},
      {"sw-layers --size 200x100 --step 7 --layer 0:1500:0:1000", 2,
       "sw-layers: --size, --step: 200 m are 28.571 steps of 7 m, expected a whole number"},
      {"sw-layers --size 200x100 --step -5 --layer 0:1500:0:1000", 2,
       "sw-layers: --size, --step: found a step of -5 m, expected it above zero"},
      {"sw-layers --size 200 --step 5 --layer 0:1500:0:1000", 2,
       "sw-layers: --size: found '200', expected a size LXxLZ"},
      {"sw-layers --size 200x-100 --step 5 --layer 0:1500:0:1000", 2,
       "sw-layers: --size: found '200x-100', expected a size LXxLZ above zero"},
      {layers + "--layer 0:1500:0:1000 more", 2,
       "sw-layers: unexpected argument 'more'; usage: sw-layers [options] [-o M]"},
      {"sw-layers --size 200x100 --step 5 --layer 0:1500:0:1000 -o nowhere/out.nc", 1,
       "sw-layers: nowhere/out.nc: No such file or directory"},
      {"sw-layers --size 200x100 --step 5 --layer 0:1500:0:1000 -o .", 1,
       "sw-layers: .: is a directory, expected a file"},
      {"sw-layers --size 1e9x1e9 --step 1e-3 --layer 0:1500:0:1000 2>&1 | sed 's/at most [^,]*/at most N/' "
       ">&2",
       2,
       "sw-layers: --size, --step: found 1e+24 cells, expected at most N, what fits the memory of this "
       "machine"},
  });
}

TEST_F(ModelBadInput, OfCurvedLayersIsNamedInOneLine) {
  const std::string rock = ":3000:1500:2000";
  expect_all({
      {layers + "--layer @none.txt" + rock, 1,
       "sw-layers: --layer: '@none.txt:3000:1500:2000': none.txt: No such file or directory"},
      {layers + "--layer @nan.txt" + rock, 1,
       "sw-layers: --layer: '@nan.txt:3000:1500:2000': nan.txt: line 2: found 'nan', expected a number"},
      {layers + "--layer @back.txt" + rock, 1,
       "sw-layers: --layer: '@back.txt:3000:1500:2000': back.txt: line 3: found x = 90 after 100, expected x "
       "to "
       "ascend"},
      {layers + "--layer @empty" + rock, 1,
       "sw-layers: --layer: '@empty:3000:1500:2000': empty: found 0 points, expected at least 2"},
      {layers + "--layer @." + rock, 1,
       "sw-layers: --layer: '@.:3000:1500:2000': .: is a directory, expected a file"},
      {layers + "--layer @top.txt" + rock, 1,
       "sw-layers: --layer: @top.txt reaches from x = 0 to 150 m, expected at least 2.5 to 197.5, the "
       "centres "
       "of the outer cells"},
      {layers + "--layer 80" + rock + " --layer sine,40,10,50" + rock, 2,
       "sw-layers: --layer: the layer at sine,40,10,50 lies above the one before it, at 80 m, all along the "
       "model; expected them from the top down"},
      {layers + "--layer sine,40,10" + rock, 2,
       "sw-layers: --layer: 'sine,40,10:3000:1500:2000': found 'sine,40,10', expected "
       "sine,MEAN,AMPLITUDE,WAVELENGTH[,PHASE]"},
      {layers + "--layer sine,40,10,-5" + rock, 2,
       "sw-layers: --layer: 'sine,40,10,-5:3000:1500:2000': found a wavelength of -5 m, expected it above "
       "zero"},
      {layers + "--layer 0:3000+x:1500:2000", 2,
       "sw-layers: --layer: '0:3000+x:1500:2000': found 'x', expected a number"},
      {layers + "--layer 0:3000-40:0:1000", 1,
       "sw-layers: vp at x=2.5 z=77.5 is -100, expected a finite number not below zero"},
  });
}

TEST_F(ModelBadInput, OfMarmousiIsNamedInOneLine) {
  const std::string marmousi = "sw-marmousi --size 200x100 -o out.nc ";
  expect_all({
      {marmousi, 2, "sw-marmousi: --step is missing; expected --step H"},
      {marmousi + "--step 7", 2,
       "sw-marmousi: --size, --step: 200 m are 28.571 steps of 7 m, expected a whole number"},
      {marmousi + "--step 5 --water -1", 2,
       "sw-marmousi: found a depth of water of -1, expected it not below zero"},
      {marmousi + "--step 5 --scale 0", 2, "sw-marmousi: found a scale of 0, expected it above zero"},
      {marmousi + "--step 5 --vp-over-vs 1.4", 2,
       "sw-marmousi: found a vp/vs of 1.4, expected at least sqrt(2)"},
      {marmousi + "--step 5 --seed 1.5", 2, "sw-marmousi: --seed: found '1.5', expected a whole number"},
      {marmousi + "--step 5 --water nan", 2, "sw-marmousi: --water: found 'nan', expected a number"},
  });
}

TEST_F(ModelBadInput, OfFracturesIsNamedInOneLine) {
  expect_all({
      {fracture + "--box 0:100,50:80", 2, "sw-fracture: found 0 of --dip and --normal, expected one or two"},
      {fracture + "--dip 0", 2,
       "sw-fracture: found 0 of --box, --polygon, --ellipse and --slab, expected one of them"},
      {fracture + "--dip 0 --box 0:1,0:1 --polygon p", 2,
       "sw-fracture: found 2 of --box, --polygon, --ellipse and --slab, expected one of them"},
      {fracture + "--dip 0 --box 0:1", 2, "sw-fracture: --box: found '0:1', expected a box X0:X1,Z0:Z1"},
      {fracture + "--dip 0 --box 100:0,50:80", 2,
       "sw-fracture: --box: found '100:0,50:80', expected a box X0:X1,Z0:Z1 with each low end below its high "
       "end"},
      {fracture + "--dip 100 --box 0:100,50:80", 2,
       "sw-fracture: --dip: found a dip of 100 degrees, expected it from -90 to 90"},
      {fracture + "--dip steep --box 0:100,50:80", 2, "sw-fracture: --dip: found 'steep', expected a number"},
      {fracture + "--normal 0,0 --box 0:100,50:80", 2,
       "sw-fracture: --normal: found a normal of length 0, expected a direction"},
      {fracture + "--normal 1 --box 0:100,50:80", 2,
       "sw-fracture: --normal: found '1', expected a point X,Z"},
      {fracture + "--dip 0 --normal 0,2 --box 0:100,50:80", 2,
       "sw-fracture: two slip systems of the set are parallel, expected different planes"},
      {fracture + "--dip 0 --box 0:100,0:30", 1,
       "sw-fracture: found 120 cell centres in the region and none of them solid, expected at least one "
       "solid cell"},
      {fracture + "--dip 0 --box 1000:2000,0:30", 1,
       "sw-fracture: found 0 cell centres in the region and none of them solid, expected at least one solid "
       "cell"},
      {"sw-fracture m.nc -o out.nc --friction -1 --viscosity 1 --dip 0 --box 0:100,50:80", 1,
       "sw-fracture: fracture set 1 'fractures-1': friction is -1, expected a finite number not below zero"},
      {"sw-fracture m.nc -o out.nc --viscosity 1 --dip 0 --box 0:100,50:80", 2,
       "sw-fracture: --friction is missing; expected --friction Q"},
      {fracture + "--dip 0 --ellipse 50,50", 2,
       "sw-fracture: --ellipse: found '50,50', expected an ellipse X,Z:A,B[:DIP]"},
      {fracture + "--dip 0 --ellipse 50,50:20,0", 2,
       "sw-fracture: --ellipse: '50,50:20,0': found '20,0', expected two lengths above zero"},
      {fracture + "--dip 0 --slab 50,50:20,5:steep", 2,
       "sw-fracture: --slab: '50,50:20,5:steep': found 'steep', expected a number"},
      {fracture + "--dip 0 --box 0:100,50:80 --count -3", 2,
       "sw-fracture: --count: found a count of -3, expected at least 1"},
      {fracture + "--dip 0 --box 0:100,50:80 --count 3 --body 10,-1", 2,
       "sw-fracture: --count: found slabs of 10 by -1 m, expected both above zero"},
      {fracture + "--dip 0 --box 0:100,50:80 --body 10,5", 2,
       "sw-fracture: found --body without --count, expected both"},
      {fracture + "--dip 0 --polygon two.txt", 1,
       "sw-fracture: two.txt: found 2 vertices, expected at least 3"},
      {fracture + "--dip 0 --polygon word.txt", 1,
       "sw-fracture: word.txt: line 2: found 'ten', expected a number"},
      {fracture + "--dip 0 --polygon none.txt", 1, "sw-fracture: none.txt: No such file or directory"},
      {"sw-fracture none.nc -o out.nc --friction 0.1 --viscosity 1 --dip 0 --box 0:1,0:1", 1,
       "sw-fracture: none.nc: No such file or directory"},
      {"sw-fracture . -o out.nc --friction 0.1 --viscosity 1 --dip 0 --box 0:1,0:1", 1,
       "sw-fracture: .: is a directory, expected a file"},
      {"sw-fracture garbage -o out.nc --friction 0.1 --viscosity 1 --dip 0 --box 0:1,0:1", 1,
       "sw-fracture: garbage: is no netCDF file"},
      {"sw-fracture empty -o out.nc --friction 0.1 --viscosity 1 --dip 0 --box 0:1,0:1", 1,
       "sw-fracture: empty: is empty, expected a netCDF file"},
      {"sw-fracture -o out.nc --friction 0.1 --viscosity 1 --dip 0 --box 0:1,0:1 < /dev/null", 1,
       "sw-fracture: standard input: is empty, expected a netCDF file"},
  });
}

TEST_F(ModelBadInput, OfImportsIsNamedInOneLine) {
  const std::string relations = "--vs-from-vp castagna --rho-from-vp gardner ";
  expect_all({
      {import + relations, 2, "sw-import: --vp is missing; expected --vp F"},
      {import + "--vp 4000.raw", 2, "sw-import: found neither --vs nor --vs-from-vp, expected one of them"},
      {import + "--vp 4000.raw --vs 4000.raw --vs-from-vp castagna", 2,
       "sw-import: found both --vs and --vs-from-vp, expected one of them"},
      {import + "--vp 4000.raw --vs-from-vp magic", 2,
       "sw-import: --vs-from-vp: found 'magic', expected one of castagna"},
      {import + "--vp nan.raw " + relations, 1,
       "sw-import: vp at x=2.5 z=2.5 is NaN, expected a finite number not below zero"},
      {import + "--vp negative.raw " + relations, 1,
       "sw-import: vp at x=2.5 z=2.5 is -4000, expected a finite number not below zero"},
      {import + "--vp 4000.raw --vs 4000.raw --rho 4000.raw", 1,
       "sw-import: vs at x=2.5 z=2.5 is 4000, expected at most vp/sqrt(2) = 2828.4272 (lambda < 0 "
       "needs "
       "--allow-auxetic)"},
      {import + "--vp 4000.raw --vs-from-vp castagna --rho zero.raw", 1,
       "sw-import: rho at x=2.5 z=2.5 is 0 with vp 4000 and vs 2275.862, expected both 0 in void or "
       "a density"},
      {"sw-import -o out.nc --shape 3x2 --step 5 --vp 4000.raw " + relations, 1,
       "sw-import: 4000.raw: found 16 bytes, expected 24 for 3 x 2 cells of 5 m, 4 bytes each"},
      {"sw-import -o out.nc --shape 2x --step 5 --vp 4000.raw " + relations, 2,
       "sw-import: --shape: found '2x', expected whole numbers NXxNZ above zero"},
      {"sw-import -o out.nc --shape 2x2 --vp 4000.raw " + relations, 2,
       "sw-import: --step is missing; raw files need it"},
      {"sw-import -o out.nc --shape 2x2 --step 0 --vp 4000.raw " + relations, 2,
       "sw-import: --step: found 0, expected it above zero"},
      {"sw-import -o out.nc --vp garbage " + relations, 1,
       "sw-import: garbage: is neither netCDF nor SEG-Y; raw float32 needs --shape and --step"},
      {"sw-import -o out.nc --vp none " + relations, 1, "sw-import: none: No such file or directory"},
      {"sw-import -o out.nc --vp m.nc:speed " + relations, 1, "sw-import: m.nc: found no variable 'speed'"},
      {"sw-import -o out.nc --vp m.nc --step 20 " + relations, 1,
       "sw-import: m.nc: vp: found a step of 5 m, expected 20 m along both axes"},
      {import + "--vp 4000.raw --resample 3 " + relations, 2,
       "sw-import: --resample: 10 m are 3.333 steps of 3 m, expected a whole number"},
      {import + "--vp 4000.raw --crop 0:20,0:10 " + relations, 2,
       "sw-import: --crop: found x from 0 to 20, expected it within the model, 0 to 10"},
      {"sw-import -o out.nc --vp m.nc --vs 4000.raw --rho-from-vp gardner --shape 2x2 --step 5", 1,
       "sw-import: m.nc: found " +
           std::to_string(std::stoll(done("sw-layers --size 200x100 --step 5 --layer "
                                          "0:1500:0:1000 --layer 40:3000:1500:2200 | wc -c"))) +
           " bytes, expected 16 for 2 x 2 cells of 5 m, 4 bytes each"},
      {"sw-import -o out.nc --vp - --vs - --rho-from-vp gardner", 2,
       "sw-import: found - more than once, expected one input on standard input"},
  });
}

TEST_F(ModelBadInput, OfInfoIsNamedInOneLine) {
  expect_all({
      {"sw-info", 2, "sw-info: FILE is missing; usage: sw-info [options] FILE..."},
      {"sw-info none", 1, "sw-info: none: No such file or directory"},
      {"sw-info .", 1, "sw-info: .: is a directory, expected a file"},
      {"sw-info empty", 1, "sw-info: empty: is empty, expected a model, snapshots or a gather"},
      {"sw-info garbage", 1,
       "sw-info: garbage: is no netCDF, SEG-Y or Seismic Unix file, expected a model, snapshots or a gather"},
  });
}
