// SPDX-License-Identifier: BSD-3-Clause
#include "base/report.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace slipwave::base_report_test {

TEST(Report, AlignsItsLines) {
  Report report;
  report.text("a", "one\ntwo");
  report.count("longer", 3);
  report.range("r", 0, 0.5, "m");
  report.range("same", 2, 2, "");
  EXPECT_EQ(report.lines(), "  a       one; two\n  longer  3\n  r       0 to 0.5 m\n  same    2\n");
}

TEST(Report, GivesTextsALineEach) {
  Report report;
  report.texts("text", {"one", "two \"2\""});
  report.texts("none", {});
  EXPECT_EQ(report.lines(), "  text  one\n  text  two \"2\"\n");
  EXPECT_EQ(report.json(), "{\"text\": [\"one\", \"two \\\"2\\\"\"], \"none\": []}");
}

TEST(Report, IsJsonWithUnitsAndWithoutNaN) {
  Report item;
  item.text("name", "a \"b\" \\ \n");
  Report report;
  report.number("two words", 0.1, "m/s");
  report.number("n", std::nan(""), "");
  report.list("items", {item, item});
  report.list("none", {});
  EXPECT_EQ(report.json(),
            "{\"two_words\": {\"value\": 0.1, \"unit\": \"m/s\"}, \"n\": {\"value\": null, \"unit\": \"\"}, "
            "\"items\": [{\"name\": \"a \\\"b\\\" \\\\ \\u000a\"}, {\"name\": \"a \\\"b\\\" \\\\ "
            "\\u000a\"}], \"none\": []}");
}

TEST(Report, MakesUtf8OfAnyBytes) {
  EXPECT_EQ(json_string("\xc3\xa4"), "\"\xc3\xa4\"");
  EXPECT_EQ(json_string("\xe4"), "\"\xc3\xa4\"");              // ISO 8859-1
  EXPECT_EQ(json_string("\xc0\xaf"), "\"\xc3\x80\xc2\xaf\"");  // an overlong form is no UTF-8
}

}  // namespace slipwave::base_report_test
