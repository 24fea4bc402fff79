// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "cli/progress_bar.hpp"

namespace slipwave::cli::cli_progress_test {
namespace {

TEST(Progress, TheRateHasItsUnitAndIsThatOfThisRun) {
  ProgressRate rate("steps");
  EXPECT_EQ(rate.words(401, 1000, 0.5), "");  // resumed: 400 steps are of an earlier run
  EXPECT_EQ(rate.words(501, 1000, 2.5), "50 steps/s, 10 s left");
  EXPECT_EQ(rate.words(1000, 1000, 12.48), "50 steps/s");
}

TEST(Progress, BytesAreReadInUnitsThatReadWell) {
  ProgressRate rate(ProgressRate::bytes);
  rate.words(0, 1000, 0);
  EXPECT_EQ(rate.words(50 << 20, 100 << 20, 2), "25 MiB/s, 2.0 s left");
}

TEST(Progress, TimesReadAsAPersonSaysThem) {
  EXPECT_EQ(duration_in_words(0.254), "0.25 s");
  EXPECT_EQ(duration_in_words(7.24), "7.2 s");
  EXPECT_EQ(duration_in_words(41.4), "41 s");
  EXPECT_EQ(duration_in_words(125), "2 min 05 s");
  EXPECT_EQ(duration_in_words(11400), "3 h 10 min");
  EXPECT_EQ(bytes_in_words(58000000), "55.3 MiB");
}

}  // namespace
}  // namespace slipwave::cli::cli_progress_test
