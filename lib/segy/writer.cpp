#include "segy/writer.hpp"

#include <algorithm>
#include <utility>

#include "base/error.hpp"
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
    : out_(out), info_(std::move(info)), sample_format_(checked_format(info_)) {
  interval_word_ = interval_word(info_.axis.interval_s);
  if (info_.format.su) return;
  if (info_.text.empty()) info_.text = lay_out_text({}, info_.format.revision);
  const auto put_text = [&](const std::string& text) {
    const auto bytes = encode_text(text, info_.format.encoding);
    out_.write(bytes.data(), bytes.size());
  };
  put_text(info_.text);
  const auto binary = binary_header(info_).in_file_order(info_.format.endian);
  const auto stamped = with_revision_stamp(binary, info_.format);
  out_.write(stamped.data(), stamped.size());
  for (const std::string& text : info_.extended) put_text(text);
}

void Writer::write(const TraceHeader& header, std::span<const double> samples) {
  in_place("trace " + std::to_string(written_ + 1), [&] {
    TraceWords words = words_from_si(header, info_.layout);
    words.set("cdpt", ++in_bin_[words.get("cdp")]);
    words.set("delrt", delay_word(info_.axis.start_s));
    words.set("tracl", written_ + 1);
    write_words(words, samples);
  });
}

void Writer::write(const Trace& trace, bool from_su) {
  in_place("trace " + std::to_string(written_ + 1), [&] {
    TraceWords words = trace.words;
    if (from_su) fill_revision_1(words);
    if (words.get("tracl") == 0) words.set("tracl", written_ + 1);
    write_words(words, trace.samples);
  });
}

void Writer::write_words(TraceWords words, std::span<const double> samples) {
  if (static_cast<std::int64_t>(samples.size()) != info_.axis.count)
    throw Error(std::to_string(samples.size()) + " samples, expected " + std::to_string(info_.axis.count) +
                " as in the file header");
  words.set("tracr", written_ + 1);
  words.set("ns", info_.axis.count <= 65535 ? info_.axis.count : 0);
  words.set("dt", interval_word_);
  if (info_.format.su) clear_for_su(words);
  const std::size_t body = samples.size() * static_cast<std::size_t>(sample_format_.bytes);
  bytes_.resize(TraceLayout::size + body);
  const auto head = words.in_file_order(info_.format.endian);
  std::copy(head.begin(), head.end(), bytes_.begin());
  encode_samples(samples, sample_format_, info_.format.endian, {bytes_.data() + TraceLayout::size, body});
  out_.write(bytes_.data(), bytes_.size());
  ++written_;
}

void write_gather(OutputFile& out, const Gather& gather, const FileFormat& format,
                  const std::vector<std::string>& entries) {
  std::vector<TraceHeader> headers;
  for (const slipwave::Trace& trace : gather.traces) headers.push_back(trace.header);
  FileInfo info;
  info.format = format;
  info.axis = gather.axis;
  info.layout = layout_of(headers);
  std::vector<std::string> all = entries;
  const auto more = convention_entries(components_of(gather), info.axis, info.layout);
  all.insert(all.end(), more.begin(), more.end());
  info.text = lay_out_text(all, format.revision);
  Writer writer(out, std::move(info));
  for (const slipwave::Trace& trace : gather.traces) writer.write(trace.header, trace.samples);
}

}  // namespace slipwave::segy
