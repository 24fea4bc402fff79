// SPDX-License-Identifier: BSD-3-Clause
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <thread>

#include "base/error.hpp"
#include "gather/difference.hpp"
#include "segy/conversion.hpp"
#include "segy/extension.hpp"
#include "segy/pair.hpp"
#include "segy_shared.hpp"
#include "segy_write_cases.hpp"

namespace slipwave::segy_extra_test {

// What a file may hold beside one text and one header a trace: extended texts, additional trace headers,
// trailers, traces of different length.

using namespace slipwave::segy;

namespace {

using Bytes = std::vector<std::uint8_t>;

constexpr std::int64_t samples = 20;
constexpr std::size_t trace_bytes = 240 + 4 * samples;

void put_word(Bytes& bytes, FieldName<BinaryLayout> name, std::int64_t value, Endian endian = Endian::big) {
  store_bytes(&bytes[3200 + static_cast<std::size_t>(name.field.byte - BinaryLayout::first)],
              size_of(name.field.type), endian, static_cast<std::uint64_t>(value));
}

Bytes text_block(std::string text, TextEncoding encoding = TextEncoding::ebcdic) {
  text.resize(text_bytes, ' ');
  return encode_text(text, encoding);
}

Bytes plain_file(const Scratch& scratch, int revision, Endian endian = Endian::big) {
  write_file(scratch.file("plain"), survey_gather(samples, 1),
             {5, revision, endian, TextEncoding::ebcdic, false});
  return bytes_of(scratch.file("plain"));
}

/// Puts what `headers` gives for each trace, counted from 0, behind the trace headers.
template <class Headers>
Bytes with_headers(const Bytes& plain, Headers headers) {
  Bytes bytes(plain.begin(), plain.begin() + 3600);
  std::size_t number = 0;
  for (std::size_t at = 3600; at < plain.size(); at += trace_bytes) {
    const Bytes more = headers(number++);
    bytes.insert(bytes.end(), &plain[at], &plain[at] + 240);
    bytes.insert(bytes.end(), more.begin(), more.end());
    bytes.insert(bytes.end(), &plain[at] + 240, &plain[at] + trace_bytes);
  }
  return bytes;
}

Bytes extension_bytes(const ExtensionWords& words, Endian endian, TextEncoding encoding) {
  const auto bytes = words.in_file_order(endian);
  Bytes extension(bytes.begin(), bytes.end());
  const auto name = encode_text("SEG00001", encoding);
  std::copy(name.begin(), name.end(), extension.end() - 8);
  return extension;
}

void expect_same(const Gather& found, const Gather& expected) {
  ASSERT_EQ(found.traces.size(), expected.traces.size());
  for (std::size_t i = 0; i < found.traces.size(); ++i) {
    EXPECT_EQ(geometry_difference(found.traces[i].header, expected.traces[i].header), "");
    EXPECT_EQ(found.traces[i].samples, expected.traces[i].samples);
  }
}

std::string complaint(const Scratch& scratch, const Bytes& bytes) {
  put_bytes(scratch.file("bad"), bytes);
  try {
    read_file(scratch.file("bad"));
  } catch (const Error& error) {
    return std::string(error.what()).substr(scratch.file("bad").size() + 2);
  }
  return "accepted";
}

void rewrite(const std::string& from, const std::string& to, const FileFormat& format) {
  Reader reader(from);
  OutputFile out(to, OutputFile::Content::binary);
  Writer writer(out, info_as(reader, "sw-convert", format));
  segy::Trace trace;
  while (reader.next(trace)) writer.write(trace, reader.header().su);
  out.commit();
}

}  // namespace

TEST(ExtendedText, IsReadByCountAndUpToItsStanzaAndCarriedAlong) {
  const Scratch scratch;
  Bytes bytes = plain_file(scratch, 1);
  const Bytes first = text_block("((SEG: Measurement Units ver 1.0))", TextEncoding::ascii);
  const Bytes last = text_block("((SEG:EndText))");
  bytes.insert(bytes.begin() + 3600, last.begin(), last.end());
  bytes.insert(bytes.begin() + 3600, first.begin(), first.end());
  for (const int count : {2, -1}) {
    put_word(bytes, "extended", count);
    put_bytes(scratch.file("x"), bytes);
    expect_same(read_file(scratch.file("x")), survey_gather(samples, 1));
    const Reader reader(scratch.file("x"));
    ASSERT_EQ(reader.header().extended.size(), 2U);
    EXPECT_EQ(reader.header().extended[0].text.substr(0, 34), "((SEG: Measurement Units ver 1.0))");
    const FileInfo info = info_like(reader, "sw-nothing");
    EXPECT_EQ(info.extended, reader.header().extended);
    rewrite(scratch.file("x"), scratch.file("y"), format_of(reader));
    const Bytes written = bytes_of(scratch.file("y"));
    EXPECT_TRUE(std::equal(bytes.begin() + 3600, bytes.end(), written.begin() + 3600, written.end()));
    EXPECT_EQ(Reader(scratch.file("y")).header().binary.get("extended"), 2);
  }
}

TEST(ExtendedText, EndsWithItsStanzaInAnyCaseBlanksAndCode) {
  const Scratch scratch;
  const Bytes plain = plain_file(scratch, 1);
  for (const std::string end : {"((SEG: EndText))", "((  seg: endTEXt  ))", "( ( SEG : ENDTEXT ) )"})
    for (const TextEncoding first : {TextEncoding::ebcdic, TextEncoding::ascii})
      for (const TextEncoding last : {TextEncoding::ebcdic, TextEncoding::ascii}) {
        Bytes bytes = plain;
        for (const Bytes& block :
             {text_block(end, last), text_block("((SEG: Notes ver 1.0)) of the crew", first)})
          bytes.insert(bytes.begin() + 3600, block.begin(), block.end());
        put_word(bytes, "extended", -1);
        put_bytes(scratch.file("x"), bytes);
        expect_same(read_file(scratch.file("x")), survey_gather(samples, 1));
        const Reader reader(scratch.file("x"));
        ASSERT_EQ(reader.header().extended.size(), 2U) << end;
        EXPECT_EQ(reader.header().extended[1].text.substr(0, end.size()), end);
      }
}

TEST(ExtendedText, ChangesItsCodeWithTheFirst) {
  const Scratch scratch;
  Bytes bytes = plain_file(scratch, 1);
  const Bytes block = text_block("((SEG: Notes)) 7 < 8");
  bytes.insert(bytes.begin() + 3600, block.begin(), block.end());
  put_word(bytes, "extended", 1);
  put_bytes(scratch.file("x"), bytes);
  rewrite(scratch.file("x"), scratch.file("y"), {5, 1, Endian::big, TextEncoding::ascii, false});
  const Bytes written = bytes_of(scratch.file("y"));
  EXPECT_EQ(std::string(written.begin() + 3600, written.begin() + 3620), "((SEG: Notes)) 7 < 8");
}

TEST(ExtendedText, IsLeftOutWithASentenceWhereThereIsNoPlaceForIt) {
  const Scratch scratch;
  Bytes bytes = plain_file(scratch, 2);
  const Bytes block = text_block("((SEG: Notes))");
  bytes.insert(bytes.begin() + 3600, block.begin(), block.end());
  put_word(bytes, "extended", 1);
  put_bytes(scratch.file("x"), bytes);
  const Reader reader(scratch.file("x"));
  FileFormat old;
  old.revision = 0;
  EXPECT_EQ(losses_of(reader, old),
            std::vector<std::string>{scratch.file("x") +
                                     ": extended textual headers are left out; --revision 1 keeps them"});
  EXPECT_TRUE(losses_of(reader, {}).empty());
  rewrite(scratch.file("x"), scratch.file("y"), old);
  expect_same(read_file(scratch.file("y")), survey_gather(samples, 1));
  EXPECT_TRUE(Reader(scratch.file("y")).header().extended.empty());
}

TEST(ExtendedText, IsRefusedWhereItDoesNotEnd) {
  const Scratch scratch;
  Bytes bytes = plain_file(scratch, 1);
  put_word(bytes, "extended", 3);
  EXPECT_EQ(complaint(scratch, bytes), "ends within extended textual header 2 of 3");
  put_word(bytes, "extended", -1);
  EXPECT_EQ(complaint(scratch, bytes),
            "ends within extended textual header 2, before a stanza ((SEG: EndText))");
  put_word(bytes, "extended", -2);
  EXPECT_EQ(complaint(scratch, bytes), "-2 extended textual headers (byte 3505), expected a number or -1");
}

TEST(AdditionalHeader, GivesPositionsThatDoNotFitTheFirst) {
  const Scratch scratch;
  for (const Endian endian : {Endian::big, Endian::little})
    for (const TextEncoding encoding : {TextEncoding::ebcdic, TextEncoding::ascii}) {
      Bytes bytes = with_headers(plain_file(scratch, 2, endian), [&](std::size_t trace) {
        ExtensionWords words;
        words.set_real("xsx", 5e9 + 0.125);
        words.set_real("xgy", -0.0009765625 * static_cast<double>(trace + 1));
        words.set_real("xgelev", 12.5);
        words.set_real("xsdepth", std::numeric_limits<double>::quiet_NaN());  // not believed
        words.set("xfldr", 3'000'000'000);
        return extension_bytes(words, endian, encoding);
      });
      put_word(bytes, "extra_headers", 1, endian);
      put_bytes(scratch.file("x"), bytes);
      Gather expected = survey_gather(samples, 1);
      double number = 0;
      for (auto& trace : expected.traces) {
        trace.header.source_m[0] = 5e9 + 0.125;
        trace.header.receiver_m[1] = -0.0009765625 * ++number;
        trace.header.receiver_m[2] = -12.5;
        trace.header.shot = 3'000'000'000;
      }
      expect_same(read_file(scratch.file("x")), expected);
    }
}

TEST(AdditionalHeader, CountsWhenFilesAreReadSideBySide) {
  const Scratch scratch;
  for (const double x : {7e9, 8e9}) {
    Bytes bytes = with_headers(plain_file(scratch, 2), [&](std::size_t) {
      ExtensionWords words;
      words.set_real("xsx", x);
      return extension_bytes(words, Endian::big, TextEncoding::ebcdic);
    });
    put_word(bytes, "extra_headers", 1);
    put_bytes(scratch.file(x < 7.5e9 ? "7" : "8"), bytes);
  }
  const auto refusal = [&](auto trace_a, auto trace_b) {
    Reader a(scratch.file("7"));
    Reader b(scratch.file("8"));
    try {
      PairReader(a, b).next(trace_a, trace_b);
    } catch (const Error& error) {
      return std::string(error.what()).substr(scratch.file("8").size());
    }
    return std::string("accepted");
  };
  const std::string expected = ": trace 1: source x is 8e+09 m, expected 7e+09 m as in " + scratch.file("7");
  EXPECT_EQ(refusal(segy::Trace(), segy::Trace()), expected);
  EXPECT_EQ(refusal(RawTrace(), RawTrace()), expected);
}

TEST(AdditionalHeader, OfAnotherNameIsCarriedAndNotRead) {
  const Scratch scratch;
  Bytes bytes = with_headers(plain_file(scratch, 2), [](std::size_t trace) {
    return Bytes(3 * 240, static_cast<std::uint8_t>(trace + 1));
  });
  put_word(bytes, "extra_headers", 3);
  put_bytes(scratch.file("x"), bytes);
  expect_same(read_file(scratch.file("x")), survey_gather(samples, 1));
  const Reader reader(scratch.file("x"));
  rewrite(scratch.file("x"), scratch.file("y"), format_of(reader));
  const Bytes written = bytes_of(scratch.file("y"));
  EXPECT_TRUE(std::equal(bytes.begin() + 3600, bytes.end(), written.begin() + 3600, written.end()));
  EXPECT_EQ(losses_of(reader, {}),
            std::vector<std::string>{
                scratch.file("x") +
                ": additional trace headers are left out; --revision 2 in the same byte order keeps them"});
  rewrite(scratch.file("x"), scratch.file("z"), {});
  expect_same(read_file(scratch.file("z")), survey_gather(samples, 1));
}

TEST(AdditionalHeader, MayBeThereInAnyNumberWhereTracesDiffer) {
  const Scratch scratch;
  Bytes bytes = with_headers(plain_file(scratch, 2), [](std::size_t trace) {
    ExtensionWords words;
    words.set("headers", static_cast<std::int64_t>(1 + trace % 3));
    Bytes more = extension_bytes(words, Endian::big, TextEncoding::ebcdic);
    more.resize(240 * (1 + trace % 3), 0xAB);
    return more;
  });
  put_word(bytes, "extra_headers", 3);
  put_word(bytes, "fixed", 0);
  put_bytes(scratch.file("x"), bytes);
  expect_same(read_file(scratch.file("x")), survey_gather(samples, 1));
}

TEST(AdditionalHeader, FollowsTheSamplingOfTheOutput) {
  Bytes headers(240, 0);
  ExtensionWords words;
  words.set("xns", 20);
  words.set_real("xdt", 2000);
  headers = extension_bytes(words, Endian::little, TextEncoding::ebcdic);
  set_sampling(headers, Endian::little, 10, 4000);
  const auto found = extension_of(headers, Endian::little);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->get("xns"), 10);
  EXPECT_EQ(found->get_real("xdt"), 4000);
}

TEST(SamplingWords, AreInMicrosecondsWhereverTheyStand) {
  const Scratch scratch;
  const Bytes bytes = plain_file(scratch, 2);
  const BinaryWords words(std::span<const std::uint8_t, 400>(&bytes[3200], 400), Endian::big);
  EXPECT_EQ(words.get("dt"), 2000);
  EXPECT_EQ(words.get("dto"), 2000);
  EXPECT_EQ(words.get_real("xdt"), 2000);
  EXPECT_EQ(words.get_real("xdto"), 2000);
}

TEST(Trailer, IsNoTrace) {
  const Scratch scratch;
  Bytes bytes = plain_file(scratch, 2);
  put_word(bytes, "ntraces", 0);
  for (const int count : {1, -1}) {
    for (const TextEncoding encoding : {TextEncoding::ebcdic, TextEncoding::ascii}) {
      Bytes all = bytes;
      put_word(all, "trailers", count);
      const Bytes stanza = text_block("((SEG: User Notes))", encoding);
      all.insert(all.end(), stanza.begin(), stanza.end());
      put_bytes(scratch.file("x"), all);
      expect_same(read_file(scratch.file("x")), survey_gather(samples, 1));
      ASSERT_EQ(mkfifo(scratch.file("fifo").c_str(), 0600), 0);
      std::thread writer([&] { put_bytes(scratch.file("fifo"), all); });
      expect_same(read_file(scratch.file("fifo")), survey_gather(samples, 1));
      writer.join();
      std::filesystem::remove(scratch.file("fifo"));
      EXPECT_EQ(losses_of(Reader(scratch.file("x")), {}).size(), 1U);
    }
  }
}

TEST(TracesOfDifferentLength, AreWrittenAsTheyWereRead) {
  const Scratch scratch;
  Bytes bytes = plain_file(scratch, 1);
  put_word(bytes, "fixed", 0);
  for (std::size_t trace = 12; trace-- > 0;) {  // from the last: each gets 4 * trace bytes more
    const std::size_t at = 3600 + trace * trace_bytes;
    store_bytes(&bytes[at + 114], 2, Endian::big, samples + trace);
    bytes.insert(bytes.begin() + static_cast<std::ptrdiff_t>(at + 240), 4 * trace, 0);
  }
  put_bytes(scratch.file("x"), bytes);
  const Reader reader(scratch.file("x"));
  EXPECT_TRUE(reader.lengths_by_trace());
  rewrite(scratch.file("x"), scratch.file("y"), format_of(reader));
  const Bytes written = bytes_of(scratch.file("y"));
  EXPECT_TRUE(std::equal(bytes.begin() + 3200, bytes.end(), written.begin() + 3200, written.end()));
  rewrite(scratch.file("x"), scratch.file("z"), {6, 2, Endian::little, TextEncoding::ascii, false});
  expect_same(read_file(scratch.file("z")), read_file(scratch.file("x")));
}

}  // namespace slipwave::segy_extra_test
