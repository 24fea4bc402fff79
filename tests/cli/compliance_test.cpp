// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>

#include "shell.hpp"

namespace slipwave::compliance_test {
namespace {

/// Planes that give way like springs, from the command line to traces.
class Compliance : public Shell {
 protected:
  const std::string model = "sw-layers --size 300x300 --step 10 --layer 0:3000:1500:2200 -q ";
  const std::string region = "--box 50:250,100:200 --dip 30 ";
  void expect_misuse(const std::string& options, const std::string& sentence) {
    expect_refused("sw-fracture m.nc " + region + options + " -o no.nc", 2, "sw-fracture: " + sentence);
  }
};

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

}  // namespace

TEST_F(Compliance, IsReportedAndPlannedAndChangesTraces) {
  done(model + "-o m.nc");
  done("sw-fracture m.nc " + region + "--stiffness 1e11,5e10 --spacing 5 --dashpot 1e6,1e6 -o s.nc");
  const auto info = done("sw-info s.nc");
  EXPECT_TRUE(has(info, "normal compliance 1e-11 m/Pa")) << info;
  EXPECT_TRUE(has(info, "tangential dashpot 1000000 Pa s/m")) << info;
  EXPECT_FALSE(has(info, "viscosity")) << info;
  const std::string shot =
      " --source 150,50 --receivers 50:250:50,20 --wavelet ricker:20 --time 0.2 --dt 0.002 -q ";
  EXPECT_TRUE(has(done("sw-shoot s.nc" + shot + "--plan -v"), "linear slip"));
  done("sw-shoot s.nc" + shot + "-o with.sgy && sw-shoot s.nc" + shot +
       "--without compliance -o without.sgy");
  done("sw-shoot s.nc" + shot + "--without slip -o intact.sgy");
  done("sw-compare without.sgy intact.sgy --tolerance 0");
  EXPECT_NE(run("sw-compare with.sgy intact.sgy --tolerance 0.001").code, 0);
}

TEST_F(Compliance, OfSingleFracturesGoesFromTheCommandLineToTraces) {
  done(model + "-o m.nc");
  write("lines.txt", "50 200\n100 180\n150 220\n\n200 100\n250 250\n");
  done("sw-fracture m.nc --segment 100,150:200,120 --compliance 1e-10,2e-10 -o one.nc");
  done("sw-fracture one.nc --trace lines.txt --stiffness 1e10,1e10 --name curves -o s.nc");
  const auto info = done("sw-info s.nc");
  EXPECT_TRUE(has(info, "single fractures 1")) << info;
  EXPECT_TRUE(has(info, "name curves")) << info;
  EXPECT_TRUE(has(info, "single fractures 2")) << info;
  const std::string shot =
      " --source 150,50 --receivers 50:250:50,20 --wavelet ricker:20 --time 0.2 --dt 0.002 -q ";
  done("sw-shoot s.nc" + shot + "-o with.sgy && sw-shoot s.nc" + shot +
       "--without compliance -o without.sgy && sw-shoot s.nc" + shot + "--without slip -o intact.sgy");
  done("sw-compare without.sgy intact.sgy --tolerance 0");
  EXPECT_NE(run("sw-compare with.sgy intact.sgy --tolerance 0.001").code, 0);
  const std::string drawn = "sw-fracture m.nc --box 50:250,50:250 --length 20:80 --dip 30 --concentration 5 ";
  done(drawn + "--network 12 --seed 4 --compliance 1e-10,1e-10 -o n.nc && sw-plot n.nc -o n.png");
  EXPECT_TRUE(has(done("sw-info n.nc"), "single fractures 12"));
  EXPECT_TRUE(has(done("sw-shoot n.nc" + shot + "--plan"), "fractures: --plan --measure"));
}

TEST_F(Compliance, OfFracturesWithFrictionGoesFromTheCommandLineToTraces) {
  done(model + "-o m.nc");
  done(
      "sw-fracture m.nc --segment 80,150:220,150 --faces --friction 0.3 --viscosity 10 --spacing 5 --opening "
      "--strength 10 --compliance 1e-11,1e-11 --prestress=-100,-100,20 -o s.nc");
  const auto info = done("sw-info s.nc");
  for (const auto* text : {"lie on faces between cells", "friction 0.3", "spacing 5 m", "opens under tension",
                           "prestress sxz  20 Pa"})
    EXPECT_TRUE(has(info, text)) << info;
  const std::string shot =
      " --source 150,50 --receivers 50:250:50,20 --wavelet ricker:20 --amplitude 1e9 --time 0.2 --dt 0.002 ";
  const auto balance = run("sw-shoot s.nc" + shot + "--balance -o with.sgy").err;
  EXPECT_TRUE(has(balance, "14 of 14 fractured cells slipped")) << balance;
  for (const std::string effect :
       {"slip", "viscosity", "cohesion", "opening", "compliance", "prestress", "friction,prestress"}) {
    done("sw-shoot s.nc" + shot + "--without " + effect + " -q -o without.sgy");
    EXPECT_NE(run("sw-compare with.sgy without.sgy --tolerance 0").code, 0) << effect;
  }
  EXPECT_TRUE(has(done("sw-shoot s.nc" + shot + "--plan -q"), "fractures: --plan --measure"));
  done("sw-plot s.nc -o s.png");
}

TEST_F(Compliance, OfFracturesThatWeakenGoesFromTheCommandLineToTraces) {
  done(model + "-o m.nc");
  const auto fault = [&](const std::string& law) {
    return done("sw-fracture m.nc --segment 80,150:220,150 --faces --friction 0.6 --viscosity 0 --law " +
                law + " --prestress=-100,-100,50 -o w.nc");
  };
  fault("coulomb");
  const std::string shot =
      " --source 150,50 --receivers 50:250:50,20 --wavelet ricker:20 --amplitude 1e9 --time 0.2 --dt 0.002 ";
  done("sw-shoot w.nc" + shot + "-q -o coulomb.sgy");
  fault("slip-weakening:0.6:1e-6");
  done("sw-shoot w.nc" + shot + "-q -o same.sgy && sw-compare same.sgy coulomb.sgy --tolerance 0");
  fault("slip-weakening:0.1:1e-6");
  const auto info = done("sw-info w.nc");
  for (const auto* text : {"law slip-weakening", "dynamic friction 0.1", "slip distance 1e-06 m"})
    EXPECT_TRUE(has(info, text)) << info;
  EXPECT_TRUE(has(done("sw-shoot w.nc" + shot + "--plan -v -q"), "slip weakening"));
  done("sw-shoot w.nc" + shot + "-q -o weak.sgy");
  EXPECT_NE(run("sw-compare weak.sgy coulomb.sgy --tolerance 0").code, 0);
  const auto warned =
      run("sw-fracture m.nc --segment 80,150:220,150 --faces --friction 0.6 --viscosity 0 --law "
          "slip-weakening:0.1:1e-9 --prestress=1e5 -o w.nc");
  EXPECT_TRUE(has(warned.err, "too large for slip weakening")) << warned.err;
}

TEST_F(Compliance, OfDiscsGoesFromTheCommandLineToTraces) {
  done("sw-layers --size 200x150x120 --step 10 --layer 0:3000:1500:2200 -q -o m.nc");
  write("plates.txt", "40 40 60\n90 40 60\n90 100 80\n40 100 80\n\n120 50 30\n150 50 30\n150 50 90\n");
  done(
      "sw-fracture m.nc --disc 100,70,60:40:30:40 --rectangle 60,70,50:50,30:80 --compliance 1e-10,2e-10 -q "
      "-o some.nc");
  done("sw-fracture some.nc --trace plates.txt --stiffness 1e10,1e10 --name plates -q -o s.nc");
  const auto info = done("sw-info s.nc");
  EXPECT_TRUE(has(info, "single fractures 2, area of all 6526.548 m2")) << info;
  EXPECT_TRUE(has(info, "name plates")) << info;
  const std::string shot =
      " --source 100,70,20 --receivers 50:150:50,60,20 --wavelet ricker:20 --time 0.15 --dt 0.002 -q ";
  const auto plan = done("sw-shoot s.nc" + shot + "--plan -v");
  EXPECT_TRUE(has(plan, "linear slip: ")) << plan;
  EXPECT_TRUE(has(plan, "fractures: --plan --measure")) << plan;
  done("sw-shoot s.nc" + shot + "-o with.sgy && sw-shoot s.nc" + shot +
       "--without compliance -o without.sgy && sw-shoot s.nc" + shot + "--without slip -o intact.sgy");
  done("sw-compare without.sgy intact.sgy --tolerance 0");
  EXPECT_NE(run("sw-compare with.sgy intact.sgy --tolerance 0.001").code, 0);
  done("sw-plot s.nc -o s.png && sw-plot s.nc --slice z=60 -o z.png");
  const auto cut = run("sw-fracture m.nc --disc 100,70,10:40:90 --compliance 1e-10,1e-10 -o cut.nc");
  EXPECT_TRUE(has(cut.err, "fractures end with the model: 1720 m2 of them are outside")) << cut.err;
  const std::string drawn = "sw-fracture m.nc --box 0:200,0:150,0:120 --radius 10:40:2.5 --dip 70:30 ";
  done(drawn + "--concentration 10 --network 12 --seed 4 --compliance 1e-10,1e-10 -o n.nc");
  EXPECT_TRUE(has(done("sw-info n.nc"), "single fractures 12"));
  done(drawn + "--intensity 0.02 --compliance 1e-10,1e-10 -o p.nc && sw-plot p.nc -o p.png");
}

TEST_F(Compliance, OfWhatIsRarelyMeantIsWarnedAbout) {
  done(model + "-o m.nc");
  const std::string region = "sw-fracture m.nc --box 50:900,100:200 --dip 30 --friction 0.1 --viscosity 1 ";
  const auto said = [&](const std::string& line) { return run(line + " -o w.nc").err; };
  EXPECT_EQ(said(region),
            "sw-fracture: warning: the box at x=50..900 z=100..200 leaves the model, which is at x=0..300 "
            "z=0..300: planes end there\n");
  EXPECT_EQ(said("sw-fracture m.nc --box 0:300,100:300 --dip 30 --friction 0.1 --viscosity 1"), "");
  const std::string cracks = "sw-fracture m.nc --box 50:250,100:200 --dip 30 --crack-density ";
  EXPECT_EQ(said(cracks + "0.3"),
            "sw-fracture: warning: a crack density of 0.3 is above 0.2, to which Hudson's theory of first "
            "order holds; usual are 0.01 to 0.1\n");
  EXPECT_EQ(said(cracks + "0.2"), "");
  const std::string lines = "sw-fracture m.nc --compliance 1e-11,1e-11 --segment 50,100:150,100 --segment ";
  EXPECT_EQ(said(lines + "150,100:50,100"),
            "sw-fracture: warning: 100 m of the fractures lie on others, and have the compliance of both "
            "there; if that is not meant, give each of them once\n");
  EXPECT_EQ(said(lines + "150,100:250,100"), "");
}

TEST_F(Compliance, ThatContradictsItselfIsRefusedInOneLine) {
  done(model + "-o m.nc");
  expect_misuse("--compliance -1e-12,1e-12 --spacing 1",
                "--compliance: found '-1e-12,1e-12', expected two numbers not below zero");
  expect_misuse("--compliance 1e-12 --spacing 1",
                "--compliance: found '1e-12', expected two numbers not below zero");
  expect_misuse("--compliance 1e-12,1e-12 --spacing 0",
                "--spacing: found 0, expected it above zero, the distance between planes in m");
  expect_misuse("--compliance 1e-12,1e-12", "--spacing is missing");
  expect_misuse("--compliance 1,1 --stiffness 1,1 --spacing 1",
                "found --compliance and --stiffness, give one of both");
  expect_misuse("--compliance 1e-12,1e-12 --spacing 1 --viscosity 3", "--viscosity needs --friction");
  expect_misuse("--compliance 1e-12,1e-12 --spacing 1 --opening",
                "--opening needs --friction: planes that open carry no tension, springs do");
  expect_misuse("--friction 0.1",
                "--viscosity is missing; expected --viscosity ETA, or --for-frequency HZ --strain-rate RATE");
  expect_misuse("--friction 0.1 --for-frequency 30", "--for-frequency and --strain-rate need each other");
  expect_refused(
      "sw-fracture m.nc --box 50:250,100:200 --dip 30 --dip 80 --friction 0.1 --viscosity 1 --compliance "
      "1e-12,1e-12 --spacing 1 -o no.nc",
      1,
      "sw-fracture: fracture set 1 'fractures-1': friction together with compliance needs one family of "
      "planes, in 2-D or two at right angles; give the others a set of their own");
}

TEST_F(Compliance, IsNotNeededForAViscosityThatCompetesWithWaves) {
  done(model + "-o m.nc");
  const auto said =
      run("sw-fracture m.nc " + region + "--friction 0.1 --for-frequency 30 --strain-rate 1e-5 -o v.nc");
  EXPECT_TRUE(has(
      said.err, "sw-fracture: viscosity 250000 s, at which slip competes with waves of 30 Hz and 1e-05 1/s"))
      << said.err;
  EXPECT_TRUE(has(done("sw-info v.nc"), "viscosity 250000 s"));
}

TEST_F(Compliance, MakesAnEffectiveMediumInsteadOfSprings) {
  done(model + "-o m.nc");
  const std::string level =
      "sw-fracture m.nc --box 50:250,100:200 --dip 0 --stiffness 4e10,2e10 --spacing 1 ";
  done(level + "--effective -o e.nc");
  const auto info = done("sw-info e.nc");
  EXPECT_TRUE(has(info, "epsilon")) << info;
  EXPECT_FALSE(has(info, "compliance ")) << info;
  // Other planes go into the same cells; waves take the way that springs leave them.
  done("sw-fracture e.nc --box 50:250,100:200 --dip 90 --compliance 1e-12,1e-12 --spacing 1 -o both.nc");
  done(level + "-o s.nc");
  const std::string shot =
      " --source 150,50 --receivers 50:250:50,250 --wavelet ricker:7 --time 0.4 --dt 0.002 -q ";
  for (const std::string name : {"m", "e", "s", "both"})
    done("sw-shoot " + name + ".nc" + shot + "-o " + name + ".sgy");
  done("sw-compare e.sgy s.sgy --tolerance 0.02");
  EXPECT_NE(run("sw-compare m.sgy s.sgy --tolerance 0.05").code, 0);
  EXPECT_NE(run("sw-compare both.sgy e.sgy --tolerance 0.005").code, 0);
}

TEST_F(Compliance, OfAnEffectiveMediumIsRefusedWhereItHasNone) {
  done(model + "-o m.nc");
  const std::string springs = "--compliance 1e-12,1e-12 --spacing 1 --effective ";
  expect_misuse(springs + "--dip 75",
                "--effective: planes dip by 75 degrees in rock with planes that dip by 30 at x=55 z=105, "
                "expected the same "
                "dip or a right angle to it; other planes are springs");
  expect_misuse(springs + "--dashpot 1,1",
                "--effective: an effective medium has no dashpots, expected springs alone");
  expect_misuse(springs + "--prestress 1e6",
                "found --effective and --prestress, which is of a fracture set; --effective makes none");
}

TEST_F(Compliance, ThatSticksOrIsDryIsALineOfThePlan) {
  done(model + "-o m.nc");
  const auto slip = [&](const std::string& options, const std::string& strength) {
    done("sw-fracture m.nc " + region + options + " -q -o f.nc");
    return done(
        "sw-shoot f.nc --source 150,50 --receivers 50:250:50,20 --wavelet ricker:20 --time 0.2 -q --plan "
        "--amplitude " +
        strength + " | grep '^  slip ' || true");
  };
  EXPECT_TRUE(has(slip("--friction 0.5 --viscosity 0", "1e6"), "slip like dry friction"));
  EXPECT_TRUE(has(slip("--friction 0.5 --viscosity 1e20", "1e6"), "hardly slip"));
  const auto stuck = slip("--friction 0.6 --viscosity 1 --prestress lithostatic", "1e6");
  EXPECT_TRUE(has(stuck, "cannot slip")) << stuck;
  EXPECT_EQ(std::count(stuck.begin(), stuck.end(), '\n'), 1);
  EXPECT_EQ(slip("--compliance 1e-12,1e-12 --spacing 1", "1e6"), "");
}

TEST_F(Compliance, HasAResponseWhoseErrorIsMeasuredAndChosen) {
  done(model + "-o m.nc");
  done("sw-fracture m.nc " + region + "--friction 0.1 --viscosity 1e3 -q -o f.nc");
  const std::string shot =
      " --source 150,0 --kind plane:0 --amplitude 0.01 --top absorbing --receivers 50:250:50,20 --wavelet "
      "ricker:20 --time 0.3 ";
  // Both shots are computed alike.
  const std::string chosen =
      " --error 0.2 --of response -o a.sgy 2>&1 >/dev/null | grep 'measured error' | sed 's/, centred.*//; "
      "s/: "
      "measured.*//'";
  const auto with = done("sw-shoot f.nc" + shot + chosen);
  EXPECT_TRUE(has(with, "order ")) << with;
  EXPECT_EQ(with, done("sw-shoot f.nc --without slip" + shot + chosen));
  const auto refused = [&](const std::string& line, int code, const std::string& sentence) {
    expect_refused("sw-shoot " + line + shot + "-q -o no.sgy", code, "sw-shoot: " + sentence);
    EXPECT_FALSE(exists("no.sgy"));
  };
  refused("f.nc --error 0.1 --of Response", 2, "--of: found 'Response', expected traces or response");
  refused("f.nc --of response", 2,
          "found --of without --error, --measure or --error-gather, expected one of them");
  refused("m.nc --error 0.1 --of response", 2, "--of response: found no fractures in the model");
  EXPECT_TRUE(has(done("sw-shoot f.nc" + shot + "-q --plan --measure --of response"),
                  "% of what fractures add to the traces"));
}

}  // namespace slipwave::compliance_test
