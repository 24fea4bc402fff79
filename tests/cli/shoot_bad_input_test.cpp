// SPDX-License-Identifier: BSD-3-Clause
#include "shell.hpp"

namespace slipwave::shoot_bad_input_test {
namespace {

const std::string shoot = "sw-shoot m.nc -o out.sgy ";
const std::string source = "--source 100,50 --wavelet ricker:15 ";
const std::string shallow = "--source 100,0 --wavelet ricker:15 --receivers 0:200:50,20 --time 0.1 ";
const std::string rest = source + "--receivers 0:200:50,20 --time 0.1 ";

/// What the tables of bad_input do not hold: refusals in time, warnings, and what is right after all.
class ShootBadInput : public Shell {
 protected:
  void SetUp() override {
    done("sw-layers --size 200x100 --step 5 --layer 0:1500:0:1000 --layer 60:3000:1500:2200 -o m.nc");
    done("sw-layers --size 200x100 --step 5 --layer 40:3000:1500:2200 -o void.nc");
    done("sw-layers --size 200x100 --step 5 --layer 0:3000:2500:2200 --allow-auxetic -o auxetic.nc");
    write("out.sgy", "older");
  }
};

}  // namespace

TEST_F(ShootBadInput, IsRefusedBeforeAnythingIsComputed) {
  // An hour of waves would take far longer than this.
  const std::string endless =
      "timeout 10 sw-shoot m.nc -q --revision 1 --time 3000 --receivers 3,3 " + source;
  expect_refused(endless + "--dt 0.0500001 -o out.sgy", 2,
                 "sw-shoot: sample interval 0.0500001 s, SEG-Y revision 1 holds whole microseconds up to "
                 "65535; SEG-Y revision 2 "
                 "holds any (--time 3000, --dt 0.0500001; --revision 2, or a longer --dt)");
  expect_refused(endless + "--dt 0.05 -o nowhere/out.sgy", 1,
                 "sw-shoot: nowhere/out.sgy: No such file or directory");
  expect_refused(endless + "--dt 0.05 --every 1 --snapshots nowhere/s.nc -o out.sgy", 1,
                 "sw-shoot: nowhere/s.nc: No such file or directory");
  const Ran many = run(endless + "--dt 0.01 -o out.sgy");
  EXPECT_EQ(many.code, 2);
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

TEST_F(ShootBadInput, ASourceInTheCellsOfAFractureIsAWarning) {
  done("sw-layers --size 200x200 --step 5 --layer 0:3000:1700:2300 -o rock.nc");
  const auto warned = [&](const std::string& fracture, const std::string& depth) {
    done("sw-fracture rock.nc --segment 50,100:150,100 " + fracture + " --name crack -o cracked.nc");
    const Ran ran = run("sw-shoot cracked.nc --source 100," + depth +
                        " --wavelet ricker:20 --time 0.02 --receivers 100,20 -o cracked.sgy");
    EXPECT_EQ(ran.code, 0) << ran.err;
    return ran.err.find("warning: the source of shot 1 lies in cells of the fracture 'crack'") !=
           std::string::npos;
  };
  EXPECT_TRUE(warned("--compliance 1e-10,3e-10", "97"));
  EXPECT_TRUE(warned("--compliance 1e-10,3e-10", "104"));
  EXPECT_FALSE(warned("--compliance 1e-10,3e-10", "85"));
  EXPECT_FALSE(warned("--compliance 1e-10,3e-10 --faces", "97"));
}

TEST_F(ShootBadInput, AMomentThatLastsInAThinBedOrBelowWaterIsAWarning) {
  const auto warning = [&](const std::string& layers, const std::string& depth, const std::string& wavelet) {
    done("sw-layers --size 200x200 --step 5 " + layers + " -o rock.nc");
    const Ran ran = run("sw-shoot rock.nc --source 100," + depth + " --wavelet " + wavelet +
                        " --time 0.02 --receivers 100,20 -o rock.sgy");
    EXPECT_EQ(ran.code, 0) << ran.err;
    const std::string start = "warning: the moment of the source of shot 1 lasts, and ";
    const auto at = ran.err.find(start);
    return at == std::string::npos ? "" : ran.err.substr(at + start.size(), 23);
  };
  const std::string rock = "--layer 0:3000:1700:2300 ",
                    bed = rock + "--layer 100:4500:2500:2600 --layer 125:3000:1700:2300",
                    sea = "--layer 0:1500:0:1000 --layer 50:3000:1700:2300";
  EXPECT_EQ(warning(bed, "112", "gauss:20"), "its rock is 5 cells thi");
  EXPECT_EQ(warning(sea, "112", "gauss:20"), "water above rock may ke");
  EXPECT_EQ(warning(sea, "112", "ricker:20"), "");
  EXPECT_EQ(warning(sea, "20", "gauss:20"), "");
  EXPECT_EQ(warning(rock, "112", "gauss:20"), "");
}

TEST_F(ShootBadInput, ALongRunInAClosedBoxOfUnlikeRocksIsAWarning) {
  const auto warned = [&](const std::string& layers, const std::string& options) {
    done("sw-layers --size 40x40 --step 5 " + layers + " -o box.nc");
    const Ran ran =
        run("sw-shoot box.nc --source 20,10 --wavelet ricker:20 --time 14 --dt 0.1 --receivers 20,20 " +
            options + " -o box.sgy");
    EXPECT_EQ(ran.code, 0) << ran.err;
    return ran.err.find(
               "warning: no edge absorbs, and waves along interfaces of unlike rocks may gain up to 33 % "
               "of their amplitude in 11000 steps") != std::string::npos;
  };
  const std::string closed = "--sides free --time-step 0.001272727272727273 ",
                    unlike = "--layer 0:900:300:1800 --layer 20:3500:2000:2300";
  EXPECT_TRUE(warned(unlike, closed + "--bottom rigid"));
  EXPECT_FALSE(warned(unlike, closed + "--bottom absorbing"));
  EXPECT_FALSE(warned("--layer 0:3500:2000:2300", closed + "--bottom rigid"));
}

TEST_F(ShootBadInput, WavesTooShortForTheGridAreAWarningThatSaysTheCost) {
  const std::string line = shoot + "--source 100,50 --wavelet ricker:60 --receivers 3,3 --time 0.1 ";
  const Ran ran = run(line);
  EXPECT_EQ(ran.code, 0);
  EXPECT_EQ(ran.err.compare(0, 24, "sw-shoot: warning: only "), 0) << ran.err;
  EXPECT_NE(ran.err.find("cells per shortest P wavelength"), std::string::npos);
  EXPECT_NE(ran.err.find(" % per wavelength. Use cells of "), std::string::npos);
  EXPECT_NE(ran.err.find(" times the cost) or --error\n"), std::string::npos);
  done(line + "-q");
}

TEST_F(ShootBadInput, WhatOnlyLooksBadIsDone) {
  done(shoot + rest + "--amplitude -3");
  done("sw-shoot auxetic.nc --allow-auxetic -o out.sgy " + rest);
  done("sw-shoot void.nc -o out.sgy --wavelet ricker:15 --time 0.1 --source 100,60 --receivers 0,60");
  done("sw-layers --size 200x100 --step 5 --layer '0:3000:1500:2200 epsilon=0.2 delta=0.1' -o vti.nc");
  done("sw-shoot vti.nc -o out.sgy --kind plane:20 --top absorbing --without anisotropy " + shallow);
}

}  // namespace slipwave::shoot_bad_input_test
