// SPDX-License-Identifier: BSD-3-Clause
#include "traces/section_input.hpp"

#include <gtest/gtest.h>

#include <functional>

#include "refusal.hpp"
#include "segy_shared.hpp"
#include "segy_write_cases.hpp"
#include "traces/section.hpp"

namespace slipwave::traces_section_input_test {
namespace {

Field<3> volume(std::int64_t nx, std::int64_t ny) {
  Grid<3> grid;
  grid.shape = {nx, ny, 4};
  grid.spacing_m = 20;
  Field<3> field(grid);
  for (std::int64_t n = 0; n < grid.size(); ++n) {
    const auto at = grid.index(n);
    field[std::size_t(n)] = float(1000 + 100 * at[2] + 10 * at[1] + at[0]);
  }
  return field;
}

/// A volume as sw-export writes it, its traces in another order and with other headers.
class SectionInput : public ::testing::Test {
 protected:
  using Change = std::function<void(segy::TraceWords&, std::size_t)>;

  ImportedField read(
      const Field<3>& field, const Change& change = [](auto&, auto) {},
      const std::vector<std::size_t>& order = {}, double step_m = 20, bool trusted = true) const {
    {
      OutputFile out(scratch_.file("a"), OutputFile::Content::binary);
      write_section(out, field, {"vp", "m/s", {}}, {});
      out.commit();
    }
    {
      segy::Reader reader(scratch_.file("a"));
      std::vector<segy::Trace> traces;
      for (segy::Trace trace; reader.next(trace);) traces.push_back(trace);
      segy::FileInfo info;
      info.axis = reader.axis();
      info.text = reader.header().text;
      OutputFile out(scratch_.file("b"), OutputFile::Content::binary);
      segy::Writer writer(out, info);
      for (std::size_t n = 0; n < (order.empty() ? traces.size() : order.size()); ++n) {
        auto& trace = traces[order.empty() ? n : order[n]];
        change(trace.words, n);
        writer.write(trace, false);
      }
      out.commit();
    }
    segy::Reader reader(scratch_.file("b"));
    return read_section(reader, step_m, trusted);
  }
  static void expect_same(const ImportedField& found, const Field<3>& expected) {
    ASSERT_EQ(found.values.grid().shape, expected.grid().shape);
    for (std::size_t n = 0; n < expected.size(); ++n) ASSERT_EQ(found.values[n], expected[n]) << n;
  }

  Scratch scratch_;
};

void set_place(segy::TraceWords& words, std::int64_t x, std::int64_t y) {
  words.set("cdpx", x), words.set("cdpy", y);
  words.set("sx", x), words.set("sy", y);
  words.set("gx", x), words.set("gy", y);
}

}  // namespace

TEST_F(SectionInput, OfSeveralInLinesIsAVolume) {
  const auto field = volume(5, 3);
  const auto found = read(field);
  EXPECT_FALSE(found.is_section);
  expect_same(found, field);
  EXPECT_TRUE(found.said.empty());
}

TEST_F(SectionInput, MayHaveItsTracesInAnyOrder) {
  const auto field = volume(5, 3);
  std::vector<std::size_t> backwards, crosses;
  for (std::size_t n = 15; n-- > 0;) backwards.push_back(n);
  for (std::size_t i = 0; i < 5; ++i)
    for (std::size_t j = 0; j < 3; ++j) crosses.push_back(5 * j + i);
  expect_same(read(
                  field, [](auto&, auto) {}, backwards),
              field);
  expect_same(read(
                  field, [](auto&, auto) {}, crosses),
              field);
}

TEST_F(SectionInput, IsToldByPlacesWhereLinesHaveNoNumbers) {
  const auto field = volume(5, 3);
  expect_same(read(field,
                   [](auto& words, auto) {
                     words.set("iline", 0), words.set("xline", 0), words.set("fldr", 0), words.set("cdp", 0);
                   }),
              field);
  // Numbers of old files, in bytes 9 and 21, without places.
  const auto old = read(field, [](auto& words, auto) {
    words.set("fldr", words.get("iline")), words.set("cdp", words.get("xline"));
    words.set("iline", 0), words.set("xline", 0);
    set_place(words, 0, 0);
  });
  expect_same(old, field);
}

TEST_F(SectionInput, OfTheMapLiesAsItsPlacesDo) {
  const auto field = volume(5, 3);
  // In-lines run north: x of the model stays the map's.
  const auto turned = read(field, [](auto& words, std::size_t n) {
    words.set("iline", 1 + std::int64_t(n % 5)), words.set("xline", 1 + std::int64_t(n / 5));
  });
  expect_same(turned, field);
  // A survey turned by the angle of 3, 4, 5, far from the origin.
  const auto far = read(field, [](auto& words, std::size_t n) {
    const auto i = std::int64_t(n % 5), j = std::int64_t(n / 5);
    set_place(words, 500000 + 16 * i - 12 * j, 6000000 + 12 * i + 16 * j);
  });
  expect_same(far, field);
  ASSERT_EQ(far.said.size(), 1U);
  EXPECT_NE(far.said[0].find("sw-shoot --origin 499998,5999986 --azimuth 53.13 brings"), std::string::npos)
      << far.said[0];
  // The mirror image: y of the model is to the left of x.
  const auto mirrored = read(field, [](auto& words, std::size_t n) {
    const auto i = std::int64_t(n % 5), j = std::int64_t(n / 5);
    set_place(words, 500000 + 16 * i + 12 * j, 6000000 + 12 * i - 16 * j);
  });
  EXPECT_EQ(mirrored.values({0, 0, 0}), field({0, 2, 0}));
}

TEST_F(SectionInput, OfOneLineIsASectionFromLeftToRight) {
  const auto field = volume(6, 1);
  const auto found = read(field);
  EXPECT_TRUE(found.is_section);
  expect_same(found, field);
  expect_same(read(field, [](auto&, auto) {}, {5, 4, 3, 2, 1, 0}), field);
}

TEST_F(SectionInput, ThatItsHeadersContradictIsRefusedWithTheReadingThatFits) {
  const auto line = volume(6, 1), cube = volume(5, 3);
  const auto said = [&](const Field<3>& field, const Change& change, double step_m = 20,
                        const std::vector<std::size_t>& order = {}) {
    return refusal([&] { read(field, change, order, step_m); });
  };
  const auto holds = [](const std::string& sentence, const std::string& part) {
    EXPECT_NE(sentence.find(part), std::string::npos) << sentence;
  };
  const Change nothing = [](auto&, auto) {};
  holds(said(line, nothing, 8),
        "traces are 20 m apart (bytes 181 to 188), expected 8 m as --step says: give --step 20");
  holds(said(
            line, [](auto& words, auto) { words.set("cdpx", 0); }, 8),
        "(bytes 73 to 80)");
  holds(said(
            line, [](auto& words, auto) { words.set("cdpx", 0), words.set("sx", 0); }, 8),
        "(bytes 81 to 88)");
  holds(said(line, nothing, 20, {0, 1, 3, 4, 5}), "evenly between the first and the last of its line");
  holds(said(cube, nothing, 20, {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13}),
        "found 3 in-lines (byte 189) and 5 cross-lines (byte 193) in 14 traces, not one for each");
  holds(said(cube,
             [](auto& words, auto) {
               if (words.get("xline") > 2) words.set("xline", words.get("xline") + 1);
             }),
        "with gaps in their numbers");
  holds(said(cube, [](auto& words, auto) { set_place(words, words.get("cdpx"), 2 * words.get("cdpy")); }),
        "in-lines are 40 m apart");
  holds(said(line, [](auto& words, std::size_t n) { words.set("offset", 100 * std::int64_t(n)); }),
        "found offsets from 0 to 500 m (byte 37), which gathers have");
  holds(said(line, [](auto& words, std::size_t n) { words.set("delrt", n == 2 ? 40 : 0); }),
        "trace 3: begins at a depth of 40 m");
  holds(said(line, [](auto& words, auto) { set_place(words, 100, 0); }), "all traces lie at one place");
  EXPECT_TRUE(read(line, nothing, {}, 8, false).is_section) << "headers are not looked at where asked so";
}

TEST_F(SectionInput, KeepsTheDepthOfItsFirstSample) {
  const auto found = read(volume(6, 1), [](auto& words, auto) { words.set("delrt", 500); });
  EXPECT_EQ(found.values.grid().origin_m[2], 500);
}

TEST_F(SectionInput, SaysWhatASampleIntervalWouldMean) {
  const auto found = read(
      volume(6, 1), [](auto& words, auto) { set_place(words, 0, 0); }, {}, 25);
  ASSERT_EQ(found.said.size(), 1U);
  EXPECT_EQ(
      found.said[0],
      "samples are 20 m apart if the interval (byte 3217, 20000 us) has 1 ms for 1 m; taken 25 m apart, as "
      "--step says");
}

}  // namespace slipwave::traces_section_input_test
