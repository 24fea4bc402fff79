// SPDX-License-Identifier: BSD-3-Clause
#include "gather/difference.hpp"

#include <gtest/gtest.h>

#include <functional>

#include "base/error.hpp"

namespace slipwave::gather_difference_test {
namespace {

Gather small_gather() {
  Gather gather{{3, 0.001, 0}, {}};
  for (int channel = 1; channel <= 2; ++channel) {
    Trace trace;
    trace.header.channel = channel;
    trace.header.component = Component::vz;
    trace.header.source_m = {100, 0, 5};
    trace.header.receiver_m = {100.0 + 10 * channel, 0, 2};
    trace.samples = {1.0 * channel, 2, 3};
    gather.traces.push_back(trace);
  }
  return gather;
}

std::string refusal(const std::function<void(Gather&)>& change) {
  Gather other = small_gather();
  change(other);
  try {
    difference(small_gather(), other);
  } catch (const Error& error) {
    return error.what();
  }
  return "accepted";
}

}  // namespace

TEST(Difference, SubtractsSampleBySampleAndKeepsTheHeadersOfA) {
  Gather b = small_gather();
  b.traces[1].samples = {5, 5, 5};
  const Gather result = difference(small_gather(), b);
  EXPECT_EQ(result.traces[0].samples, (std::vector<double>{0, 0, 0}));
  EXPECT_EQ(result.traces[1].samples, (std::vector<double>{-3, -3, -2}));
  EXPECT_EQ(result.traces[1].header.receiver_m[0], 120);
}

TEST(Difference, NamesTheFirstTraceAndFieldThatDiffers) {
  EXPECT_EQ(refusal([](Gather& b) { b.traces[1].header.receiver_m[0] = 121; }),
            "trace 2: receiver x is 121 m, expected 120 m");
  EXPECT_EQ(refusal([](Gather& b) { b.traces[0].header.source_m[2] = 6; }),
            "trace 1: source z is 6 m, expected 5 m");
  EXPECT_EQ(refusal([](Gather& b) { b.traces[1].header.component = Component::p; }),
            "trace 2: component is p, expected vz");
  EXPECT_EQ(refusal([](Gather& b) { b.traces[0].header.shot = 7; }), "trace 1: shot is 7, expected 1");
  EXPECT_EQ(refusal([](Gather& b) { b.traces[0].header.channel = 9; }), "trace 1: channel is 9, expected 1");
  EXPECT_EQ(refusal([](Gather& b) { b.axis.interval_s = 0.002; }),
            "the sample interval is 0.002 s, expected 0.001 s");
  EXPECT_EQ(refusal([](Gather& b) { b.axis.count = 4; }), "the number of samples is 4, expected 3");
  EXPECT_EQ(refusal([](Gather& b) { b.axis.start_s = 0.1; }),
            "the first sample's time is 0.1 s, expected 0 s");
  EXPECT_EQ(refusal([](Gather& b) { b.traces.pop_back(); }), "the number of traces is 1, expected 2");
}

TEST(Difference, TakesPositionsForEqualThatOnlyRoundingTellsApart) {
  EXPECT_EQ(refusal([](Gather& b) { b.traces[1].header.receiver_m[0] += 1e-4; }), "accepted");
}

TEST(Component, HasANameAUnitAndAWayBack) {
  for (const char* name : {"vx", "vy", "vz", "p", "sxx", "syy", "szz", "sxy", "sxz", "syz", "other"})
    EXPECT_STREQ(name_of(component_named(name)), name);
  EXPECT_STREQ(unit_of(Component::vz), "m/s");
  EXPECT_STREQ(unit_of(Component::p), "Pa");
  EXPECT_STREQ(unit_of(Component::sxz), "Pa");
  EXPECT_STREQ(unit_of(Component::other), "");
  EXPECT_THROW(component_named("pressure"), Error);
}

}  // namespace slipwave::gather_difference_test
