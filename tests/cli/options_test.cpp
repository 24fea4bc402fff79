// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>

#include "shell.hpp"

namespace {

using Options = Shell;

const std::string layers = "sw-layers --size 200x100 --step 5 --layer 0:1500:0:1000 ";

}  // namespace

TEST_F(Options, HelpEndsWithAnExampleThatWorks) {
  for (const std::string tool : {"sw-layers", "sw-import", "sw-fracture", "sw-info"}) {
    const auto help = done(tool + " --help");
    EXPECT_EQ(help.compare(0, 7, "Usage: "), 0) << tool;
    EXPECT_NE(help.find("\nExample:\n  " + tool + " "), std::string::npos) << tool;
    const auto lines = [&](const std::string& option) {
      return "<(" + tool + option + " | grep '^  -' | sort)";
    };
    EXPECT_EQ(done("comm -23 " + lines(" --help") + " " + lines(" --help-all")), "") << tool;
    EXPECT_LE(std::count(help.begin(), help.end(), '\n'), 40) << tool;
    EXPECT_EQ(help, done(tool + " -h")) << tool;
    EXPECT_EQ(help, done(tool + " --no-such-thing --help")) << tool << ": help wins over a misspelt option";
  }
  const auto example = [](const std::string& tool) { return tool + " --help | sed '1,/^Example:/d'"; };
  done("(" + example("sw-layers") + ") > a.sh; (" + example("sw-fracture") + ") > b.sh");
  done("sh -e a.sh 2> /dev/null; sh -e b.sh; test -s broken.nc");
}

TEST_F(Options, VersionIsOneLine) {
  EXPECT_EQ(done("sw-layers --version").compare(0, 20, "sw-layers (slipwave "), 0);
}

TEST_F(Options, AMisspeltOneIsAnsweredWithTheNearest) {
  expect_refused(layers + "--setp 5", 2, "sw-layers: unknown option --setp; did you mean --step?");
  expect_refused(layers + "--layers=3", 2, "sw-layers: unknown option --layers; did you mean --layer?");
  expect_refused(layers + "--siz 3x3", 2, "sw-layers: unknown option --siz; did you mean --size?");
  expect_refused(layers + "--frequency 3", 2,
                 "sw-layers: unknown option --frequency; --help-all lists them all");
  expect_refused(layers + "-x", 2, "sw-layers: unknown option -x; --help-all lists them all");
}

TEST_F(Options, AreRefusedTwiceWithoutAValueOrWithOneTooMany) {
  expect_refused(layers + "--step 5", 2, "sw-layers: --step is given twice, expected once");
  expect_refused(layers + "--title", 2, "sw-layers: --title: found no value, expected TEXT");
  expect_refused(layers + "--title --quiet", 2, "sw-layers: --title: found no value, expected TEXT");
  expect_refused(layers + "--title=", 2, "sw-layers: --title: found no value, expected TEXT");
  expect_refused(layers + "--quiet=maybe", 2, "sw-layers: --quiet: is a switch, expected no value");
  expect_refused("sw-layers --size 200x100 --layer 0:1500:0:1000 --step abc", 2,
                 "sw-layers: --step: found 'abc', expected a number");
  expect_refused("sw-layers --size 200x100 --layer 0:1500:0:1000 --step 5m", 2,
                 "sw-layers: --step: found '5m', expected a number");
  expect_refused("sw-import --vp a --order depth", 2,
                 "sw-import: --order: found 'depth', expected one of z-fast, x-fast");
}

TEST_F(Options, ThreadsBelongToToolsThatCompute) {
  expect_refused(layers + "--threads 2", 2, "sw-layers: unknown option --threads; --help-all lists them all");
}

TEST_F(Options, NegativeNumbersAreValues) {
  done("sw-layers --size 200x100 --step 5 --layer -10:1500:0:1000 --layer 50:3000:1500:2000:-5 -o m.nc -q");
  done("sw-fracture m.nc --box -10:100,50:90 --normal -1,-1 --friction 0.1 --viscosity 1 -o n.nc -q");
  EXPECT_NE(done("sw-info n.nc").find("normal -0.707107,-0.707107"), std::string::npos);
}

TEST_F(Options, ComeFromAFileAndTheCommandLineWins) {
  write("run.cfg",
        "# a layered model\nsize = 200x100\nstep = 10\nlayer = 0:1500:0:1000\nlayer = 50:3000:1500:2000\n");
  EXPECT_NE(done("sw-layers --config run.cfg | sw-info -").find("20 x 10 cells of 10 m"), std::string::npos);
  EXPECT_NE(done("sw-layers --config run.cfg --step 5 | sw-info -").find("40 x 20 cells of 5 m"),
            std::string::npos);
  EXPECT_NE(done("sw-layers --config run.cfg --layer 0:1500:0:1000 | sw-info -").find("solid cells   0\n"),
            std::string::npos);
}

TEST_F(Options, AFileOfThemIsReadAsStrictly) {
  write("misspelt.cfg", "sise = 200x100\n");
  expect_refused("sw-layers --config misspelt.cfg", 2,
                 "sw-layers: misspelt.cfg: unknown option sise; did you mean size?");
  write("bare.cfg", "size\n");
  expect_refused("sw-layers --config bare.cfg", 2,
                 "sw-layers: bare.cfg: found 'size', expected NAME = VALUE");
  write("twice.cfg", "step = 1\nstep = 2\n");
  expect_refused("sw-layers --config twice.cfg", 2,
                 "sw-layers: twice.cfg: step is given twice, expected once");
  write("word.cfg", "step = five\n");
  expect_refused("sw-layers --config word.cfg", 2,
                 "sw-layers: word.cfg: step: found 'five', expected a number");
  expect_refused("sw-layers --config none.cfg", 1, "sw-layers: none.cfg: No such file or directory");
  expect_refused("sw-layers --config .", 1, "sw-layers: .: is a directory, expected a file");
}

TEST_F(Options, BinaryOutputToATerminalIsRefused) {
  if (run("script --version > /dev/null 2>&1").code != 0) GTEST_SKIP() << "no script (Debian: bsdutils)";
  const Ran ran = run("script -qec '" + layers + "' /dev/null < /dev/null");
  EXPECT_EQ(ran.code, 2);
  EXPECT_NE(
      ran.out.find("standard output is a terminal and the output is binary; expected -o FILE or a pipe"),
      std::string::npos)
      << ran.out;
}
