// SPDX-License-Identifier: BSD-3-Clause
#include <string>

#include "shell.hpp"

namespace slipwave::export_test {
namespace {

class Export : public Shell {
 protected:
  Export() {
    done(
        "sw-layers --size 300x200 --step 2.5 --layer 0:1500:0:1000 --layer 45:3000:1600:2300:10 --fit none | "
        "sw-fracture - --box 100:200,120:150 --dip 30 --friction 0.1 --viscosity 0 -o m.nc");
  }
};

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

}  // namespace

TEST_F(Export, OfAModelIsImportedAgainBitByBit) {
  done("for p in vp vs rho; do sw-export m.nc --property $p -o $p.sgy; done");
  done("sw-import --vp vp.sgy --vs vs.sgy --rho rho.sgy --step 2.5 -o again.nc");
  // columns by column, whatever a file of netCDF looks like inside
  for (const std::string property : {"vp", "vs", "rho"})
    done("for m in m again; do sw-export $m.nc --property " + property +
         " | tail -c +3201 | cksum; done | uniq | wc -l | grep -qx 1");
  EXPECT_TRUE(has(done("sw-export m.nc --property fracture | sw-info -"), ", amplitude 0 to 1, rms "));
}

TEST_F(Export, GoesOnThroughTheOtherTools) {
  const auto info =
      done("sw-export m.nc --property vp | sw-select --where 'cdp=11:20' --time 0.05:0.1 | sw-info -");
  EXPECT_TRUE(has(info, "traces           10\n")) << info;
  EXPECT_TRUE(has(info, "samples a trace  21\n")) << info;
  EXPECT_TRUE(has(info, "receiver x       26.25 to 48.75 m\n")) << info;
}

TEST_F(Export, TakesOneSnapshot) {
  done(
      "sw-shoot m.nc --source 150,20 --wavelet ricker:10 --receivers 0:300:100,10 --time 0.2 --snapshots "
      "s.nc "
      "--every 0.05 --fields vz,p -o /dev/null -q");
  const auto text = [&](const std::string& time) {
    return done("sw-export s.nc --property p" + time +
                " -o p.sgy; dd if=p.sgy bs=3200 count=1 conv=ascii status=none");
  };
  EXPECT_TRUE(has(text(" --time 0.09"), "Section in depth: p at 0.1")) << text(" --time 0.09");
  EXPECT_TRUE(has(text(""), "Section in depth: p at 0.2")) << text("");
  EXPECT_TRUE(has(text(""), "sw-layers --size 300x200"));
}

TEST_F(Export, OfFittedGridsHasTrueDepths) {
  const std::string layers =
      " --size 300x200 --step 2.5 --layer sine,21,8,200:1500:0:1000 --layer "
      "90:3000:1600:2300:10 --layer 170:4000:2300:2500 ";
  done("sw-layers -q" + layers + "-o fitted.nc; sw-layers --fit none --no-average" + layers +
       "-o regular.nc");
  EXPECT_TRUE(has(done("sw-info fitted.nc"), "fitted horizons"));
  const std::string note =
      "sw-export: fitted.nc: rows follow horizons; resampled to 120 x 80 cells of 2.5 m in regular depth, ";
  for (const std::string property : {"vp", "vs", "rho"})
    EXPECT_EQ(run("sw-export fitted.nc --property " + property + " -o " + property + ".sgy").err,
              note + "each takes the cell its centre lies in; 0 above the surface\n");
  done("sw-import --vp vp.sgy --vs vs.sgy --rho rho.sgy --step 2.5 -o again.nc");
  // The regular model takes the material at the centre of every cell, too: the same within a cell of an
  // interface, of which a column has three.
  const auto differing = std::stoi(
      done("for m in again regular; do ncdump -v rho $m.nc | sed '1,/^data:/d' | tr -d ' \\n' | tr , '\\n' > "
           "$m; done; diff again regular | grep -c '^<' || true"));
  EXPECT_LE(differing, 40);
  EXPECT_TRUE(has(done("sw-info again.nc"), "void cells"));
}

TEST_F(Export, OfSnapshotsOnFittedGridsHasTrueDepths) {
  done(
      "sw-layers -q --size 300x200 --step 2.5 --layer sine,21,8,200:3000:1600:2300 -o fitted.nc; "
      "sw-shoot fitted.nc --source 150,100 --wavelet ricker:30 --receivers 0:300:100,60 --time 0.05 "
      "--snapshots s.nc --every 0.05 --fields vz -o /dev/null -q");
  const Ran ran = run("sw-export s.nc --property vz -o vz.sgy");
  EXPECT_EQ(ran.code, 0);
  EXPECT_EQ(ran.err,
            "sw-export: s.nc: rows follow horizons; resampled to 120 x 80 cells of 2.5 m in regular depth, "
            "linearly between cells; 0 above the surface\n");
  const auto info = done("sw-info vz.sgy");
  EXPECT_TRUE(has(info, "samples a trace  80\n")) << info;
}

TEST_F(Export, RefusesWhatItCannotExport) {
  struct Case {
    std::string line;
    int code;
    std::string message;
  };
  const Case cases[] = {
      {"sw-export m.nc", 2, "sw-export: --property is missing; expected --property NAME"},
      {"sw-export m.nc --property vx", 2,
       "sw-export: --property: m.nc is a model: found 'vx', expected vp, vs, rho, qp, qs, epsilon, delta, "
       "gamma, epsilon1, delta1, delta3, gamma2, tilt, azimuth, rotation, cut_epsilon, cut_delta, cut_dip, "
       "c11, c12, c13, c14, c15, c16, c22, c23, c24, c25, c26, c33, c34, c35, c36, c44, c45, c46, c55, c56, "
       "c66 "
       "or fracture"},
      {"sw-export m.nc --property vp --time 1", 2, "sw-export: --time: m.nc is a model, expected snapshots"},
      {"sw-export none.nc --property vp", 1, "sw-export: none.nc: No such file or directory"},
      {"sw-export m.nc --property vp --format double", 2,
       "sw-export: m.nc: sample format double exists since revision 2, the file is of revision 1"},
      {"sw-export m.nc --property vp --format float9", 2,
       "sw-export: --format: sample format \"float9\", expected one of ibm, int32, int16, ieee, double, "
       "int24, int8, "
       "int64, uint32, uint16, uint64, uint24, uint8"},
      {"sw-export m.nc --property rho --format int8", 1,
       "sw-export: m.nc: trace 1: sample 1: 1000 does not fit a signed integer of 8 bits"},
  };
  for (const auto& one : cases) {
    expect_refused(one.line + " -o out.sgy", one.code, one.message);
    EXPECT_FALSE(exists("out.sgy")) << one.line;
  }
}

}  // namespace slipwave::export_test
