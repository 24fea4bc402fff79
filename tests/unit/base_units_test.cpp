// SPDX-License-Identifier: BSD-3-Clause
#include "io/units.hpp"

#include <gtest/gtest.h>

#include "refusal.hpp"

namespace slipwave::base_units_test {
namespace {

double made(double value, const std::string& unit, const std::string& into) {
  const auto conversion = unit_conversion(unit, into);
  return conversion ? (*conversion)(value) : -1;
}

}  // namespace

TEST(Units, ConvertAsUdunitsDoes) {
  for (const char* unit : {"m s-1", "m/s", "m.s-1", "m s^-1", "meters/second", " m/s "})
    EXPECT_EQ(made(1500, unit, "m s-1"), 1500) << unit;
  for (const char* unit : {"km.s-1", "km/s", "km s-1"}) EXPECT_EQ(made(1.5, unit, "m s-1"), 1500) << unit;
  EXPECT_DOUBLE_EQ(made(10, "ft", "m"), 3.048);
  EXPECT_DOUBLE_EQ(made(3937, "US_survey_foot", "m"), 1200);
  EXPECT_DOUBLE_EQ(made(2.2, "g/cm3", "kg m-3"), 2200);
  EXPECT_DOUBLE_EQ(made(2, "GPa", "Pa"), 2e9);
  EXPECT_DOUBLE_EQ(made(20, "percent", "1"), 0.2);
}

TEST(Units, OfSlownessAreInverseSpeeds) {
  // 100 us/ft are 3048 m/s.
  EXPECT_DOUBLE_EQ(made(100, "us/ft", "m s-1"), 3048);
  EXPECT_DOUBLE_EQ(made(0.0005, "s/m", "m s-1"), 2000);
  EXPECT_FALSE(unit_conversion("m3/kg", "kg m-3"));
}

TEST(Units, OfSomethingElseDoNotConvert) {
  for (const char* unit : {"degrees", "s", "1", "dbar", "M", "furlongs per lunch"})
    EXPECT_FALSE(unit_conversion(unit, "m")) << unit;
  // Angles are numbers for udunits, not for those who read them.
  EXPECT_FALSE(unit_conversion("degree", "1"));
  EXPECT_FALSE(unit_conversion("1", "degree"));
  EXPECT_NEAR(made(1, "radian", "degree"), 57.29578, 1e-5);
  EXPECT_EQ(unit_refusal("degrees", "m"), "found the unit 'degrees', expected one of length, as m, km or ft");
}

TEST(Units, AreNotTakenForGrains) {
  EXPECT_EQ(refusal([] { unit_conversion("gr/cm3", "kg m-3"); }),
            "found the unit 'gr/cm3', in which gr is the grain, expected g or kg");
}

TEST(Units, OfTablesAndLogsMayBeSpeltAsTheyAreThere) {
  const auto spelt = [](double value, const std::string& unit, const std::string& into) {
    const auto conversion = spelt_unit_conversion(unit, into);
    return conversion ? (*conversion)(value) : -1;
  };
  for (const char* unit : {"M/S", "m/s", "M/SEC"}) EXPECT_EQ(spelt(1500, unit, "m s-1"), 1500) << unit;
  for (const char* unit : {"US/FT", "us/f", "US/F", "USEC/FT", "us/ft"})
    EXPECT_DOUBLE_EQ(spelt(100, unit, "m s-1"), 3048) << unit;
  EXPECT_DOUBLE_EQ(spelt(500, "US/M", "m s-1"), 2000);
  for (const char* unit : {"G/CC", "G/C3", "GM/CC", "g/cm3", "G/CM3"})
    EXPECT_DOUBLE_EQ(spelt(2.2, unit, "kg m-3"), 2200) << unit;
  for (const char* unit : {"K/M3", "KG/M3", "kg/m3"}) EXPECT_EQ(spelt(2200, unit, "kg m-3"), 2200) << unit;
  for (const char* unit : {"F", "FT", "feet"}) EXPECT_DOUBLE_EQ(spelt(10, unit, "m"), 3.048) << unit;
  EXPECT_EQ(spelt(10, "M", "m"), 10);
  EXPECT_EQ(spelt(1000, "MS", "s"), 1);
}

}  // namespace slipwave::base_units_test
