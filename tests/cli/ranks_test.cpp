// SPDX-License-Identifier: BSD-3-Clause
#include <string>

#include "shell.hpp"

namespace slipwave::ranks_test {
namespace {

/// sw-shoot under the launcher of an MPI, where there is one.
class ShotByRanks : public Shell {
 protected:
  void SetUp() override {
    if (on_ranks(1).empty()) GTEST_SKIP() << "sw-shoot was built without MPI";
    done(
        "sw-layers --size 800x900 --step 5 --layer 0:1500:0:1000 --layer 100:3000:1600:2200 | "
        "sw-fracture - --box 300:500,200:700 --dip 30 --friction 0.3 --viscosity 0.01 --name cracks -o m.nc");
  }
  /// What the launcher itself says is not the tool's.
  static std::string line(int ranks, const std::string& arguments) {
    return on_ranks(ranks) + "sw-shoot " + arguments;
  }
  /// Expects so many ranks to write the file that one process does.
  void expect_same_traces(int ranks, const std::string& arguments) {
    done("sw-shoot " + arguments + "-o alone.sgy");
    const auto ran = run(line(ranks, arguments + "-o together.sgy"));
    EXPECT_EQ(ran.code, 0) << ran.err;
    done("cmp alone.sgy together.sgy");
  }
  /// Of stderr the lines of the tool.
  static std::string said(const Ran& ran) {
    std::string lines;
    for (std::size_t begin = 0; begin < ran.err.size();) {
      const auto end = std::min(ran.err.find('\n', begin), ran.err.size() - 1) + 1;
      if (ran.err.compare(begin, 9, "sw-shoot:") == 0) lines += ran.err.substr(begin, end - begin);
      begin = end;
    }
    return lines;
  }
  const std::string shots =
      "m.nc --source 390,310 --source 200,50 --source 600,600 --wavelet ricker:25 --time 0.3 "
      "--receivers 0:800:20,10 --receivers 395,20 ";
};

}  // namespace

TEST_F(ShotByRanks, IsTheSameFileAsOfOneProcess) {
  done("sw-shoot " + shots + "-o alone.sgy");
  for (const std::string groups : {"0", "1", "2", "4"}) {
    const auto ran = run(line(4, shots + "--ranks-per-shot " + groups + " -o together.sgy"));
    EXPECT_EQ(ran.code, 0) << ran.err;
    EXPECT_EQ(said(ran), "");
    EXPECT_EQ(done("cmp alone.sgy together.sgy"), "") << groups;
  }
  done("sw-shoot " + shots + "-o 'a-{shot}-{component}.sgy'");
  run(line(2, shots + "-o 'b-{shot}-{component}.sgy'"));
  for (const std::string name : {"1-vz", "2-p", "3-vx"})
    done("sw-diff -q a-" + name + ".sgy b-" + name + ".sgy -o d.sgy && cmp <(tail -c +3601 a-" + name +
         ".sgy) <(tail -c +3601 b-" + name + ".sgy)");
}

TEST_F(ShotByRanks, TakesTheSameSnapshotsAndSaysTheSame) {
  const std::string watched =
      "m.nc --source 390,310 --wavelet ricker:25 --time 0.2 --receivers 10,10 "
      "--snapshots s.nc --every 0.05 --fields vx,curl,slip --balance -o t.sgy";
  const auto alone = run("sw-shoot " + watched);
  done("mv s.nc alone.nc; mv t.sgy alone.sgy");
  const auto ran = run(line(3, watched));
  EXPECT_EQ(ran.code, 0) << ran.err;
  EXPECT_EQ(said(ran), alone.err);
  done("cmp alone.nc s.nc && cmp alone.sgy t.sgy");
}

TEST_F(ShotByRanks, IsTheSameWhereFracturesLieOnFaces) {
  done("sw-layers --size 400x500 --step 5 --layer 0:3000:1600:2200 -o f.nc");
  const auto expect_same = [&] {
    const std::string shot =
        "f.nc --source 150,100 --wavelet ricker:40 --amplitude 1e9 --time 0.15 --receivers 200,248 "
        "--receivers 100:300:100,400 ";
    expect_same_traces(2, shot);
  };
  done("sw-fracture f.nc --segment 200,150:200,400 --faces --compliance 1e-10,1e-10 -o f.nc");
  expect_same();
  done(
      "sw-fracture f.nc --segment 260,100:260,400 --segment 100,250:190,250 --faces --friction 0.2 "
      "--viscosity 1 --spacing 5 --opening --prestress=-10,-10,1 -o f.nc");
  expect_same();
  done(
      "sw-fracture f.nc --segment 150,120:150,420 --faces --friction 0.5 --viscosity 0 --law "
      "slip-weakening:0.1:1e-6 --prestress=-100,-100,10 -o f.nc");
  expect_same();
}

TEST_F(ShotByRanks, IsTheSameWhereEachShootsInBands) {
  done("sw-layers --size 240x120 --step 1 --layer 0:600:300:1800 --layer 30:2400:1200:2200 -o b.nc");
  const std::string shots_in_bands =
      "b.nc --source 60,10 --source 180,50 --wavelet ricker:20 --time 0.1 --receivers 20:220:40,0 -q "
      "--bands ";
  expect_same_traces(2, shots_in_bands + "0:1,30:4 ");
  expect_same_traces(3, shots_in_bands + "auto ");  // one has no shot: all cannot share these rows
}

TEST_F(ShotByRanks, IsTheSameWhereTheyShareAShotInBands) {
  done("sw-layers --size 240x180 --step 1 --layer 0:600:300:1800 --layer 60:2400:1200:2200 -o b.nc");
  const std::string shot =
      "b.nc --source 120,10 --wavelet ricker:20 --time 0.1 --receivers 20:220:40,0 --receivers 100,70 -q "
      "--bands 0:1,60:4 --snapshots s.nc --every 0.05 ";
  done("sw-shoot " + shot + "-o s.sgy && mv s.nc alone.nc && mv s.sgy alone.sgy");
  for (const std::string ranks : {"", "--ranks-per-shot 3 "}) {
    const auto ran = run(line(3, shot + ranks + "-o s.sgy"));
    EXPECT_EQ(ran.code, 0) << ran.err;
    done("cmp alone.nc s.nc && cmp alone.sgy s.sgy");
  }
  // Where no bands are found they share the rows of the model.
  const std::string one_rock =
      "m.nc --source 390,310 --wavelet ricker:25 --time 0.1 --receivers 10,10 -q --bands auto ";
  expect_same_traces(2, one_rock);
}

TEST_F(ShotByRanks, InThreeDimensionsToo) {
  done("sw-layers --size 120x100x300 --step 5 --layer 0:3000:1600:2200 --layer 150:4000:2300:2500 -o c.nc");
  const std::string cube =
      "c.nc --source 60,52,80 --kind force:1,2,3 --wavelet ricker:40 --time 0.06 "
      "--receivers 10:110:50,20:80:30,3 --edge-width 6 ";
  expect_same_traces(3, cube);
}

TEST_F(ShotByRanks, SaysOnceWhatIsWrong) {
  const auto expect = [&](const std::string& arguments, int code, const std::string& message) {
    const auto ran = run(line(3, arguments));
    EXPECT_EQ(said(ran), "sw-shoot: " + message + "\n") << ran.err;
    EXPECT_EQ(ran.code, code);
    EXPECT_EQ(files(), "m.nc");
  };
  expect("none.nc --source 1,1 --wavelet ricker:25 --time 1 --receivers 1,1 -o o.sgy", 1,
         "none.nc: No such file or directory");
  expect("m.nc --source 900,1 --wavelet ricker:25 --time 1 --receivers 1,1 -o o.sgy", 2,
         "source 1 at x=900 z=1 lies outside the model, expected x=0..800 z=0..900");
  expect(
      "m.nc --source 400,10 --kind plane:0 --top absorbing --wavelet ricker:25 --time 1 --receivers 1,1 "
      "-o o.sgy",
      2, "found a plane wave and 3 processes a shot, expected a point source or --ranks-per-shot 1");
  expect(shots + "--ranks-per-shot 2 -o o.sgy", 2,
         "found --ranks-per-shot 2 and 3 processes, expected a number that divides them");
  expect(shots + "--keep-unstable", 2,
         "found --keep-unstable and an output to standard output, expected the name of a file");
  expect(shots + "--checkpoint c -o o.sgy", 2, "--checkpoint does not work with 3 processes; use one");
  expect(
      shots + "--bands 0:5,100:20 --order 11 --ranks-per-shot 3 -q -o o.sgy", 2,
      "found 3 processes a shot for bands of 20 and 40 rows, expected at most 2: each takes 14 or more of a "
      "band that it shares");
  expect(shots + "--bands 0:5,101:10 -q -o o.sgy", 2,
         "--bands: found a band from z=101 m on, where no row of cells of 5 m begins, expected it at an "
         "interface that rows follow, or at a multiple of the cells of both bands");
  expect("- " + shots.substr(5) + "-o o.sgy", 2,
         "a model from standard input does not work with 3 processes; give the name of a file");
}

TEST_F(ShotByRanks, KeepsWhatAnUnstableShotRecorded) {
  // As UnstableRun: beyond single precision.
  const auto ran = run("LD_PRELOAD=" SLIPWAVE_SHIM " SLIPWAVE_FAULT=unit " +
                       line(2,
                            "m.nc --source 390,310 --wavelet ricker:25 --time 0.4 --receivers 10,10 "
                            "--amplitude 1e38 --keep-unstable -o o.sgy"));
  EXPECT_EQ(ran.code, 3);
  EXPECT_NE(said(ran).find("the simulation became unstable at x="), std::string::npos) << ran.err;
  EXPECT_NE(said(ran).find("is in unstable-o.sgy\n"), std::string::npos) << ran.err;
  EXPECT_EQ(files(), "m.nc unstable-o.sgy");
}

}  // namespace slipwave::ranks_test
