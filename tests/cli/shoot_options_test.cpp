// SPDX-License-Identifier: BSD-3-Clause
#include <cstdlib>
#include <filesystem>
#include <regex>

#include "shell.hpp"

namespace slipwave::shoot_options_test {
namespace {

const std::string shoot = "sw-shoot m.nc --wavelet ricker:20 --time 0.15 --receivers 0:400:50,20 ";
const std::string at = "--source 100,50 ";

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

class ShootOptions : public Shell {
 protected:
  void SetUp() override {
    done(
        "sw-layers --size 400x300 --step 5 --layer 0:1500:0:1000 --layer 100:3000:1500:2200 | sw-fracture - "
        "--box 150:250,150:200 --dip 45 --friction 0.1 --viscosity 1e11 -o m.nc");
    done(shoot + at + "-o base.sgy");
  }
  std::string info(const std::string& name) { return done("sw-info " + name); }
};

}  // namespace

TEST_F(ShootOptions, EachChangesTheTraces) {
  for (const std::string option :
       {"--kind force:1,0", "--kind moment:2,2,0", "--amplitude 2",      "--top absorbing",
        "--top rigid",      "--top mirror",        "--sides rigid",      "--sides mirror",
        "--bottom free",    "--edge-width 3",      "--order 1",          "--order 3",
        "--order 7",        "--without slip",      "--correction first", "--precision double",
        "--cfl 0.5",        "--time-step 1e-3",    "--time-order 4",     "--time-order 4 --cfl 1.8"}) {
    done(shoot + at + option + " -o other.sgy");
    EXPECT_EQ(done("tail -c +3601 other.sgy | wc -c"), done("tail -c +3601 base.sgy | wc -c")) << option;
    // Past the headers, which hold the command line.
    EXPECT_NE(run("cmp -s <(tail -c +3601 base.sgy) <(tail -c +3601 other.sgy)").code, 0) << option;
  }
}

TEST_F(ShootOptions, AreListedWithEveryEffectAndEachDefaultOnce) {
  const auto help = done("sw-shoot --help-all");
  EXPECT_FALSE(std::regex_search(help, std::regex("(\\[[a-z]+\\])\\s+\\1"))) << help;
  const auto begin = help.find("effects to switch off");
  const auto listed = help.substr(begin, help.find("--", begin) - begin);
  for (const std::string effect : {"slip", "friction", "viscosity", "cohesion", "opening", "prestress",
                                   "attenuation", "anisotropy", "compliance"})
    EXPECT_TRUE(has(listed, effect)) << effect;
}

TEST_F(ShootOptions, OfAttenuationAreWarnedAboutInElasticRock) {
  const auto said = [&](const std::string& options) { return run(shoot + at + options + "-o q.sgy").err; };
  EXPECT_EQ(said("--q-frequency 20 "),
            "sw-shoot: warning: --q-frequency has no effect: no cell of the model has a finite qp or qs\n");
  EXPECT_EQ(said("--q-frequency 20 --without attenuation "),
            "sw-shoot: warning: --without attenuation has no effect: the model has none\n"
            "sw-shoot: warning: --q-frequency has no effect beside --without attenuation\n");
}

TEST_F(ShootOptions, DefaultsAreWhatHelpSays) {
  done(shoot + at +
       "--kind explosion --amplitude 1 --record vz,vx,p --dt 0.001 --top free --sides absorbing --bottom "
       "absorbing --order 5 --time-order 2 --correction centred --precision float --cfl 0.9 -o other.sgy");
  done("cmp <(tail -c +3601 base.sgy) <(tail -c +3601 other.sgy)");
}

/// Where bands would pay, a line says so; they are made only when asked for.
TEST_F(ShootOptions, SayWhatBandsOfCellsWouldSave) {
  done("sw-layers --size 200x200 --step 1 --layer 0:900:300:1800 --layer 30:3500:2000:2300 -o soft.nc");
  const auto said = [&](const std::string& model, const std::string& options, const std::string& output) {
    return run("sw-shoot " + model +
               " --source 100,8 --wavelet ricker:15 --receivers 50:150:10,20 --time 0.12 " + options + "-o " +
               output)
        .err;
  };
  const std::string cells = "cells of 1 m, from z=30 m on 4 m", hint = "--bands auto\n";
  const auto by_default = said("soft.nc", "", "default.sgy");
  EXPECT_TRUE(has(by_default, "sw-shoot: " + cells + " would take ") && has(by_default, hint)) << by_default;
  EXPECT_FALSE(has(said("soft.nc", "--bands none ", "none.sgy"), cells));
  done("cmp <(tail -c +3601 default.sgy) <(tail -c +3601 none.sgy)");
  EXPECT_TRUE(has(said("soft.nc", "--bands auto ", "auto.sgy"), "sw-shoot: bands: " + cells + "; "));
  EXPECT_NE(run("cmp -s <(tail -c +3601 default.sgy) <(tail -c +3601 auto.sgy)").code, 0);
  // Bands do not go with a step in seconds, and nothing calls for them in rock of one speed.
  EXPECT_FALSE(has(said("soft.nc", "--time-step 1e-4 ", "step.sgy"), "bands"));
  done("sw-layers --size 200x200 --step 1 --layer 0:3500:2000:2300 -o hard.nc");
  EXPECT_FALSE(has(said("hard.nc", "", "hard.sgy"), "bands"));
}

TEST_F(ShootOptions, OfTheBoxLeaveTheGroundInsideItFree) {
  const std::string here =
      "sw-shoot hill.nc --wavelet ricker:20 --time 0.1 --receivers 50:350:50,surface "
      "--source 100,surface+5 --kind force:0,1 ";
  const auto traces_differ = [&](const std::string& options) {
    done(here + options + "-o other.sgy");
    return run("cmp -s <(tail -c +3601 hill.sgy) <(tail -c +3601 other.sgy)").code != 0;
  };
  // Rows begin at the ground, or void is inside the grid, on faces and off them.
  for (const std::string ground : {"sine,50,20,300", "50", "52", "52 --fit none"}) {
    const auto depth = ground.substr(0, ground.find(' ')), fit = ground.substr(depth.size());
    done("sw-layers -q --size 400x200 --step 5 --layer " + depth + ":3000:1500:2200" + fit + " -o hill.nc");
    done(here + "-o hill.sgy");
    EXPECT_FALSE(traces_differ("--top absorbing ")) << ground;
    const bool fitted = ground.front() == 's' || ground == "52";
    if (fitted) {
      EXPECT_TRUE(traces_differ("--ground absorbing "));
      continue;
    }
    const auto refused = run(here + "--ground absorbing -o other.sgy");
    EXPECT_EQ(refused.code, 2);
    EXPECT_TRUE(has(refused.err, "build the model with --fit surface")) << refused.err;
  }
}

TEST_F(ShootOptions, SamplingAndComponentsAreAsAsked) {
  done(shoot + at + "--dt 0.002 --record szz,sxx,sxz,vx -o other.sgy");
  const auto text = info("other.sgy");
  EXPECT_TRUE(has(text, "samples a trace  76\n")) << text;
  EXPECT_TRUE(has(text, "traces           36\n")) << text;
}

TEST_F(ShootOptions, APlaneWaveComesInFromTheTop) {
  done("sw-layers --size 200x200 --step 5 --layer 0:3000:1500:2200 -o m.nc");
  for (const std::string angle : {"0", "25"})
    done("sw-shoot m.nc --source 0,0 --kind plane:" + angle +
         " --top absorbing --wavelet ricker:20 --time 0.2 --receivers 100,100 --record vx,vz,p -o " + angle +
         ".sgy");
  EXPECT_TRUE(has(info("0.sgy"), "traces           3\n"));
}

TEST_F(ShootOptions, ShotsOneByOneAreThoseShotTogether) {
  done(shoot + "--source 100,50 --source 300,50 --first-shot 8 -o 'all-{shot}.sgy'");
  for (const std::string number : {"8", "9"}) {
    done(shoot + "--source " + (number == "8" ? "100,50" : "300,50") + " --first-shot " + number +
         " -o one.sgy");
    done("sw-compare one.sgy all-" + number + ".sgy --tolerance 0 -q");
    EXPECT_EQ(done("sw-select one.sgy --where shot=" + number + " | tail -c +3601 | cksum"),
              done("tail -c +3601 one.sgy | cksum"));
  }
  EXPECT_EQ(run("sw-compare all-8.sgy all-9.sgy -q").code, 1);
}

TEST_F(ShootOptions, SplitByComponentAndShot) {
  const std::string shots = shoot + "--source 100,50 --source 300,50 --record vx,p ";
  done(shots + "-o all.sgy");
  EXPECT_TRUE(has(info("all.sgy"), "shots            2\n")) << info("all.sgy");
  EXPECT_TRUE(has(info("all.sgy"), "traces           36\n"));
  done(shots + "-o 's{shot}-{component}.sgy'");
  EXPECT_EQ(files(), "all.sgy base.sgy m.nc s1-p.sgy s1-vx.sgy s2-p.sgy s2-vx.sgy");
  EXPECT_TRUE(has(info("s2-vx.sgy"), "traces           9\n"));
  EXPECT_TRUE(has(info("s2-vx.sgy"), "source x         300 m\n")) << info("s2-vx.sgy");
  // A shot does not know of the others.
  const std::string one = "sw-shoot m.nc --wavelet ricker:20 --time 0.15 --receivers 200,20 --record vx ";
  done(one + "--source 100,50 --source 300,50 -o '{shot}.sgy'; " + one + "--source 300,50 -o alone.sgy");
  done("cmp <(tail -c +3841 2.sgy) <(tail -c +3841 alone.sgy)");
  done(shots + "-o 'only-{component}.sgy'");
  EXPECT_TRUE(has(info("only-p.sgy"), "traces           18\n"));
}

TEST_F(ShootOptions, ShotsInParallelChangeNothing) {
  const std::string shots = shoot + "--source 100,50 --source 300,50 --source 250,20 --source 150,80 ";
  done(shots + "--shots-in-parallel 1 -o one.sgy");
  for (const std::string many : {"2 --threads 2", "3 --threads 3", "0", "9 --threads 1"}) {
    done(shots + "--shots-in-parallel " + many + " -o many.sgy");
    done("cmp <(tail -c +3201 one.sgy) <(tail -c +3201 many.sgy)");
  }
  done(shots + "--shots-in-parallel 3 -o 's{shot}.sgy'");
  EXPECT_TRUE(has(info("s4.sgy"), "source x         150 m\n")) << info("s4.sgy");
}

TEST_F(ShootOptions, SnapshotsAreReadableAndLeaveTheTracesAsTheyAre) {
  done(shoot + at + "--snapshots s.nc --every 0.05 --fields vx,p,div,curl -o other.sgy");
  done("cmp <(tail -c +3601 base.sgy) <(tail -c +3601 other.sgy)");
  const auto text = info("s.nc");
  for (const std::string word : {"snapshots", "80 x 60 cells of 5 m", "div", "curl"})
    EXPECT_TRUE(has(text, word)) << word << " in " << text;
  done(
      "sw-shoot m.nc --wavelet ricker:20 --time 0.15 --source 9,9 --source 99,9 --snapshots 't{shot}.nc' "
      "--every 0.05");
  EXPECT_TRUE(exists("t1.nc") && exists("t2.nc"));
}

TEST_F(ShootOptions, DoNotDependOnThreadsOrOnTheMoment) {
  // A grid of many lines, so that threads share them.
  done(
      "sw-layers --size 800x1500 --step 5 --layer 0:1500:0:1000 --layer 100:3000:1500:2200:5 --fit none | "
      "sw-fracture - "
      "--box 150:650,250:400 --dip 45 --friction 0.1 --viscosity 0 -o m.nc");
  const std::string line = shoot + at + "--snapshots s.nc --every 0.1 ";
  for (const std::string n : {"1", "2", "3"})
    done(line + "--threads " + n + " > " + n + ".sgy; mv s.nc " + n + ".nc");
  done(
      "cmp <(tail -c +3601 1.sgy) <(tail -c +3601 2.sgy); cmp <(tail -c +3601 1.sgy) <(tail -c +3601 3.sgy)");
  const std::string fields = "ncdump -v vx,vz ";
  if (run("ncdump 2> /dev/null; test $? -ne 127").code == 0) {
    for (const std::string n : {"2", "3"})
      done("cmp <(" + fields + "1.nc | sed -n '/^data/,$p') <(" + fields + n + ".nc | sed -n '/^data/,$p')");
  }
  done(line + "> a.sgy; next_second; " + line + "> b.sgy; cmp a.sgy b.sgy");
}

TEST_F(ShootOptions, ComeFromAFileAndTheCommandLineWins) {
  write("run.cfg", "source = 100,50\nwavelet = ricker:20\ntime = 0.15\nreceivers = 0:400:50,20\norder = 1\n");
  done("sw-shoot m.nc --config run.cfg --order 5 -o other.sgy");
  done("cmp <(tail -c +3601 base.sgy) <(tail -c +3601 other.sgy)");
  done("sw-shoot m.nc --config run.cfg -o other.sgy");
  EXPECT_NE(run("cmp -s <(tail -c +3601 base.sgy) <(tail -c +3601 other.sgy)").code, 0);
}

TEST_F(ShootOptions, PlanTellsWhatWouldBeComputedAndStops) {
  const std::string long_shot = "sw-shoot m.nc --source 100,50 --wavelet ricker:20 --time 1000 --plan ";
  const auto text = done(long_shot + "-v");
  for (const std::string word : {"grid", "steps", "time step", "Courant number  ", "memory", "slip, centred",
                                 "cells per shortest wavelength"})
    EXPECT_TRUE(has(text, word)) << word << " in " << text;
  EXPECT_FALSE(has(
      done("sw-shoot m.nc --source 100,50 --wavelet ricker:20 --time 1 --without slip --plan -v"), "slip,"));
  done(shoot + at + "--plan -v -o plan.txt; grep -q steps plan.txt");
}

TEST_F(ShootOptions, PlanIsAFewLinesForItsUserAndAllOfItIsJson) {
  const auto keys = [&](const std::string& options) {
    return done(shoot + at + options + "--plan | sed -E 's/^  ([a-z0-9 ]*[a-z])  .*/\\1/'");
  };
  const std::string five = "cells per shortest wavelength\ndirect waves\nnot in it\ntime\nmemory\n";
  EXPECT_EQ(keys("--without slip "), five);
  // Of stronger waves slip competes with that viscosity, of weaker ones planes are dry.
  EXPECT_EQ(keys("--amplitude 1e3 "), five);
  EXPECT_EQ(keys(""), five + "slip\n");
  write("check.py", R"(
import json, sys
once = lambda pairs: dict(pairs) if len(dict(pairs)) == len(pairs) else sys.exit("a key is there twice")
plan = json.load(sys.stdin, object_pairs_hook=once)
assert plan["dispersion_of_direct_P_waves"]["unit"] == "%", plan
assert plan["dispersion_of_direct_P_waves"]["value"] > 0, plan
assert plan["processor_time"]["value"] > 0 and plan["memory_of_a_shot"]["unit"] == "MiB", plan
assert any("slip" in part for part in plan["part_of_step"]), plan
)");
  done(shoot + at + "--plan --json | python3 check.py");
  expect_refused(shoot + at + "--json -o out.sgy", 2,
                 "sw-shoot: found --json without --plan, --measure or --error, expected one of them");
}

TEST_F(ShootOptions, HelpFitsAScreenAndTheRestIsInHelpAll) {
  const auto help = done("sw-shoot --help"), all = done("sw-shoot --help-all");
  EXPECT_LE(std::count(help.begin(), help.end(), '\n'), 60);
  for (const std::string heading :
       {"Source:", "Receivers and recording:", "Model and its boundaries:", "Numerics:", "Output:"})
    for (const auto& text : {help, all}) EXPECT_TRUE(has(text, "\n" + heading + "\n")) << heading << text;
  EXPECT_FALSE(has(help, "--edge-width"));
  EXPECT_TRUE(has(all, "--edge-width"));
  expect_refused("sw-shoot m.nc --recievrs 5,5", 2,
                 "sw-shoot: unknown option --recievrs; did you mean --receivers?");
  expect_refused("sw-shoot m.nc --polarisation 5", 2,
                 "sw-shoot: unknown option --polarisation; --help-all lists them all");
}

TEST_F(ShootOptions, WriteGathersThatAnIndependentReaderAccepts) {
  const char* given = std::getenv("SLIPWAVE_SHARED");
  const std::string checker = (given ? given : std::string(SLIPWAVE_SHARED_DEFAULT)) + "/tools/check_segy.py";
  if (!std::filesystem::exists(checker))
    GTEST_SKIP() << "no " << checker << "; SLIPWAVE_SHARED names the folder of shared tools";
  if (run("/usr/bin/python3 -c 'import numpy, segyio'").code != 0)
    GTEST_SKIP() << "no /usr/bin/python3 with segyio (Debian: python3-segyio)";
  done("sw-shoot m.nc --wavelet ricker:20 --time 0.15 --receivers 25:375:50,120 " + at +
       "--record vx,vz,p,sxx,szz,sxz -o six.sgy");
  done(shoot + "--source 100,50 --source 300.25,50.5 --receivers 12.5,33.3 -o shots.sgy");
  done(shoot + "--source 100,50 --source 300,50 --dt 0.0005 -o '{shot}-{component}.sgy'");
  done(shoot + at + "--kind force:0,1 --without slip -o force.sgy");
  done("sw-diff base.sgy force.sgy -o difference.sgy");
  const Ran ran = run("/usr/bin/python3 '" + checker + "' --profile shot --strict -q *.sgy");
  EXPECT_EQ(ran.code, 0) << ran.out << ran.err;
}

}  // namespace slipwave::shoot_options_test
