// SPDX-License-Identifier: BSD-3-Clause
#include "base/error.hpp"

#include <gtest/gtest.h>

namespace slipwave::base_error_test {

TEST(Error, CarriesThePlaceInFrontAndKeepsItsKind) {
  try {
    in_place("model.nc", [] { throw Error("vs is NaN", ErrorKind::usage); });
    FAIL() << "no error";
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(), "model.nc: vs is NaN");
    EXPECT_EQ(error.kind(), ErrorKind::usage);
  }
}

TEST(Error, ShowsNumbersShortAndExact) {
  EXPECT_EQ(shown(0.1), "0.1");
  EXPECT_EQ(shown(1e-300), "1e-300");
  EXPECT_EQ(shown(1200), "1200");
  EXPECT_EQ(shown(13876543.2, 3), "13900000");
  EXPECT_EQ(shown(0.0041999999, 2), "0.0042");
}

TEST(Error, QuotesTheBeginningOfALongText) {
  EXPECT_EQ(excerpt("short"), "short");
  EXPECT_EQ(excerpt(std::string(60, 'x')), std::string(60, 'x'));
  EXPECT_EQ(excerpt(std::string(1000, 'x')), std::string(60, 'x') + "...");
  EXPECT_EQ(excerpt(std::string("a\0b", 3)), "a?b");
}

TEST(Error, NeverDrivesATerminal) {
  EXPECT_EQ(printable("two\nlines"), "two lines");
  EXPECT_EQ(printable("\x1b[2J\a\x7f"), "?[2J??");
  EXPECT_EQ(printable("\xc2\x9b"
                      "2J"),
            "?2J");  // the same control sequence in eight bits
  EXPECT_EQ(printable("m\xc3\xb6"
                      "del \xe2\x82\xac"),
            "m\xc3\xb6"
            "del \xe2\x82\xac");
  EXPECT_EQ(printable("\x89HDF\xff"), "?HDF?");
}

}  // namespace slipwave::base_error_test
