// SPDX-License-Identifier: BSD-3-Clause
#include <string>

#include "shell.hpp"

namespace slipwave::provenance_test {

// What files say of the commands that made them, and that these commands make them again, to the bit.

namespace {

class Provenance : public Shell {
 protected:
  void SetUp() override {
    write(
        "shot.ini",
        "source = 100,20\nwavelet = ricker:30\nreceivers = 0:300:25,10\nrecord = vx,vz\nkind = force:0.5,1\n"
        "sides = rigid\nmonotone = true\nbalance = false\n");
    write("box.ini", "box = 100:200,60:120\ndip = 30\nfriction = 0.1\nviscosity = 4e3\n");
    done(layers + " -o whole.nc; sw-fracture whole.nc --config box.ini -o m.nc");
  }
  /// Runs what sw-info says in an empty folder and compares.
  void expect_again(const std::string& file) const {
    const auto command = done("sw-info --command " + file);
    write("again.sh", command);
    done(
        "rm -rf elsewhere; mkdir elsewhere; cd elsewhere; sh ../again.sh > again 2> /dev/null; cmp again "
        "../" +
        file);
  }
  const std::string layers =
      "sw-layers -q --size 300x200 --step 5 --layer 0:2500:1250:2200 --layer 100:3000:1600:2300 --fit none";
};

}  // namespace

TEST_F(Provenance, OfModelsIsTheirPipeWithTheOptionsOfConfigFiles) {
  EXPECT_EQ(
      done("sw-info --command m.nc"),
      "sw-layers --size 300x200 --step 5 --layer 0:2500:1250:2200 --layer 100:3000:1600:2300 --fit none | "
      "sw-fracture --box=100:200,60:120 --dip=30 --friction=0.1 --viscosity=4e3\n");
  expect_again("m.nc");
}

TEST_F(Provenance, OfShotsMakesThemAgain) {
  done("sw-shoot m.nc --config shot.ini --time 0.1 -q -o g.sgy");
  const auto command = done("sw-info --command g.sgy");
  for (const std::string part : {"sw-fracture --box=", " | sw-shoot --time 0.1 --source=100,20",
                                 "--kind=force:0.5,1", "--sides=rigid", "--monotone"})
    EXPECT_NE(command.find(part), std::string::npos) << part << " in " << command;
  for (const std::string part : {"config", "balance", "m.nc"})
    EXPECT_EQ(command.find(part), std::string::npos) << part << " in " << command;
  expect_again("g.sgy");
  // The same whatever the model's file is called, and through a pipe.
  done("cp m.nc other.nc; sw-shoot other.nc --config shot.ini --time 0.1 -q | cmp - g.sgy");
  done("cat m.nc | sw-shoot --config shot.ini --time 0.1 -q - | cmp - g.sgy");
  const auto text = done("sw-info g.sgy");
  EXPECT_NE(text.find("source: force:0.5,1"), std::string::npos) << text;
  EXPECT_NE(text.find("boundaries: top free, sides rigid, bottom absorbing"), std::string::npos) << text;
  EXPECT_NE(text.find("monotone"), std::string::npos) << text;
}

TEST_F(Provenance, GoesOnThroughToolsForTraces) {
  done("sw-shoot m.nc --config shot.ini --time 0.1 -q -o g.sgy");
  done(
      "sw-filter g.sgy --band 5,10,60,80 | sw-select - --where 'component=vz or component=vx' | sw-sort "
      "--key=-offset | "
      "sw-convert --format ibm -o last.sgy");
  expect_again("last.sgy");
  done("sw-spectrum last.sgy --window hann -o s.nc; sw-export m.nc --property vp -o vp.sgy");
  expect_again("s.nc");
  expect_again("vp.sgy");
  EXPECT_EQ(done("sw-diff g.sgy g.sgy | sw-info --command -"), "sw-diff g.sgy g.sgy\n")
      << "what is named by its file is not made again";
}

TEST_F(Provenance, IsWholeWhereTheTextualHeaderHasNoRoom) {
  std::string many;
  for (int n = 1; n <= 150; ++n) many += " --layer " + std::to_string(n) + ":2500:1250:2200";
  done("sw-layers -q --size 300x200 --step 5 --fit none --layer 0:2500:1250:2200" + many + " -o deep.nc");
  done(
      "sw-shoot deep.nc --config shot.ini --time 0.05 -q -o g.sgy; sw-info g.sgy | grep -q 'extended texts *"
      "[1-9]'");
  expect_again("g.sgy");
  done("sw-filter g.sgy --gain rms | sw-convert --text ascii -o f.sgy");
  expect_again("f.sgy");
  const auto old = run("sw-convert -q g.sgy --revision 0 | sw-info --command -");
  EXPECT_EQ(old.code, 1);
  EXPECT_EQ(old.err, "sw-info: standard input: does not say by which command of slipwave it was made\n");
}

TEST_F(Provenance, KeepsTheNamesThatSplitWhatIsRecorded) {
  done("sw-shoot m.nc --config shot.ini --time 0.05 -q -o '{component}.sgy'");
  write("again.sh", done("sw-info --command vz.sgy"));
  done(
      "mkdir elsewhere; cd elsewhere; sh ../again.sh 2> /dev/null; cmp vz.sgy ../vz.sgy; cmp vx.sgy "
      "../vx.sgy");
}

TEST_F(Provenance, IsNotMadeUp) {
  write("t.txt", "no gather");
  done("sw-shoot m.nc --config shot.ini --time 0.05 -q -o g.su");
  expect_refused("sw-info --command g.su", 1,
                 "sw-info: g.su: does not say by which command of slipwave it was made");
  expect_refused("sw-info --command --json m.nc", 2,
                 "sw-info: found --json and --command, expected one of them");
}

}  // namespace slipwave::provenance_test
