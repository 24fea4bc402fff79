// SPDX-License-Identifier: BSD-3-Clause
#include "shooting/geometry_segy.hpp"

#include <gtest/gtest.h>

#include <functional>

#include "refusal.hpp"
#include "segy_shared.hpp"
#include "segy_write_cases.hpp"

namespace slipwave::shooting_geometry_test {
namespace {

/// The survey of twelve traces whose headers are empty but for what `change` puts there.
class GeometryOfTraces : public ::testing::Test {
 protected:
  using Change = std::function<void(segy::TraceWords&, std::int64_t)>;

  GivenSurvey read(const Change& change, int revision = 1) const {
    segy::FileInfo info;
    info.axis = {20, 0.004, 0};
    info.format.revision = revision;
    {
      OutputFile out(scratch_.file("g"), OutputFile::Content::binary);
      segy::Writer writer(out, info);
      segy::Trace trace;
      trace.samples.assign(20, 0);
      for (std::int64_t n = 0; n < 12; ++n) {
        trace.words = {};
        change(trace.words, n);
        writer.write(trace, false);
      }
      out.commit();
    }
    return read_trace_geometry(scratch_.file("g"));
  }
  std::string said(const Change& change, int revision = 1) const {
    const auto sentence = refusal([&] { read(change, revision); });
    return sentence.empty() ? sentence : sentence.substr(scratch_.file("g").size() + 2);
  }

  Scratch scratch_;
};

}  // namespace

TEST_F(GeometryOfTraces, OfAStackWithoutRecordsIsNoShot) {
  const auto section = [](segy::TraceWords& words, std::int64_t n) {
    words.set("offset", 1), words.set("scalco", -10);
    words.set("cdpx", 6000000 + 250 * n), words.set("cdpy", 60000000 + 8 * n);
  };
  const std::string nothing =
      "found no coordinates of sources (bytes 73, 77) and receivers (81, 85), and one offset, 1 m, for all "
      "traces; "
      "expected coordinates";
  EXPECT_EQ(said(section, 0), nothing + "; midpoints in bytes 181 to 188 count from revision 1 on");
  // Midpoints, known since revision 1, make a shot of each trace.
  EXPECT_EQ(read(section).shots.size(), 12U);
  // Sources have places, receivers one offset.
  EXPECT_EQ(said([](auto& words, std::int64_t n) {
              words.set("sx", 500), words.set("offset", 100), words.set("tracf", n + 1);
            }),
            "trace 1: found all 12 receivers of field record 0 at one offset (byte 37), 100 m, and no "
            "coordinates of "
            "them, expected some (bytes 81, 85)");
}

TEST_F(GeometryOfTraces, OfGathersWithoutRecordsAndChannelsIsRefused) {
  // Two gathers of one midpoint each, told apart by nothing that makes shots.
  EXPECT_EQ(
      said([](auto& words, std::int64_t n) { words.set("offset", 100 * (n % 6)), words.set("cdp", n / 6); }),
      "trace 7: found channel 0 of field record 0 again at x = 0 m (first: trace 1), expected gathers, with "
      "records (byte 9) and channels (byte 13) or a place of its own for each trace (bytes 73 to 88)");
  // All of them at one place.
  EXPECT_NE(said([](auto& words, std::int64_t) { words.set("sx", 100), words.set("gx", 200); }), "");
}

TEST_F(GeometryOfTraces, OfOneGatherNeedsNoChannels) {
  const auto survey = read([](auto& words, std::int64_t n) { words.set("offset", 100 * n); });
  ASSERT_EQ(survey.shots.size(), 1U);
  EXPECT_EQ(survey.places.size(), 12U);
}

TEST_F(GeometryOfTraces, OfSeveralComponentsAtOnePlaceCountsOnce) {
  const auto survey = read([](auto& words, std::int64_t n) {
    words.set("trid", 12 + n % 2), words.set("fldr", 1), words.set("tracf", 1 + n / 2);
    words.set("sx", 500), words.set("gx", 25 * (n / 2));
  });
  ASSERT_EQ(survey.shots.size(), 1U);
  EXPECT_EQ(survey.places.size(), 6U);
}

}  // namespace slipwave::shooting_geometry_test
