// SPDX-License-Identifier: BSD-3-Clause
#include <string>

#include "shell.hpp"

namespace slipwave::traces_test {
namespace {

/// Tools that change traces, on the gathers of three shots.
class Traces : public Shell {
 protected:
  Traces() {
    done("sw-layers --size 600x300 --step 10 --layer 0:2000:1000:2000 --layer 150:3000:1600:2300 -o m.nc");
    done(
        "sw-shoot m.nc --source 100,10 --source 300,10 --source 500,10 --wavelet ricker:10 "
        "--receivers 0:600:50,10 --time 0.4 --record vx,vz,p -o line.sgy");
  }
  /// Values of one column of sw-compare --summary or the like: the number behind `name` in sw-info.
  std::string info(const std::string& file, const std::string& name) const {
    return done("sw-info " + file + " | sed -n 's/^  " + name + "  *//p' | head -n 1 | tr -d '\\n'");
  }
};

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

}  // namespace

TEST_F(Traces, GoThroughAllToolsInOnePipe) {
  done(
      "sw-select line.sgy --where 'component=vz and abs(offset)<=200' | sw-sort --key 'abs(offset),shot' | "
      "sw-filter --taper 0.02 --band 2,4,30,40 --resample 0.002 --gain power:1 --gain rms -o out.sgy");
  EXPECT_TRUE(has(info("out.sgy", "component"), "name vz, traces 23, "));
  EXPECT_TRUE(has(info("out.sgy", "component"), ", rms 1 m/s"));
  EXPECT_EQ(info("out.sgy", "interval"), "0.002 s");
  EXPECT_EQ(info("out.sgy", "samples a trace"), "201");
  const auto text = done("head -c 3200 out.sgy | dd conv=ascii status=none");
  for (const char* tool : {"sw-shoot --", "sw-select --where", "sw-sort --key", "sw-filter --taper"})
    EXPECT_TRUE(has(text, tool)) << tool << " in\n" << text;
  EXPECT_EQ(files(), "line.sgy m.nc out.sgy");
}

TEST_F(Traces, ContradictionsOfHeadersAndSamplesAreWarnedOf) {
  const auto changed = [&](const std::string& from, const std::string& to, int at, const std::string& bytes) {
    done("cp " + from + " " + to + "; printf '" + bytes + "' | dd of=" + to +
         " bs=1 conv=notrunc status=none seek=" + std::to_string(at));
  };
  const auto said = [&](const std::string& line) { return run(line).err; };
  const auto info = [&](const std::string& file) { return done("sw-info " + file); };
  EXPECT_FALSE(has(info("line.sgy"), "doubt"));
  EXPECT_EQ(said("sw-spectrum line.sgy -o s.nc"), "");
  // 2 ms in the header of the third trace of 401 samples, 1 ms in that of the file.
  changed("line.sgy", "slow.sgy", 3600 + 2 * (240 + 4 * 401) + 116, "\\007\\320");
  const std::string interval =
      "slow.sgy: trace 3 says 0.002 s between samples (byte 117), taken are the 0.001 s of "
      "the file header (byte 3217)";
  EXPECT_TRUE(has(info("slow.sgy"), "doubt            " + interval)) << info("slow.sgy");
  for (const std::string line :
       {"sw-spectrum slow.sgy -o s.nc", "sw-filter slow.sgy --taper 0.1 -o f.sgy",
        "sw-sort slow.sgy --key tracl -o f.sgy", "sw-convert slow.sgy -o f.sgy",
        "sw-select slow.sgy --where 'shot>0' -o f.sgy", "sw-diff line.sgy slow.sgy -o d.sgy",
        "sw-compare slow.sgy line.sgy --summary -o c.txt"})
    EXPECT_EQ(said(line), line.substr(0, line.find(' ')) + ": warning: " + interval + "\n") << line;
  // Floating point of the other kind than the file header says.
  done("sw-convert line.sgy --format ibm -o ibm.sgy");
  EXPECT_FALSE(has(info("ibm.sgy"), "doubt"));
  changed("ibm.sgy", "ieee.sgy", 3224, "\\0\\005");
  EXPECT_TRUE(has(info("ieee.sgy"),
                  "ieee.sgy: samples are called IEEE floating point (format code 5) and look like IBM"));
  EXPECT_FALSE(has(done("sw-info --format ibm ieee.sgy"), "doubt"));
  changed("line.sgy", "ibm.sgy", 3224, "\\0\\001");
  EXPECT_TRUE(has(info("ibm.sgy"),
                  "ibm.sgy: samples are called IBM floating point (format code 1) and look like IEEE"));
  EXPECT_TRUE(has(said("sw-spectrum ibm.sgy -o s.nc"), "look like IEEE"));
}

TEST_F(Traces, SelectedOnesAndTheOthersAreAllThereAre) {
  done("sw-select line.sgy --where 'component=vz,p and shot=2:' -o a.sgy");
  done("sw-select line.sgy --where 'not (component=vz,p and shot=2:)' -o b.sgy");
  EXPECT_EQ(info("a.sgy", "traces"), "52");
  EXPECT_EQ(info("b.sgy", "traces"), "65");
  // Put together and sorted back they are the line again, byte by byte but for the running number
  // (tracr, byte 5) and the file header.
  done("{ cat a.sgy; tail -c +3601 b.sgy; } | sw-sort --key tracl -o again.sgy");
  done("sw-compare again.sgy line.sgy --tolerance 0 > /dev/null");
  EXPECT_EQ(done("for f in line again; do tail -c +3601 $f.sgy | cksum; done | uniq | wc -l"), "1\n");
}

TEST_F(Traces, OfSeveralFilesAreSortedIntoOne) {
  done("for s in 1 2 3; do sw-select line.sgy --where shot=$s -o $s.sgy; done");
  done("sw-sort 3.sgy 1.sgy 2.sgy --key component,cdp,offset -o a.sgy");
  done("sw-sort line.sgy --key component,cdp,offset -o b.sgy");
  done("cmp <(tail -c +3601 a.sgy) <(tail -c +3601 b.sgy)");
  // The first may come through a pipe.
  done("cat 3.sgy | sw-sort - 1.sgy 2.sgy --key component,cdp,offset -o c.sgy");
  done("cmp <(tail -c +3601 a.sgy) <(tail -c +3601 c.sgy)");
  const auto refused = [&](const std::string& made, const std::string& said) {
    done(made + " -o other.sgy");
    expect_refused("sw-sort 1.sgy other.sgy --key cdp -o x.sgy", 1, "sw-sort: other.sgy: the " + said);
    EXPECT_FALSE(exists("x.sgy"));
  };
  refused("sw-convert 2.sgy --format ibm", "sample format is ibm, expected ieee as in 1.sgy");
  refused("sw-convert 2.sgy --endian little", "byte order is little, expected big as in 1.sgy");
  refused("sw-convert 2.sgy --su", "file is Seismic Unix, expected SEG-Y revision 1 as in 1.sgy");
  refused("sw-filter 2.sgy --resample 0.002", "number of samples is 201, expected 401 as in 1.sgy");
}

TEST_F(Traces, KeepTheirFormatWhenOnlyTheirOrderChanges) {
  for (const std::string format : {"ibm", "int16", "double"}) {
    const std::string revision = format == "double" ? " --revision 2" : "";
    done("sw-filter line.sgy --gain peak --gain scale:30000 | sw-convert --format " + format + revision +
         " -o f.sgy");
    done("sw-sort f.sgy --key=-trace | sw-sort --key=-trace | sw-select --where 'trace>0' -o g.sgy");
    EXPECT_EQ(info("g.sgy", "samples"), format);
    done("sw-compare g.sgy f.sgy --tolerance 0 -q");
  }
}

TEST_F(Traces, SortedFilesSayByWhat) {
  const auto word = [&](const std::string& keys, int byte) {
    done("sw-sort line.sgy --key=" + keys + " -o s.sgy");
    return done("od --endian=big -An -d -j " + std::to_string(byte - 1) + " -N 2 s.sgy | tr -d ' \\n'");
  };
  EXPECT_EQ(word("cdp,offset", 3229), "2");
  EXPECT_EQ(word("shot,channel", 3229), "5");
  EXPECT_EQ(word("shot,channel", 3213), "39");  // 13 receivers, 3 components
  EXPECT_EQ(word("component", 3213), "39");
  EXPECT_EQ(word("channel,shot", 3213), "9");
}

TEST_F(Traces, SelectedFilesSayHowManyThereAre) {
  const auto word = [&](int byte, const std::string& type) {
    return done("od --endian=big -An -t " + type + " -j " + std::to_string(byte - 1) + " -N " +
                type.substr(1) + " s.sgy | tr -d ' \\n'");
  };
  done("sw-select line.sgy --where 'component=vz and not (shot=2 and channel>5)' -o s.sgy");
  EXPECT_EQ(word(3213, "d2"), "13");
  done("sw-convert line.sgy --revision 2 -o two.sgy; sw-select two.sgy --where 'component=vz' -o s.sgy");
  EXPECT_EQ(word(3261, "d4"), "13");
  EXPECT_EQ(word(3513, "d8"), "39");
  // what a pipe holds is not known before its end
  done("cat two.sgy | sw-select --where 'component=vz' -o s.sgy");
  EXPECT_EQ(word(3513, "d8"), "0");
  EXPECT_EQ(info("s.sgy", "traces"), "39");
}

TEST_F(Traces, AreSortedTheSameThroughATemporaryFile) {
  done("body() { tail -c +3601 line.sgy; }; { cat line.sgy; for i in $(seq 20); do body; done; } > big.sgy");
  done("sw-sort big.sgy --key=-offset,shot -o in-memory.sgy");
  const Ran ran = run("sw-sort big.sgy --key=-offset,shot --memory 1 -v -o through-file.sgy");
  EXPECT_EQ(ran.code, 0);
  EXPECT_TRUE(has(ran.err, " of memory and ") && has(ran.err, " MiB on disk, in ")) << ran.err;
  // the command differs, so the text does
  EXPECT_EQ(done("for f in in-memory through-file; do tail -c +3201 $f.sgy | cksum; done | uniq | wc -l"),
            "1\n");
  EXPECT_EQ(done("ls -A $TMPDIR"), "stderr\nstdout\nwork\n");
}

TEST_F(Traces, FilterGivesTheSameBytesAgain) {
  const std::string filter = "sw-filter line.sgy --band 2,4,30,40 --resample 0.0007 --gain agc:0.1 ";
  done(filter + "-o a.sgy; " + filter + "-o b.sgy; cmp a.sgy b.sgy");
}

TEST_F(Traces, ResamplingBackGivesTheShotAgain) {
  done("sw-filter line.sgy --resample 0.00025 | sw-filter --resample 0.001 -o again.sgy");
  // 10 Hz Ricker against 400 Hz: what is lost are the ends of traces that do not end at zero
  done("sw-select again.sgy --time 0:0.36 -o a.sgy; sw-select line.sgy --time 0:0.36 -o b.sgy");
  done("sw-compare a.sgy b.sgy --tolerance 1e-4 -q");
}

TEST_F(Traces, ConvolutionShiftsByTheWaveletsDelayUnlessTold) {
  // a band-limited spike, given the look of 20 Hz Ricker wavelet with and without its delay of 75 ms
  done("sw-select line.sgy --where 'shot=1 and component=vz and channel=1:3' -o few.sgy");
  done("sw-filter few.sgy --taper 0,0.2 --convolve ricker:20 -o late.sgy");
  done("sw-filter few.sgy --taper 0,0.2 --convolve ricker:20 --zero-delay -o now.sgy");
  const auto lag = done("sw-compare late.sgy now.sgy --summary | awk '/all/ { print $NF }'");
  EXPECT_NEAR(std::stod(lag), 0.075, 1e-4);
}

TEST_F(Traces, AWaveletMuchLongerThanTheTracesCostsNothing) {
  // a sine of eleven days; 2 GB hold an eighth of its samples
  done("(ulimit -v 2000000; sw-filter line.sgy --convolve sine:1e-6 -o long.sgy)");
  // from its start it grows like 2 pi F t: twice the frequency, twice the values
  done("sw-filter line.sgy --convolve sine:2e-6 --gain scale:0.5 -o half.sgy");
  done("sw-compare long.sgy half.sgy --tolerance 1e-6 -q");
}

TEST_F(Traces, GetSeismicUnixByTheNameOfTheirFile) {
  done("sw-convert line.sgy --su -o wanted; sw-convert line.sgy -o made.su; cmp wanted made.su");
  done("sw-select line.sgy --where 'component=vz' -o some.sgy; sw-convert some.sgy --su -o wanted");
  done("sw-select line.sgy --where 'component=vz' -o made.su; cmp wanted made.su");
  done("sw-sort line.sgy --key offset,component -o sorted.sgy; sw-convert sorted.sgy --su -o wanted");
  done("sw-sort line.sgy --key offset,component -o made.su; cmp wanted made.su");
  done("sw-filter line.sgy --gain rms -o made.su; sw-diff made.su made.su -o zero.su");
  EXPECT_EQ(info("zero.su", "format"), "Seismic Unix");
  expect_refused(
      "sw-convert line.sgy --revision 1 -o made.su", 2,
      "sw-convert: found -o made.su and --revision, expected one of them: Seismic Unix has no such "
      "thing");
}

TEST_F(Traces, AreComparedComponentByComponent) {
  // Velocities that differ by half do not vanish beside a pressure that is the same.
  done(
      "sw-select line.sgy --where 'component=p' -o p.sgy; sw-select line.sgy --where 'component=vz' -o "
      "vz.sgy");
  done("sw-filter vz.sgy --gain scale:0.5 -o half.sgy");
  done("sw-sort p.sgy vz.sgy --key component -o a.sgy; sw-sort p.sgy half.sgy --key component -o b.sgy");
  EXPECT_EQ(done("sw-compare a.sgy b.sgy --summary | awk '{ print $1, $2, $4 }'"),
            "# trace shot\nall vz 1\nall p 0\n");
  const Ran refused = run("sw-compare a.sgy b.sgy -q --tolerance 0.1");
  EXPECT_EQ(refused.code, 1);
  EXPECT_TRUE(has(refused.err, "is 1 in vz, expected at most 0.1")) << refused.err;
  EXPECT_EQ(done("sw-compare a.sgy b.sgy --json --summary | python3 -c 'import json, sys; "
                 "print([(c[\"component\"], c[\"relative_l2\"][\"value\"]) for c in "
                 "json.load(sys.stdin)[\"components\"]])'"),
            "[('vz', 1), ('p', 0)]\n");
}

TEST_F(Traces, HaveTheSameFkSpectrumInWhateverOrderTheyStand) {
  done("sw-select line.sgy --where shot=2 -o shot.sgy; sw-sort shot.sgy --key=-channel -o mixed.sgy");
  const std::string numbers = " --fk --text | grep -v '^#'";
  EXPECT_NE(done("sw-spectrum shot.sgy" + numbers), "");
  EXPECT_EQ(done("sw-spectrum shot.sgy" + numbers), done("sw-spectrum mixed.sgy" + numbers));
}

}  // namespace slipwave::traces_test
