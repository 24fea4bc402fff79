// SPDX-License-Identifier: BSD-3-Clause
#include <string>

#include "shell.hpp"

namespace slipwave::exchange_test {

// What docs/exchange.md promises beside its recipes, which the test house.exchange runs.

namespace {

class Exchange : public Shell {
 protected:
  void SetUp() override {
    done(
        "sw-layers --size 300x200 --step 5 --layer 0:2500:1250:2200 | sw-shoot - --source 100,20 --source "
        "200,20 "
        "--wavelet ricker:30 --receivers 0:300:25,10 --time 0.2 --record vx,vz -o gather.sgy");
  }
  bool has_segyio() const { return run("/usr/bin/python3 -c 'import segyio'").code == 0; }
  /// What Python says of a file after a recipe.
  std::string python(const std::string& program) const {
    write("program.py", program);
    return done("/usr/bin/python3 program.py");
  }
};

}  // namespace

TEST_F(Exchange, SegyioFindsSamplesAndPositionsWithoutGeometry) {
  if (!has_segyio()) GTEST_SKIP() << "python3-segyio is not there";
  EXPECT_EQ(
      python("import segyio\n"
             "with segyio.open('gather.sgy', ignore_geometry=True) as gather:\n"
             "    samples = gather.trace.raw[:]\n"
             "    x_m = gather.attributes(segyio.TraceField.GroupX)[:] / 10  # the scalar in byte 71 is -10\n"
             "print(samples.shape, x_m[:3], x_m.max())\n"),
      "(52, 201) [ 0. 25. 50.] 300.0\n");
}

TEST_F(Exchange, SegyioFindsTheSortingOfCubes) {
  if (!has_segyio()) GTEST_SKIP() << "python3-segyio is not there";
  const std::string program =
      "import segyio, numpy\n"
      "with segyio.open('cube.sgy') as f:\n"
      "    print(list(f.ilines), len(f.xlines), list(f.offsets), segyio.tools.cube(f).shape)\n";
  done("sw-sort gather.sgy --key fldr,tracf,trid | sw-convert --cube -o cube.sgy");
  EXPECT_EQ(python(program + "    whole = segyio.open('gather.sgy', ignore_geometry=True)\n"
                             "    vz = [t for t, h in zip(whole.trace.raw[:], whole.header)\n"
                             "          if h[9] == 2 and h[13] == 5 and h[29] == 12]\n"
                             "    print(numpy.array_equal(f.gather[2, 5, 12], vz[0]))\n"),
            "[1, 2] 13 [12, 14] (2, 13, 2, 201)\nTrue\n");
  expect_refused(
      "sw-convert gather.sgy --cube -o no.sgy", 1,
      "sw-convert: gather.sgy: trace 14: found shot 1, channel 1, vz behind shot 1, channel 13, vx; a "
      "cube needs the same traces of every shot, sorted by sw-sort --key fldr,tracf,trid");
  done(
      "sw-sort gather.sgy --key fldr,tracf,trid | sw-select --where 'not (fldr=2 and tracf=13)' -o part.sgy");
  expect_refused(
      "sw-convert part.sgy --cube -o no.sgy", 1,
      "sw-convert: part.sgy: shot 2 ends before channel 13, vz; a cube needs the same traces of every "
      "shot, sorted by sw-sort --key fldr,tracf,trid");
  // A volume: values where they belong, in-lines along y.
  done(
      "sw-layers --size 60x40x30 --step 10 --layer 0:1500:0:1000 --layer 15:3000:1500:2000:20 --fit none "
      "--no-average -o m.nc; "
      "sw-export m.nc --property vp -o cube.sgy");
  EXPECT_EQ(python(program + "    import netCDF4\n"
                             "    vp = netCDF4.Dataset('m.nc')['vp'][:].data  # z, y, x\n"
                             "    print(numpy.array_equal(segyio.tools.cube(f), vp.transpose(1, 2, 0)))\n"),
            "[1, 2, 3, 4] 6 [0] (4, 6, 3)\nTrue\n");
}

TEST_F(Exchange, SegyioOpensAnAreaOfReceiversByItsLines) {
  if (!has_segyio()) GTEST_SKIP() << "python3-segyio is not there";
  done(
      "sw-layers --size 100x80x60 --step 10 --layer 0:2000:1000:2000 | sw-shoot - -q --source 45,45,10 "
      "--source "
      "55,35,10 --wavelet ricker:20 --receivers 15:85:10,15:65:10,5 --time 0.02 --record vz,p -o area.sgy");
  done("sw-sort area.sgy --key gy,gx,fldr,trid | sw-convert --area -o cube.sgy");
  EXPECT_EQ(python("import segyio, numpy\n"
                   "with segyio.open('cube.sgy') as f:\n"
                   "    print(len(f.ilines), len(f.xlines), list(f.offsets), segyio.tools.cube(f).shape)\n"
                   "    whole = segyio.open('area.sgy', ignore_geometry=True)\n"
                   "    one = [t for t, h in zip(whole.trace.raw[:], whole.header)\n"
                   "           if h[9] == 2 and h[29] == 11 and h[85] == 350 // 10 and h[81] == 650 // 10]\n"
                   "    print(numpy.array_equal(f.gather[3, 6, 3], one[0]))\n"),
            "6 8 [1, 2, 3, 4] (6, 8, 4, 21)\nTrue\n");
  expect_refused(
      "sw-convert area.sgy --area -o no.sgy", 1,
      "sw-convert: area.sgy: trace 49: found a receiver at y=15 x=15 (bytes 85 and 81) behind one at y=65 "
      "x=85; an area needs the same records of every receiver, sorted by sw-sort --key gy,gx,fldr,trid");
}

TEST_F(Exchange, SegyioFindsTheSortingOfLinesAndWells) {
  if (!has_segyio()) GTEST_SKIP() << "python3-segyio is not there";
  const std::string program =
      "import segyio\n"
      "def show(name):\n"
      "    with segyio.open(name) as f:\n"
      "        print(list(f.ilines), list(f.xlines), list(f.offsets)[:2], segyio.tools.cube(f).shape)\n"
      "        whole = segyio.open(name, ignore_geometry=True)\n"
      "        last = f.gather[f.ilines[-1], f.xlines[-1], f.offsets[-1]]\n"
      "        assert (last == whole.trace[-1]).all()\n";
  const std::string wave = "--wavelet ricker:30 --time 0.1 -q ";
  done("sw-layers --size 300x200 --step 10 --layer 0:2500:1250:2200 -o m.nc");
  // A shot into a line, several components; a spread that moves; a well.
  done("sw-shoot m.nc --source 100,20 " + wave + "--receivers 0:300:50,10 --record vz,vx -o a.sgy");
  done("sw-shoot m.nc --source 100,20 --source 200,20 " + wave + "--receivers +20:+80:20,10 -o b.sgy");
  done("sw-shoot m.nc --source 100,20 " + wave + "--receivers 200,20:100:20 --record vz,vx -o c.sgy");
  EXPECT_EQ(python(program + "for name in ('a', 'b', 'c'): show(name + '.sgy')\n"),
            "[1] [12, 14] [-100, -50] (1, 2, 7, 101)\n"
            "[1, 2] [12, 14, 11] [20, 40] (2, 3, 4, 101)\n"
            "[12, 14] [1, 2, 3, 4, 5] [100] (2, 5, 101)\n");
  // A line in 3-D; and one component of it.
  done("sw-layers --size 200x120x100 --step 10 --layer 0:2500:1250:2200 -o m3.nc");
  done("sw-shoot m3.nc --source 95,65,85 " + wave + "--receivers 20:180:40,65,5 --record vx,vy,vz -o d.sgy");
  done("sw-select d.sgy --where component=vy -o e.sgy");
  EXPECT_EQ(python(program + "show('d.sgy'); show('e.sgy')\n"),
            "[1] [14, 13, 12] [-75, -35] (1, 3, 5, 101)\n[1] [13] [-75, -35] (1, 1, 5, 101)\n");
}

TEST_F(Exchange, RecipeOfOpendtectSortsOneComponentByMidpointAndOffset) {
  if (!has_segyio()) GTEST_SKIP() << "python3-segyio is not there";
  done("sw-select gather.sgy --where component=vz | sw-sort --key cdp,offset -o line.sgy");
  EXPECT_EQ(python("import segyio\n"
                   "f = segyio.open('line.sgy', ignore_geometry=True)\n"
                   "order = [(h[21], h[37]) for h in f.header]\n"
                   "print(len(order), order == sorted(order), {h[29] for h in f.header}, f.bin[3505])\n"),
            "26 True {12} 0\n");
}

TEST_F(Exchange, RecipeOfSeismicUnixLeavesHeadersAndNativeFloats) {
  if (!has_segyio()) GTEST_SKIP() << "python3-segyio is not there";
  done("sw-convert gather.sgy --su > gather.su; sw-convert < gather.su > back.sgy");
  EXPECT_EQ(python("import numpy, segyio\n"
                   "f = segyio.open('gather.sgy', ignore_geometry=True)\n"
                   "raw = numpy.fromfile('gather.su', numpy.uint8).reshape(52, 240 + 4 * 201)\n"
                   "samples = raw[:, 240:].copy().view('=f4')\n"
                   "shots = raw[:, 8:12].copy().view('=i4')[:, 0]\n"
                   "print((samples == f.trace.raw[:]).all(), (shots == f.attributes(9)[:]).all(),\n"
                   "      raw[:, 180:240].any())\n"),
            "True True False\n");
  done("sw-compare back.sgy gather.sgy --tolerance 0 > /dev/null");
}

}  // namespace slipwave::exchange_test
