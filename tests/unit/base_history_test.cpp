// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "base/history.hpp"

namespace slipwave::base_history_test {
namespace {

std::string history_of(std::initializer_list<const char*> commands) {
  std::string history;
  for (const char* command : commands) append_history(history, command);
  return history;
}

}  // namespace

TEST(History, LeavesOutTheNameOfWhatTheCommandBeforeMade) {
  EXPECT_EQ(history_of({"sw-layers --step 5", "sw-fracture m.nc --dip 5", "sw-shoot - --time 1"}),
            "sw-layers --step 5\nsw-fracture --dip 5\nsw-shoot --time 1");
  EXPECT_EQ(history_of({"sw-filter 'my file.sgy' --gain rms"}), "sw-filter 'my file.sgy' --gain rms");
  EXPECT_EQ(history_of({"sw-shoot m.nc", "sw-filter 'it'\\''s.sgy' --gain rms"}),
            "sw-shoot m.nc\nsw-filter --gain rms");
  EXPECT_EQ(history_of({"sw-shoot m.nc", "sw-diff a.sgy b.sgy"}), "sw-shoot m.nc\nsw-diff a.sgy b.sgy");
}

TEST(History, IsAPipeFromTheLastCommandThatReadsNoOther) {
  EXPECT_EQ(pipeline_of("sw-layers --step 5\nsw-fracture --dip 5\nsw-shoot --time 1\n"),
            "sw-layers --step 5 | sw-fracture --dip 5 | sw-shoot --time 1");
  EXPECT_EQ(pipeline_of("sw-layers --step 5\nsw-shoot m.nc --time 1\nsw-filter --gain rms"),
            "sw-shoot m.nc --time 1 | sw-filter --gain rms");
  EXPECT_EQ(pipeline_of("sw-layers --step 5\nsw-import --vp vp.nc"), "sw-import --vp vp.nc");
  EXPECT_EQ(pipeline_of("sw-shoot --time 1\nsw-diff a.sgy b.sgy"), "sw-diff a.sgy b.sgy");
  EXPECT_EQ(pipeline_of(""), "");
}

}  // namespace slipwave::base_history_test
