// SPDX-License-Identifier: BSD-3-Clause
#include "segy/describe.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "segy/gather_report.hpp"
#include "segy_shared.hpp"
#include "segy_write_cases.hpp"

namespace slipwave::segy_describe_test {

using namespace slipwave::segy;

namespace {

constexpr FileFormat doubles{6, 2, Endian::little, TextEncoding::ascii, false};

Description description_of(const Gather& gather, const FileFormat& format = doubles) {
  const Scratch scratch;
  write_file(scratch.file("g"), gather, format);
  return describe(scratch.file("g"));
}

/// All samples `small` but those that `change` sets.
template <class Change>
double rms_with(double small, Change change) {
  Gather gather = survey_gather(37, 1);
  for (auto& trace : gather.traces) std::fill(trace.samples.begin(), trace.samples.end(), small);
  change(gather.traces);
  return description_of(gather).rms;
}

}  // namespace

TEST(Describe, CountsShotsInWhateverOrderTheirTracesAre) {
  Gather gather = survey_gather();
  auto& traces = gather.traces;
  std::stable_sort(traces.begin(), traces.end(),
                   [](const auto& a, const auto& b) { return a.header.channel < b.header.channel; });
  int runs = 1;
  for (std::size_t n = 1; n < traces.size(); ++n) runs += traces[n].header.shot != traces[n - 1].header.shot;
  ASSERT_GT(runs, 4);
  EXPECT_EQ(description_of(gather).shots, 2);
}

TEST(Describe, ReportsComponentsGeometryAndSamples) {
  const Description facts = description_of(survey_gather(), {});
  EXPECT_EQ(facts.traces, 48);
  EXPECT_EQ(facts.shots, 2);
  EXPECT_EQ(facts.components.at(Component::sxz).traces, 8);
  EXPECT_EQ(facts.components.size(), 6U);
  EXPECT_EQ(facts.receiver_m[0].lowest, 912.5);
  EXPECT_EQ(facts.receiver_m[0].highest, 950);
  EXPECT_EQ(facts.source_m[2].lowest, 7.5);
  EXPECT_EQ(facts.sample.lowest, 0);
  EXPECT_EQ(facts.sample.highest, 100);
  EXPECT_FALSE(facts.damage);
  EXPECT_FALSE(facts.lengths_vary);
}

TEST(Describe, FindsTheRmsOfEveryMagnitude) {
  const auto none = [](auto&) {};
  const double count = 12 * 37;
  for (const double size : {1e-300, 1e-170, 1e-100, 1.0, 1e100, 1e170, 1e300})
    EXPECT_NEAR(rms_with(size, none), size, 1e-14 * size);
  EXPECT_EQ(rms_with(0, none), 0);
  const auto one = [&](double value) { return [value](auto& traces) { traces[5].samples[20] = value; }; };
  EXPECT_NEAR(rms_with(0, one(-3)), 3 / std::sqrt(count), 1e-14);
  EXPECT_NEAR(rms_with(0, one(1e-170)), 1e-170 / std::sqrt(count), 1e-184);
  EXPECT_NEAR(rms_with(1, one(1e200)), 1e200 / std::sqrt(count), 1e186);
  EXPECT_NEAR(rms_with(1e-200, one(1)), 1 / std::sqrt(count), 1e-14);
}

TEST(Describe, CountsWhatIsNotFiniteAndLeavesItOut) {
  const Scratch scratch;
  write_file(scratch.file("g"), survey_gather(), {});
  auto bytes = bytes_of(scratch.file("g"));
  const std::size_t samples = 3600 + 240;
  store_bytes(&bytes[samples + 4 * 3], 4, Endian::big, 0x7fc00000);
  store_bytes(&bytes[samples + 4 * 40], 4, Endian::big, 0xff800000);
  put_bytes(scratch.file("g"), bytes);
  const Description facts = describe(scratch.file("g"));
  EXPECT_EQ(facts.not_finite, 2);
  EXPECT_EQ(facts.sample.lowest, 0);
  EXPECT_EQ(facts.sample.highest, 100);
  EXPECT_TRUE(std::isfinite(facts.rms));
}

TEST(Describe, KeepsComponentsApart) {
  Gather gather = survey_gather();
  for (auto& trace : gather.traces)
    for (auto& sample : trace.samples) sample = trace.header.component == Component::p ? -2e5 : 3e-6;
  const Description facts = description_of(gather);
  const auto& p = facts.components.at(Component::p);
  EXPECT_EQ(p.sample.lowest, -2e5);
  EXPECT_EQ(p.sample.highest, -2e5);
  EXPECT_NEAR(p.rms, 2e5, 1e-6);
  EXPECT_NEAR(facts.components.at(Component::vz).rms, 3e-6, 1e-18);
  const std::string lines = report_of(facts).lines();
  EXPECT_NE(lines.find("name p, traces 8, amplitude -200000 Pa, rms 200000 Pa\n"), std::string::npos)
      << lines;
  EXPECT_NE(lines.find("name vz, traces 8, amplitude 3e-06 m/s, rms 3e-06 m/s\n"), std::string::npos)
      << lines;
}

namespace {

/// A gather of others: one component, these words set in each trace.
template <class Change>
Description with_words(Change change) {
  const Scratch scratch;
  write_file(scratch.file("g"), survey_gather(), {});
  auto bytes = bytes_of(scratch.file("g"));
  const std::size_t trace = 240 + 4 * 51;
  for (std::size_t n = 0; 3600 + n * trace < bytes.size(); ++n) {
    const auto put = [&](std::size_t byte, std::int64_t value) {
      store_bytes(&bytes[3600 + n * trace + byte - 1], 4, Endian::big, std::uint64_t(value));
    };
    change(std::int64_t(n), put);
  }
  put_bytes(scratch.file("g"), bytes);
  return describe(scratch.file("g"));
}

}  // namespace

TEST(Describe, TakesOffsetsFromByte37WhereNoCoordinatesAre) {
  const Description facts = with_words([](std::int64_t n, const auto& put) {
    for (const std::size_t byte : {73, 77, 81, 85, 181, 185}) put(byte, 0);
    put(37, 100 + n);
  });
  EXPECT_FALSE(facts.positions.source);
  EXPECT_FALSE(facts.positions.receiver);
  EXPECT_EQ(facts.offset_m.lowest, 100);
  EXPECT_EQ(facts.offset_m.highest, 147);
}

TEST(Describe, TakesStacksWithoutReceiversForStacks) {
  // As of F3: source coordinates, byte 37 is 0.
  const Description facts = with_words([](std::int64_t n, const auto& put) {
    put(73, 6201972 + n);
    for (const std::size_t byte : {37, 81, 85}) put(byte, 0);
  });
  EXPECT_TRUE(facts.positions.source);
  EXPECT_FALSE(facts.positions.receiver);
  EXPECT_EQ(facts.offset_m.lowest, 0);
  EXPECT_EQ(facts.offset_m.highest, 0);
  EXPECT_NE(report_of(facts).lines().find("receiver         no coordinates in the file"), std::string::npos);
}

TEST(Describe, TakesStacksThatBeginAtTheOriginForStacks) {
  // The first trace says nothing at all.
  const Description facts = with_words([](std::int64_t n, const auto& put) {
    put(73, 25000 * n), put(77, 25000 * n);
    for (const std::size_t byte : {37, 81, 85, 181, 185}) put(byte, 0);
  });
  EXPECT_TRUE(facts.positions.source);
  EXPECT_FALSE(facts.positions.receiver);
  EXPECT_EQ(facts.offset_m.highest, 0);
}

TEST(Describe, ShowsNoMetresWhereTheHeadersHaveNone) {
  const auto lines_of = [](const Description& facts) { return report_of(facts).lines(); };
  const auto holds = [](const std::string& lines, const std::string& part) {
    EXPECT_NE(lines.find(part), std::string::npos) << part << '\n' << lines;
  };
  // Bytes 89 and 90: the unit of coordinates; 71 and 72: their scalar. Words of 4 bytes hold a neighbour,
  // too.
  const auto arc = lines_of(with_words([](std::int64_t n, const auto& put) {
    put(89, 2 << 16);
    put(73, 1052345), put(81, 1052345 + n), put(37, 100 * (n + 1));
  }));
  holds(arc, " seconds of arc\n");
  holds(arc, "in seconds of arc (byte 89); sw-shoot --geometry refuses it");
  holds(arc, "offset word (37)  100 to 4800 m\n");
  EXPECT_EQ(arc.find("source x          1052345 m"), std::string::npos);
  const auto scalar = lines_of(with_words([](std::int64_t, const auto& put) {
    put(69, (1 << 16) + 82);
    put(73, 501351);
  }));
  holds(scalar, "501351 unscaled\n");
  holds(scalar, "scalar 82 (byte 71) is no power of ten; sw-shoot --geometry refuses it");
  const auto other = lines_of(with_words([](std::int64_t n, const auto& put) { put(37, 1000 * (n + 1)); }));
  holds(other, "offset word (37)");
  holds(other, "the words (byte 37) are not the distances of the coordinates");
}

TEST(Describe, BelievesCoordinatesThatAre0) {
  // A receiver at 0 whose byte 37 was left empty, and others beside it.
  const Description line = with_words([](std::int64_t n, const auto& put) {
    put(37, 0);
    put(73, 500000);
    put(81, 100 * n);
  });
  EXPECT_TRUE(line.positions.receiver);
  EXPECT_LT(line.offset_m.lowest, -400);
  // A source at 0 whose byte 37 was left empty.
  const Description shot = with_words([](std::int64_t n, const auto& put) {
    put(37, 0);
    put(73, 0);
    put(81, 10000 + 100 * n);
  });
  EXPECT_TRUE(shot.positions.source);
  EXPECT_GT(shot.offset_m.lowest, 0);
  // One receiver at 0 all the time, with a byte 37 that says so.
  Gather well = survey_gather();
  for (auto& trace : well.traces) trace.header.receiver_m = {0, 0, 50};
  EXPECT_TRUE(description_of(well).positions.receiver);
  EXPECT_EQ(description_of(well).offset_m.lowest, -1100);
}

TEST(GatherReport, SaysFormatSamplingPositionsAndText) {
  const std::string lines = report_of(description_of(survey_gather(), {})).lines();
  for (const char* line :
       {"format           SEG-Y revision 1.0\n", "byte order       big\n", "samples          ieee\n",
        "format code      5\n", "text code        ebcdic\n", "samples a trace  51\n",
        "time             0 to 0.1 s\n", "component        name vx, traces 8, amplitude 0 to 100 m/s, rms ",
        "receiver z       2.5 m\n", "text             C 1 slipwave test\n",
        "text             C39 SEG Y REV1\n"})
    EXPECT_NE(lines.find(line), std::string::npos) << line << lines;
  const std::string json = report_of(description_of(survey_gather(), {})).json();
  for (const char* part : {"\"format_code\": 5", "\"interval\": {\"value\": 0.002, \"unit\": \"s\"}",
                           "\"text\": [\"C 1 slipwave test\", "})
    EXPECT_NE(json.find(part), std::string::npos) << part << json;
}

TEST(GatherReport, OfSeismicUnixHasNoText) {
  const std::string lines =
      report_of(description_of(survey_gather(), {5, 1, Endian::big, TextEncoding::ebcdic, true})).lines();
  EXPECT_NE(lines.find("format           Seismic Unix\n"), std::string::npos);
  EXPECT_EQ(lines.find("text"), std::string::npos);
}

}  // namespace slipwave::segy_describe_test
