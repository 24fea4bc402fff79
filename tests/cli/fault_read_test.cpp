// SPDX-License-Identifier: BSD-3-Clause
#include <regex>

#include "fault_scene.hpp"

namespace slipwave::fault_read_test {
namespace {

using FaultOfReading = FaultScene;

}  // namespace

TEST_F(FaultOfReading, ShortAndInterruptedReadsAndWritesChangeNothing) {
  for (const auto& command : commands()) {
    // Of sw-accuracy the times differ.
    if (command.tool == "sw-accuracy") continue;
    if (command.output.empty()) {
      EXPECT_EQ(done(command.to_file()), done(with_fault("short", command.to_file()))) << command.to_file();
      continue;
    }
    done(command.to_file() + "; mv " + command.output + " whole");
    done(with_fault("short", command.to_file()) + "; cmp whole " + command.output);
    // Through a pipe as well, where that gives the same: pictures are PNG there, and snapshots say their
    // name.
    const bool same = command.output.find(".svg") == std::string::npos &&
                      command.output.find(".pdf") == std::string::npos &&
                      command.arguments.find("--snapshots") == std::string::npos;
    if (same) done(with_fault("short", command.to("-")) + " | cmp whole -");
  }
}

TEST_F(FaultOfReading, ADiskThatFailsIsNamedWithItsFile) {
  for (const auto& command : commands()) {
    if (command.arguments.find("in/") == std::string::npos) continue;
    if (!command.output.empty()) write(command.output, "older");
    int failed = 0;
    for (int number = 1; number < 1000; number += 1 + number / (long_form() ? 5 : 2)) {
      const Ran ran = run(with_fault("read:" + std::to_string(number) + ":5", command.to_file()));
      if (ran.code == 0) break;
      ++failed;
      EXPECT_EQ(ran.code, 1) << number << command.to_file();
      const std::string expected = command.tool + ": (in/[a-z]*\\.(nc|sgy)|out\\..*): Input/output error\n";
      EXPECT_TRUE(std::regex_match(ran.err, std::regex(expected)))
          << number << ' ' << command.to_file() << '\n'
          << ran.err;
      EXPECT_TRUE(command.output.empty() || content(command.output) == "older")
          << number << command.to_file();
      if (HasFailure()) return;
    }
    EXPECT_GE(failed, 2) << command.to_file();
  }
}

TEST_F(FaultOfReading, ShortReadsOfClassicModelsAreNoZeros) {
  if (run("nccopy 2> /dev/null; test $? -ne 127").code != 0) GTEST_SKIP() << "no nccopy (Debian: netcdf-bin)";
  for (const std::string kind : {"classic", "64-bit-offset", "cdf5"}) {
    done("nccopy -k " + kind + " in/m.nc classic.nc");
    const std::string line = "sw-export classic.nc --property vp -o -";
    EXPECT_EQ(done(line + " | cksum"), done(with_fault("short", line) + " | cksum")) << kind;
  }
}

}  // namespace slipwave::fault_read_test
