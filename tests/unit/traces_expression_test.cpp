// SPDX-License-Identifier: BSD-3-Clause
#include "traces/expression.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <vector>

#include "base/error.hpp"

namespace slipwave::traces_expression_test {
namespace {

/// Trace 7 of its file: vz, shot 3, channel 12, from (100, 0, 5) to (400.1, 0, 2), offset 300, cdp -4.
double value_of(const std::string& text) {
  segy::RawTrace trace;
  trace.words.set("offset", 300);
  trace.words.set("cdp", -4);
  trace.words.set("ns", 40000);
  const std::vector<std::uint8_t> samples = {3, 252, 0, 0};  // 3, -4, 0, 0
  trace.samples = samples;
  segy::FileHeader file;
  file.format = &segy::format_named("int8");
  TraceView view{7, {}, &trace, &file};
  view.header.shot = 3;
  view.header.channel = 12;
  view.header.component = Component::vz;
  view.header.source_m = {100, 0, 5};
  view.header.receiver_m = {400.1, 0, 2};
  return Expression(text).value(view);
}

bool holds(const std::string& text) {
  EXPECT_EQ(Expression(text).kind(), Expression::Kind::truth) << text;
  return value_of(text) != 0;
}

std::string refusal(const std::string& text) {
  try {
    (void)Expression(text);
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::usage) << text;
    return error.what();
  }
  return "accepted";
}

}  // namespace

TEST(Expression, ComparesWhatATraceIs) {
  for (const char* text : {"component=vz",
                           "component = vz and offset>=100",
                           "shot=3",
                           "channel==12",
                           "trace=7",
                           "offset!=301",
                           "offset<>301",
                           "offset<301",
                           "offset<=300",
                           "offset>299",
                           "offset>=300",
                           "cdp=-4",
                           "cdp<-3.5",
                           "ns=40000",
                           "source_z=5",
                           "receiver_x=400.1",
                           "peak=4",
                           "rms=2.5",
                           "receiver_x-source_x=300.1",
                           "distance=300.1",
                           "midpoint_x=250.05",
                           "component!=vx"})
    EXPECT_TRUE(holds(text)) << text;
  for (const char* text :
       {"component=vx", "component=vz and offset>300", "shot!=3", "channel<12", "channel>12",
        "receiver_x-source_x>300.1", "receiver_x-source_x<300.1", "midpoint_y!=0"})
    EXPECT_FALSE(holds(text)) << text;
}

TEST(Expression, BindsNotBeforeAndBeforeOr) {
  const std::string yes = "shot=3", no = "shot=4";
  // every combination of three truths against the language's own rules in C++
  for (int bits = 0; bits < 8; ++bits) {
    const bool a = bits & 1, b = bits & 2, c = bits & 4;
    const std::string A = a ? yes : no, B = b ? yes : no, C = c ? yes : no;
    EXPECT_EQ(holds(A + " or " + B + " and " + C), a || (b && c));
    EXPECT_EQ(holds("(" + A + " or " + B + ") and " + C), (a || b) && c);
    EXPECT_EQ(holds(A + " and " + B + " or " + C), (a && b) || c);
    EXPECT_EQ(holds("not " + A + " and " + B), !a && b);
    EXPECT_EQ(holds("not (" + A + " and " + B + ")"), !(a && b));
    EXPECT_EQ(holds("not not " + A + " or not " + B), a || !b);
  }
}

TEST(Expression, KnowsListsAndRangesWithTheirEnds) {
  for (const char* text : {"component=vx,vz", "shot=1,2,3", "shot=1:3", "shot=3:5", "shot=3:", "shot=:3",
                           "shot=1:9:2", "shot!=2:8:2", "offset=-100:100,250:350", "cdp=-4:-4",
                           "trace=1:10:3", "component!=vx,p", "shot=:2,3:", "offset=100*2:100*4"})
    EXPECT_TRUE(holds(text)) << text;
  for (const char* text : {"component=vx,p", "shot=1,2,4", "shot=4:", "shot=:2", "shot=1:2", "shot=2:8:2",
                           "shot!=1:3", "component!=vx,vz", "offset=-100:100,350:400"})
    EXPECT_FALSE(holds(text)) << text;
}

TEST(Expression, ChainsComparisons) {
  EXPECT_TRUE(holds("100<=offset<500"));
  EXPECT_TRUE(holds("1 < shot < channel < offset"));
  EXPECT_FALSE(holds("100<=offset<300"));
  EXPECT_FALSE(holds("301<=offset<500"));
  EXPECT_TRUE(holds("500>offset>=300"));
}

TEST(Expression, Calculates) {
  const auto near = [](const char* text, double expected) {
    EXPECT_EQ(Expression(text).kind(), Expression::Kind::number) << text;
    EXPECT_NEAR(value_of(text), expected, 1e-12) << text;
  };
  near("2+3*4", 14);
  near("(2+3)*4", 20);
  near("10-4-3", 3);
  near("12/4/3", 1);
  near("-offset", -300);
  near("- -offset", 300);
  near("abs(cdp)", 4);
  near("abs(cdp-1)*2", 10);
  near("offset%7", 300 % 7);
  near("cdp%3", 2);  // the remainder has the sign of the divisor
  near("1e-3*offset", 0.3);
  near("1.5e2-5", 145);
  near(".5+shot", 3.5);
  EXPECT_TRUE(holds("abs(receiver_x-source_x)>=300 and (channel+shot)%5=0"));
  EXPECT_FALSE(holds("offset/0=1"));
}

TEST(Expression, SaysWhereItIsWrong) {
  EXPECT_EQ(refusal("component=vz and ofset>=100"),
            "character 18, 'ofset': unknown name, did you mean offset?");
  EXPECT_EQ(refusal("component=vy2"), "character 11, 'vy2': unknown name, did you mean vy?");
  EXPECT_EQ(refusal("zzzzzzzzzz=1"),
            "character 1, 'zzzzzzzzzz': unknown name, expected one of a trace header");
  EXPECT_EQ(refusal(""), "character 1, the end: expected a condition or a number");
  EXPECT_EQ(refusal("   "), "character 4, the end: expected a condition or a number");
  EXPECT_EQ(refusal("offset>="), "character 9, the end: expected a number or a name");
  EXPECT_EQ(refusal("offset>=100 and"), "character 16, the end: expected a number or a name");
  EXPECT_EQ(refusal("(offset>=100"), "character 13, the end: expected ) for the ( at character 1");
  EXPECT_EQ(refusal("offset>=100)"), "character 12, ')': expected and, or, or the end");
  EXPECT_EQ(refusal("offset 100"), "character 8, '100': expected an operator or the end");
  EXPECT_EQ(refusal("offset>=100 channel=1"), "character 13, 'channel': expected and, or, or the end");
  EXPECT_EQ(refusal("offset and shot=1"),
            "character 1, 'offset': is a number, expected a condition before and");
  EXPECT_EQ(refusal("shot=1 or offset"),
            "character 11, 'offset': is a number, expected a condition after or");
  EXPECT_EQ(refusal("not shot"), "character 5, 'shot': is a number, expected a condition after not");
  EXPECT_EQ(refusal("component=3"), "character 11, '3': is a number, expected a component");
  EXPECT_EQ(refusal("shot=vz"), "character 6, 'vz': is a component, expected a number");
  EXPECT_EQ(refusal("component<vz"),
            "character 1, 'component': is a component, expected a number to compare by size");
  EXPECT_EQ(refusal("component=vx:vz"),
            "character 1, 'component': is a component, expected a number for a range");
  EXPECT_EQ(refusal("shot=:"), "character 7, the end: expected LOW:HIGH, LOW: or :HIGH");
  EXPECT_EQ(refusal("shot=:5:2"), "character 9, '2': expected a range with LOW before its step");
  EXPECT_EQ(refusal("shot=5m"), "character 6, '5m': expected a number");
  EXPECT_EQ(refusal("shot=1.2.3"), "character 6, '1.2.3': expected a number");
  EXPECT_EQ(refusal("(shot=1)>2"), "character 1, '(': is a condition, expected a number to compare");
  EXPECT_EQ(refusal("shot = 1 & shot = 2"), "character 10, '&': expected and, or, or the end");
  EXPECT_EQ(refusal("shot=1,"), "character 8, the end: expected a number or a name");
  EXPECT_EQ(refusal("1+(shot=1)"), "character 3, '(': is a condition, expected a number to calculate with");
  EXPECT_EQ(refusal("-component=3"),
            "character 2, 'component': is a component, expected a number behind its sign");
}

TEST(Expression, OfAbsurdDepthIsRefused) {
  const auto deep = [](const std::string& open) {
    std::string text;
    for (int n = 0; n < 100000; ++n) text += open;
    return refusal(text + "1");
  };
  for (const char* open : {"(", "-", "not ", "abs("})
    EXPECT_NE(deep(open).find("is nested more than 200 deep"), std::string::npos) << open;
}

TEST(Expression, OfAnyWordsIsParsedOrRefusedInOneSentence) {
  const std::vector<std::string> words = {"offset", "component", "vz",  "abs", "(",    ")",       "(",  ")",
                                          "and",    "or",        "not", "=",   "!=",   "<",       ">=", "+",
                                          "-",      "*",         "/",   "%",   ",",    ":",       "1",  "2.5",
                                          "1e3",    "$",         "'",   ".",   "shot", "\xc3\xa9"};
  std::uint32_t state = 3;
  const auto draw = [&](std::size_t below) {
    state = state * 1664525U + 1013904223U;
    return (state >> 8) % below;
  };
  int parsed = 0;
  for (int trial = 0; trial < 50000; ++trial) {
    std::string text;
    const std::size_t length = 1 + draw(9);
    for (std::size_t n = 0; n < length; ++n) text += words[draw(words.size())] + (draw(3) != 0 ? " " : "");
    const std::string outcome = refusal(text);
    if (outcome == "accepted") {
      value_of(text);
      ++parsed;
    } else {
      ASSERT_EQ(outcome.find("character "), 0U) << text << ": " << outcome;
    }
  }
  EXPECT_GT(parsed, 300);
}

TEST(HeaderKey, IsEveryWordOfATraceHeader) {
  segy::RawTrace trace;
  const segy::FileHeader file;
  int value = 0;
  for (const segy::Field& field : segy::TraceLayout::fields)
    if (segy::is_signed(field.type)) trace.words.set(segy::FieldName<segy::TraceLayout>(field), ++value);
  value = 0;
  for (const segy::Field& field : segy::TraceLayout::fields) {
    const auto key = HeaderKey::named(std::string(field.name));
    ASSERT_TRUE(key) << field.name;
    if (segy::is_signed(field.type)) {
      EXPECT_EQ(key->value({1, {}, &trace, &file}), ++value) << field.name;
    }
  }
  EXPECT_FALSE(HeaderKey::named("Offset"));
  EXPECT_FALSE(HeaderKey::named(""));
}

}  // namespace slipwave::traces_expression_test
