// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>

#include "segy/conversion.hpp"
#include "segy_shared.hpp"
#include "segy_write_cases.hpp"

namespace slipwave::segy_segyio_test {

// segyio, which half of the world reads SEG-Y with, finds every word and every sample that were written.

using namespace slipwave::segy;

namespace {

bool has_segyio() { return std::system("/usr/bin/python3 -c 'import segyio' 2>/dev/null") == 0; }

/// What `gather` must look like: words from the table of the format, samples as they are.
void put_expected(const std::string& path, const Gather& gather, const FileFormat& format,
                  const std::string& text) {
  std::vector<TraceHeader> headers;
  for (const auto& trace : gather.traces) headers.push_back(trace.header);
  const SurveyLayout layout = layout_of(headers);
  std::ofstream out(path);
  const auto count = gather.axis.count;
  out << "bin 3217 2000\nbin 3221 " << count << "\nbin 3225 " << format.code << "\nbin 3213 24\nbin 3255 1\n";
  out << "bin 3505 0\n";
  for (std::size_t line = 0; line < 40; ++line) out << "text " << text.substr(80 * line, 80) << '\n';
  std::int64_t number = 0;
  for (const auto& trace : gather.traces) {
    TraceWords words = words_from_si(trace.header, layout);
    ++number;
    words.set("tracl", number);
    words.set("tracr", number);
    words.set("ns", count);
    words.set("dt", 2000);
    out << "trace";
    for (const segy::Field& field : TraceLayout::fields)
      if (field.byte != 25)  // the ordinal within the bin is counted while writing
        out << ' ' << field.byte << '=' << words.get(FieldName<TraceLayout>(field));
    out << "\nsamples";
    for (const double sample : trace.samples) out << ' ' << sample;
    out << '\n';
  }
}

/// `files`: triples of a file, its order of bytes and what is expected of it.
int segyio_reads(const std::string& files) {
  return std::system(("/usr/bin/python3 '" SLIPWAVE_TESTS_UNIT "/segyio_reads.py'" + files).c_str());
}
std::string to_read(const std::string& file, Endian endian, const std::string& expected) {
  return " '" + file + "' " + name_of(endian) + " '" + expected + "'";
}

}  // namespace

TEST(Segyio, FindsEveryWordAndSampleOfRevisions0And1) {
  if (!has_segyio()) GTEST_SKIP() << "python3-segyio is not there";
  const Scratch scratch;
  const Gather gather = survey_gather();
  std::string files;
  for (const int revision : {0, 1})
    for (const int code : {1, 2, 3, 5, 8})
      for (const Endian endian : {Endian::big, Endian::little}) {
        const FileFormat format{code, revision, endian, TextEncoding::ebcdic, false};
        const auto file = scratch.file("format-" + std::to_string(code) + "-revision-" +
                                       std::to_string(revision) + name_of(endian));
        write_file(file, gather, format);
        put_expected(file + ".txt", gather, format, Reader(file).header().text);
        files += to_read(file, endian, file + ".txt");
      }
  EXPECT_EQ(segyio_reads(files), 0);
}

TEST(Segyio, FindsTheSameInWhatWasConverted) {
  if (!has_segyio()) GTEST_SKIP() << "python3-segyio is not there";
  const Scratch scratch;
  const Gather gather = survey_gather();
  write_file(scratch.file("two.sgy"), gather, {6, 2, Endian::little, TextEncoding::ascii, false});
  const FileFormat format{1, 0, Endian::big, TextEncoding::ebcdic, false};
  {
    Reader reader(scratch.file("two.sgy"));
    OutputFile out(scratch.file("g.sgy"), OutputFile::Content::binary);
    Writer writer(out, info_as(reader, "sw-convert", format));
    segy::Trace trace;
    while (reader.next(trace)) writer.write(trace, false);
    out.commit();
  }
  put_expected(scratch.file("expected"), gather, format, Reader(scratch.file("g.sgy")).header().text);
  EXPECT_EQ(segyio_reads(to_read(scratch.file("g.sgy"), Endian::big, scratch.file("expected"))), 0);
}

}  // namespace slipwave::segy_segyio_test
