#include <vector>

#include "shell.hpp"

namespace {

struct Case {
  std::string line;
  int code;
  std::string message;
};

const std::string shoot = "sw-shoot m.nc -o out.sgy ";
const std::string source = "--source 100,50 --wavelet ricker:15 ";
const std::string rest = source + "--receivers 0:200:50,20 --time 0.1 ";

class ShootBadInput : public Shell {
 protected:
  void SetUp() override {
    done("sw-layers --size 200x100 --step 5 --layer 0:1500:0:1000 --layer 60:3000:1500:2200 -o m.nc");
    done("sw-layers --size 200x100 --step 5 --layer 40:3000:1500:2200 -o void.nc");
    done("sw-layers --size 200x100 --step 5 --layer 0:3000:2500:2200 --allow-auxetic -o auxetic.nc");
    done("head -c 4000 m.nc > part.nc");
    done("sw-shoot m.nc " + rest + "-o gather.sgy");
    write("nan.txt", "0 0\n0.01 nan\n0.02 0\n");
    write("empty", "");
    write("out.sgy", "older");
  }
  /// Each case: the exit code, the one line, and an older output that survives.
  void expect_all(const std::vector<Case>& cases) {
    const auto before = files();
    for (const auto& [line, code, message] : cases) {
      expect_refused(line, code, "sw-shoot: " + message);
      EXPECT_EQ(content("out.sgy"), "older") << line;
      EXPECT_EQ(files(), before) << line;
    }
  }
};

}  // namespace

TEST_F(ShootBadInput, OfModelsIsNamedInOneLine) {
  const auto whole = std::to_string(content("m.nc").size());
  expect_all({
      {"sw-shoot none.nc -o out.sgy " + rest, 1, "none.nc: No such file or directory"},
      {"sw-shoot . -o out.sgy " + rest, 1, ".: is a directory, expected a file"},
      {"sw-shoot empty -o out.sgy " + rest, 1, "empty: is empty, expected a netCDF file"},
      {"sw-shoot -o out.sgy " + rest + "< /dev/null", 1, "standard input: is empty, expected a netCDF file"},
      {"sw-shoot part.nc -o out.sgy " + rest, 1, "part.nc: truncated: found 4000 bytes, expected " + whole},
      {"sw-shoot gather.sgy -o out.sgy " + rest, 1, "gather.sgy: is no netCDF file"},
      {"sw-shoot auxetic.nc -o out.sgy " + rest, 1,
       "auxetic.nc: vs at x=2.5 z=2.5 is 2500, expected at most vp/sqrt(2) = 2121.3203 (lambda < 0 needs "
       "--allow-auxetic)"},
  });
}

TEST_F(ShootBadInput, OfValuesInAModelFileIsNamedWithItsPlace) {
  if (run("/usr/bin/python3 -c 'import netCDF4'").code != 0)
    GTEST_SKIP() << "no /usr/bin/python3 with netCDF4 (Debian: python3-netcdf4)";
  write("set.py", R"(
import netCDF4, shutil, sys
shutil.copy('m.nc', sys.argv[1])
m = netCDF4.Dataset(sys.argv[1], 'a'); m.set_auto_mask(False)
m[sys.argv[2]][2, 3] = float(sys.argv[3])
)");
  done("/usr/bin/python3 set.py a.nc vp nan && /usr/bin/python3 set.py b.nc vp -1500");
  done("/usr/bin/python3 set.py c.nc rho 0 && /usr/bin/python3 set.py d.nc vs 1400");
  expect_all({
      {"sw-shoot a.nc -o out.sgy " + rest, 1,
       "a.nc: vp at x=17.5 z=12.5 is NaN, expected a finite number not below zero"},
      {"sw-shoot b.nc -o out.sgy " + rest, 1,
       "b.nc: vp at x=17.5 z=12.5 is -1500, expected a finite number not below zero"},
      {"sw-shoot c.nc -o out.sgy " + rest, 1,
       "c.nc: rho at x=17.5 z=12.5 is 0 with vp 1500 and vs 0, expected both 0 in void or a density"},
      {"sw-shoot d.nc -o out.sgy " + rest, 1,
       "d.nc: vs at x=17.5 z=12.5 is 1400, expected at most vp/sqrt(2) = 1060.6602 (lambda < 0 needs "
       "--allow-auxetic)"},
  });
}

TEST_F(ShootBadInput, OfPlacesIsNamedInOneLine) {
  const std::string void_model = "sw-shoot void.nc -o out.sgy --wavelet ricker:15 --time 0.1 ";
  expect_all({
      {shoot + rest + "--source 500,20", 1,
       "source 2 at x=500 z=20 lies outside the model, expected x=0..200 z=0..100"},
      {shoot + rest + "--receivers 10,-5", 1,
       "receiver 6 at x=10 z=-5 lies outside the model, expected x=0..200 z=0..100"},
      {void_model + "--source 100,20 --receivers 0,60", 1,
       "the source at x=102.5 z=22.5 is in void, expected rock or fluid"},
      {void_model + "--source 100,60 --receivers 0,20", 1,
       "the receiver at x=2.5 z=22.5 is in void, expected rock or fluid"},
      {shoot + rest + "--kind moment:1,-1,0", 1,
       "the source at x=102.5 z=52.5 is in fluid and its moment differs between directions, expected --kind "
       "explosion there"},
      {shoot + rest + "--shots-in-parallel -1", 2, "--shots-in-parallel: found -1, expected 0 or more"},
      {shoot + rest + "--shots-in-parallel 2 --snapshots s.nc --every 0.1", 2,
       "found --snapshots with 2 for --shots-in-parallel, expected 1: snapshots are written one after the "
       "other"},
      {shoot + rest + "--kind plane:0", 1, "the plane wave enters by the top, expected --top absorbing"},
      {shoot + rest + "--kind plane:20 --top absorbing", 1,
       "the plane wave meets vp 3000 vs 1500 rho 2200 at x=2.5 z=62.5 and vp 1500 vs 0 rho 1000 at x=2.5 "
       "z=2.5, expected one solid or fluid along the edge"},
  });
}

TEST_F(ShootBadInput, OfSettingsIsNamedInOneLine) {
  expect_all({
      {"sw-shoot m.nc -o out.sgy --source 1,1 --wavelet ricker:15", 2,
       "--time is missing; expected --time T"},
      {shoot + source + "--time 0.1", 2,
       "found neither --receivers nor --snapshots, expected what to record"},
      {shoot + rest + "--recievers 3,3", 2, "unknown option --recievers; did you mean --receivers?"},
      {shoot + rest + "--top fre", 2, "--top: found 'fre', expected one of free, absorbing, rigid, mirror"},
      {shoot + rest + "--order 4", 2, "--order: found '4', expected one of 1, 3, 5, 7"},
      {shoot + rest + "--record vx,vy", 2, "found component vy in 2-D, expected vx, vz, p, sxx, szz or sxz"},
      {shoot + source + "--receivers 3,3 --time abc", 2, "--time: found 'abc', expected a number"},
      {shoot + source + "--receivers 3,3 --time 0", 2, "found --time of 0 s, expected it above 0"},
      {shoot + rest + "--dt 0", 2, "found --dt of 0 s, expected it above 0"},
      {shoot + rest + "--dt 0.0003333", 1,
       "sample interval 0.0003333 s, SEG-Y revision 1 holds whole microseconds up to 65535 (resample, or "
       "write revision 2)"},
      {shoot + rest + "--time-step 0.01", 2,
       "found a time step of 0.01 s, expected at most h/vp_max = 0.0016666666666666668 s"},
      {shoot + rest + "--cfl 1.5", 2,
       "found --cfl 1.5, expected above 0 and at most 1: h/vp_max is 0.0016666666666666668 s"},
      {shoot + rest + "--time-order 4 --cfl 2.2", 2,
       "found --cfl 2.2, expected above 0 and at most 2: h/vp_max is 0.0016666666666666668 s"},
      {shoot + rest + "--time-order 3", 2, "--time-order: found '3', expected one of 2, 4"},
      {shoot + rest + "--snapshots s.nc", 2,
       "found --snapshots without --every, expected the time between them"},
      {shoot + rest + "--every 0.1 --snapshots out.sgy", 2,
       "found out.sgy for both --output and --snapshots, expected two places"},
      {shoot + rest + "--snapshots 's{component}.nc' --every 0.1", 2,
       "found {component} in --snapshots s{component}.nc, expected --fields to choose them"},
      {shoot + rest + "--source 50,50 --snapshots s.nc --every 0.1", 2,
       "found 2 sources and --snapshots s.nc, expected {shot} in the name"},
  });
}

TEST_F(ShootBadInput, OfWaveletFilesNamesTheLine) {
  const Ran ran = run(shoot + "--source 1,1 --receivers 3,3 --time 0.1 --wavelet file:nan.txt");
  EXPECT_EQ(ran.code, 1);
  EXPECT_NE(ran.err.find("nan.txt: line 2: "), std::string::npos) << ran.err;
  EXPECT_EQ(content("out.sgy"), "older");
}

TEST_F(ShootBadInput, IsRefusedBeforeAnythingIsComputed) {
  // An hour of waves would take far longer than this.
  const std::string endless = "timeout 10 sw-shoot m.nc -q --time 3000 --receivers 3,3 " + source;
  expect_refused(
      endless + "--dt 0.0500001 -o out.sgy", 1,
      "sw-shoot: sample interval 0.0500001 s, SEG-Y revision 1 holds whole microseconds up to 65535 "
      "(resample, or write revision 2)");
  expect_refused(endless + "--dt 0.05 -o nowhere/out.sgy", 1,
                 "sw-shoot: nowhere/out.sgy: No such file or directory");
  expect_refused(endless + "--dt 0.05 --every 1 --snapshots nowhere/s.nc -o out.sgy", 1,
                 "sw-shoot: nowhere/s.nc: No such file or directory");
  const Ran many = run(endless + "--dt 0.01 -o out.sgy");
  EXPECT_EQ(many.code, 1);
  EXPECT_NE(many.err.find("300001 samples"), std::string::npos) << many.err;
  EXPECT_EQ(content("out.sgy"), "older");
}

TEST_F(ShootBadInput, AFullDiskIsSaidInOneLine) {
  const std::string full = ": No space left on device";
  expect_refused("sw-shoot m.nc " + rest + "-o /dev/full", 1, "sw-shoot: /dev/full" + full);
  expect_refused("sw-shoot m.nc " + rest + "> /dev/full", 1, "sw-shoot: standard output" + full);
  expect_refused(shoot + rest + "--every 0.05 --snapshots /dev/full", 1, "sw-shoot: /dev/full" + full);
  EXPECT_EQ(content("out.sgy"), "older");
  const auto before = files();
  const Ran limited = run("(ulimit -f 1; " + shoot + rest + "2>&1) | cat");
  EXPECT_EQ(limited.code, 1);
  EXPECT_EQ(limited.out, "sw-shoot: out.sgy: File too large\n");
  EXPECT_EQ(content("out.sgy"), "older");
  EXPECT_EQ(files(), before);
}

TEST_F(ShootBadInput, WavesTooShortForTheGridAreAWarningThatSaysTheCost) {
  const std::string line = shoot + "--source 100,50 --wavelet ricker:60 --receivers 3,3 --time 0.1 ";
  const Ran ran = run(line);
  EXPECT_EQ(ran.code, 0);
  EXPECT_EQ(ran.err.compare(0, 25, "sw-shoot: warning: found "), 0) << ran.err;
  EXPECT_NE(ran.err.find("cells a shortest wavelength"), std::string::npos);
  EXPECT_NE(ran.err.find("of their amplitude a wavelength; cells of "), std::string::npos);
  EXPECT_NE(ran.err.find(" times the cost\n"), std::string::npos);
  done(line + "-q");
}

TEST_F(ShootBadInput, WhatOnlyLooksBadIsDone) {
  done(shoot + rest + "--amplitude -3");
  done("sw-shoot auxetic.nc --allow-auxetic -o out.sgy " + rest);
  done("sw-shoot void.nc -o out.sgy --wavelet ricker:15 --time 0.1 --source 100,60 --receivers 0,60");
}
