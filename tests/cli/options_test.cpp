// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>

#include "shell.hpp"

namespace slipwave::options_test {
namespace {

using Options = Shell;
using OptionPairs = Shell;

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

TEST_F(OptionPairs, OfAModelThatGivesThemNothingToDoAreWarnedOf) {
  done("sw-layers --size 200x100 --step 5 --layer 0:2000:1000:2000 -o m.nc");
  const std::string shoot =
      "sw-shoot m.nc --source 100,50 --wavelet ricker:15 --receivers 50,50 --time 0.1 -o a.sgy ";
  // A row a pair: an option, and what it has no effect beside.
  const std::pair<const char*, const char*> rows[] = {
      {"--correction first", "--correction has no effect: nothing in the scene slips"},
      {"--q-frequency 20", "--q-frequency has no effect: no cell of the model has a finite qp or qs"},
      {"--q-band 5,20", "--q-band has no effect: no cell of the model has a finite qp or qs"},
      {"--q-mechanisms 4", "--q-mechanisms has no effect: no cell of the model has a finite qp or qs"},
      {"--top rigid --sides free --bottom free --edge-width 5",
       "--edge-width has no effect: no boundary is absorbing"},
      {"--without slip", "--without slip has no effect: the model has none"},
      {"--without friction", "--without friction has no effect: the model has none"},
      {"--without viscosity", "--without viscosity has no effect: the model has none"},
      {"--without cohesion", "--without cohesion has no effect: the model has none"},
      {"--without opening", "--without opening has no effect: the model has none"},
      {"--without prestress", "--without prestress has no effect: the model has none"},
      {"--without attenuation", "--without attenuation has no effect: the model has none"},
      {"--without anisotropy", "--without anisotropy has no effect: the model has none"},
      {"--without compliance", "--without compliance has no effect: the model has none"},
      {"--ranks-per-shot 2", "--ranks-per-shot has no effect without mpirun"}};
  for (const auto& [options, sentence] : rows)
    EXPECT_EQ(run(shoot + options).err, "sw-shoot: warning: " + std::string(sentence) + "\n") << options;
  const std::string snapshots =
      "sw-shoot m.nc --source 100,50 --wavelet ricker:15 --time 0.1 --snapshots s.nc --every 0.05 ";
  for (const std::string option : {"--dt 0.002", "--record p", "--revision 2"})
    EXPECT_EQ(run(snapshots + option).err, "sw-shoot: warning: " + option.substr(0, option.find(' ')) +
                                               " has no effect: there are no receivers\n");
  done(
      "sw-layers --size 200x100 --step 5 --layer '0:2000:1000:2000 qp=50 qs=30 epsilon=0.1 delta=0.1' -o "
      "m.nc");
  EXPECT_EQ(run(shoot + "--without attenuation --q-frequency 20").err,
            "sw-shoot: warning: --q-frequency has no effect beside --without attenuation\n");
  for (const char* options : {"--without attenuation", "--without anisotropy", "--q-frequency 20"})
    EXPECT_EQ(run(shoot + options).err, "") << options;
}

TEST_F(OptionPairs, OfUnitsThatFilesNameThemselvesAreToldOf) {
  done("sw-layers --size 200x100 --step 5 --layer 0:2000:1000:2000 -o m.nc");
  EXPECT_EQ(run("sw-import --vp m.nc --vs m.nc --rho m.nc --units km/s -o n.nc").err,
            "sw-import: m.nc: vp is in m s-1, as the file says; --units is of numbers that name no unit\n"
            "sw-import: m.nc: vs is in m s-1, as the file says; --units is of numbers that name no unit\n");
  done("sw-import --vp m.nc --vs m.nc --rho 2.1 --units g/cm3 -o n.nc");
}

TEST_F(OptionPairs, InAFileOfOptionsWaitOrGiveWay) {
  done("sw-layers --size 200x100 --step 5 --layer 0:2000:1000:2000 -o m.nc");
  const std::string shoot = "sw-shoot m.nc --config shot.cfg ";
  const std::string shot =
      "source = 100,50\nwavelet = ricker:15\nreceivers = 50,50\ntime = 0.1\noutput = a.sgy\n";
  // What is idle there may be for another command.
  write("shot.cfg", shot + "every = 0.05\nfields = vx\nbalance = false\n");
  done(shoot);
  done(shoot + "--snapshots s.nc && test -s s.nc");
  // The command line wins over what it excludes.
  write("shot.cfg", shot + "time-step = 0.0005\n");
  done(shoot + "--cfl 0.5");
  EXPECT_EQ(done("sw-info --command a.sgy").find("time-step"), std::string::npos);
  // Two in the file contradict each other still.
  write("shot.cfg", shot + "time-step = 0.0005\ncfl = 0.5\n");
  expect_refused(shoot, 2, "sw-shoot: found --cfl and --time-step, expected one of them");
  // A switch that is off is none.
  write("shot.cfg", shot + "plan = false\n");
  expect_refused(shoot + "--json", 2,
                 "sw-shoot: found --json without --plan, --measure or --error, expected one of them");
}

}  // namespace slipwave::options_test
