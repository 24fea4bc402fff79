// SPDX-License-Identifier: BSD-3-Clause
#include <sys/stat.h>

#include <cstdlib>
#include <random>
#include <string>

#include "shell.hpp"

namespace slipwave::checkpoint_test {
namespace {

/// A run of about a tenth of a second with cracks, and what it gives when nobody disturbs it.
class Checkpoint : public Shell {
 protected:
  Checkpoint() {
    done(
        "sw-layers --size 750x600 --step 5 --layer 0:1500:0:1000 --layer 200:3000:1600:2200:3 --fit none | "
        "sw-fracture - --box 250:450,300:350 --dip 30 --friction 0.1 --viscosity 4e3 -o m.nc");
  }
  const std::string scene = "sw-shoot m.nc --source 350,50 --wavelet ricker:20 --receivers 0:750:50,20 ";
  const std::string shoot = scene + "--time 0.8 --threads 1 ";
  const std::string two_shots = scene + "--time 0.6 --threads 1 --source 300,60 ";
  const std::string often = "--checkpoint c --checkpoint-every 0.01 ";

  const std::string seldom = "--checkpoint c --checkpoint-every 0.02 ";
  /// Begins a line in the background and waits until it has put a file there for the n-th time, where it
  /// stops by itself, however busy the machine is.
  static std::string held_at(const std::string& file, int times, const std::string& line) {
    // A shell's background children ignore INT unless they are jobs, and of jobs it waits for a stop, too.
    return "set -m; LD_PRELOAD=" SLIPWAVE_SHIM " SLIPWAVE_FAULT=hold:" + file + ':' + std::to_string(times) +
           ' ' + line +
           "& tool=$!; set +m; await 'grep -q \"^State:.T\" /proc/$tool/status || ! kill -0 $tool'; ";
  }
  /// Ends a line by a signal there.
  Ran ended_at(const std::string& file, int times, const std::string& line, const std::string& signal) const {
    return run(held_at(file, times, line) + "kill -" + signal +
               " $tool; kill -CONT $tool 2> $TMPDIR/gone; wait $tool");
  }
  /// Ends a line by a signal some seconds after it was begun, or after it has written a checkpoint; its exit
  /// code, what it said in `said`.
  int ended(const std::string& line, const std::string& signal, double after_s, std::string& said,
            bool after_checkpoint = false) const {
    const std::string written = "while kill -0 $tool 2> gone && ! [ c -nt begun ]; do sleep 0.003; done; ";
    const Ran ran = run("touch begun; " + line + "& tool=$!; " + (after_checkpoint ? written : "") +
                        "sleep " + std::to_string(after_s) + "; kill -" + signal +
                        " $tool 2> gone; wait $tool; code=$?; rm gone begun; exit $code");
    said = ran.err;
    return ran.code;
  }
  /// The step at which a run says it continues, 0 where it says nothing.
  static long step_of(const std::string& said) {
    const std::string before = "at step ";
    const auto at = said.find(before);
    return said.find("continues from") == std::string::npos || at == std::string::npos
               ? 0
               : std::atol(said.c_str() + at + before.size());
  }
};

}  // namespace

TEST_F(Checkpoint, ARunThatIsKilledAnywhereGoesOnToTheSameOutputs) {
  const std::string outputs = "--snapshots s.nc --every 0.05 -o out.sgy ";
  const std::string shoot = scene + "--time 1.6 --threads 1 ";
  done(shoot + outputs + "; mv out.sgy whole.sgy; mv s.nc whole.nc");
  write("out.sgy", "older");
  std::mt19937 engine(9);
  std::uniform_real_distribution<double> moment(0.01, 0.15);
  const int wanted = long_form() ? 50 : 6;
  int kills = 0, went_on = 0;
  long step = 0;
  for (int runs = 0; kills < wanted && runs < 4 * wanted; ++runs) {
    std::string said;
    const int code = ended("ulimit -c 0; " + shoot + outputs + often, "KILL",
                           moment(engine) / (runs % 2 ? 3 : 1), said, runs % 2);
    if (code == 0) {  // done before that moment: from the beginning
      done("cmp out.sgy whole.sgy && cmp s.nc whole.nc && echo older > out.sgy && rm s.nc");
      EXPECT_EQ(files(), "m.nc out.sgy whole.nc whole.sgy");
      step = 0;
      continue;
    }
    ASSERT_EQ(code, 128 + 9) << said;
    ++kills;
    // Nothing is lost that a checkpoint knew of, and no output is half there.
    if (const long at = step_of(said); at > 0) {
      EXPECT_GE(at, step) << said;
      step = at;
      ++went_on;
    }
    const auto out = content("out.sgy");
    EXPECT_TRUE(out.substr(0, 5) == "older" || out == content("whole.sgy")) << "after kill " << kills;
    EXPECT_TRUE(!exists("s.nc") || content("s.nc") == content("whole.nc")) << "after kill " << kills;
  }
  EXPECT_EQ(kills, wanted);
  EXPECT_GE(went_on, wanted / 4);
  const Ran last = run(shoot + outputs + often);
  EXPECT_EQ(last.code, 0) << last.err;
  done("cmp out.sgy whole.sgy && cmp s.nc whole.nc");
  EXPECT_EQ(files(), "m.nc out.sgy s.nc whole.nc whole.sgy");
}

TEST_F(Checkpoint, ASignalWritesOneAndShowsInTheExitStatus) {
  done(shoot + "-o whole.sgy");
  for (const auto& [name, number] : {std::pair("TERM", 15), std::pair("INT", 2), std::pair("HUP", 1)}) {
    write("out.sgy", "older");
    const std::string line = shoot + "-o out.sgy " + seldom;
    const Ran ran = ended_at("c", 1, line, name);
    EXPECT_EQ(ran.code, 128 + number);
    EXPECT_NE(
        ran.err.find("sw-shoot: ended by signal " + std::to_string(number) + "; c holds shot 1 at step "),
        std::string::npos)
        << ran.err;
    EXPECT_EQ(files(), "c c.1 m.nc out.sgy whole.sgy");
    EXPECT_EQ(content("out.sgy"), "older");
    const Ran rest = run(line);
    EXPECT_EQ(rest.code, 0);
    EXPECT_GT(step_of(rest.err), 0) << rest.err;
    EXPECT_EQ(rest.err.find('\n'), rest.err.size() - 1) << rest.err;
    done("cmp out.sgy whole.sgy");
    EXPECT_EQ(files(), "m.nc out.sgy whole.sgy");
  }
}

TEST_F(Checkpoint, ASecondSignalEndsTheRunAtOnce) {
  // Hardly anything is read of what is written at the end, so the run hangs there.
  const Ran ran =
      run("mkfifo pipe; exec 3<> pipe; sw-shoot m.nc --source 350,50 --wavelet ricker:20 "
          "--receivers 0:750:5,20 --time 0.05 --dt 0.0001 --checkpoint c > pipe & tool=$!; "
          "timeout 60 head -c 1 <&3 > first; kill -TERM $tool; "
          "await '! grep -q \"^...Pnd:.*[1-9a-f]\" /proc/$tool/status'; "
          "timeout 60 head -c 200000 <&3 | wc -c; kill -TERM $tool; wait $tool");
  // More than a pipe holds: it went on writing after the first signal.
  EXPECT_EQ(ran.out, "200000\n");
  EXPECT_EQ(ran.code, 128 + 15);
}

TEST_F(Checkpoint, WithoutOneASignalLeavesNothing) {
  const Ran ran = run(scene +
                      "--time 30 --threads 1 --snapshots s.nc --every 0.05 -o out.sgy & tool=$!; "
                      "await 'ls .out.sgy* .s.nc* > $TMPDIR/seen 2>&1'; kill -TERM $tool; wait $tool");
  EXPECT_EQ(ran.code, 128 + 15);
  EXPECT_EQ(ran.err, "");
  EXPECT_EQ(files(), "m.nc");
}

TEST_F(Checkpoint, NothingIsStreamedBeforeAllIsDone) {
  done(shoot + "-o whole.sgy");
  const std::string line = shoot + "-o - " + seldom;
  const Ran ran = ended_at("c", 1, line + "> part", "TERM");
  EXPECT_EQ(ran.code, 128 + 15);
  EXPECT_EQ(content("part"), "");
  EXPECT_EQ(run(line + "> rest").code, 0);
  done("cmp rest whole.sgy");
}

TEST_F(Checkpoint, ShotsThatAreDoneAreNotShotAgain) {
  const std::string shots = scene + "--time 0.6 --threads 3 --source 300,60 --source 500,70 ";
  // Names that split what is recorded stand in the history.
  done(shots + "-o 'out{shot}.sgy'; for i in 1 2 3; do mv out$i.sgy whole$i.sgy; done");
  for (const std::string parallel : {"1", "2", "3"}) {
    const std::string line = shots + seldom + "--shots-in-parallel " + parallel + " -o 'out{shot}.sgy' ";
    const Ran ran = parallel == "1" ? ended_at("out1.sgy", 1, line, "TERM") : ended_at("c", 2, line, "TERM");
    ASSERT_EQ(ran.code, 128 + 15) << ran.err;
    const auto first = parallel == "1" ? done("stat -c '%i %y' out1.sgy") : "";
    const Ran rest = run(line);
    EXPECT_EQ(rest.code, 0) << rest.err;
    EXPECT_NE(rest.err.find(" of 3 shots done"), std::string::npos) << rest.err;
    if (parallel == "1") {
      EXPECT_NE(rest.err.find(" 1 of 3 shots done"), std::string::npos) << rest.err;
      EXPECT_EQ(done("stat -c '%i %y' out1.sgy"), first);
    }
    for (const std::string shot : {"1", "2", "3"}) done("cmp out" + shot + ".sgy whole" + shot + ".sgy");
    done("rm out?.sgy");
    EXPECT_EQ(files(), "m.nc whole1.sgy whole2.sgy whole3.sgy");
  }
}

TEST_F(Checkpoint, AFileOfAFinishedShotThatIsGoneIsMadeAgain) {
  const std::string line =
      two_shots + "--snapshots 's{shot}.nc' --every 0.1 " + seldom + "-o 'out{shot}.sgy' ";
  done(two_shots +
       "--snapshots 's{shot}.nc' --every 0.1 -o 'out{shot}.sgy'; "
       "for i in 1 2; do mv out$i.sgy whole$i.sgy; mv s$i.nc whole$i.nc; done");
  for (const std::string gone : {"out1.sgy", "s1.nc"}) {
    EXPECT_EQ(ended_at("out1.sgy", 1, line, "TERM").code, 128 + 15);
    const Ran rest = run("rm " + gone + "; " + line);
    EXPECT_EQ(rest.code, 0) << rest.err;
    for (const std::string shot : {"1", "2"})
      done("cmp out" + shot + ".sgy whole" + shot + ".sgy && cmp s" + shot + ".nc whole" + shot + ".nc");
    done("rm out?.sgy s?.nc");
    EXPECT_EQ(files(), "m.nc whole1.nc whole1.sgy whole2.nc whole2.sgy");
  }
}

TEST_F(Checkpoint, TheOlderOneServesToo) {
  done(shoot + "--snapshots s.nc --every 0.05 -o whole.sgy; mv s.nc whole.nc");
  const std::string line = shoot + often + "--snapshots s.nc --every 0.05 -o out.sgy ";
  for (const std::string loss : {"mv c.1 c", "rm c"}) {
    EXPECT_EQ(ended_at("c", 2, line, "KILL").code, 128 + 9);
    const Ran rest = run(loss + "; " + line);
    EXPECT_EQ(rest.code, 0) << rest.err;
    EXPECT_GT(step_of(rest.err), 0) << rest.err;
    done("cmp out.sgy whole.sgy && cmp s.nc whole.nc");
    EXPECT_EQ(files(), "m.nc out.sgy s.nc whole.nc whole.sgy");
  }
}

TEST_F(Checkpoint, ADiskWithoutRoomForOneIsSaidAndDoesNotEndTheRun) {
  done(shoot + "-o whole.sgy");
  const Ran ran = run("(ulimit -f 400; " + shoot + "-o out.sgy " + seldom + "2>&1) | cat");
  EXPECT_EQ(ran.code, 0);
  EXPECT_EQ(ran.out.find("sw-shoot: warning: c: File too large; the checkpoint was not written"), 0u)
      << ran.out;
  done("cmp out.sgy whole.sgy");
  EXPECT_EQ(files(), "m.nc out.sgy whole.sgy");
  expect_refused(shoot + "--checkpoint no/c -o out.sgy", 1, "sw-shoot: no/c: No such file or directory");
}

TEST_F(Checkpoint, ASecondRunDoesNotTouchTheCheckpointOfTheFirst) {
  const std::string line = shoot + seldom + "-o ";
  const Ran ran = run(held_at("c", 1, line + "first.sgy 2> first") + line +
                      "second.sgy; code=$?; ls -A > there; kill -KILL $tool; wait $tool; exit $code");
  EXPECT_EQ(ran.code, 1);
  EXPECT_EQ(ran.err.substr(0, ran.err.find('\n')),
            "sw-shoot: c: is in use by another run, expected one at a time");
  EXPECT_EQ(content("first"), "");
  EXPECT_NE(content("there").find("c.lock"), std::string::npos);
  EXPECT_EQ(content("there").find("second.sgy"), std::string::npos);
  // The lock of a run that was killed keeps nobody out, and goes with the one that ends.
  EXPECT_TRUE(exists("c.lock"));
  const Ran next = ended_at("c", 1, line + "out.sgy", "TERM");
  EXPECT_EQ(next.code, 128 + 15) << next.err;
  EXPECT_GT(step_of(next.err), 0) << next.err;
  EXPECT_FALSE(exists("c.lock"));
}

TEST_F(Checkpoint, OneOfAnotherRunOrDamagedIsRefusedAndStaysAsItIs) {
  done(
      "sw-layers --size 750x600 --step 5 --layer 0:1500:0:1000 --layer 200:3000:1500:2200:3 --fit none -o "
      "other.nc");
  ASSERT_EQ(ended_at("c", 1, shoot + "-o out.sgy " + seldom, "TERM").code, 128 + 15);
  const auto before = content("c");
  const std::string rest = " --checkpoint c -o out.sgy", begin = "sw-shoot: c: is of a run with ";
  const std::string anew = "; remove it to begin anew";
  std::string model = shoot;
  model.replace(model.find("m.nc"), 4, "other.nc");
  const auto refused = [&](const std::string& line) {
    const Ran ran = run(line);
    EXPECT_EQ(ran.code, 1) << line;
    EXPECT_EQ(content("c"), before) << line;
    EXPECT_FALSE(exists("out.sgy")) << line;
    return ran.err;
  };
  EXPECT_EQ(refused(model + rest).find(begin), 0u);
  EXPECT_EQ(refused(shoot + "--order 3" + rest), begin + "order 5, expected 3" + anew + "\n");
  EXPECT_EQ(refused(shoot + "--amplitude 2" + rest), begin + "another source or wavelet" + anew + "\n");
  expect_refused(shoot + "--checkpoint-every 0" + rest, 2,
                 "sw-shoot: --checkpoint-every: found 0, expected it above 0");
  done("mv c whole; head -c 1000 whole > c");
  const Ran damaged = run(shoot + rest);
  EXPECT_EQ(damaged.code, 1);
  EXPECT_EQ(damaged.err.find("sw-shoot: c: is damaged or cut off"), 0u) << damaged.err;
  EXPECT_NE(damaged.err.find("; c.1 is the one before\n"), std::string::npos) << damaged.err;
  EXPECT_EQ(run("mv c.1 c; " + shoot + rest).code, 0);
}

TEST_F(Checkpoint, InADirectoryThatMayNotBeWrittenIsSaidBeforeAnythingIsComputed) {
  const bool root = run("test $(id -u) -eq 0").code == 0;
  const std::string as = root ? "setpriv --reuid 65534 --regid 65534 --clear-groups " : "";
  done(
      "mkdir closed bin; cp $(dirname $(command -v sw-shoot))/sw-shoot bin; chmod 755 . .. bin; chmod 644 "
      "m.nc; chmod 555 closed");
  if (root && run(as + "bin/sw-shoot --version > version").code != 0)
    GTEST_SKIP() << "cannot run as another user here";
  expect_refused(as + "bin/" + shoot + "--checkpoint closed/c -o /dev/null", 1,
                 "sw-shoot: closed/c: Permission denied");
}

}  // namespace slipwave::checkpoint_test
