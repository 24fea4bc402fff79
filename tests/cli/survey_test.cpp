// SPDX-License-Identifier: BSD-3-Clause
#include "shell.hpp"

namespace slipwave::survey_test {
namespace {

const std::string source = "--wavelet ricker:20 --time 0.2 --dt 0.002 ";

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

/// Sources and receivers as people give them, over water, rock and a hill.
class SurveyOfSea : public Shell {
 protected:
  void SetUp() override {
    done("sw-layers --size 600x300 --step 5 --layer 0:1500:0:1000 --layer 100:3000:1500:2200 -o m.nc");
  }
  /// Both commands record the same: headers and samples, but for what the texts say of the commands.
  void expect_same(const std::string& one, const std::string& other) {
    done("sw-shoot m.nc " + source + one + " -o one.sgy");
    done("sw-shoot m.nc " + source + other + " -o other.sgy");
    EXPECT_EQ(run("cmp <(tail -c +3601 one.sgy) <(tail -c +3601 other.sgy)").out, "") << one << '\n' << other;
  }
  std::string info(const std::string& name) { return done("sw-info " + name); }
};

class SurveyOnHill : public Shell {
 protected:
  void make(const std::string& fit) {
    done("sw-layers -q --size 600x300 --step 5 --layer sine,60,25,500:2500:1300:2200 --fit " + fit +
         " -o m.nc");
  }
};

}  // namespace

TEST_F(SurveyOfSea, LinesOfSourcesAreShots) {
  expect_same("--source 100:300:100,10 --receivers 50,20",
              "--source 100,10 --source 200,10 --source 300,10 --receivers 50,20");
}

TEST_F(SurveyOfSea, DepthsFromSurfaceAndFloorAreThoseOfTheModel) {
  expect_same(
      "--source 100,surface+10 --receivers 0:600:50,floor-5 --receivers 300,floor --receivers 300,surface",
      "--source 100,10 --receivers 0:600:50,95 --receivers 300,100 --receivers 300,0");
}

/// Between columns the ground of other cells is a little higher or lower than that of the model, at x = 760 m
/// by a millimetre.
TEST_F(SurveyOfSea, PlacesOnTheSurfaceFollowTheGroundOfCellsThatErrorChooses) {
  write("hills.txt", "0 60\n250 75\n500 40\n750 30\n1000 70\n");
  done("sw-layers -q --size 1000x500 --step 12.5 --layer smooth@hills.txt:1800:800:1900 -o hills.nc");
  const auto ran =
      run("sw-shoot hills.nc --source 300,surface+40 --wavelet ricker:8 --receivers 600:900:20,surface "
          "--record vz --time 0.3 --error 0.1 -o hills.sgy");
  EXPECT_EQ(ran.code, 0) << ran.err;
  EXPECT_TRUE(has(ran.err, "measured error: ")) << ran.err;
  EXPECT_TRUE(has(done("sw-select hills.sgy --where receiver_x=760 | sw-info -"), "receiver z       30.6"));
}

TEST_F(SurveyOfSea, AStreamerMovesWithItsSource) {
  done("sw-shoot m.nc " + source + "--source 300:500:100,10 --receivers -250:-50:50,15 -o line.sgy");
  for (const std::string notation : {"-250:-50:50", "+-250:+-50:50"}) {
    done("sw-shoot m.nc " + source + "--source 400,10 --first-shot 2 --receivers " + notation +
         ",15 -o two.sgy");
    done("sw-shoot m.nc " + source +
         "--source 400,10 --first-shot 2 --receivers 150:350:50,15 -o absolute.sgy");
    done("cmp <(tail -c +3601 two.sgy) <(tail -c +3601 absolute.sgy)");
  }
  done("sw-select line.sgy --where shot=2 -o second.sgy");
  const auto left = run("sw-diff second.sgy two.sgy | sw-info - | grep '^  component'");
  EXPECT_NE(left.out, "");
  for (std::size_t at = left.out.find("amplitude"); at != std::string::npos;
       at = left.out.find("amplitude", at + 1))
    EXPECT_EQ(left.out.compare(at, 12, "amplitude 0 "), 0) << left.out;
}

TEST_F(SurveyOfSea, ATableSaysWhatOptionsSay) {
  write("s.csv", "# a boat\nz, shot ,x\nsurface+10,7,100\n 10,9,\"200\"\n");
  write("r.txt", "0 20\n50 20\n100 floor\n");
  done("sw-shoot m.nc " + source + "--source @s.csv --receivers @r.txt -o shot-{shot}.sgy");
  EXPECT_EQ(files(), "m.nc r.txt s.csv shot-7.sgy shot-9.sgy");
  EXPECT_TRUE(has(info("shot-9.sgy"), "source x         200 m"));
  done("sw-shoot m.nc " + source +
       "--source 200,10 --first-shot 9 --receivers 0:50:50,20 --receivers 100,100 -o same.sgy");
  done("cmp <(tail -c +3601 shot-9.sgy) <(tail -c +3601 same.sgy)");
}

TEST_F(SurveyOfSea, ShotsOfATableMayHaveWaveletsKindsAndReceiversOfTheirOwn) {
  write("s.csv", "shot,x,depth,wavelet,kind,amplitude\n1,100,10,,,\n2,200,120,ricker:15,\"force:0,1\",3\n");
  write("r.csv", "shot,x,z,channel\n2,300,20,5\n1,100,20,9\n2,+50,20,6\n");
  done("sw-shoot m.nc " + source + "--source @s.csv --receivers @r.csv -o {shot}.sgy");
  done(
      "sw-shoot m.nc --time 0.2 --dt 0.002 --wavelet ricker:15 --kind force:0,1 --amplitude 3 --first-shot 2 "
      "--source 200,120 --receivers 300,20 --receivers 250,20 -o same.sgy");
  EXPECT_EQ(run("cmp <(tail -c +3841 2.sgy | head -c 400) <(tail -c +3841 same.sgy | head -c 400)").code, 0);
  EXPECT_EQ(done("od -An -tx1 -j 3612 -N 4 2.sgy"), " 00 00 00 05\n");  // channel
}

TEST_F(SurveyOfSea, ShotsWrittenAreTakenAsGeometry) {
  for (const std::string spread : {"--source 100,10 --source 400,12.5 --receivers 0:600:25,20",
                                   "--source 250,10 --receivers 250,100:200:20",
                                   "--source 100:300:100,10 --receivers +50:+250:12.5,floor --first-shot 12",
                                   "--source 0,10 --receivers 0,20:80:20"}) {
    done("sw-shoot m.nc " + source + spread + " -o first.sgy");
    done("sw-shoot m.nc " + source + "--geometry first.sgy -o again.sgy");
    EXPECT_EQ(run("cmp <(tail -c +3601 first.sgy) <(tail -c +3601 again.sgy)").out, "") << spread;
    done("sw-convert first.sgy --su -o first.su");
    done("sw-shoot m.nc " + source + "--geometry first.su -o again.sgy");
    EXPECT_EQ(run("cmp <(tail -c +3601 first.sgy) <(tail -c +3601 again.sgy)").out, "") << spread;
  }
}

TEST_F(SurveyOfSea, ASurveyOnAMapIsTurnedIntoTheModel) {
  // Along the north, 40 m beside the line at its end.
  write("map.csv",
        "shot,channel,cdp,sx,sy,sdepth,gx,gy,gz\n"
        "31,4,7,5000,90100,10,5000,90300,20\n"
        "31,5,8,5000,90100,10,5040,90400,20\n");
  const auto ran = run("sw-shoot m.nc " + source +
                       "--geometry map.csv --origin 5000,90000 --azimuth 0 --record p -o map.sgy");
  EXPECT_EQ(ran.code, 0);
  EXPECT_TRUE(has(ran.err, "places by up to 40 m across it and offsets by up to 2.65 m")) << ran.err;
  EXPECT_TRUE(has(ran.err, "--origin and --azimuth choose the section")) << ran.err;
  const auto text = info("map.sgy");
  EXPECT_TRUE(has(text, "source y         90100 m") && has(text, "receiver y       90300 to 90400 m"))
      << text;
  EXPECT_EQ(done("od -An -tx1 -j 3608 -N 16 map.sgy"), " 00 00 00 1f 00 00 00 04 00 00 00 1f 00 00 00 07\n");
  // The samples are those of the places on the section.
  done("sw-shoot m.nc " + source + "--source 100,10 --receivers 300:400:100,20 --record p -o plain.sgy");
  EXPECT_EQ(run("cmp <(tail -c +3841 map.sgy | head -c 404) <(tail -c +3841 plain.sgy | head -c 404)").code,
            0);
}

TEST_F(SurveyOfSea, ShotsInTheGeometryOfFieldDataAreTakenFromThemTraceByTrace) {
  write("map.csv",
        "shot,channel,cdp,sx,sy,sdepth,gx,gy,gz\n"
        "31,4,7,500100,90000,10,500300,90000,20\n"
        "31,9,8,500100,90000,10,500400.5,90000,20\n"
        "35,4,9,500200,90000,10,500400.5,90000,20\n");
  const std::string record = "sw-shoot m.nc --time 0.2 --dt 0.002 --record p --origin 500000,90000 ";
  done(record + "--wavelet ricker:20 --geometry map.csv -o field.sgy");
  // As field data say: trid 1, seismic data.
  done(
      "for t in 0 1 2; do printf '\\0\\1' | dd of=field.sgy bs=1 conv=notrunc status=none "
      "seek=$((3628 + 644 * t)); done");
  done(record + "--wavelet ricker:25 --geometry field.sgy -o model.sgy");
  done("sw-diff field.sgy model.sgy -o difference.sgy");
  EXPECT_TRUE(has(info("difference.sgy"), "traces           3"));
}

TEST_F(SurveyOfSea, BlendedShotsAddUp) {
  const std::string line = source +
                           "--time-step 0.0015 --precision double --record p --source 100:300:100,10 "
                           "--receivers 0:600:50,20 ";
  write("b.csv", "record,shot,delay,amplitude\n5,1,0,\n5,3,0,-2\n");
  done("sw-shoot m.nc " + line + "--blend b.csv -o blended.sgy");
  done("sw-shoot m.nc " + line + "--shots 1 -o 1.sgy");
  done("sw-shoot m.nc " + line + "--shots 3 --amplitude 2 -o 3.sgy");
  done("sw-select blended.sgy --where 'shot=5' -o five.sgy");
  // 1 - 2 x 3, made of samples behind each header.
  done(
      "for f in five 1 3; do sw-convert $f.sgy --format ieee --endian little -o le.sgy; "
      "tail -c +3601 le.sgy | od -An -v -tf4 -w4 | awk 'NR % 161 > 60 || NR % 161 == 0' > $f.txt; done; "
      "paste five.txt 1.txt 3.txt | awk '{ d = $1 - ($2 - $3); e += d * d; s += $1 * $1 } "
      "END { print (s > 0 && sqrt(e / s) < 1e-6) ? \"adds up\" : sqrt(e / s) }' > sum.txt");
  EXPECT_EQ(content("sum.txt"), "adds up\n");
}

TEST_F(SurveyOfSea, ADelayBelowZeroFiresBeforeTheRecord) {
  // Times are 0.001 s times powers of 2, so that 32 samples are to the bit what both differ by.
  const std::string line = "sw-shoot m.nc --wavelet ricker:20 --record p --receivers 300,20 ";
  write("early.csv", "shot,x,z,delay\n1,200,10,-0.032\n1,400,10,0.032\n2,500,10,0\n");
  write("late.csv", "shot,x,z,delay\n1,200,10,0\n1,400,10,0.064\n2,500,10,0.032\n");
  done(line + "--time 0.256 --source @early.csv -o early.sgy");
  done(line + "--time 0.288 --source @late.csv -o late.sgy");
  for (const std::string shot : {"1", "2"}) {
    done("for f in early late; do sw-select $f.sgy --where shot=" + shot +
         " -o one.sgy; od -An -v -tx4 -w4 -j 3840 one.sgy > $f.txt; done");
    EXPECT_EQ(done("cat early.txt | wc -l"), "257\n");
    done("tail -n 257 late.txt | cmp - early.txt");
  }
  EXPECT_TRUE(has(info("early.sgy"), "0 to 0.256 s")) << info("early.sgy");
}

TEST_F(SurveyOnHill, GeophonesStandOnTheGround) {
  for (const std::string fit : {"surface,floor", "none"}) {
    make(fit);
    expect_refused("sw-shoot m.nc " + source + "--source 300,surface+4 --receivers 0:600:50,40", 2,
                   std::string("sw-shoot: receiver 1 at x=0 z=40 ") +
                       (fit == "none" ? "is in void" : "lies above the model") +
                       ", expected rock or fluid: the surface there is at z=60");
    done("sw-shoot m.nc " + source +
         "--source 300,surface+4 --receivers 0:600:50,surface --record vz -o a.sgy");
    const auto text = done("sw-info a.sgy");
    EXPECT_TRUE(
        has(text, fit == "none" ? "receiver z       35 to 85 m" : "receiver z       36.2236 to 83.7764 m"))
        << text;
    done("sw-shoot m.nc " + source + "--geometry a.sgy --record vz -o b.sgy");
    EXPECT_EQ(run("cmp <(tail -c +3601 a.sgy) <(tail -c +3601 b.sgy)").out, "") << fit;
    done("sw-shoot m.nc " + source +
         "--geometry a.sgy --source-depth surface+4 --receiver-depth surface --record vz -o c.sgy");
    EXPECT_EQ(run("cmp <(tail -c +3601 a.sgy) <(tail -c +3601 c.sgy)").out, "") << fit;
  }
  expect_refused("sw-shoot m.nc " + source + "--source 300,surface+4 --receivers 0:600:50,floor", 2,
                 "sw-shoot: receiver 1 has its depth from the sea floor, found no water above rock at x=0");
}

TEST_F(SurveyOfSea, LongGeometryLeavesTheTextualHeaderWhatItMustSay) {
  std::string many = "--source 100,10";
  for (int n = 0; n < 101; ++n)
    many += " --receivers " + std::to_string(5 * n) + "," + std::to_string(10 + n % 7);
  done("sw-shoot m.nc " + source + many + " -o m.sgy");
  done("sw-filter m.sgy --taper 0.05 -o m2.sgy");
  const auto text = info("m2.sgy");
  for (const std::string part :
       {"source: explosion", "Recorded: vz m/s (trid 12)", "Signs: z and vz", "Sampling: 101",
        "Bytes: source x 73", "Lengths in metres", "sw-filter --taper"})
    EXPECT_TRUE(has(text, part)) << part << text;
}

TEST_F(SurveyOfSea, EveryMalformedTableIsNamedByLineAndColumn) {
  const auto refused = [&](const std::string& table, const std::string& option, int code,
                           const std::string& sentence) {
    write("t.csv", table);
    expect_refused("sw-shoot m.nc " + source + option + " -o no.sgy", code, "sw-shoot: " + sentence);
    EXPECT_FALSE(exists("no.sgy"));
  };
  const std::string shot = "--source 100,10 --receivers @t.csv", shots = "--receivers 100,10 --source @t.csv";
  refused("x,z\n1,2\n3,nan\n", shot, 1,
          "t.csv: line 3: column z: found 'nan', expected a depth in m, surface+D or floor-D");
  refused("x,z\n1,2\n3\n", shot, 1, "t.csv: line 3: found 1 value, expected 2, one for each column");
  refused("x,dept\n1,2\n", shot, 1, "t.csv: found column 'dept', expected x, y, z, depth, shot or channel");
  refused("x,z,depth\n1,2,3\n", shot, 1, "t.csv: found columns z and depth, expected one of them");
  refused("1 2 3\n", shot, 1,
          "t.csv: found 3 columns without a header line, expected X Z or names above the columns");
  refused("x,z\n1,surface*2\n", shot, 1,
          "t.csv: line 2: column z: found 'surface*2', expected surface, surface+D or surface-D");
  refused("x,z,channel\n1,2,1\n2,2,1\n", shot, 1,
          "t.csv: line 3: found channel 1 again (first: t.csv: line 2), expected it once");
  refused("x,z,shot\n1,2,1\n1,2,2\n", shot, 1,
          "t.csv: line 3: found a receiver of shot 2, which has no source");
  refused("x,z,delay\n1,2,-1\n", shots + " --snapshots s.nc --every 0.1", 2,
          "found --snapshots and a delay below 0, expected one of them: snapshots begin with the record");
  refused("x,z,wavelet\n100,20,rick:3\n", shots, 1,
          "t.csv: line 2: wavelet: found 'rick:3', expected ricker:F, gauss:F, sine:F[:CYCLES] (F in Hz) or "
          "file:PATH");
  refused("", shots, 1, "t.csv: found no row, expected a table");
  refused("# sources\nx,z\n\n# none\n", shots, 1, "t.csv: found no row below the header line, expected some");
  refused("x,z\n100,301\n", shots, 1,
          "t.csv: line 2: the source at x=100 z=301 lies outside the model, expected x=0..600 z=0..300");
  refused("shot,sx,sz,gx,gz\n1,1,1,2,1\n1,9,1,3,1\n", "--geometry t.csv", 1,
          "t.csv: line 3: found another source of shot 1 than before (t.csv: line 2), expected one place for "
          "a shot");
  refused("shot,channel,sx,sz,gx,gz\n1,1,1,1,2,1\n1,1,1,1,3,1\n", "--geometry t.csv", 1,
          "t.csv: line 3: found channel 1 twice in a shot, first on line 2; expected it once");
  refused("record,shot\n1,4\n", "--source 1,1 --receivers 5,5 --blend t.csv", 1,
          "t.csv: line 2: column shot: found shot 4, which the survey does not have");
  write("t.csv", "x,z,wavelet\n100,20,ricker:20\n200,20,\n");
  expect_refused("sw-shoot m.nc --time 0.2 --receivers 100,10 --source @t.csv", 2,
                 "sw-shoot: t.csv: line 3: found no wavelet, expected one there or --wavelet W");
  expect_refused("sw-shoot m.nc " + source + "--geometry m.nc", 1,
                 "sw-shoot: m.nc: expected traces in SEG-Y or SU, a CSV table or SPS, found none of them");
  expect_refused("sw-shoot m.nc " + source + "--geometry t.csv --source 1,1", 2,
                 "sw-shoot: found --geometry and --source, expected one of them");
  expect_refused("sw-shoot m.nc " + source + "--source 1,1 --origin 1,1", 2,
                 "sw-shoot: found --origin without --geometry, expected both");
  expect_refused("sw-shoot m.nc " + source + "--source 100:200:100,10 --receivers 5,5 --shots 3", 2,
                 "sw-shoot: --shots: found no shot 3 in the survey, whose shots are numbered 1 to 2");
}

TEST_F(SurveyOfSea, HeadersWithoutGeometrySayWhatIsMissing) {
  done("sw-shoot m.nc " + source + "--source 100,10 --receivers 200:400:100,10 --record p -o a.sgy");
  const auto changed = [&](const std::string& bytes) {
    done("cp a.sgy b.sgy");
    // Every trace: 240 + 4 x 101 bytes.
    for (const int trace : {0, 1, 2})
      done("printf '" + bytes +
           "' | dd of=b.sgy bs=1 conv=notrunc status=none seek=" + std::to_string(3600 + trace * 644 + 72));
  };
  changed(std::string("\\0\\0\\0\\0\\0\\0\\0\\0\\0\\0\\0\\0\\0\\0\\0\\0"));
  // Midpoints and offsets tell as much.
  done("sw-shoot m.nc " + source + "--geometry b.sgy --record p -o c.sgy");
  EXPECT_TRUE(has(info("c.sgy"), "receiver x       200 to 400 m"));
  done("printf '\\0\\7' | dd of=b.sgy bs=1 conv=notrunc status=none seek=3670");  // scalco 7
  expect_refused(
      "sw-shoot m.nc " + source + "--geometry b.sgy", 1,
      "sw-shoot: b.sgy: trace 1: found scalar scalco (byte 71) 7, expected 1, 10, 100, 1000 or 10000, or "
      "one of them negative");
  done("cp a.sgy b.sgy; printf '\\0\\0\\0\\1' | dd of=b.sgy bs=1 conv=notrunc status=none seek=4256");
  expect_refused(
      "sw-shoot m.nc " + source + "--geometry b.sgy", 1,
      "sw-shoot: b.sgy: trace 2: found channel 1 of field record 1 again (first: trace 1), expected it "
      "once");
  // A scalar of 100 where it was 1.
  done(
      "cp a.sgy b.sgy; for t in 0 1 2; do printf '\\0\\144' | dd of=b.sgy bs=1 conv=notrunc status=none "
      "seek=$((3670 + 644 * t)); done");
  expect_refused(
      "sw-shoot m.nc " + source + "--geometry b.sgy", 1,
      "sw-shoot: b.sgy: trace 1: the source at x=10000 z=10 lies outside the model, expected x=0..600 "
      "z=0..300; the survey would begin at the model's origin with --origin 9999,0; or the scalar scalco "
      "(byte 71) 100 is reversed: it multiplies, -100 divides");
}

}  // namespace slipwave::survey_test
