// SPDX-License-Identifier: BSD-3-Clause
#include "segy/conversion.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "gather/difference.hpp"
#include "segy/describe.hpp"
#include "segy_shared.hpp"
#include "segy_write_cases.hpp"

namespace slipwave::segy_conversion_test {

using namespace slipwave::segy;

namespace {

using Bytes = std::vector<std::uint8_t>;

template <class AnyTrace>
void convert(const std::string& from, const std::string& to, const FileFormat& format) {
  Reader reader(from);
  OutputFile out(to, OutputFile::Content::binary);
  Writer writer(out, info_as(reader, "sw-convert", format));
  AnyTrace trace;
  while (reader.next(trace)) writer.write(trace, reader.header().su);
  out.commit();
}

/// Everything but the textual header, which grows by the command line.
Bytes after_text(const std::string& path) {
  const Bytes bytes = bytes_of(path);
  return {bytes.begin() + 3200, bytes.end()};
}

std::string refusal(const std::string& from, const std::string& to, const FileFormat& format) {
  try {
    convert<RawTrace>(from, to, format);
  } catch (const Error& error) {
    return error.what();
  }
  return "accepted";
}

std::vector<FileFormat> all_formats() {
  std::vector<FileFormat> formats;
  for (const SampleFormat& samples : sample_formats())
    for (int revision = samples.since == 2 ? 2 : 0; revision <= 2; ++revision)
      for (const Endian endian : {Endian::big, Endian::little})
        formats.push_back({samples.code, revision, endian,
                           endian == Endian::big ? TextEncoding::ebcdic : TextEncoding::ascii, false});
  for (const Endian endian : {Endian::big, Endian::little})
    formats.push_back({5, 1, endian, TextEncoding::ebcdic, true});
  return formats;
}

std::string name_of_format(const FileFormat& format) {
  return std::string(find_format(format.code)->name) + " revision " + std::to_string(format.revision) + " " +
         name_of(format.endian) + (format.su ? " su" : "");
}

}  // namespace

TEST(Conversion, ThereAndBackGivesTheSameBytes) {
  const Scratch scratch;
  for (const FileFormat& format : all_formats()) {
    if (format.su) continue;
    SCOPED_TRACE(name_of_format(format));
    write_file(scratch.file("a"), survey_gather(51, 2), {});
    convert<segy::Trace>(scratch.file("a"), scratch.file("b"), format);
    EXPECT_EQ(read_file(scratch.file("b")).traces.size(), 24U);
    convert<segy::Trace>(scratch.file("b"), scratch.file("c"), {});
    EXPECT_EQ(after_text(scratch.file("c")), after_text(scratch.file("a")));
  }
}

TEST(Conversion, BetweenAnyTwoFormatsKeepsSamplesAndGeometry) {
  const Scratch scratch;
  const Gather gather = survey_gather(21, 1);
  const auto formats = all_formats();
  for (std::size_t i = 0; i < formats.size(); ++i)
    for (const std::size_t step : {1, 7, 20}) {
      const FileFormat& to = formats[(i + step) % formats.size()];
      SCOPED_TRACE(name_of_format(formats[i]) + " to " + name_of_format(to));
      write_file(scratch.file("a"), gather, formats[i]);
      convert<segy::Trace>(scratch.file("a"), scratch.file("b"), to);
      const Gather found = read_file(scratch.file("b"));
      EXPECT_EQ(sampling_difference(found.axis, gather.axis), "");
      ASSERT_EQ(found.traces.size(), gather.traces.size());
      for (std::size_t t = 0; t < found.traces.size(); ++t) {
        EXPECT_EQ(geometry_difference(found.traces[t].header, gather.traces[t].header), "");
        EXPECT_EQ(found.traces[t].samples, gather.traces[t].samples);
      }
    }
}

TEST(Conversion, CopiesUndecodedSamplesAsItWritesDecodedOnes) {
  const Scratch scratch;
  for (const FileFormat& format : all_formats()) {
    SCOPED_TRACE(name_of_format(format));
    write_file(scratch.file("a"), survey_gather(51, 2), format);
    convert<RawTrace>(scratch.file("a"), scratch.file("raw"), format);
    convert<segy::Trace>(scratch.file("a"), scratch.file("decoded"), format);
    EXPECT_EQ(bytes_of(scratch.file("raw")), bytes_of(scratch.file("decoded")));
    if (format.su) continue;
    EXPECT_EQ(after_text(scratch.file("raw")), after_text(scratch.file("a")));
  }
}

TEST(Conversion, CopiesTracesThatAreLongerThanAnyBuffer) {
  const Scratch scratch;
  const FileFormat format{6, 2, Endian::big, TextEncoding::ebcdic, false};
  write_file(scratch.file("a"), survey_gather(150'000, 1), format);
  convert<RawTrace>(scratch.file("a"), scratch.file("b"), format);
  EXPECT_EQ(after_text(scratch.file("b")), after_text(scratch.file("a")));
}

TEST(Conversion, RefusesNanAndInfinityInCopiesToo) {
  const Scratch scratch;
  for (const int code : {5, 6})
    for (const Endian endian : {Endian::big, Endian::little}) {
      const FileFormat format{code, 2, endian, TextEncoding::ebcdic, false};
      write_file(scratch.file("a"), survey_gather(51, 1), format);
      Bytes bytes = bytes_of(scratch.file("a"));
      const int width = find_format(code)->bytes;
      const auto at = static_cast<std::size_t>(3600 + 2 * (240 + 51 * width) + 240 + 16 * width);
      const auto put = [&](std::uint64_t word) {
        store_bytes(&bytes[at], width, endian, word);
        put_bytes(scratch.file("a"), bytes);
        return refusal(scratch.file("a"), scratch.file("b"), format);
      };
      EXPECT_EQ(put(code == 5 ? 0x7fc00000 : 0x7ff8000000000000),
                "trace 3: sample 17: nan, expected a finite number");
      EXPECT_EQ(put(code == 5 ? 0xff800000 : 0xfff0000000000000),
                "trace 3: sample 17: -inf, expected a finite number");
      EXPECT_EQ(put(code == 5 ? 0x7f7fffff : 0x7fefffffffffffff), "accepted");
    }
}

TEST(Conversion, KeepsTheDelayWhereRevisionsDifferInTheTimeScalar) {
  const Scratch scratch;
  Gather late = survey_gather(20, 1);
  late.axis.start_s = 0.3;
  write_file(scratch.file("0"), late, {5, 0, Endian::big, TextEncoding::ebcdic, false});
  Bytes bytes = bytes_of(scratch.file("0"));
  store_bytes(&bytes[3600 + 214], 2, Endian::big, 17);  // no meaning in revision 0
  put_bytes(scratch.file("0"), bytes);
  convert<segy::Trace>(scratch.file("0"), scratch.file("1"), {});
  EXPECT_DOUBLE_EQ(Reader(scratch.file("1")).axis().start_s, 0.3);
  bytes = bytes_of(scratch.file("1"));
  for (std::size_t trace = 0; trace < 12; ++trace) {
    store_bytes(&bytes[3600 + trace * 320 + 108], 2, Endian::big, 30000);
    store_bytes(&bytes[3600 + trace * 320 + 214], 2, Endian::big, static_cast<std::uint64_t>(-100));
  }
  put_bytes(scratch.file("1"), bytes);
  EXPECT_DOUBLE_EQ(Reader(scratch.file("1")).axis().start_s, 0.3);
  for (const bool su : {false, true}) {
    convert<segy::Trace>(scratch.file("1"), scratch.file("back"),
                         {5, 0, Endian::big, TextEncoding::ebcdic, su});
    EXPECT_DOUBLE_EQ(Reader(scratch.file("back")).axis().start_s, 0.3);
  }
}

TEST(Conversion, SaysAllInSeismicUnixToo) {
  const Scratch scratch;
  write_file(scratch.file("a"), survey_gather(21, 2), {});
  convert<segy::Trace>(scratch.file("a"), scratch.file("a.su"),
                       {5, 1, Endian::little, TextEncoding::ebcdic, true});
  convert<segy::Trace>(scratch.file("a.su"), scratch.file("b"), {});
  const Bytes a = after_text(scratch.file("a"));
  const Bytes b = after_text(scratch.file("b"));
  ASSERT_EQ(a.size(), b.size());
  // all words but those of bytes 181 to 240, and of these the positions
  const std::size_t length = 240 + 4 * 21;
  for (std::size_t at = 400; at < a.size(); at += length) {
    EXPECT_TRUE(std::equal(&a[at], &a[at] + 188, &b[at]));
    EXPECT_TRUE(std::equal(&a[at] + 240, &a[at] + length, &b[at] + 240));
  }
  EXPECT_NE(Reader(scratch.file("b")).header().text.find("sw-convert"), std::string::npos);
}

TEST(Conversion, OfTheCorpusKeepsItsFacts) {
  const auto folder = shared_folder() / "data/segy-corpus";
  if (shared_folder().empty() || !std::filesystem::exists(folder))
    GTEST_SKIP() << "the corpus ../shared/data/segy-corpus is not there";
  const Scratch scratch;
  int files = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    const std::string path = entry.path().string();
    const bool is_data = path.ends_with(".sgy") || path.ends_with(".su");
    if (!is_data || path.ends_with("broken.sgy") || path.find("code 4") != std::string::npos) continue;
    SCOPED_TRACE(path);
    ++files;
    const Description before = describe(path);
    for (const FileFormat& format : {FileFormat{6, 2, Endian::little, TextEncoding::ascii, false},
                                     FileFormat{1, 1, Endian::big, TextEncoding::ebcdic, false}}) {
      convert<segy::Trace>(path, scratch.file("b"), format);
      const Description after = describe(scratch.file("b"));
      EXPECT_EQ(after.axis, before.axis);
      EXPECT_EQ(after.traces, before.traces);
      EXPECT_EQ(after.shots, before.shots);
      ASSERT_EQ(after.header.extended.size(), before.header.extended.size());
      for (std::size_t i = 0; i < after.header.extended.size(); ++i)
        EXPECT_EQ(after.header.extended[i].text, before.header.extended[i].text);
      if (before.traces == 0) continue;
      EXPECT_NEAR(after.sample.lowest, before.sample.lowest, 1e-6 * std::fabs(before.sample.lowest));
      EXPECT_NEAR(after.rms, before.rms, 1e-6 * before.rms);
      EXPECT_EQ(after.source_m[0].highest, before.source_m[0].highest);
      EXPECT_EQ(after.receiver_m[1].highest, before.receiver_m[1].highest);
    }
  }
  EXPECT_GE(files, 20);
}

}  // namespace slipwave::segy_conversion_test
