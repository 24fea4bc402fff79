// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "refusal.hpp"
#include "shooting/output_names.hpp"
#include "shooting/output_options.hpp"

namespace slipwave::shooting_output_test {
namespace {

TEST(OutputNames, TellShotsAndComponentsApart) {
  EXPECT_EQ(name_for("a/{shot}-{component}-{shot}.sgy", 12, "vz"), "a/12-vz-12.sgy");
  EXPECT_TRUE(holds("s{shot}.nc", "{shot}"));
  EXPECT_FALSE(holds("s.nc", "{shot}"));
  EXPECT_EQ(unstable_name("dir/out.sgy"), "dir/unstable-out.sgy");
  EXPECT_EQ(unstable_name("out.sgy"), "unstable-out.sgy");
}

TEST(OutputNames, WithAMisspeltMarkAreRefused) {
  EXPECT_EQ(refusal([] { check_marks("a-{shots}.sgy"); }),
            "found {shots} in the name a-{shots}.sgy, expected {shot} or {component}");
  EXPECT_EQ(refusal([] { check_marks("a-{shot}-{component}.sgy"); }), "");
}

TEST(OutputOptions, NumberShotsFromTheFirst) {
  OutputOptions options;
  options.first_shot = 7;
  EXPECT_EQ(options.number_of(1), 7U);
  EXPECT_EQ(options.number_of(3), 9U);
}

TEST(OutputOptions, ThatContradictEachOtherAreRefused) {
  OutputOptions options;
  options.snapshots = std::string("s.nc");
  EXPECT_EQ(refusal([&] { options.check<2>(1); }), "");
  EXPECT_EQ(refusal([&] { options.check<2>(2); }),
            "found 2 sources and --snapshots s.nc, expected {shot} in the name");
  options.shots_in_parallel = 2;
  EXPECT_NE(refusal([&] { options.check<2>(1); }), "");
  options = {};
  options.checkpoint = options.traces = std::string("x");
  EXPECT_EQ(refusal([&] { options.check<2>(1); }),
            "--checkpoint and an output both name x; give them different names");
}

TEST(OutputOptions, WantSlipWhereAFieldIsOfSlip) {
  OutputOptions options;
  EXPECT_FALSE(options.wants_slip());
  options.snapshot_fields = std::string("vx,slip_rate");
  EXPECT_TRUE(options.wants_slip());
}

}  // namespace
}  // namespace slipwave::shooting_output_test
