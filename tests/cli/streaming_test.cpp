// SPDX-License-Identifier: BSD-3-Clause
#include <string>

#include "shell.hpp"

namespace slipwave::streaming_test {
namespace {

/// Trace tools on a gather of 1 MB fifteen, thirty and sixty times over, through pipes.
class Streaming : public Shell {
 protected:
  Streaming() {
    done(
        "sw-layers --size 600x200 --step 10 --layer 0:2000:1000:2000 -o m.nc; "
        "sw-shoot m.nc --source 300,10 --wavelet ricker:10 --receivers 0:600:5,10 --time 1 --dt 0.001 "
        "--record vx,vz -o once.sgy");
    done(
        "times() { cat once.sgy; for i in $(seq 2 $1); do tail -c +3601 once.sgy; done; }; "
        "times 15 > quarter.sgy; times 30 > half.sgy; times 60 > whole.sgy");
  }
  /// Of the largest process of a line that finds its input in $GATHER.
  double peak_mib(const std::string& gather, const std::string& line) const {
    const Ran ran = run("export GATHER=" + gather + "; " + line);
    EXPECT_EQ(ran.code, 0) << line;
    EXPECT_EQ(ran.err, "") << line;
    return ran.peak_mib;
  }
  /// How much more memory twice the traces take, 31 MB of them or another file.
  double growth_mib(const std::string& line, const std::string& half = "half.sgy",
                    const std::string& whole = "whole.sgy") const {
    return peak_mib(whole, line) - peak_mib(half, line);
  }
};

}  // namespace

TEST_F(Streaming, ToolsThatTakeATraceAtATimeDoNotGrow) {
  for (const std::string line :
       {"cat $GATHER | sw-select --where 'offset>=-1000' | cat > /dev/null",
        "cat $GATHER | sw-convert --format ibm | cat > /dev/null",
        "cat $GATHER | sw-filter --band 2,4,20,30 --resample 0.002 --gain agc:0.1 | cat > /dev/null",
        "cat $GATHER | sw-diff - $GATHER -o difference.sgy", "cat $GATHER | sw-compare - $GATHER --summary",
        "cat $GATHER | sw-spectrum --text", "cat $GATHER | sw-spectrum --each -o each.nc"})
    EXPECT_LT(long_form() ? growth_mib(line) : growth_mib(line, "quarter.sgy", "half.sgy"), 4) << line;
}

TEST_F(Streaming, SortTakesTheMemoryItIsGiven) {
  const std::string sort = "cat $GATHER | sw-sort --key offset,-trace -o sorted.sgy --memory ";
  EXPECT_LT(growth_mib(sort + "4"), 4);
  EXPECT_LT(peak_mib("whole.sgy", sort + "4"), 30);
  EXPECT_GT(growth_mib(sort + "100"), 25);
}

TEST_F(Streaming, SortSaysWhatItsTemporaryFileIsShortOf) {
  const std::string sort = "sw-sort whole.sgy --key offset --memory 1 -o sorted.sgy";
  const Ran full = run("ulimit -f 10000; " + sort);
  EXPECT_EQ(full.code, 1);
  EXPECT_NE(full.err.find(": writing a temporary file: File too large\n"), std::string::npos) << full.err;
  expect_refused("TMPDIR=/no/such/place " + sort, 1, "sw-sort: /no/such/place: No such file or directory");
  // A pipe that stays open: what it took so far is in its temporary file.
  const Ran ended =
      run("mkfifo pipe; exec 3<> pipe; sw-sort --key offset --memory 1 -o sorted.sgy <&3 & tool=$!; "
          "cat whole.sgy >&3; kill -TERM $tool; wait $tool");
  EXPECT_EQ(ended.code, 128 + 15);
  EXPECT_FALSE(exists("sorted.sgy"));
  EXPECT_EQ(done("find $TMPDIR -name 'slipwave.*'"), "");
}

TEST_F(Streaming, AReaderThatStopsEarlyStopsTheWholePipeQuietly) {
  const Ran ran =
      run("cat whole.sgy | sw-filter --gain rms | sw-sort --key offset --memory 2 | head -c 5000 | wc -c");
  EXPECT_EQ(ran.err, "");
  EXPECT_EQ(ran.out, "5000\n");
  EXPECT_NE(ran.code, 0);
  EXPECT_EQ(done("ls -A $TMPDIR"), "stderr\nstdout\nwork\n");
}

}  // namespace slipwave::streaming_test
