// SPDX-License-Identifier: BSD-3-Clause
#include <string>
#include <utility>

#include "shell.hpp"

namespace slipwave::model_fault_test {
namespace {

using ModelFault = Shell;

// 300 000 cells, so that the output does not fit any buffer on the way.
const std::string large =
    "sw-layers --size 3000x2500 --step 5 --layer 0:1500:0:1000 --layer 400:3000:1500:2200:5 --fit none ";
const std::string crack = "--box 500:2000,2000:2100 --dip 45 --friction 0.1 --viscosity 1 ";

}  // namespace

TEST_F(ModelFault, AFullDiskIsSaidInOneLine) {
  expect_refused(large + "-o /dev/full", 1, "sw-layers: /dev/full: No space left on device");
  expect_refused(large + "> /dev/full", 1, "sw-layers: standard output: No space left on device");
  expect_refused("sw-info /dev/null > /dev/full", 1,
                 "sw-info: /dev/null: is empty, expected a model, snapshots or a gather");
  done(large + "-o m.nc");
  expect_refused("sw-info m.nc > /dev/full", 1, "sw-info: standard output: No space left on device");
}

TEST_F(ModelFault, AFileSizeLimitIsSaidAndLeavesTheOlderFile) {
  done(large + "-o m.nc");
  write("out.nc", "older");
  for (const int kibibytes : {0, 1, 4, 10, 20, 30, 40}) {
    const std::string limit = "ulimit -f " + std::to_string(kibibytes) + "; ";
    // The limit would hold for the captured stderr too, so that goes through a pipe.
    const Ran ran = run("(" + limit + "sw-fracture m.nc " + crack + "-o out.nc 2>&1) | cat");
    EXPECT_EQ(ran.code, 1) << kibibytes;
    EXPECT_EQ(ran.out, "sw-fracture: out.nc: File too large\n") << kibibytes;
    EXPECT_EQ(content("out.nc"), "older") << kibibytes;
    EXPECT_EQ(files(), "m.nc out.nc") << kibibytes;
  }
}

TEST_F(ModelFault, AReaderThatLeavesEarlyEndsTheWriterQuietly) {
  EXPECT_EQ(run("sw-layers --size 3000x2500 --step 2.5 --layer 0:1500:0:1000 --layer 400:3000:1500:2200:5 "
                "--fit none | "
                "head -c "
                "100 > part; echo ${PIPESTATUS[0]}; wc -c < part")
                .out,
            "141\n100\n");
  const Ran quiet = run(
      "sw-layers --size 3000x2500 --step 2.5 --layer 400:3000:1500:2200:5 --fit none | head -c 100 > part");
  EXPECT_NE(quiet.code, 0);
  EXPECT_EQ(quiet.err, "");
  // Also where the parent ignores SIGPIPE.
  const Ran ignoring =
      run("trap '' PIPE; sw-layers --size 3000x2500 --step 2.5 --layer 400:3000:1500:2200:5 --fit none | "
          "head -c 100 > "
          "part");
  EXPECT_NE(ignoring.code, 0);
  EXPECT_EQ(ignoring.err, "");
}

TEST_F(ModelFault, ATruncatedModelIsRefusedWhereverItEnds) {
  done(large + "-o whole.nc");
  const auto whole = content("whole.nc");
  for (const std::size_t share : {1, 10, 50, 90, 99}) {
    const std::size_t kept = whole.size() * share / 100;
    write("part.nc", whole.substr(0, kept));
    const std::string sentence =
        "truncated: found " + std::to_string(kept) + " bytes, expected " + std::to_string(whole.size());
    expect_refused("sw-fracture part.nc " + crack + "-o out.nc", 1, "sw-fracture: part.nc: " + sentence);
    expect_refused("sw-info - < part.nc", 1, "sw-info: standard input: " + sentence);
  }
  EXPECT_EQ(files(), "part.nc whole.nc");
}

TEST_F(ModelFault, ATruncatedClassicFileDoesNotReadAsZeros) {
  if (run("nccopy 2> /dev/null; test $? -ne 127").code != 0) GTEST_SKIP() << "no nccopy (Debian: netcdf-bin)";
  done(large + "-o m.nc");
  for (const std::string kind : {"classic", "64-bit-offset", "cdf5"}) {
    done("nccopy -k " + kind + " m.nc whole.nc; sw-info whole.nc > /dev/null");
    const auto whole = content("whole.nc");
    for (const std::size_t missing : {std::size_t(4), whole.size() / 2, whole.size() - 200}) {
      write("part.nc", whole.substr(0, whole.size() - missing));
      const Ran ran = run("sw-info part.nc");
      EXPECT_EQ(ran.code, 1) << kind << missing;
      EXPECT_NE(
          ran.err.find("part.nc: truncated: found " + std::to_string(whole.size() - missing) + " bytes"),
          std::string::npos)
          << kind << ": " << ran.err;
    }
  }
}

TEST_F(ModelFault, ASignalRemovesTheTemporaryAndKeepsTheOlderFile) {
  done(large + "-o m.nc");
  write("out.nc", "older");
  done("mkfifo $TMPDIR/pipe");
  for (const auto& [name, number] : {std::pair("INT", 2), std::pair("TERM", 15), std::pair("HUP", 1)}) {
    // The model comes from a pipe that stays open, so the tool surely waits with its output opened. Children
    // in the background ignore INT unless they are jobs.
    const Ran ran = run("set -m; exec 3<> $TMPDIR/pipe; sw-fracture - " + crack +
                        "-o out.nc <&3 & tool=$!; " + "await 'ls .out.nc* > $TMPDIR/seen 2>&1'; kill -" +
                        name + " $tool; wait $tool; code=$?; ls -A > left; exit $code");
    EXPECT_EQ(ran.code, 128 + number) << ran.err;
    EXPECT_EQ(content("left"), "left\nm.nc\nout.nc\n") << name;
    EXPECT_EQ(content("out.nc"), "older") << name;
    done("rm left");
  }
}

TEST_F(ModelFault, ASignalShowsInTheExitStatus) {
  // It waits for somebody to write the pipe it is given by name.
  const Ran waited = run("mkfifo pipe; sw-fracture pipe " + crack + "-o out.nc & tool=$!; exec 3> pipe; " +
                         "kill -TERM $tool; wait $tool");
  EXPECT_EQ(waited.code, 128 + 15);
  EXPECT_EQ(files(), "pipe");
}

TEST_F(ModelFault, AnOutputKeepsItsModeAndALinkStaysALink) {
  done("umask 027; " + large + "-o new.nc; touch old.nc; chmod 604 old.nc; ln -s old.nc link.nc; " + large +
       "-o link.nc");
  EXPECT_EQ(done("stat -c '%n %a %F' new.nc old.nc link.nc"),
            "new.nc 640 regular file\nold.nc 604 regular file\nlink.nc 777 symbolic link\n");
  done("cmp new.nc old.nc");
}

}  // namespace slipwave::model_fault_test
