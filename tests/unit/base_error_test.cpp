#include "base/error.hpp"

#include <gtest/gtest.h>

using namespace slipwave;

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
}
