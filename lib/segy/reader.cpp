// SPDX-License-Identifier: BSD-3-Clause
#include "segy/reader.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "base/error.hpp"
#include "segy/extension.hpp"
#include "segy/geometry.hpp"
#include "segy/sniff.hpp"

namespace slipwave::segy {
namespace {

/// The steps by which memory for what comes from a pipe grows, in bytes.
constexpr std::uint64_t smallest_step = 1 << 20;
constexpr std::uint64_t largest_step = 1 << 25;
/// Looked at for positions, beside the first one.
constexpr std::uint64_t most_heads = 100;

}  // namespace

Reader::Reader(const std::string& path, const ReadOptions& options, std::vector<std::uint8_t> already_read)
    : source_(path, std::move(already_read)), to_damage_(options.to_damage) {
  in_place(name(), [&] {
    header_ = read_file_header(source_, options);
    look_at_first_trace();
    look_for_positions();
  });
}

void Reader::look_at_first_trace() {
  const auto first = source_.peek(TraceLayout::size + ExtensionLayout::size);
  if (first.size() < TraceLayout::size) {  // none, or a piece that next() will complain of
    axis_ = {header_.samples, header_.interval_us * 1e-6, 0};
    return;
  }
  const TraceWords words(first.first<TraceLayout::size>(), header_.endian);
  blank_headers_ = words == TraceWords();
  std::optional<ExtensionWords> extension;
  if (header_.extra_headers > 0) extension = extension_of(first.subspan(TraceLayout::size), header_.endian);
  if (header_.samples == 0) {
    lengths_by_trace_ = true;
    if (samples_of(words, extension) == 0)
      throw Error("the number of samples is 0 in the file header and in the first trace");
  } else if (source_.size()) {
    const auto body = *source_.size() - header_.first_trace;
    const auto length = static_cast<std::uint64_t>(TraceLayout::size * (1 + extra_headers_of(extension)) +
                                                   header_.samples * header_.format->bytes);
    lengths_by_trace_ = body % length != 0 && trace_headers_fill(*source_.size());
  }
  if (header_.interval_us == 0) header_.interval_us = static_cast<double>(words.get("dt"));
  if (header_.interval_us == 0) header_.interval_us = std::max(0.0, real_or(extension, "xdt", 0));
  axis_ = {samples_of(words, extension), header_.interval_us * 1e-6, start_s(words, header_)};
}

const SampleAxis& Reader::axis_with_interval() const {
  if (!(axis_.interval_s > 0))
    throw Error(name() + ": the sample interval is 0 in the file header and in the first trace");
  return axis_;
}

/// Do traces as long as their own headers say end where the file does?
bool Reader::trace_headers_fill(std::uint64_t size) const {
  std::array<std::uint8_t, TraceLayout::size + ExtensionLayout::size> bytes{};
  const std::span<const std::uint8_t> all(bytes);
  const std::size_t looked_at = header_.extra_headers > 0 ? bytes.size() : TraceLayout::size;
  std::uint64_t at = header_.first_trace;
  while (at < size) {
    if (!source_.read_at(at, {bytes.data(), looked_at})) return false;
    const TraceWords words(all.first<TraceLayout::size>(), header_.endian);
    std::optional<ExtensionWords> extension;
    if (header_.extra_headers > 0) extension = extension_of(all.subspan(TraceLayout::size), header_.endian);
    const std::int64_t wide = extension ? extension->get("xns") : 0;
    const std::int64_t ns = wide > 0 ? wide : words.get("ns");
    at += static_cast<std::uint64_t>(TraceLayout::size * (1 + extra_headers_of(extension)) +
                                     (ns > 0 ? ns : header_.samples) * header_.format->bytes);
  }
  return at == size;
}

/// Returns as many as the file header says, unless its traces may differ and this one says how many it has.
std::int64_t Reader::extra_headers_of(const std::optional<ExtensionWords>& extension) const {
  const std::int64_t most = header_.extra_headers;
  if (!extension || header_.binary.get("fixed") == 1) return most;
  const std::int64_t own = extension->get("headers");
  return own >= 1 && own <= most ? own : most;
}

std::int64_t Reader::samples_of(const TraceWords& words,
                                const std::optional<ExtensionWords>& extension) const {
  if (!lengths_by_trace_) return header_.samples;
  if (extension && extension->get("xns") > 0) return extension->get("xns");
  return words.get("ns") > 0 ? words.get("ns") : header_.samples;
}

void Reader::refuse_end(std::uint64_t found, const std::string& expected) const {
  throw Error("ends within trace " + std::to_string(delivered_ + 1) + ": " + std::to_string(found) + " of " +
              expected + " bytes");
}

/// Data trailers of revision 2 follow the traces.
bool Reader::at_trailer() {
  return header_.major >= 2 && header_.binary.get("trailers") != 0 && begins_stanza(source_.peek(2));
}

/// Files that were tapes are filled with zeros to whole blocks. Whole traces of zeros may be traces.
bool Reader::at_padding() {
  const auto is_0 = [](std::uint8_t byte) { return byte == 0; };
  const auto head = source_.peek(TraceLayout::size);
  if (blank_headers_ || !std::all_of(head.begin(), head.end(), is_0)) return false;
  const auto rest = source_.peek(ByteSource::peek_limit);
  const auto length = static_cast<std::size_t>(TraceLayout::size * (1 + header_.extra_headers) +
                                               axis_.count * header_.format->bytes);
  if (rest.size() == ByteSource::peek_limit || rest.size() % length == 0) return false;
  if (!std::all_of(rest.begin(), rest.end(), is_0)) return false;
  throw Error("ends with " + std::to_string(rest.size()) + " bytes of zeros behind trace " +
              std::to_string(delivered_));
}

void Reader::read_extensions(std::vector<std::uint8_t>& into) {
  into.clear();
  if (header_.extra_headers == 0) return;
  const auto append_up_to = [&](std::int64_t count) {
    const auto wanted = static_cast<std::size_t>(ExtensionLayout::size * count);
    while (into.size() < wanted) {
      const auto part = source_.take(std::min(wanted - into.size(), ByteSource::peek_limit));
      into.insert(into.end(), part.begin(), part.end());
      if (part.empty())
        refuse_end(TraceLayout::size + into.size(),
                   "the " + std::to_string(TraceLayout::size + wanted) + " header");
    }
  };
  append_up_to(1);
  append_up_to(extra_headers_of(extension_of(into, header_.endian)));
}

/// `count` bytes of samples, `before` bytes of the trace having been read.
std::span<const std::uint8_t> Reader::read_samples(std::uint64_t count, std::uint64_t before) {
  const auto refuse = [&](std::uint64_t found) {
    refuse_end(before + found, std::to_string(before + count));
  };
  if (count <= ByteSource::peek_limit) {
    const auto samples = source_.take(static_cast<std::size_t>(count));
    if (samples.size() < count) refuse(samples.size());
    return samples;
  }
  if (source_.size()) {
    const std::uint64_t left = *source_.size() - std::min(source_.position(), *source_.size());
    if (left < count) refuse(left);
  }
  std::uint64_t have = 0;
  while (have < count) {
    std::uint64_t step = count - have;
    if (!source_.size()) step = std::min(step, std::clamp(have, smallest_step, largest_step));
    const auto size = static_cast<std::size_t>(have + step);
    bytes_.reserve(size);
    if (bytes_.size() < size) bytes_.resize(size);
    const std::size_t got = source_.read({bytes_.data() + have, static_cast<std::size_t>(step)});
    have += got;
    if (got < step) refuse(have);
  }
  return {bytes_.data(), static_cast<std::size_t>(count)};
}

bool Reader::read_trace(RawTrace& trace) {
  if (at_trailer()) return false;
  if (at_padding()) return false;
  const auto head = source_.take(TraceLayout::size);
  if (head.empty()) return false;
  if (head.size() < TraceLayout::size) refuse_end(head.size(), "the 240 header");
  trace.words = TraceWords(head.first<TraceLayout::size>(), header_.endian);
  if (header_.su) trace.words.clear(181, 240);  // Seismic Unix keeps floats of its own there
  read_extensions(trace.extensions);
  const std::int64_t samples = samples_of(trace.words, extension_of(trace.extensions, header_.endian));
  if (samples == 0) throw Error("trace " + std::to_string(delivered_ + 1) + " has 0 samples");
  trace.samples = read_samples(static_cast<std::uint64_t>(samples * header_.format->bytes),
                               TraceLayout::size + trace.extensions.size());
  return true;
}

bool Reader::next(RawTrace& trace) {
  if (damage_) return false;
  try {
    return in_place(name(), [&] {
      if (header_.traces && delivered_ == *header_.traces) return false;
      if (!read_trace(trace)) {
        if (header_.traces)
          throw Error("ends after " + std::to_string(delivered_) + " of " + std::to_string(*header_.traces) +
                      " traces (byte 3513)");
        return false;
      }
      ++delivered_;
      see_doubts(trace);
      return true;
    });
  } catch (const Error& error) {
    if (!to_damage_ || delivered_ == 0 || source_.failed()) throw;
    damage_ = error.what();
    return false;
  }
}

std::vector<std::string> Reader::doubts() const {
  std::vector<std::string> sentences;
  for (const auto& doubt : {interval_doubt_, words_.doubt()})
    if (!doubt.empty()) sentences.push_back(name() + ": " + doubt);
  return sentences;
}

/// Notes what the first traces leave in doubt; later ones have the same format.
void Reader::see_doubts(const RawTrace& trace) {
  constexpr std::int64_t first_traces = 64;
  if (delivered_ <= first_traces) words_.see(trace.samples, *header_.format, header_.endian);
  const auto given_us = static_cast<double>(trace.words.get("dt"));
  if (given_us == 0 || std::fabs(given_us - header_.interval_us) < 1 || !interval_doubt_.empty()) return;
  interval_doubt_ = "trace " + std::to_string(delivered_) + " says " + shown(given_us * 1e-6) +
                    " s between samples (byte 117), taken are the " + shown(axis_.interval_s) + " s of " +
                    (header_.su ? "the first trace" : "the file header (byte 3217)");
}

void Reader::expect_whole() const {
  if (damage_)
    throw Error(*damage_ + (delivered_ == 1
                                ? "; its whole trace was used"
                                : "; its " + std::to_string(delivered_) + " whole traces were used"));
}

bool Reader::next(Trace& trace) {
  if (!next(raw_)) return false;
  trace.words = raw_.words;
  trace.extensions = raw_.extensions;
  trace.samples.resize(raw_.samples.size() / static_cast<std::size_t>(header_.format->bytes));
  decode_samples(raw_.samples, *header_.format, header_.endian, trace.samples);
  return true;
}

TraceHeader Reader::si_header(const Trace& trace) const {
  return si_header_of(trace.words, trace.extensions);
}

TraceHeader Reader::si_header(const RawTrace& trace) const {
  return si_header_of(trace.words, trace.extensions);
}

TraceHeader Reader::si_header_of(const TraceWords& words, const std::vector<std::uint8_t>& extensions) const {
  const auto extension = extension_of(extensions, header_.endian);
  auto header = si_from_words(words, header_, extension);
  if ((positions_.source && positions_.receiver) || !arc_of(words).empty()) return header;
  const auto place = place_words(words, header_, extension);
  const auto own = positions_given(header, place);
  const bool own_source = own.anything && own.source, own_receiver = own.anything && own.receiver;
  place_missing(header, {own_source || positions_.source, own_receiver || positions_.receiver}, place);
  return header;
}

/// `head`: the header of a trace and, if it has more, its extension 1. One that says a position is enough;
/// one that says nothing, as at the origin of the map, counts where no other says more.
void Reader::see_positions(std::span<const std::uint8_t> head, PositionsGiven& seen) const {
  TraceWords words(head.first<TraceLayout::size>(), header_.endian);
  if (header_.su) words.clear(181, 240);
  std::optional<ExtensionWords> extension;
  if (header_.extra_headers > 0) extension = extension_of(head.subspan(TraceLayout::size), header_.endian);
  const auto own = arc_of(words).empty() ? positions_given(si_from_words(words, header_, extension),
                                                           place_words(words, header_, extension))
                                         : PositionsGiven{};
  if (!own.anything) return;
  seen.source |= own.source;
  seen.receiver |= own.receiver;
  seen.anything = true;
}

/// Only where the first trace lacks some are others looked at: what is 0 there may be a place.
void Reader::look_for_positions() {
  const std::size_t head = TraceLayout::size + (header_.extra_headers > 0 ? ExtensionLayout::size : 0);
  const auto first = source_.peek(head);
  if (first.size() < head) return;
  PositionsGiven seen{false, false, false};
  see_positions(first, seen);
  if (!lengths_by_trace_ && !(seen.source && seen.receiver)) look_further(head, seen);
  if (seen.anything) positions_ = seen;
}

/// At the headers of other traces.
void Reader::look_further(std::size_t head, PositionsGiven& seen) {
  const auto length = static_cast<std::uint64_t>(TraceLayout::size * (1 + header_.extra_headers) +
                                                 axis_.count * header_.format->bytes);
  if (!source_.size()) {
    const auto ahead = source_.peek(ByteSource::peek_limit);
    for (std::uint64_t at = length; at + head <= ahead.size(); at += length)
      see_positions(ahead.subspan(static_cast<std::size_t>(at), head), seen);
    return;
  }
  const std::uint64_t traces = (*source_.size() - header_.first_trace) / length;
  const std::uint64_t step = std::max<std::uint64_t>(1, traces / most_heads);
  std::vector<std::uint8_t> bytes(head);
  for (std::uint64_t trace = step; trace < traces; trace += step)
    if (source_.read_at(header_.first_trace + trace * length, bytes)) see_positions(bytes, seen);
}

SampleAxis Reader::axis_of(const RawTrace& trace) const {
  const auto count = static_cast<std::int64_t>(trace.samples.size()) / header_.format->bytes;
  return {count, axis_.interval_s, start_s(trace.words, header_)};
}

SampleAxis Reader::axis_of(const Trace& trace) const {
  return {static_cast<std::int64_t>(trace.samples.size()), axis_.interval_s, start_s(trace.words, header_)};
}

}  // namespace slipwave::segy
