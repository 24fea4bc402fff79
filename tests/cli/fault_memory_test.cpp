// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>

#include "fault_scene.hpp"

namespace slipwave::fault_memory_test {
namespace {

using FaultOfMemory = FaultScene;

}  // namespace

TEST_F(FaultOfMemory, ALimitIsSaidInOneLineAndLeavesTheOlderFile) {
  // Address space in KiB: the libraries alone take some 80 MiB. Limits go up until the tool has what it
  // needs; by how much at a time is what the long form refines.
  const int step = long_form() ? 4000 : 32000;
  int told = 0;
  for (const auto& command : commands()) {
    if (command.output.empty()) continue;
    write(command.output, "older");
    const auto before = files();
    bool done_once = false;
    for (int kibibytes = 40000; kibibytes <= 800000 && !done_once; kibibytes += step) {
      const Ran ran = run("ulimit -v " + std::to_string(kibibytes) + "; " + command.to_file());
      // The dynamic loader and libraries that start up before main() have their own words for what they have
      // no room for.
      if (ran.err.find("error while loading shared libraries") != std::string::npos ||
          ran.err.find("cannot allocate TLS data structures for initial thread") != std::string::npos ||
          ran.err.find("Error in GnuTLS initialization") != std::string::npos)
        continue;
      done_once = ran.code == 0;
      if (done_once) continue;
      ++told;
      EXPECT_EQ(ran.code, 1) << kibibytes << ' ' << command.to_file() << '\n' << ran.err;
      EXPECT_EQ(ran.err.compare(0, command.tool.size() + 2, command.tool + ": "), 0) << ran.err;
      EXPECT_EQ(std::count(ran.err.begin(), ran.err.end(), '\n'), 1) << ran.err;
      EXPECT_EQ(content(command.output), "older") << kibibytes << ' ' << command.to_file();
      EXPECT_EQ(files(), before) << kibibytes << ' ' << command.to_file();
    }
    EXPECT_TRUE(done_once) << command.to_file();
  }
  // Some of them have words of the loader at one limit, and room enough at the next.
  EXPECT_GE(told, 10);
}

}  // namespace slipwave::fault_memory_test
