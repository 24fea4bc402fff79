// SPDX-License-Identifier: BSD-3-Clause
#include "traces/time_window.hpp"

#include <gtest/gtest.h>

#include "base/error.hpp"
#include "segy_shared.hpp"
#include "segy_write_cases.hpp"

namespace slipwave::traces_time_window_test {

TEST(TimeWindow, HoldsItsEnds) {
  const SampleAxis axis{101, 0.001, 0.05};  // 0.05 to 0.15 s
  const auto left = [&](double from_s, double to_s) { return TimeWindow{from_s, to_s}.cut(axis); };
  EXPECT_EQ(left(0.06, 0.08).count, 21);
  EXPECT_NEAR(left(0.06, 0.08).start_s, 0.06, 1e-15);
  EXPECT_EQ(left(0.0601, 0.0799).count, 19);
  EXPECT_EQ(left(-1, 1), axis);
  EXPECT_EQ(left(0.07, 0.07).count, 1);
  EXPECT_EQ(left(0.0701, 0.0709).count, 0);
  EXPECT_EQ(left(0.2, 0.3).count, 0);
  EXPECT_EQ(left(0, 0.01).count, 0);
  // 0.3/0.1 is a little below 3 in floating point
  EXPECT_EQ((TimeWindow{0, 0.3}.cut(SampleAxis{10, 0.1, 0}).count), 4);
}

TEST(TimeWindow, TakesSamplesAndSetsTheDelay) {
  const Scratch scratch;
  Gather gather = segy::survey_gather(51, 4, 0.002);
  gather.axis.start_s = -0.02;
  segy::write_file(scratch.file("a"), gather, {});
  segy::Reader reader(scratch.file("a"));
  segy::RawTrace trace;
  ASSERT_TRUE(reader.next(trace));
  TimeWindow{-0.01, 0.03}.cut(trace, reader);
  ASSERT_EQ(trace.samples.size(), 21U * 4);
  EXPECT_EQ(trace.words.get("delrt"), -10);
  std::vector<double> samples(21);
  segy::decode_samples(trace.samples, *reader.header().format, reader.header().endian, samples);
  for (std::size_t n = 0; n < 21; ++n) EXPECT_EQ(samples[n], gather.traces[0].samples[n + 5]);
}

TEST(TimeWindow, KeepsTheScalarOfTimes) {
  const Scratch scratch;
  segy::write_file(scratch.file("a"), segy::survey_gather(51, 4, 0.0005), {});
  segy::Reader reader(scratch.file("a"));
  segy::RawTrace trace;
  ASSERT_TRUE(reader.next(trace));
  trace.words.set("tscal", -10);  // tenths of a millisecond
  const auto whole = trace.samples;
  TimeWindow{0.0015, 0.01}.cut(trace, reader);
  EXPECT_EQ(trace.words.get("delrt"), 15);
  trace.words.set("tscal", 1);
  trace.words.set("delrt", 0);
  trace.samples = whole;
  TimeWindow{0.0015, 0.01}.cut(trace, reader);  // whole milliseconds do not hold it
  EXPECT_EQ(trace.words.get("delrt"), 15);
  EXPECT_EQ(trace.words.get("tscal"), -10);
  EXPECT_THROW((TimeWindow{1, 2}.cut(trace, reader)), Error);
}

TEST(TimeWindow, IsTwoTimesInOrder) {
  EXPECT_EQ(parse_time_window("-0.1:2").to_s, 2);
  for (const char* text : {"", "1", "2:1", "1:2:3", "a:b", "1,2"})
    EXPECT_THROW(parse_time_window(text), Error);
}

}  // namespace slipwave::traces_time_window_test
