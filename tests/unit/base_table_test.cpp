// SPDX-License-Identifier: BSD-3-Clause
#include "io/table.hpp"

#include <gtest/gtest.h>

#include "refusal.hpp"

namespace slipwave::base_table_test {
namespace {

/// The numbers of the columns x and delay in the first row, x in m and the delay in s.
std::vector<double> first_row(const std::string& text) {
  Table table("t", text);
  table.expect_columns({{"x", "m"}, {"delay", "s"}, {"shot"}});
  table.next();
  return {table.number(*table.find("x")), table.number(*table.find("delay"))};
}

}  // namespace

TEST(Table, TakesSeparatorsCasesAndUnitsAsPeopleWriteThem) {
  for (const char* text :
       {"x,delay\n30.48,0.5\n", "X;DELAY\n30.48;0.5\n", "x delay\n30.48 0.5\n", "X.FT,DELAY.MS\n100,500\n",
        "delay (ms);x (ft)\n500;100\n", "X [ft]  Delay [ms]\n100 500\n", "x (ft) delay (ms)\n100 500\n",
        "\"X (ft)\",\"delay (s)\"\n100,0.5\n"}) {
    const auto row = first_row(text);
    EXPECT_DOUBLE_EQ(row[0], 30.48) << text;
    EXPECT_DOUBLE_EQ(row[1], 0.5) << text;
  }
}

TEST(Table, RefusesUnitsAndNumbersThatAreSomethingElse) {
  const auto said = [](const std::string& text) { return refusal([&] { first_row(text); }); };
  EXPECT_EQ(said("x (deg),delay\n1,2\n"),
            "t: column x: found the unit 'deg', expected one of length, as m, km or ft");
  EXPECT_EQ(said("x,delay,shot.m\n1,2,3\n"), "t: column shot: found the unit 'm', expected none");
  EXPECT_EQ(said("1,5;2,5\n1,5;2,5\n"),
            "t: line 1: found '1,5', expected a name, or a number with a decimal point");
  EXPECT_EQ(said("x;delay\n1,5;2\n"), "t: line 2: column x: found '1,5', expected a number");
}

}  // namespace slipwave::base_table_test
