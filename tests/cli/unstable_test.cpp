// SPDX-License-Identifier: BSD-3-Clause
#include <string>

#include "shell.hpp"

namespace slipwave::unstable_test {
namespace {

/// A source so strong that the numbers of single precision end while it acts, as the unit of the fields is
/// made to stay that of SI. In double precision the same shot goes well.
class UnstableRun : public Shell {
 protected:
  UnstableRun() {
    done(
        // Values at faces overflow first; uniform runs compute none.
        "sw-layers --size 1000x800 --step 5 --layer 0:1500:0:1000 --layer 300:3000:1600:2200 "
        "$(for z in 330 340 350 360; do echo --layer $z:2999:1600:2200 --layer $((z + 5)):3000:1600:2200; "
        "done) | "
        "sw-fracture - --box 400:600,400:450 --dip 30 --friction 0.1 --viscosity 4e3 --name cracks -o m.nc");
  }
  const std::string scene =
      "LD_PRELOAD=" SLIPWAVE_SHIM
      " SLIPWAVE_FAULT=unit sw-shoot m.nc --wavelet ricker:25 --receivers 0:1000:10,10 --amplitude 2.5e36 ";
  const std::string shoot = scene + "--time 0.4 --source 500,350 ";
  /// The second is in the water, where all is well.
  const std::string two_shots = scene + "--time 0.4 --source 500,350 --source 100,100 ";

  void expect_unstable(const Ran& ran, const std::string& begin, const std::string& end) const {
    EXPECT_EQ(ran.code, 3);
    EXPECT_EQ(ran.out, "");
    EXPECT_EQ(ran.err.find("sw-shoot: " + begin +
                           "the simulation became unstable at x=497.5 z=347.5, t=0.0465 s (step 31): v"),
              0u)
        << ran.err;
    EXPECT_NE(ran.err.find("; vp=3000 vs=1600 rho=2200, 5 m from the source, 45 m from "), std::string::npos)
        << ran.err;
    EXPECT_EQ(ran.err.find('\n'), ran.err.size() - 1) << ran.err;
    EXPECT_EQ(ran.err.substr(std::min(ran.err.rfind("; ") + 2, ran.err.size())), end + "\n") << ran.err;
  }
};

const std::string near_by =
    "vp=3000 vs=1600 rho=2200, 5 m from the source, 45 m from a fluid-solid interface";

}  // namespace

TEST_F(UnstableRun, EndsWithStatus3AndSaysWhereWithoutAnyOutput) {
  write("out.sgy", "older");
  const std::string line = shoot + "--snapshots s.nc --every 0.02 -o out.sgy ";
  for (const std::string more : {"", "-q --threads 1", "--threads 2"}) {
    expect_unstable(run(line + more), "", near_by);
    EXPECT_EQ(content("out.sgy"), "older");
    EXPECT_EQ(files(), "m.nc out.sgy");
  }
}

TEST_F(UnstableRun, KeepsWhatItRecordedUnderAnotherNameIfAsked) {
  write("out.sgy", "older");
  const std::string outputs = "--snapshots s.nc --every 0.02 --keep-unstable -o out.sgy ";
  expect_unstable(run(shoot + outputs), "",
                  "what it recorded until t=0.045 s is in unstable-out.sgy, unstable-s.nc");
  EXPECT_EQ(content("out.sgy"), "older");
  EXPECT_EQ(files(), "m.nc out.sgy unstable-out.sgy unstable-s.nc");
  // What comes without overflow is the same as far as it goes, and then there is nothing.
  done(shoot + "--precision double " + outputs);
  EXPECT_EQ(files(), "m.nc out.sgy s.nc unstable-out.sgy unstable-s.nc");
  for (const std::string file : {"out", "unstable-out"})
    done("sw-select " + file + ".sgy --time 0:0.035 -o " + file + ".begin");
  done("sw-compare out.begin unstable-out.begin --tolerance 1e-4 -o table");
  EXPECT_NE(run("sw-compare out.sgy unstable-out.sgy --tolerance 0.5 -o table").code, 0);
  done("sw-select unstable-out.sgy --time 0.046:0.4 -o rest");
  EXPECT_EQ(
      done("sw-info unstable-out.sgy | grep -c 'shot 1 became unstable: its samples after 0.045 s are zero'"),
      "1\n");
  EXPECT_EQ(done("sw-spectrum rest --text -o spectrum; grep -v '#' spectrum | awk '{ if ($2 != 0) n++ } END "
                 "{ print n + 0 }'"),
            "0\n");
  EXPECT_EQ(done("sw-info unstable-s.nc | grep -c 'of time 3,'"), "1\n");
}

TEST_F(UnstableRun, KeepsShotsThatAreDone) {
  // Files of their own are there as if nothing had happened to the others.
  for (const std::string parallel : {"1", "2"}) {
    const std::string line = two_shots + "--source 900,100 --threads 2 --shots-in-parallel " + parallel + " ";
    done(line + "--precision double -o 'whole{shot}.sgy'");
    const Ran ran = run(line + "--keep-unstable -o 'out{shot}.sgy'");
    expect_unstable(ran, "shot 1: ", "what it recorded until t=0.045 s is in unstable-out1.sgy");
    if (parallel == "2") done("sw-compare out2.sgy whole2.sgy --tolerance 1e-4 -o table; rm out2.sgy table");
    EXPECT_EQ(files(), "m.nc unstable-out1.sgy whole1.sgy whole2.sgy whole3.sgy");
  }
  // In one file the traces of the shot before are beside those of the unstable one.
  const std::string one =
      scene + "--time 0.4 --source 100,100 --source 500,350 --first-shot 2 --shots-in-parallel 1 ";
  expect_unstable(run(one + "--keep-unstable -o all.sgy"),
                  "shot 3: ", "what it recorded until t=0.045 s is in unstable-all.sgy");
  EXPECT_FALSE(exists("all.sgy"));
  done("sw-select unstable-all.sgy --where shot=2 -o second; sw-select whole2.sgy --where shot=2 -o two");
  done("sw-compare second two --tolerance 1e-4 -o table");
  EXPECT_EQ(done("sw-select unstable-all.sgy --where shot=3 | sw-info - | grep -c '^ *shots  *1$'"), "1\n");
}

TEST_F(UnstableRun, WhoseRemainsCanNotBeKeptIsStillUnstable) {
  done("mkdir unstable-out.sgy");
  const Ran ran = run(shoot + "--keep-unstable -o out.sgy");
  EXPECT_EQ(ran.code, 3);
  EXPECT_EQ(ran.err.find("sw-shoot: warning: unstable-out.sgy: is a directory, expected a file\n"
                         "sw-shoot: the simulation became unstable at "),
            0u)
      << ran.err;
  expect_refused(
      shoot + "--keep-unstable", 2,
      "sw-shoot: found --keep-unstable and an output to standard output, expected the name of a file");
}

TEST_F(UnstableRun, IsUnstableAgainWhenItGoesOnFromItsCheckpoint) {
  const std::string line = shoot + "--checkpoint c --checkpoint-every 0.00001 -o out.sgy";
  const Ran first = run(line);
  EXPECT_EQ(first.code, 3);
  EXPECT_TRUE(exists("c"));
  const Ran again = run(line);
  EXPECT_EQ(again.code, 3);
  EXPECT_EQ(again.err.find("sw-shoot: continues from c: shot 1 at step "), 0u) << again.err;
  EXPECT_EQ(again.err.substr(again.err.find('\n') + 1), first.err);
}

}  // namespace slipwave::unstable_test
