#include <string>
#include <vector>

#include "shell.hpp"

namespace {

/// What each tool says about misuse and bad data: one line, nothing written.
class TracesBadInput : public Shell {
 protected:
  TracesBadInput() {
    done("sw-layers --size 300x100 --step 10 --layer 0:2000:1000:2000 -o m.nc");
    done(
        "sw-shoot m.nc --source 150,10 --wavelet ricker:10 --receivers 0:300:100,10 --time 0.1 --record "
        "vx,vz "
        "-o a.sgy");
  }
  struct Case {
    std::string line;
    int code;
    std::string message;
  };
  void expect_all(const std::vector<Case>& cases) const {
    for (const auto& one : cases) {
      expect_refused(one.line, one.code, one.message);
      expect_refused(one.line + " -o out.sgy", one.code, one.message);
      EXPECT_FALSE(exists("out.sgy")) << one.line;
    }
  }
};

}  // namespace

TEST_F(TracesBadInput, OfSwFilterIsMisuse) {
  const std::string gains = "expected one of power:P, exp:A, agc:T, rms, peak, scale:C, clip:C";
  expect_all({
      {"sw-filter a.sgy --band 5,10,20", 2,
       "sw-filter: --band: found '5,10,20', expected F1,F2,F3,F4 in Hz, none below the one before it"},
      {"sw-filter a.sgy --band 5,10,20,x", 2,
       "sw-filter: --band: found '5,10,20,x', expected numbers with ',' between them ('x' is not a number)"},
      {"sw-filter a.sgy --band 10,5,20,30", 2,
       "sw-filter: --band: found '10,5,20,30', expected F1,F2,F3,F4 in Hz, none below the one before it"},
      {"sw-filter a.sgy --band 0,0,400,600", 2,
       "sw-filter: --band: found F4 = 600 Hz, expected at most the Nyquist frequency 500 Hz of samples every "
       "0.001 s"},
      {"sw-filter a.sgy --gain tpow:2", 2, "sw-filter: --gain: found 'tpow:2', " + gains},
      {"sw-filter a.sgy --gain rms --gain agc", 2, "sw-filter: --gain: found 'agc', " + gains},
      {"sw-filter a.sgy --gain agc:-1", 2, "sw-filter: --gain: found 'agc:-1', expected T above 0"},
      {"sw-filter a.sgy --taper 0.1,0.2,0.3", 2,
       "sw-filter: --taper: found '0.1,0.2,0.3', expected T or START,END in s, none negative"},
      {"sw-filter a.sgy --resample 0", 2, "sw-filter: --resample: found 0 s, expected an interval above 0"},
      {"sw-filter a.sgy --resample 1ms", 2, "sw-filter: --resample: found '1ms', expected a number"},
      {"sw-filter a.sgy --resample 0.0000005", 1,
       "sw-filter: 200001 samples a trace, SEG-Y revision 1 holds 1 to 65535"},
      {"sw-filter a.sgy --resample 0.0012345", 1,
       "sw-filter: sample interval 0.0012345 s, SEG-Y revision 1 holds whole microseconds up to 65535 "
       "(resample, or "
       "write revision 2)"},
      {"sw-filter a.sgy --convolve rickr:20", 2,
       "sw-filter: --convolve: wavelet: found 'rickr:20', expected ricker:F, gauss:F, sine:F[:CYCLES] (F in "
       "Hz) or file:PATH"},
      {"sw-filter a.sgy --convolve file:none.txt", 1,
       "sw-filter: --convolve: none.txt: No such file or directory"},
      {"sw-filter a.sgy --zero-delay", 2, "sw-filter: --zero-delay: found no --convolve, expected one"},
  });
}

TEST_F(TracesBadInput, OfSwSelectAndSwSortSaysWhere) {
  expect_all({
      {"sw-select a.sgy", 2, "sw-select: found neither --where nor --time, expected one of them"},
      {"sw-select a.sgy --where 'component=vz and ofset>=100'", 2,
       "sw-select: --where: character 18, 'ofset': unknown name, did you mean offset?"},
      {"sw-select a.sgy --where offset", 2,
       "sw-select: --where: 'offset' is no condition, expected one like offset>=100"},
      {"sw-select a.sgy --where '(shot=1'", 2,
       "sw-select: --where: character 8, the end: expected ) for the ( at character 1"},
      {"sw-select a.sgy --where shot=2", 1,
       "sw-select: a.sgy: none of 8 traces meets 'shot=2', expected at least one"},
      {"sw-select a.sgy --time 1", 2, "sw-select: --time: found '1', expected T0:T1 in s, T0 not above T1"},
      {"sw-select a.sgy --time 3:4", 1,
       "sw-select: a.sgy: trace 1: has no samples from 3 to 4 s, it goes from 0 to 0.1 s"},
      {"sw-sort a.sgy", 2, "sw-sort: --key is missing; expected --key KEY[,...]"},
      {"sw-sort a.sgy --key cdp,ofset", 2,
       "sw-sort: --key: 'ofset': character 1, 'ofset': unknown name, did you mean offset?"},
      {"sw-sort a.sgy --key shot=1", 2,
       "sw-sort: --key: 'shot=1': is a condition, expected a number or component"},
      {"sw-sort a.sgy --key cdp --memory 0", 2, "sw-sort: --memory: found 0, expected at least 1 MiB"},
  });
}

TEST_F(TracesBadInput, WhatIsNoNumberIsNamedByTraceAndSample) {
  // a NaN for the 17th sample of the second trace
  done(
      "cp a.sgy nan.sgy; printf '\\177\\300\\000\\000' | "
      "dd of=nan.sgy bs=1 seek=$((3600 + 644 + 240 + 64)) conv=notrunc status=none");
  const std::string what = "trace 2: sample 17: nan";
  expect_all({
      {"sw-filter nan.sgy --gain rms", 1, "sw-filter: nan.sgy: " + what + ", expected a finite number"},
      {"sw-spectrum nan.sgy", 1, "sw-spectrum: nan.sgy: " + what + ", expected a finite number"},
      {"sw-spectrum nan.sgy --fk --text", 1, "sw-spectrum: nan.sgy: " + what + ", expected a finite number"},
      {"sw-compare a.sgy nan.sgy", 1, "sw-compare: nan.sgy: " + what + ", expected a finite number"},
      {"sw-diff nan.sgy a.sgy", 1, "sw-diff: " + what + ", expected a finite number"},
  });
}

TEST_F(TracesBadInput, FkWantsTheTracesOfAShotTogetherOnAnEvenLine) {
  done("sw-select a.sgy --where 'channel!=2' -o uneven.sgy; sw-select a.sgy --where channel=1 -o one.sgy");
  done("sw-sort a.sgy --key channel -o mixed.sgy");
  expect_all({
      {"sw-spectrum a.sgy --fk --each", 2,
       "sw-spectrum: found --fk and --each, expected one of them: a gather makes one f-k spectrum"},
      {"sw-spectrum uneven.sgy --fk", 1,
       "sw-spectrum: uneven.sgy: shot 1, vx: receivers at x = 0 and 200 m, expected one every 150 m"},
      {"sw-spectrum a.sgy --pad 1e4", 2,
       "sw-spectrum: zero padding of 10000 times the trace, expected 1 to 1000"},
      {"sw-spectrum one.sgy --fk", 1,
       "sw-spectrum: one.sgy: shot 1, vx: has 1 receiver, expected a line of at least two"},
  });
  done(
      "sw-spectrum a.sgy --fk --text | grep -v '^#' > a.txt; sw-spectrum mixed.sgy --fk --text | grep -v "
      "'^#' | "
      "cmp - a.txt");
}

TEST_F(TracesBadInput, FilesThatAreNoneOrEndEarlyLeaveNoOutput) {
  done("head -c 5400 a.sgy > cut.sgy; : > empty.sgy; mkdir folder; echo text > text.sgy");
  for (const std::string tool :
       {"sw-filter", "sw-select --where shot=1", "sw-sort --key shot", "sw-spectrum"}) {
    const std::string name = tool.substr(0, tool.find(' '));
    expect_all({
        {tool + " none.sgy", 1, name + ": none.sgy: No such file or directory"},
        {tool + " folder", 1, name + ": folder: is a directory, expected a file"},
        {tool + " cut.sgy", 1, name + ": cut.sgy: ends within trace 3: 512 of 644 bytes"},
    });
    for (const std::string file : {"empty.sgy", "text.sgy"}) {
      const Ran ran = run(tool + " " + file + " -o out.sgy");
      EXPECT_EQ(ran.code, 1) << tool << " " << file;
      EXPECT_EQ(ran.err.find(name + ": " + file + ": "), 0U) << ran.err;
      EXPECT_EQ(ran.err.find('\n'), ran.err.size() - 1) << ran.err;
      EXPECT_FALSE(exists("out.sgy"));
    }
  }
}
