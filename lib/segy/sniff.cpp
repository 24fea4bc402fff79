// SPDX-License-Identifier: BSD-3-Clause
#include "segy/sniff.hpp"

#include <algorithm>
#include <cmath>
#include <string_view>

#include "segy/sample_format.hpp"
#include "segy/text.hpp"

namespace slipwave::segy {
namespace {

std::optional<Endian> order_of_format(std::span<const std::uint8_t, BinaryLayout::size> binary) {
  for (const Endian endian : {Endian::big, Endian::little}) {
    const BinaryWords words(binary, endian);
    if (words.get("byte_order") == byte_order_constant) return endian;
  }
  for (const Endian endian : {Endian::big, Endian::little}) {
    const std::int64_t code = BinaryWords(binary, endian).get("format");
    if (code == 4 || find_format(code) != nullptr) return endian;
  }
  return std::nullopt;
}

bool is_scalar(std::int64_t value) {
  for (const std::int64_t power : {1, 10, 100, 1000, 10000})
    if (value == power || value == -power) return true;
  return value == 0;
}

bool plausible_su(const TraceWords& words, std::optional<std::uint64_t> size) {
  const std::int64_t ns = words.get("ns");
  if (ns == 0 || !is_scalar(words.get("scalel")) || !is_scalar(words.get("scalco"))) return false;
  if (words.get("counit") < 0 || words.get("counit") > 4) return false;
  if (words.get("trid") < -1 || words.get("trid") > 300) return false;
  return !size || *size % static_cast<std::uint64_t>(TraceLayout::size + 4 * ns) == 0;
}

/// A netCDF file may have a plausible trace header by chance; its first bytes could be a trace number of
/// billions only.
bool begins_netcdf(std::span<const std::uint8_t> first) {
  const auto begins = [&](std::string_view signature) {
    return first.size() >= signature.size() &&
           std::equal(signature.begin(), signature.end(), first.begin(),
                      [](char a, std::uint8_t b) { return static_cast<std::uint8_t>(a) == b; });
  };
  return begins("\x89HDF\r\n\x1a\n") || begins("CDF\x01") || begins("CDF\x02") || begins("CDF\x05");
}

/// Sum over the words of how many bits their magnitudes take: the wrong byte order makes small numbers large.
int bits_of(const TraceWords& words) {
  int bits = 0;
  for (const Field& field : TraceLayout::fields) {
    if (field.byte >= 181) break;
    const std::int64_t value = words.get(FieldName<TraceLayout>(field));
    bits += std::bit_width(static_cast<std::uint64_t>(std::abs(value)));
  }
  return bits;
}

}  // namespace

bool names_su(const std::string& path) { return path.ends_with(".su"); }

bool looks_like_text(std::span<const std::uint8_t> bytes) {
  const std::string text = decode_text(bytes, encoding_of(bytes));
  const auto printable = std::count_if(text.begin(), text.end(), [](char c) {
    return (c >= ' ' && c <= '~') || c == '\r' || c == '\n' || c == '\t' || c == '\0';
  });
  const auto blank = std::count(text.begin(), text.end(), '\0');
  return 20 * printable >= 19 * static_cast<std::ptrdiff_t>(text.size()) &&
         2 * blank < static_cast<std::ptrdiff_t>(text.size());
}

bool begins_stanza(std::span<const std::uint8_t> bytes) {
  return bytes.size() >= 2 && bytes[0] == bytes[1] && (bytes[0] == 0x28 || bytes[0] == 0x4d);
}

Endian byte_order_of(std::span<const std::uint8_t, BinaryLayout::size> binary) {
  return order_of_format(binary).value_or(Endian::big);
}

Endian su_byte_order_of(std::span<const std::uint8_t, TraceLayout::size> header,
                        std::optional<std::uint64_t> size) {
  const TraceWords big(header, Endian::big);
  const TraceWords little(header, Endian::little);
  if (plausible_su(big, size) != plausible_su(little, size))
    return plausible_su(big, size) ? Endian::big : Endian::little;
  const int bits_big = bits_of(big);
  const int bits_little = bits_of(little);
  if (bits_big == bits_little) return native_endian;
  return bits_big < bits_little ? Endian::big : Endian::little;
}

FileKind kind_of(std::span<const std::uint8_t> first, std::optional<std::uint64_t> size) {
  const bool whole = first.size() >= file_header_bytes;
  if (whole && looks_like_text(first.first(text_bytes))) {
    // text that continues where numbers should stand is somebody's notes
    constexpr std::size_t assigned = 60;  // of the binary header, in every revision
    const bool has_format = order_of_format(first.subspan<text_bytes, BinaryLayout::size>()).has_value();
    const bool goes_on = !has_format && looks_like_text(first.subspan(text_bytes, assigned));
    return goes_on ? FileKind::unknown : FileKind::segy;
  }
  if (begins_netcdf(first)) return FileKind::unknown;
  if (first.size() >= TraceLayout::size) {
    const auto header = first.first<TraceLayout::size>();
    if (plausible_su(TraceWords(header, su_byte_order_of(header, size)), size)) return FileKind::su;
  }
  if (!whole) return FileKind::unknown;
  const auto binary = first.subspan<text_bytes, BinaryLayout::size>();
  const std::optional<Endian> order = order_of_format(binary);
  if (!order) return FileKind::unknown;
  const BinaryWords words(binary, *order);
  return words.get("ns") > 0 || words.get("xns") > 0 ? FileKind::segy : FileKind::unknown;
}

bool looks_like_segy(std::span<const std::uint8_t> first, std::optional<std::uint64_t> size) {
  return kind_of(first, size) != FileKind::unknown;
}

}  // namespace slipwave::segy
