// SPDX-License-Identifier: BSD-3-Clause
#include "segy/conversion.hpp"

#include <algorithm>
#include <iterator>

#include "base/history.hpp"
#include "base/parse.hpp"
#include "gather/difference.hpp"
#include "segy/history.hpp"
#include "segy/sniff.hpp"

namespace slipwave::segy {
namespace {

bool holds_extended_text(const FileFormat& format) { return !format.su && format.revision >= 1; }

bool holds_extra_headers(const Reader& reader, const FileFormat& format) {
  return !format.su && format.revision >= 2 && format.endian == reader.header().endian;
}

}  // namespace

FileFormat format_of(const Reader& reader) {
  const FileHeader& header = reader.header();
  FileFormat format;
  format.su = header.su;
  format.endian = header.endian;
  format.encoding = header.encoding;
  format.revision = header.su ? 1 : std::min(header.major, 2);
  format.code = header.format->code;
  if (header.format->since >= 2) format.revision = 2;  // where the file is wrong about one of them
  return format;
}

FileInfo info_as(const Reader& reader, const std::string& entry, const FileFormat& format) {
  const FileHeader& header = reader.header();
  FileInfo info;
  info.format = format;
  info.axis = reader.axis();
  info.raw_format = header.format;
  info.raw_endian = header.endian;
  info.lengths_vary = reader.lengths_by_trace() && (!header.su || format.su);
  const History before = history_of(header);
  info.history = before.commands;
  append_history(info.history, entry);
  const std::string shown = split(info.history, '\n').back();
  if (!before.complete) info.history.clear();  // only what the text still shows
  if (header.su) {
    info.text = lay_out_text(std::vector<std::string>{shown}, format.revision);
    return info;
  }
  info.layout.traces = header.traces.value_or(0);
  info.layout.traces_per_shot = header.binary.get("ntrpr");
  if (header.major >= 2 && header.binary.get("xntrpr") > 0)
    info.layout.traces_per_shot = header.binary.get("xntrpr");
  info.text = with_entry(header.text, shown, format.revision);
  if (holds_extended_text(format))
    std::copy_if(header.extended.begin(), header.extended.end(), std::back_inserter(info.extended),
                 [](const ExtendedText& extended) { return !holds_history(extended); });
  // they may be in another code than the first text, and stay so where that one stays
  if (format.encoding != header.encoding)
    for (ExtendedText& extended : info.extended) extended.encoding = format.encoding;
  if (holds_extra_headers(reader, format)) info.extra_headers = header.extra_headers;
  info.carried = header.binary;
  info.carried_revision = std::min(header.major, 2);
  return info;
}

FileInfo info_like(const Reader& reader, const std::string& entry, const std::string& output) {
  if (names_su(output)) return info_as(reader, entry, format_named_by(output));
  FileFormat format = format_of(reader);
  const SampleFormat& samples = *reader.header().format;
  format.code = samples.code == 6 || samples.bytes == 8 ? 6 : 5;
  if (format.code == 6) format.revision = 2;
  if (format.code == 5 && !format.su) format.revision = std::min(reader.header().major, 2);
  return info_as(reader, entry, format);
}

std::string record_difference(const Reader& found, const Reader& expected) {
  const FileHeader &a = found.header(), &b = expected.header();
  const auto sentence = [](const std::string& field, const std::string& is, const std::string& wanted) {
    return "the " + field + " is " + is + ", expected " + wanted;
  };
  const auto kind = [](const FileHeader& header) {
    return header.su ? "Seismic Unix" : "SEG-Y revision " + std::to_string(header.major);
  };
  const auto order = [](const FileHeader& header) { return header.endian == Endian::big ? "big" : "little"; };
  const auto unit = [](const FileHeader& header) { return header.feet ? "feet" : "metres"; };
  if (kind(a) != kind(b)) return sentence("file", kind(a), kind(b));
  if (a.endian != b.endian) return sentence("byte order", order(a), order(b));
  if (a.format->code != b.format->code) return sentence("sample format", a.format->name, b.format->name);
  if (a.feet != b.feet) return sentence("unit of length", unit(a), unit(b));
  if (a.extra_headers != b.extra_headers)
    return sentence("number of additional trace headers", std::to_string(a.extra_headers),
                    std::to_string(b.extra_headers));
  if (found.lengths_by_trace() && expected.lengths_by_trace()) return "";
  return sampling_difference(found.axis(), expected.axis());
}

std::vector<std::string> losses_of(const Reader& reader, const FileFormat& format) {
  const FileHeader& header = reader.header();
  std::vector<std::string> losses;
  const auto lose = [&](std::int64_t count, const std::string& what, const std::string& cure) {
    if (count != 0) losses.push_back(reader.name() + ": " + what + " left out; " + cure);
  };
  if (!holds_extended_text(format))
    lose(static_cast<std::int64_t>(header.extended.size()), "extended textual headers are",
         "--revision 1 keeps them");
  if (!holds_extra_headers(reader, format))
    lose(header.extra_headers, "additional trace headers are",
         "--revision 2 in the same byte order keeps them");
  if (header.major >= 2)
    lose(header.binary.get("trailers"), "data trailers are", "only a copy of the file keeps them");
  if (header.feet && format.su)
    losses.push_back(reader.name() + ": lengths are in feet, which SU does not say; SEG-Y (no --su) does");
  return losses;
}

}  // namespace slipwave::segy
