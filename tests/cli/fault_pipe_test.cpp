// SPDX-License-Identifier: BSD-3-Clause
#include "fault_scene.hpp"

namespace slipwave::fault_pipe_test {
namespace {

class FaultOfPipes : public FaultScene {
 protected:
  /// Runs the line with standard output a pipe whose reader has gone.
  Ran run_unread(const std::string& before, const std::string& line) const {
    return run("mkfifo pipe; exec 4<> pipe; exec 5> pipe; exec 4>&-; " + before + "(" + line +
               ") >&5 5>&-; code=$?; rm pipe; exit $code");
  }
};

}  // namespace

TEST_F(FaultOfPipes, AReaderThatHasGoneEndsEveryToolQuietly) {
  for (const auto& command : commands()) {
    if (command.tool == "sw-accuracy") continue;  // its table goes to a file, too
    // Also where the parent ignores the signal.
    for (const std::string before : {"", "trap '' PIPE; "}) {
      const Ran ran = run_unread(before, command.to("-"));
      EXPECT_EQ(ran.code, 128 + 13) << before << command.to("-");
      EXPECT_EQ(ran.err, "") << before << command.to("-");
      EXPECT_EQ(files(), "in") << before << command.to("-");
    }
  }
  EXPECT_EQ(run("ls -A $TMPDIR").out, "stderr\nstdout\nwork\n");
}

TEST_F(FaultOfPipes, AClosedStandardOutputIsSaid) {
  for (const auto& command : commands()) {
    if (command.tool == "sw-accuracy") continue;
    const Ran ran = run(command.to("-") + " >&-");
    EXPECT_EQ(ran.code, 1) << command.to("-");
    EXPECT_EQ(ran.err, command.tool + ": standard output: Bad file descriptor\n") << command.to("-");
  }
}

TEST_F(FaultOfPipes, AClosedStandardErrorKeepsMessagesOutOfTheOutput) {
  for (const auto& command : commands()) {
    if (command.output.empty() || command.tool == "sw-accuracy") continue;
    done(command.to_file() + "; mv " + command.output + " whole");
    done(command.to_file() + " -v 2>&- >&- <&-; cmp whole " + command.output);
  }
}

TEST_F(FaultOfPipes, AClosedStandardInputIsSaid) {
  for (const std::string line : {"sw-fracture - --box 0:9,0:9 --dip 0 --friction 0 --viscosity 1",
                                 "sw-shoot - --source "
                                 "1,1 --wavelet ricker:9 --receivers 1,1 --time 1",
                                 "sw-filter", "sw-info -", "sw-plot"})
    expect_refused(line + " <&-", 1,
                   line.substr(0, line.find(' ')) + ": standard input: Bad file descriptor");
}

}  // namespace slipwave::fault_pipe_test
