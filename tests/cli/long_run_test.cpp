// SPDX-License-Identifier: BSD-3-Clause
#include <regex>
#include <string>

#include "shell.hpp"

namespace slipwave::long_run_test {
namespace {

using LongRun = Shell;

const std::string layers = "sw-layers -q --size 600x400 --step 10 --layer 0:2500:1250:2200 -o m.nc; ";
const std::string survey = "--source 300,50 --wavelet ricker:10 --receivers 0:600:20,10 -o g.sgy ";
const std::string shoot = "sw-shoot m.nc " + survey + "--time 0.2 ";

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

}  // namespace

TEST_F(LongRun, ALogHoldsWhatWasSaidWithItsTimeAndChangesNothing) {
  done(layers + shoot + "; cp g.sgy without.sgy; " + shoot + "--log run.log; cmp g.sgy without.sgy");
  const auto first = content("run.log");
  const std::string line = "[0-9]{4}-[0-9]{2}-[0-9]{2} [0-9]{2}:[0-9]{2}:[0-9]{2} ";
  EXPECT_TRUE(std::regex_match(first, std::regex("(" + line + ".*\n)+"))) << first;
  EXPECT_TRUE(has(first, " sw-shoot m.nc --source 300,50")) << first;
  EXPECT_TRUE(
      std::regex_search(first, std::regex(line + "shot 1 50 %, [0-9.e+]+ steps/s, [0-9.]+ s left\n")));
  EXPECT_TRUE(std::regex_search(
      first, std::regex(line + "1 shot, expected error [0-9.]+ %[^,]*, [0-9.]+ s, [0-9.]+ MiB\n$")))
      << first;
  const std::string refusal = "none.nc: No such file or directory";
  expect_refused("sw-shoot none.nc " + survey + "--time 0.2 --log run.log", 1, "sw-shoot: " + refusal);
  EXPECT_EQ(content("run.log").substr(0, first.size()), first);  // continued
  EXPECT_TRUE(has(content("run.log").substr(first.size()), " " + refusal + "\n")) << content("run.log");
  expect_refused(shoot + "--log none/run.log", 1, "sw-shoot: --log: none/run.log: No such file or directory");
}

TEST_F(LongRun, ATerminalShowsARateWithItsUnitAndHowTheRunEnded) {
  if (run("script --version > /dev/null 2>&1").code != 0) GTEST_SKIP() << "no script (Debian: bsdutils)";
  done(layers);
  const Ran ran = run("script -qec '" + shoot + "' /dev/null < /dev/null");
  EXPECT_EQ(ran.code, 0) << ran.out;
  EXPECT_TRUE(std::regex_search(ran.out, std::regex("100 % [0-9.e+]+ steps/s, [0-9.]+ s"))) << ran.out;
  EXPECT_TRUE(std::regex_search(ran.out, std::regex("sw-shoot: 1 shot, expected error [0-9.]+ %")))
      << ran.out;
}

TEST_F(LongRun, TheLineOfABarIsFinishedWhenASignalEndsTheRun) {
  if (run("script --version > /dev/null 2>&1").code != 0) GTEST_SKIP() << "no script (Debian: bsdutils)";
  write("run.sh", "echo $$ > pid\nexec sw-shoot m.nc " + survey + "--time 500 --dt 0.01 $1\n");
  done(layers);
  for (const std::string checkpoint : {"", "--checkpoint c"}) {
    run("(script -qec 'bash run.sh \"" + checkpoint + "\"' /dev/null < /dev/null > seen) & " +
        "await 'grep -q steps/s seen'; kill -INT $(cat pid); wait");
    const auto seen = content("seen");
    const std::string end = checkpoint.empty() ? " left\033[K\r\n" : "c holds shot 1 at step ";
    EXPECT_TRUE(has(seen, end)) << seen.substr(seen.size() > 200 ? seen.size() - 200 : 0);
    EXPECT_EQ(seen.back(), '\n');
    done("rm seen pid");
  }
}

}  // namespace slipwave::long_run_test
