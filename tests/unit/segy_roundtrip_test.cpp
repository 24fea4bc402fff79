// SPDX-License-Identifier: BSD-3-Clause
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <thread>

#include "base/error.hpp"
#include "gather/difference.hpp"
#include "segy/describe.hpp"
#include "segy_shared.hpp"
#include "segy_write_cases.hpp"

namespace slipwave::segy_roundtrip_test {

using namespace slipwave::segy;

namespace {

void expect_equal(const Gather& found, const Gather& expected) {
  EXPECT_EQ(sampling_difference(found.axis, expected.axis), "");
  ASSERT_EQ(found.traces.size(), expected.traces.size());
  for (std::size_t i = 0; i < found.traces.size(); ++i) {
    EXPECT_EQ(geometry_difference(found.traces[i].header, expected.traces[i].header), "");
    EXPECT_EQ(found.traces[i].samples, expected.traces[i].samples);
  }
}

std::string refusal(const Gather& gather, const FileFormat& format) {
  const Scratch scratch;
  try {
    write_file(scratch.file("g.sgy"), gather, format);
  } catch (const Error& error) {
    return error.what();
  }
  return "accepted";
}

}  // namespace

TEST(SegyFile, ReturnsEveryFormatByteOrderRevisionAndEncoding) {
  const Scratch scratch;
  const Gather gather = survey_gather();
  for (const SampleFormat& format : sample_formats())
    for (const int revision : {0, 1, 2})
      for (const Endian endian : {Endian::big, Endian::little})
        for (const TextEncoding encoding : {TextEncoding::ebcdic, TextEncoding::ascii}) {
          if (revision < 2 && format.since == 2) continue;
          SCOPED_TRACE(std::string(format.name) + " revision " + std::to_string(revision) + " " +
                       name_of(endian));
          write_file(scratch.file("g.sgy"), gather, {format.code, revision, endian, encoding, false});
          expect_equal(read_file(scratch.file("g.sgy")), gather);
          const Reader reader(scratch.file("g.sgy"));
          EXPECT_EQ(reader.header().endian, endian);
          EXPECT_EQ(reader.header().encoding, encoding);
          EXPECT_EQ(reader.header().major, revision);
          EXPECT_EQ(reader.header().minor, revision == 2 ? 1 : 0);
          EXPECT_EQ(reader.header().format->code, format.code);
          EXPECT_EQ(reader.header().text.substr(4, 13), "slipwave test");
        }
}

TEST(SegyFile, ReturnsSeismicUnixFilesInBothByteOrders) {
  const Scratch scratch;
  const Gather gather = survey_gather();
  for (const Endian endian : {Endian::big, Endian::little}) {
    write_file(scratch.file("g.su"), gather, {5, 1, endian, TextEncoding::ebcdic, true});
    const auto bytes = bytes_of(scratch.file("g.su"));
    EXPECT_EQ(bytes.size(), gather.traces.size() * (240 + 4 * 51));
    for (std::size_t i = 180; i < 240; ++i) ASSERT_EQ(bytes[i], 0);
    expect_equal(read_file(scratch.file("g.su")), gather);
    EXPECT_TRUE(Reader(scratch.file("g.su")).header().su);
    EXPECT_EQ(Reader(scratch.file("g.su")).header().endian, endian);
  }
}

TEST(SegyFile, ReadsTheSameFromAPipeThatCannotSeek) {
  const Scratch scratch;
  const Gather gather = survey_gather(3000);
  for (const bool su : {false, true}) {
    write_file(scratch.file("g"), gather, {5, 1, Endian::big, TextEncoding::ebcdic, su});
    const std::string fifo = scratch.file(su ? "su" : "segy");
    ASSERT_EQ(mkfifo(fifo.c_str(), 0600), 0);
    std::thread writer([&] { put_bytes(fifo, bytes_of(scratch.file("g"))); });
    const Gather found = read_file(fifo);
    writer.join();
    expect_equal(found, gather);
  }
}

TEST(SegyFile, LiftsTheLimitsOfNsAndDtInRevision2) {
  const Scratch scratch;
  const Gather long_traces = survey_gather(70000, 1);
  write_file(scratch.file("l.sgy"), long_traces, {5, 2, Endian::big, TextEncoding::ebcdic, false});
  expect_equal(read_file(scratch.file("l.sgy")), long_traces);
  const Gather fine = survey_gather(10, 2, 0.00012345678);
  write_file(scratch.file("f.sgy"), fine, {6, 2, Endian::little, TextEncoding::ebcdic, false});
  expect_equal(read_file(scratch.file("f.sgy")), fine);
  EXPECT_DOUBLE_EQ(read_file(scratch.file("f.sgy")).axis.interval_s, 0.00012345678);
}

TEST(SegyFile, RefusesWhatTheRevisionCannotHold) {
  FileFormat su;
  su.su = true;
  EXPECT_EQ(refusal(survey_gather(65536, 1), {}),
            "65536 samples a trace, SEG-Y revision 1 holds 1 to 65535; SEG-Y revision 2 holds them");
  EXPECT_EQ(refusal(survey_gather(65536, 1), su),
            "65536 samples a trace, Seismic Unix holds 1 to 65535; SEG-Y revision 2 holds them");
  EXPECT_EQ(refusal(survey_gather(65535, 1), {}), "accepted");
  EXPECT_EQ(refusal(survey_gather(10, 1, 0.0001234), {}),
            "sample interval 0.0001234 s, SEG-Y revision 1 holds whole microseconds up to 65535; "
            "SEG-Y revision 2 holds any");
  EXPECT_EQ(refusal(survey_gather(10, 1, 0.0007), {}), "accepted");
  EXPECT_EQ(refusal(survey_gather(), {6, 1, Endian::big, TextEncoding::ebcdic, false}),
            "sample format double exists since revision 2, the file is of revision 1");
  Gather late = survey_gather();
  late.axis.start_s = 0.0005;
  EXPECT_EQ(refusal(late, {}), "accepted") << "by the time scalar";
  EXPECT_EQ(refusal(late, su),
            "first sample at 5e-04 s, Seismic Unix and SEG-Y revision 0 hold whole milliseconds up to 32.767 "
            "s; revision "
            "1 holds fractions");
  late.axis.start_s = -0.04;
  EXPECT_EQ(refusal(late, {}), "accepted");
  Gather broken = survey_gather();
  broken.traces[2].samples[16] = std::nan("");
  EXPECT_EQ(refusal(broken, {}), "trace 3: sample 17: nan, expected a finite number");
  broken = survey_gather();
  broken.traces[1].samples.pop_back();
  EXPECT_EQ(refusal(broken, {}), "trace 2: 50 samples, expected 51 as in the file header");
  broken = survey_gather();
  broken.traces[3].header.shot = 3000000000;
  EXPECT_TRUE(refusal(broken, {}).starts_with("trace 4: header word fldr"));
}

TEST(SegyFile, WritesTheSameBytesEveryTime) {
  const Scratch scratch;
  write_file(scratch.file("a"), survey_gather(), {});
  write_file(scratch.file("b"), survey_gather(), {});
  EXPECT_EQ(bytes_of(scratch.file("a")), bytes_of(scratch.file("b")));
}

TEST(SegyFile, CarriesHeadersOfAnotherFileUnchanged) {
  const Scratch scratch;
  write_file(scratch.file("a"), survey_gather(), {});
  Reader reader(scratch.file("a"));
  {
    OutputFile out(scratch.file("b"), OutputFile::Content::binary);
    Writer writer(out, info_like(reader, "sw-nothing a"));
    segy::Trace trace;
    while (reader.next(trace)) writer.write(trace, false);
    out.commit();
  }
  auto a = bytes_of(scratch.file("a"));
  auto b = bytes_of(scratch.file("b"));
  EXPECT_EQ(std::vector<std::uint8_t>(a.begin() + 3200, a.end()),
            std::vector<std::uint8_t>(b.begin() + 3200, b.end()));
  EXPECT_NE(Reader(scratch.file("b")).header().text.find("sw-nothing"), std::string::npos);
  EXPECT_NE(Reader(scratch.file("b")).header().text.find("sw-shoot model.nc"), std::string::npos);
}

TEST(SegyFile, SkipsExtendedTextAndExtraTraceHeaders) {
  const Scratch scratch;
  const Gather gather = survey_gather();
  write_file(scratch.file("g.sgy"), gather, {5, 2, Endian::big, TextEncoding::ebcdic, false});
  const auto plain = bytes_of(scratch.file("g.sgy"));
  const std::size_t length = 240 + 4 * 51;
  for (const int count : {2, -1}) {
    std::vector<std::uint8_t> bytes(plain.begin(), plain.begin() + 3600);
    store_bytes(&bytes[3504], 2, Endian::big, static_cast<std::uint64_t>(count));
    store_bytes(&bytes[3506], 2, Endian::big, 3);  // three more headers a trace
    std::string stanza(3200, ' ');
    bytes.insert(bytes.end(), 3200, 0x40);
    stanza.replace(0, 16, "((SEG: EndText))");
    const auto end = encode_text(stanza, TextEncoding::ebcdic);
    bytes.insert(bytes.end(), end.begin(), end.end());
    for (std::size_t at = 3600; at < plain.size(); at += length) {
      bytes.insert(bytes.end(), &plain[at], &plain[at] + 240);
      bytes.insert(bytes.end(), 3 * 240, 0xAB);
      bytes.insert(bytes.end(), &plain[at] + 240, &plain[at] + length);
    }
    put_bytes(scratch.file("x.sgy"), bytes);
    expect_equal(read_file(scratch.file("x.sgy")), gather);
    EXPECT_EQ(Reader(scratch.file("x.sgy")).header().extended.size(), 2U);
  }
}

TEST(SegyFile, ReadsTracesOfDifferentLengthByTheirOwnHeaders) {
  const Scratch scratch;
  write_file(scratch.file("g.sgy"), survey_gather(20, 1), {});
  auto bytes = bytes_of(scratch.file("g.sgy"));
  store_bytes(&bytes[3600 + 114], 2, Endian::big, 25);  // the first trace has 5 samples more
  bytes.insert(bytes.begin() + 3600 + 240, 20, 0);
  put_bytes(scratch.file("v.sgy"), bytes);
  const Gather gather = read_file(scratch.file("v.sgy"));
  ASSERT_EQ(gather.traces.size(), 12U);
  EXPECT_EQ(gather.traces[0].samples.size(), 25U);
  EXPECT_EQ(gather.traces[1].samples.size(), 20U);
}

}  // namespace slipwave::segy_roundtrip_test
