// SPDX-License-Identifier: BSD-3-Clause
#include "segy/file_header.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/error.hpp"
#include "segy/sniff.hpp"

namespace slipwave::segy {
namespace {

constexpr std::int64_t most_extended = 32767;

/// Major and minor revision. Words 0x0001 and 0x0010 are written for 1.0 too (0x0002, 0x0020 for 2.0), and a
/// little-endian revision 1 file has the two bytes swapped.
void read_revision(FileHeader& header) {
  const int first = static_cast<int>(header.binary.get("major"));
  const int second = static_cast<int>(header.binary.get("minor"));
  const int word = header.endian == Endian::big ? first << 8 | second : second << 8 | first;
  if (word == 0x0001 || word == 0x0010) {
    header.major = 1;
  } else if (word == 0x0002 || word == 0x0020) {
    header.major = 2;
  } else {
    const bool swapped = header.endian == Endian::little && first < 2;
    header.major = swapped ? second : first;
    header.minor = swapped ? first : second;
  }
  // The bytes are free in revision 0: what is no revision and has no mark of revision 2 is none.
  if (header.major > 2 && header.binary.get("byte_order") != byte_order_constant)
    header.major = header.minor = 0;
}

const SampleFormat* readable_format(const FileHeader& header, const ReadOptions& options) {
  const std::int64_t code = options.format ? *options.format : header.binary.get("format");
  if (const SampleFormat* format = find_format(code)) return format;
  if (code == 4)
    throw Error(
        "sample format code 4 (fixed point with gain) is ambiguous; say what the samples are (--format or "
        "--input-format)");
  throw Error("sample format code " + std::to_string(code) +
              " (byte 3225), expected 1, 2, 3, 5 to 12, 15 or 16");
}

void read_revision_2(FileHeader& header) {
  const BinaryWords& binary = header.binary;
  if (binary.get("xns") > 0) header.samples = binary.get("xns");
  const double interval_us = binary.get_real("xdt");
  if (interval_us > 0 && std::isfinite(interval_us)) header.interval_us = interval_us;
  header.extra_headers = binary.get("extra_headers");
  // a count of traces is believed where the revision is one that exists
  if (header.major == 2 && header.minor <= 1 && binary.get("ntraces") > 0)
    header.traces = binary.get("ntraces");
}

/// Whether a text holds the stanza ((SEG: EndText)), in letters of any case, blanks anywhere, in either code.
bool ends_stanzas(std::span<const std::uint8_t> block) {
  for (const TextEncoding encoding : {TextEncoding::ebcdic, TextEncoding::ascii}) {
    std::string dense;
    for (const char c : decode_text(block, encoding))
      if (c > ' ' && c <= '~') dense += c >= 'A' && c <= 'Z' ? char(c - 'A' + 'a') : c;
    if (dense.find("((seg:endtext))") != std::string::npos) return true;
  }
  return false;
}

/// A count of extended headers, or -1: up to the stanza that ends them.
void read_extended(ByteSource& source, FileHeader& header) {
  const std::int64_t count = header.binary.get("extended");
  // Revision 0 knows none: there the word counts where a text follows.
  const auto next = source.peek(text_bytes);
  if (header.major == 0 && !looks_like_text(next) && !begins_stanza(next)) return;
  if (count < -1)
    throw Error(std::to_string(count) + " extended textual headers (byte 3505), expected a number or -1");
  std::array<std::uint8_t, text_bytes> block{};
  for (bool more = count != 0; more;) {
    const std::string number = std::to_string(header.extended.size() + 1);
    if (source.read(block) < block.size())
      throw Error("ends within extended textual header " + number +
                  (count < 0 ? ", before a stanza ((SEG: EndText))" : " of " + std::to_string(count)));
    const TextEncoding encoding = encoding_of(block);
    header.extended.push_back({decode_text(block, encoding), encoding});
    const auto read = static_cast<std::int64_t>(header.extended.size());
    more = count < 0 ? !ends_stanzas(block) : read < count;
    if (more && read == most_extended)
      throw Error("no stanza ((SEG: EndText)) in " + number + " extended textual headers");
  }
}

void skip_to_first_trace(ByteSource& source, FileHeader& header) {
  const std::int64_t said = header.major >= 2 ? header.binary.get("first_trace") : 0;
  const std::uint64_t wanted = said > 0 ? static_cast<std::uint64_t>(said) : 0;
  if (wanted > source.position()) {
    const std::uint64_t missing = wanted - source.position();
    if (source.skip(missing) < missing)
      throw Error("ends at byte " + std::to_string(source.position()) + ", before the first trace at byte " +
                  std::to_string(wanted) + " (byte 3521)");
  }
  header.first_trace = source.position();
}

FileHeader read_segy(ByteSource& source, const ReadOptions& options) {
  std::array<std::uint8_t, file_header_bytes> bytes{};
  const std::size_t got = source.read(bytes);
  if (got < bytes.size())
    throw Error(std::to_string(got) + " bytes, expected at least the 3600 of the SEG-Y headers");
  const auto text = std::span<const std::uint8_t>(bytes).first<text_bytes>();
  const auto binary = std::span<const std::uint8_t>(bytes).subspan<text_bytes, BinaryLayout::size>();
  FileHeader header;
  header.encoding = encoding_of(text);
  header.text = decode_text(text, header.encoding);
  const auto mark = binary.subspan<3297 - BinaryLayout::first, 4>();
  if ((mark[0] == 2 && mark[1] == 1 && mark[2] == 4 && mark[3] == 3) ||
      (mark[0] == 3 && mark[1] == 4 && mark[2] == 1 && mark[3] == 2))
    throw Error("bytes are swapped in pairs (byte 3297), expected big- or little-endian order");
  header.endian = options.endian.value_or(byte_order_of(binary));
  header.binary = BinaryWords(binary, header.endian);
  read_revision(header);
  header.format = readable_format(header, options);
  header.samples = header.binary.get("ns");
  header.interval_us = static_cast<double>(header.binary.get("dt"));
  header.feet = header.binary.get("mfeet") == 2;
  if (header.major >= 2) read_revision_2(header);
  read_extended(source, header);
  skip_to_first_trace(source, header);
  return header;
}

FileHeader read_su(ByteSource& source, const ReadOptions& options) {
  FileHeader header;
  header.su = true;
  header.format = find_format(5);
  const auto first = source.peek(TraceLayout::size);
  if (first.size() < TraceLayout::size)
    throw Error(std::to_string(first.size()) + " bytes, expected at least a trace header of 240");
  header.endian = options.endian.value_or(su_byte_order_of(first.first<TraceLayout::size>(), source.size()));
  return header;
}

}  // namespace

FileHeader read_file_header(ByteSource& source, const ReadOptions& options) {
  const auto first = source.peek(file_header_bytes);
  if (first.empty()) throw Error("is empty, expected SEG-Y or Seismic Unix traces");
  if (options.su) return read_su(source, options);
  const FileKind kind = kind_of(first, source.size());
  if (kind == FileKind::su || (kind == FileKind::unknown && names_su(source.name())))
    return read_su(source, options);
  // a user who says byte order or format knows it is SEG-Y
  if (kind == FileKind::unknown && first.size() >= file_header_bytes && !options.endian && !options.format)
    throw Error(
        "is neither SEG-Y nor Seismic Unix: no textual header, no sample format, no plausible trace header");
  return read_segy(source, options);
}

}  // namespace slipwave::segy
