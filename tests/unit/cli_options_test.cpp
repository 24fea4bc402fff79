// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "base/nearest.hpp"
#include "cli/parser.hpp"
#include "cli/tool.hpp"

namespace slipwave::cli_options_test {

using namespace slipwave::cli;

namespace {

struct Settings {
  std::string source, output = "-";
  int count = 3;
  std::optional<double> width;
  std::vector<std::string> layers, files;
  bool plan = false;
};

struct Outcome {
  int code = 0;
  bool ran = false;
  Settings settings;
  std::string command_line;
  int threads = 0;
};

Outcome run(std::vector<std::string> words) {
  words.insert(words.begin(), "/usr/bin/sw-test");
  std::vector<char*> argv;
  for (auto& word : words) argv.push_back(word.data());
  Outcome outcome;
  outcome.code = run_tool(
      int(argv.size()), argv.data(), {"sw-test", "Tests.", "[options]", "sw-test"},
      [&](Options& options) {
        options.add("source", outcome.settings.source, "X,Z", "source");
        options.add("count", outcome.settings.count, "N", "count");
        options.add("width", outcome.settings.width, "W", "width");
        options.add("layer", outcome.settings.layers, "L", "layer");
        options.add("plan", outcome.settings.plan, "plan");
        options.add("output,o", outcome.settings.output, "F", "output");
        options.positional(outcome.settings.files, "FILE");
        options.add_threads();
      },
      [&](const Context& context) {
        outcome.ran = true;
        outcome.command_line = context.command_line;
        outcome.threads = context.threads;
      });
  return outcome;
}

}  // namespace

TEST(Options, ReachTheSettingsTheyAreBoundTo) {
  const auto outcome = run(
      {"--source", "-10,5", "--layer=a", "--layer", "b", "-", "--count", "-4", "m.nc", "--plan", "-oout"});
  EXPECT_TRUE(outcome.ran);
  EXPECT_EQ(outcome.code, 0);
  EXPECT_EQ(outcome.settings.source, "-10,5");
  EXPECT_EQ(outcome.settings.layers, (std::vector<std::string>{"a", "b"}));
  EXPECT_EQ(outcome.settings.files, (std::vector<std::string>{"-", "m.nc"}));
  EXPECT_EQ(outcome.settings.count, -4);
  EXPECT_EQ(outcome.settings.output, "out");
  EXPECT_TRUE(outcome.settings.plan);
  EXPECT_FALSE(outcome.settings.width.has_value());
}

TEST(Options, KeepTheirDefaultsWhenNotGiven) {
  const auto outcome = run({});
  EXPECT_TRUE(outcome.ran);
  EXPECT_EQ(outcome.settings.count, 3);
  EXPECT_EQ(outcome.settings.output, "-");
}

TEST(Options, ProvenanceLeavesOutWhatDoesNotChangeTheOutput) {
  const auto outcome = run({"-q", "--threads", "2", "--source", "it's 1,2", "--output", "x y", "m.nc", "-v"});
  EXPECT_EQ(outcome.command_line, "sw-test m.nc --source 'it'\\''s 1,2'");
  EXPECT_EQ(outcome.threads, 2);
}

TEST(Options, AreRefusedWithUsageStatusBeforeTheBodyRuns) {
  for (const auto& words : std::vector<std::vector<std::string>>{{"--sourc", "1"},
                                                                 {"--count", "x"},
                                                                 {"--count", "1", "--count", "1"},
                                                                 {"--source"},
                                                                 {"--threads", "0"}}) {
    const auto outcome = run(words);
    EXPECT_EQ(outcome.code, 2) << words[0];
    EXPECT_FALSE(outcome.ran) << words[0];
  }
}

TEST(Options, AreNotEmptyWhereThatWouldPassForNone) {
  EXPECT_EQ(run({"--source", ""}).code, 2);
  EXPECT_EQ(run({"--source="}).code, 2);
  EXPECT_EQ(run({"--config", ""}).code, 2);
  EXPECT_EQ(run({"--output", ""}).settings.output, "");
}

TEST(Options, TheNearestNameIsTheOneMeant) {
  const std::vector<std::string> names = {"receivers", "record", "source", "sides", "time"};
  EXPECT_EQ(slipwave::nearest_of(names, "receiver"), "receivers");
  EXPECT_EQ(slipwave::nearest_of(names, "soruce"), "source");
  EXPECT_EQ(slipwave::nearest_of(names, "si"), "sides");
  EXPECT_EQ(slipwave::nearest_of(names, "tiem"), "time");
  EXPECT_EQ(slipwave::nearest_of(names, "recievrs"), "receivers");
  EXPECT_EQ(slipwave::nearest_of(names, "polarisation"), "");
}

}  // namespace slipwave::cli_options_test
