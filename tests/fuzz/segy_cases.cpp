// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>

#include "segy/words.hpp"
#include "segy_shared.hpp"
#include "segy_target.hpp"
#include "segy_write_cases.hpp"

namespace slipwave::segy {
namespace {

constexpr std::size_t first_trace = 3600;

void put_word(std::span<std::uint8_t> bytes, std::size_t at, const Field& field, Endian endian,
              std::uint64_t value) {
  const auto width = static_cast<std::size_t>(size_of(field.type));
  if (at + width <= bytes.size()) store_bytes(bytes.data() + at, size_of(field.type), endian, value);
}

void append_text(Bytes& bytes, const std::string& begin, TextEncoding encoding) {
  std::string text = begin;
  text.resize(text_bytes, ' ');
  const auto encoded = encode_text(text, encoding);
  bytes.insert(bytes.end(), encoded.begin(), encoded.end());
}

/// `plain`, a revision 2 file in big-endian order, with two extended texts (counted, or up to the stanza),
/// two additional headers a trace and a trailer.
Bytes with_everything(const Bytes& plain, std::int64_t samples, bool counted) {
  Bytes bytes(plain.begin(), plain.begin() + first_trace);
  const auto binary = [&](FieldName<BinaryLayout> name, std::uint64_t value) {
    put_word(bytes, text_bytes + static_cast<std::size_t>(name.field.byte - BinaryLayout::first), name.field,
             Endian::big, value);
  };
  binary("extended", counted ? 2 : 0xffff);
  binary("extra_headers", 2);
  binary("trailers", 1);
  binary("ntraces", 0);
  append_text(bytes, "((SEG: Coordinate Reference System ver 1.0))", TextEncoding::ebcdic);
  append_text(bytes, "((SEG: EndText))", TextEncoding::ebcdic);
  ExtensionWords words;
  words.set_real("xsx", 1234.5);
  words.set("xns", samples);
  auto extension = words.in_file_order(Endian::big);
  const auto name = encode_text("SEG00001", TextEncoding::ebcdic);
  std::copy(name.begin(), name.end(), extension.end() - 8);
  const auto body = static_cast<std::ptrdiff_t>(4 * samples);
  for (auto at = plain.begin() + first_trace; at != plain.end(); at += 240 + body) {
    bytes.insert(bytes.end(), at, at + 240);
    bytes.insert(bytes.end(), extension.begin(), extension.end());
    bytes.insert(bytes.end(), 240, 0xAB);
    bytes.insert(bytes.end(), at + 240, at + 240 + body);
  }
  append_text(bytes, "((SEG: User notes))", TextEncoding::ebcdic);
  return bytes;
}

/// A shot into three lines of receivers on either side of y = 0: inline and crossline numbers, negative ones,
/// too.
Gather area_gather(std::int64_t samples) {
  Gather gather{{samples, 0.002, 0}, {}};
  for (const Component component : {Component::vy, Component::syz, Component::sxy})
    for (int channel = 0; channel < 6; ++channel) {
      slipwave::Trace trace;
      trace.header.channel = channel + 1;
      trace.header.component = component;
      trace.header.source_m = {20, -3.5, 7.5};
      trace.header.receiver_m = {-10. + 25 * (channel % 2), -8. + 4 * (channel / 2), 2.5};
      for (std::int64_t n = 0; n < samples; ++n) trace.samples.push_back(double((5 * n + channel) % 17));
      gather.traces.push_back(trace);
    }
  return gather;
}

/// A word of one of the layouts, by its number, and where it stands in a file.
struct Place {
  Field field;
  std::size_t at;
};

template <class Layout>
void add_places(std::vector<Place>& places, std::size_t from) {
  for (const Field& field : Layout::fields)
    places.push_back({field, from + static_cast<std::size_t>(field.byte - Layout::first)});
}

}  // namespace

std::vector<Seed> seeds(std::int64_t samples) {
  const Scratch scratch;
  const Gather gather = survey_gather(samples, 1), area = area_gather(samples);
  std::vector<Seed> all;
  const auto add = [&](const std::string& name, const Gather& of, const FileFormat& format) {
    write_file(scratch.file("seed"), of, format);
    all.push_back({name, bytes_of(scratch.file("seed"))});
  };
  for (const SampleFormat& format : sample_formats())
    for (const Endian endian : {Endian::big, Endian::little})
      for (int revision = format.since == 2 ? 2 : 0; revision <= 2; ++revision) {
        const auto encoding = (format.code + revision) % 2 == 0 ? TextEncoding::ebcdic : TextEncoding::ascii;
        add(std::string(format.name) + "-" + name_of(endian) + "-" + std::to_string(revision) + ".sgy",
            gather, {format.code, revision, endian, encoding, false});
      }
  for (const Endian endian : {Endian::big, Endian::little})
    add(std::string(name_of(endian)) + ".su", gather, {5, 1, endian, TextEncoding::ebcdic, true});
  for (const Endian endian : {Endian::big, Endian::little})
    for (const int revision : {1, 2})
      add("area-" + std::string(name_of(endian)) + "-" + std::to_string(revision) + ".sgy", area,
          {5, revision, endian, TextEncoding::ebcdic, false});
  add("area.su", area, {5, 1, Endian::little, TextEncoding::ebcdic, true});
  write_file(scratch.file("seed"), gather, {5, 2, Endian::big, TextEncoding::ebcdic, false});
  const Bytes plain = bytes_of(scratch.file("seed"));
  all.push_back({"counted.sgy", with_everything(plain, samples, true)});
  all.push_back({"stanza.sgy", with_everything(plain, samples, false)});
  return all;
}

void change_headers(std::span<std::uint8_t> bytes, std::mt19937& random) {
  static const std::vector<Place> places = [] {
    std::vector<Place> all;
    add_places<BinaryLayout>(all, text_bytes);
    add_places<TraceLayout>(all, 0);  // of Seismic Unix
    add_places<TraceLayout>(all, first_trace);
    add_places<TraceLayout>(all, first_trace + 2 * text_bytes);
    add_places<ExtensionLayout>(all, first_trace + 240);
    add_places<ExtensionLayout>(all, first_trace + 2 * text_bytes + 240);
    return all;
  }();
  constexpr std::array<std::uint64_t, 12> extremes = {
      0, 1, 2, 0x7f, 0x80, 0x7fff, 0x8000, 0x7fffffff, 0x80000000, 0x7fffffffffffffff, 1ULL << 63, ~0ULL};
  const Endian endian = random() % 8 == 0 ? Endian::little : Endian::big;
  for (std::uint32_t left = 1 + random() % 8; left > 0; --left) {
    const Place& place = places[random() % places.size()];
    const std::uint32_t kind = random() % 4;
    const std::uint64_t value = kind < 3 ? extremes[random() % extremes.size()] : random();
    put_word(bytes, place.at, place.field, endian, value);
    if (random() % 4 == 0 && bytes.size() > text_bytes) bytes[random() % bytes.size()] ^= 1U << random() % 8;
  }
}

}  // namespace slipwave::segy
