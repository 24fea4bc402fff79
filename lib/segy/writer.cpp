// SPDX-License-Identifier: BSD-3-Clause
#include "segy/writer.hpp"

#include <algorithm>
#include <utility>

#include "base/error.hpp"
#include "base/parse.hpp"
#include "segy/extension.hpp"
#include "segy/history.hpp"
#include "segy/sniff.hpp"
#include "segy/time_words.hpp"
#include "segy/writer_headers.hpp"

namespace slipwave::segy {
namespace {

/// In the order in which they come.
std::vector<Component> components_of(const Gather& gather) {
  std::vector<Component> components;
  for (const slipwave::Trace& trace : gather.traces)
    if (std::find(components.begin(), components.end(), trace.header.component) == components.end())
      components.push_back(trace.header.component);
  return components;
}

}  // namespace

Writer::Writer(OutputFile& out, FileInfo info)
    : out_(out), info_(std::move(info)), sample_format_(checked_format(info_)), rounding_(sample_format_) {
  interval_word_ = interval_word(info_.axis.interval_s);
  if (info_.format.su) return;
  if (info_.text.empty()) info_.text = lay_out_text({}, info_.format.revision);
  const History shown = history_in_text(info_.text);
  if (!info_.history.empty() && info_.format.revision >= 1 &&
      (!shown.complete || shown.commands != info_.history))
    for (ExtendedText& block : history_stanza(info_.history, info_.format.encoding))
      info_.extended.push_back(std::move(block));
  const auto put_text = [&](const std::string& text, TextEncoding encoding) {
    const auto bytes = encode_text(text, encoding);
    out_.write(bytes.data(), bytes.size());
  };
  put_text(info_.text, info_.format.encoding);
  const auto binary = binary_header(info_).in_file_order(info_.format.endian);
  const auto stamped = with_revision_stamp(binary, info_.format);
  out_.write(stamped.data(), stamped.size());
  for (const ExtendedText& extended : info_.extended) put_text(extended.text, extended.encoding);
}

void Writer::write(const TraceHeader& header, std::span<const double> samples) {
  in_place("trace " + std::to_string(written_ + 1), [&] {
    TraceWords words = words_from_si(header, info_.layout);
    words.set("cdpt", ++in_bin_[words.get("cdp")]);
    set_first_sample(words, info_.axis.start_s, has_time_scalar(info_.format));
    words.set("tracl", written_ + 1);
    put_headers(words, {}, static_cast<std::int64_t>(samples.size()));
    put_samples(header.component, samples);
  });
}

void Writer::write(const Trace& trace, bool from_su) {
  in_place("trace " + std::to_string(written_ + 1), [&] {
    put_headers(carried(trace.words, from_su), trace.extensions,
                static_cast<std::int64_t>(trace.samples.size()));
    put_samples(component_of_code(trace.words.get("trid")), trace.samples);
  });
}

void Writer::write(const RawTrace& trace, bool from_su) {
  const bool other_order = info_.raw_endian != info_.format.endian;
  if (info_.raw_format && (info_.raw_format != &sample_format_ || other_order)) {
    Trace decoded{trace.words, {}, trace.extensions};
    decoded.samples.resize(trace.samples.size() / static_cast<std::size_t>(info_.raw_format->bytes));
    decode_samples(trace.samples, *info_.raw_format, info_.raw_endian, decoded.samples);
    return write(decoded, from_su);
  }
  in_place("trace " + std::to_string(written_ + 1), [&] {
    put_headers(carried(trace.words, from_su), trace.extensions,
                static_cast<std::int64_t>(trace.samples.size()) / sample_format_.bytes);
    check_samples(trace.samples, sample_format_, info_.format.endian);
    out_.write(trace.samples.data(), trace.samples.size());
    ++written_;
  });
}

/// The words of another file as this one's revision reads them.
TraceWords Writer::carried(TraceWords words, bool from_su) {
  const bool with_scalar = has_time_scalar(info_.format);
  if (from_su)
    fill_revision_1(words);
  else if (info_.carried_revision == 0 && with_scalar)
    words.set("tscal", 1);
  else if (info_.carried_revision >= 1 && !with_scalar && apply_time_scalar(words))
    ++times_rounded_;
  if (words.get("tracl") == 0) words.set("tracl", written_ + 1);
  return words;
}

void Writer::put_headers(TraceWords words, std::vector<std::uint8_t> extensions, std::int64_t samples) {
  if (samples != info_.axis.count && !info_.lengths_vary)
    throw Error(std::to_string(samples) + " samples, expected " + std::to_string(info_.axis.count) +
                " as in the file header");
  const bool fits = samples <= highest_16;
  if (samples < 1 || (!fits && info_.lengths_vary))
    throw Error(std::to_string(samples) + " samples, traces of different length hold 1 to " +
                std::to_string(highest_16));
  words.set("tracr", written_ + 1);
  words.set("ns", fits ? samples : 0);
  words.set("dt", interval_word_);
  if (info_.format.su) words.clear(181, 240);
  const auto head = words.in_file_order(info_.format.endian);
  out_.write(head.data(), head.size());
  if (info_.extra_headers == 0) return;
  set_sampling(extensions, info_.format.endian, samples, info_.axis.interval_s * 1e6);
  extensions.resize(static_cast<std::size_t>(TraceLayout::size * info_.extra_headers));
  out_.write(extensions.data(), extensions.size());
}

void Writer::put_samples(Component component, std::span<const double> samples) {
  bytes_.resize(samples.size() * static_cast<std::size_t>(sample_format_.bytes));
  encode_samples(samples, sample_format_, info_.format.endian, bytes_);
  rounding_.see(component, samples, bytes_, info_.format.endian);
  out_.write(bytes_.data(), bytes_.size());
  ++written_;
}

std::vector<std::string> Writer::finish() const {
  auto sentences = rounding_.sentences();
  if (times_rounded_ > 0)
    sentences.push_back(
        "times of " + std::to_string(times_rounded_) +
        " traces (bytes 95 to 114, not the first sample's) were rounded to milliseconds; SEG-Y "
        "revision 1 holds them");
  return sentences;
}

FileFormat format_named_by(const std::string& path, const FileFormat& format) {
  if (!names_su(path)) return format;
  FileFormat su;
  su.endian = native_endian;
  su.encoding = format.encoding;
  su.su = true;
  return su;
}

std::vector<std::string> write_gather(OutputFile& out, const Gather& gather, const FileFormat& format,
                                      const Heading& heading) {
  std::vector<TraceHeader> headers;
  for (const slipwave::Trace& trace : gather.traces) headers.push_back(trace.header);
  FileInfo info;
  info.format = format;
  info.axis = gather.axis;
  info.layout = layout_of(headers);
  const auto conventions = convention_entries(components_of(gather), info.axis, info.layout);
  info.history = heading.history;
  auto entries = heading.entries;
  for (std::string& command : split(heading.history, '\n'))
    if (!command.empty()) entries.push_back(std::move(command));
  info.text = lay_out_text(entries, conventions, format.revision);
  auto sentences = places_rounded(info.layout);
  Writer writer(out, std::move(info));
  for (const slipwave::Trace& trace : gather.traces) writer.write(trace.header, trace.samples);
  for (auto& sentence : writer.finish()) sentences.push_back(std::move(sentence));
  return sentences;
}

}  // namespace slipwave::segy
