// SPDX-License-Identifier: BSD-3-Clause
#include <string>

#include "shell.hpp"

namespace slipwave::output_test {

// Outputs that hold what they were given, or say by how much they do not.

namespace {

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

class Output : public Shell {
 protected:
  void SetUp() override { done("sw-layers -q --size 300x200 --step 5 --layer 0:2000:1000:2000 -o m.nc"); }
  void shoot() const { done("sw-shoot -q m.nc" + shot + "--time 0.1 --record vz,p -o g.sgy"); }
  const std::string shot = " --source 150,50 --wavelet ricker:30 --receivers 50:250:50,20 ";
};

}  // namespace

TEST_F(Output, OfWholeNumbersIsNeverZerosOnly) {
  shoot();
  for (const std::string format : {"int8", "int16", "int32"}) {
    const auto ran =
        run("sw-select g.sgy --where component=vz | sw-convert --format " + format + " -o i.sgy");
    EXPECT_EQ(ran.code, 1);
    EXPECT_TRUE(has(ran.err, "every sample would become 0")) << ran.err;
    EXPECT_FALSE(exists("i.sgy"));
    const auto factor = ran.err.substr(ran.err.rfind("scale:"));
    done("sw-select g.sgy --where component=vz | sw-filter --gain " + factor.substr(0, factor.size() - 1) +
         " | sw-convert --format " + format + " -q -o i.sgy");
    done("rm i.sgy");
  }
  EXPECT_EQ(run("sw-export m.nc --property vs --format int8 -o i.sgy").code, 1);
  EXPECT_TRUE(has(run("sw-convert g.sgy --format int16 -o i.sgy").err, "every sample would become 0"));
}

TEST_F(Output, OfATruncatedOrPaddedFileIsItsWholeTraces) {
  shoot();
  done("cp g.sgy padded.sgy; head -c 512 /dev/zero >> padded.sgy; head -c -100 g.sgy > cut.sgy");
  for (const std::string command : {"sw-convert % ", "sw-filter % --gain rms ", "sw-sort % --key fldr ",
                                    "sw-select % --where 'offset>-1000' "})
    for (const std::string file : {"padded", "cut"}) {
      auto line = command;
      const auto good = line.replace(line.find('%'), 1, "g.sgy") + "-o good.sgy";
      line = command;
      const auto bad = line.replace(line.find('%'), 1, file + ".sgy") + "-o bad.sgy";
      done(good);
      const auto ran = run(bad);
      EXPECT_EQ(ran.code, 1) << bad;
      EXPECT_TRUE(has(ran.err, file == "cut" ? "ends within trace 10" : "512 bytes of zeros behind trace 10"))
          << ran.err;
      EXPECT_TRUE(has(ran.err, "whole traces were used")) << ran.err;
      done(file == "cut" ? "cmp -i 3600 -n 5000 bad.sgy good.sgy" : "cmp bad.sgy good.sgy");
      done("rm bad.sgy");
    }
  EXPECT_EQ(run("cat padded.sgy | sw-convert > p.sgy").code, 1);
  EXPECT_EQ(run("sw-compare padded.sgy padded.sgy --summary").code, 1);
  EXPECT_EQ(done("sw-info p.sgy | grep traces | head -n 1"), "  traces           10\n");
}

TEST_F(Output, OfUltrasoundIsWrittenInRevision2WithExactPlaces) {
  done("sw-layers -q --size 0.1x0.06 --step 0.0005 --layer 0:1500:0:1000 -o u.nc");
  const std::string line =
      "sw-shoot u.nc --top absorbing --source 0.05,0.03 --wavelet ricker:200000 --receivers "
      "0.02:0.08:0.0005,0.01 --time "
      "0.00004 --record p --dt ";
  const auto ran = run(line + "0.0000002 -o u.sgy");
  EXPECT_EQ(ran.code, 0) << ran.err;
  EXPECT_TRUE(has(ran.err, "revision 2")) << ran.err;
  EXPECT_TRUE(has(done("sw-info u.sgy"), "SEG-Y revision 2.1"));
  EXPECT_TRUE(has(done("sw-info u.sgy"), "receiver x       0.02 to 0.08 m"));
  done(line + "0.0000002 --revision 2 -q -o v.sgy; sw-compare u.sgy v.sgy --tolerance 0 --summary");
  const auto refused = run(line + "0.0000002 --revision 1 -o no.sgy");
  EXPECT_EQ(refused.code, 2);
  EXPECT_TRUE(has(refused.err, "--revision 2")) << refused.err;
  EXPECT_EQ(run(line + "0.0000002 -o no.su").code, 2);
  EXPECT_FALSE(exists("no.sgy") || exists("no.su"));
}

TEST_F(Output, OfRecordsTooShortForTheirWavesSaysSo) {
  const auto early = run("sw-shoot m.nc" + shot + "--time 0.03 --record vz -o g.sgy");
  EXPECT_EQ(early.code, 0);
  EXPECT_TRUE(has(early.err, "no wave can have reached 2 of 5 receivers")) << early.err;
}

TEST_F(Output, ThatFloatsCanNotHoldIsRefusedBeforeTheRun) {
  for (const std::string amplitude : {"1e300", "1e-300", "1e60"}) {
    const auto ran = run("sw-shoot m.nc" + shot + "--time 0.1 --amplitude " + amplitude + " -o g.sgy");
    EXPECT_EQ(ran.code, 2) << amplitude;
    EXPECT_TRUE(has(ran.err, "--amplitude: found " + std::string(amplitude == "1e60"    ? "1e+60"
                                                                 : amplitude == "1e300" ? "1e+300"
                                                                                        : "1e-300")))
        << ran.err;
  }
}

TEST_F(Output, TakesNoOptionInSilenceThatDoesNothing) {
  for (const std::string line :
       {"sw-plot m.nc --time 1 -o p.png",
        "sw-shoot m.nc --source 150,50 --wavelet ricker:20 --receivers 9,9 --time 0.1 --reverse -o g.sgy"})
    EXPECT_EQ(run(line).code, 2) << line;
  const std::string planes = "sw-fracture m.nc --box 100:200,60:120 --viscosity 4e3 ";
  EXPECT_TRUE(has(run(planes + "--dip 30 --friction 30 -o f.nc").err, "--friction 30"));
  EXPECT_TRUE(has(run(planes + "--dip 30 --normal 1,0 --friction 0.3 -o f.nc").err, "2 families of planes"));
}

TEST_F(Output, LeavesNoTemporaryWhateverSignalEndsTheRun) {
  for (const std::string name : {"QUIT", "USR1", "XCPU", "ALRM"}) {
    const auto before = files();
    run("ulimit -c 0; env --default-signal=" + name + " sw-shoot m.nc" + shot +
        "--time 500 --dt 0.01 -q -o long.sgy & p=$!; await 'ls -A | grep -q tmp'; kill -" + name +
        " $p; wait $p");
    EXPECT_EQ(files(), before) << name;
  }
}

TEST_F(Output, OfSnapshotsGoesOnWhenTheirLogFitsTheDiskNoMore) {
  // A limit of file sizes stands for a full disk: the log of all snapshots passes it, no snapshot does.
  const std::string line =
      "sw-shoot m.nc" + shot + "--time 0.1 --snapshots s.nc --every 0.001 --fields vx -q -o g.sgy";
  done(line + "; mv s.nc whole.nc; mv g.sgy whole.sgy");
  const auto limited = run("ulimit -f $(( $(stat -c %s whole.nc) / 1024 + 200 )); " + line +
                           " --checkpoint c --checkpoint-every 0.0001");
  EXPECT_EQ(limited.code, 0) << limited.err;
  done("cmp s.nc whole.nc; cmp g.sgy whole.sgy");
}

TEST_F(Output, OfInjectedTracesComesBackToItsSource) {
  done(
      "sw-shoot m.nc --source 150,100 --wavelet ricker:20 --receivers 10:290:10,10 --receivers 10:290:10,190 "
      "--receivers "
      "10,20:180:10 --receivers 290,20:180:10 --time 0.2 --record p --top absorbing -q -o ring.sgy");
  done(
      "sw-shoot m.nc --inject ring.sgy --reverse --receivers 50:250:10,100 --time 0.2 --record p --top "
      "absorbing -q -o back.sgy");
  EXPECT_EQ(done("sw-info --command back.sgy | grep -c 'inject ring.sgy --reverse'"), "1\n");
  // The middle of the line is loudest.
  EXPECT_EQ(done("for x in 50 100 150 200 250; do sw-select back.sgy --where gx=$x | sw-info - --json | "
                 "grep -o '\"rms\": [^,}]*' | head -n 1 | sed \"s/.*: //; s/$/ $x/\"; done | sort -g | tail "
                 "-n 1 | cut -d' ' -f2"),
            "150\n");
  expect_refused("sw-shoot m.nc --inject ring.sgy --source 9,9 --receivers 9,9 --time 0.1 -o no.sgy", 2,
                 "sw-shoot: found --inject and --source, expected one of them");
  done(
      "sw-shoot -q m.nc --source 150,100 --wavelet ricker:20 --receivers 9,9 --time 0.1 --record exx -o "
      "strain.sgy");
  expect_refused(
      "sw-shoot m.nc --inject strain.sgy --receivers 9,9 --time 0.1 -o no.sgy", 1,
      "sw-shoot: strain.sgy: trace 1: records exx, expected velocities, which are injected as forces, or "
      "pressure; sw-select --where component=vz leaves others out");
}

TEST_F(Output, OfComparisonsOverTime) {
  shoot();
  done("sw-filter g.sgy --gain scale:1.1 -o h.sgy");
  const auto table = done("sw-compare h.sgy g.sgy --summary --time 0.02:0.05 --time 0.05:0.1");
  EXPECT_TRUE(has(table, "0.02:0.05\n") && has(table, "0.05:0.1\n")) << table;
  expect_refused("sw-compare h.sgy g.sgy --time 5:6 -o no", 2,
                 "sw-compare: --time: found 5:6, no sample of h.sgy lies there: it goes from 0 to 0.1 s");
  done("sw-compare h.sgy g.sgy --nrms 0.02 -o nrms.sgy; sw-plot nrms.sgy -o nrms.png");
  EXPECT_TRUE(has(done("sw-info nrms.sgy"), " to 9.52")) << "200 0.1/2.1 percent";
}

TEST_F(Output, OfAFibreInADeviatedWell) {
  write("well.csv", "x,z\n150,20\n150,40\n150,60\n160,77\n175,87\n195,90\n215,90\n");
  done(
      "sw-shoot -q m.nc --source 60,50 --wavelet ricker:30 --receivers @well.csv --time 0.1 --record "
      "das:path:10 -o d.sgy");
  EXPECT_TRUE(has(done("sw-info d.sgy"), "fibre through"));
  // The first channels are those of an upright fibre, the last ones those of a level one.
  done(
      "sw-shoot -q m.nc --source 60,50 --wavelet ricker:30 --receivers @well.csv --time 0.1 --record "
      "das:0:10 -o z.sgy");
  done(
      "sw-shoot -q m.nc --source 60,50 --wavelet ricker:30 --receivers @well.csv --time 0.1 --record "
      "das:90:10 -o x.sgy");
  done(
      "for n in 1 2; do sw-compare <(sw-select d.sgy --where tracf=$n) <(sw-select z.sgy --where tracf=$n) "
      "--tolerance 1e-6 -q; done");
  done(
      "sw-compare <(sw-select d.sgy --where tracf=7) <(sw-select x.sgy --where tracf=7) --tolerance 1e-6 -q");
}

}  // namespace slipwave::output_test
