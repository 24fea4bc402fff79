// SPDX-License-Identifier: BSD-3-Clause
#include "traces/section.hpp"

#include <gtest/gtest.h>

#include "base/error.hpp"
#include "segy_shared.hpp"
#include "segy_write_cases.hpp"

namespace slipwave::traces_section_test {
namespace {

Field<2> slope(double spacing_m = 2.5) {
  Grid<2> grid;
  grid.shape = {7, 4};
  grid.spacing_m = spacing_m;
  grid.origin_m = {100, 0};
  Field<2> field(grid);
  for (std::int64_t k = 0; k < 4; ++k)
    for (std::int64_t i = 0; i < 7; ++i) field({i, k}) = static_cast<float>(1000 + 10 * k + i);
  return field;
}

void write(const std::string& path, const Field<2>& field, const segy::FileFormat& format) {
  OutputFile out(path, OutputFile::Content::binary);
  write_section(out, field, {"vp", "m/s", {"made by a test"}}, format);
  out.commit();
}

}  // namespace

TEST(Section, IsAColumnATraceFromTheTopDown) {
  const Scratch scratch;
  for (const bool su : {false, true}) {
    segy::FileFormat format;
    format.su = su;
    write(scratch.file("s"), slope(), format);
    segy::ReadOptions options;
    options.su = su;
    segy::Reader reader(scratch.file("s"), options);
    EXPECT_DOUBLE_EQ(reader.axis().interval_s, 0.0025);  // 2.5 m
    segy::Trace trace;
    for (std::int64_t i = 0; i < 7; ++i) {
      ASSERT_TRUE(reader.next(trace));
      EXPECT_EQ(trace.samples, (std::vector<double>{1000.0 + double(i), 1010.0 + double(i),
                                                    1020.0 + double(i), 1030.0 + double(i)}));
      EXPECT_EQ(trace.words.get("cdp"), i + 1);
      EXPECT_EQ(reader.si_header(trace).receiver_m[0], 101.25 + 2.5 * double(i));
      if (!su) {
        EXPECT_EQ(trace.words.get("xline"), i + 1);
        EXPECT_EQ(trace.words.get("sp"), i + 1);
        EXPECT_EQ(trace.words.get("unit"), 6);
        EXPECT_EQ(segy::scaled(trace.words.get("cdpx"), trace.words.get("scalco")), 101.25 + 2.5 * double(i));
      }
    }
    EXPECT_FALSE(reader.next(trace));
  }
}

TEST(Section, SaysInWordsWhatItsDepthIs) {
  const Scratch scratch;
  write(scratch.file("s"), slope(), {});
  const segy::Reader reader(scratch.file("s"));
  const std::string& text = reader.header().text;
  for (const char* part :
       {"made by a test", "Section in depth: vp, m/s", "Step 2.5 m, first sample at depth 1.25 m"})
    EXPECT_NE(text.find(part), std::string::npos) << part;
}

TEST(Section, RefusesStepsTheFormatCannotHold) {
  const Scratch scratch;
  EXPECT_THROW(write(scratch.file("s"), slope(100), {}), Error);
  EXPECT_FALSE(std::filesystem::exists(scratch.file("s")));
  segy::FileFormat wide;
  wide.revision = 2;
  write(scratch.file("s"), slope(100), wide);
  EXPECT_DOUBLE_EQ(segy::Reader(scratch.file("s")).axis().interval_s, 0.1);
}

}  // namespace slipwave::traces_section_test
