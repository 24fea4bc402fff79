#include "segy/reader.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "base/error.hpp"
#include "segy/geometry.hpp"

namespace slipwave::segy {
namespace {

/// Memory grows with what has been read, not with what a header promises.
constexpr std::size_t step_bytes = 1 << 20;

}  // namespace

Reader::Reader(const std::string& path, const ReadOptions& options, std::vector<std::uint8_t> already_read)
    : source_(path, std::move(already_read)) {
  in_place(name(), [&] {
    header_ = read_file_header(source_, options);
    look_at_first_trace();
  });
}

void Reader::look_at_first_trace() {
  const auto first = source_.peek(TraceLayout::size);
  if (first.size() < TraceLayout::size) {  // none, or a piece that next() will complain of
    axis_ = {header_.samples, header_.interval_us * 1e-6, 0};
    return;
  }
  const TraceWords words(first.first<TraceLayout::size>(), header_.endian);
  if (header_.samples == 0) {
    lengths_by_trace_ = true;
    if (words.get("ns") == 0)
      throw Error("the number of samples is 0 in the file header and in the first trace");
  } else if (source_.size()) {
    const auto body = *source_.size() - header_.first_trace;
    const auto length = static_cast<std::uint64_t>(TraceLayout::size * (1 + header_.extra_headers) +
                                                   header_.samples * header_.format->bytes);
    lengths_by_trace_ = body % length != 0 && trace_headers_fill(*source_.size());
  }
  if (header_.interval_us == 0) header_.interval_us = static_cast<double>(words.get("dt"));
  axis_ = {samples_of(words), header_.interval_us * 1e-6, start_s(words, header_)};
}

const SampleAxis& Reader::axis_with_interval() const {
  if (!(axis_.interval_s > 0))
    throw Error(name() + ": the sample interval is 0 in the file header and in the first trace");
  return axis_;
}

/// Do traces as long as their own headers say end where the file does?
bool Reader::trace_headers_fill(std::uint64_t size) const {
  std::array<std::uint8_t, TraceLayout::size> bytes{};
  std::uint64_t at = header_.first_trace;
  while (at < size) {
    if (!source_.read_at(at, bytes)) return false;
    const std::int64_t ns = TraceWords(bytes, header_.endian).get("ns");
    at += static_cast<std::uint64_t>(TraceLayout::size * (1 + header_.extra_headers) +
                                     (ns > 0 ? ns : header_.samples) * header_.format->bytes);
  }
  return at == size;
}

std::int64_t Reader::samples_of(const TraceWords& words) const {
  const std::int64_t ns = lengths_by_trace_ ? words.get("ns") : 0;
  return ns > 0 ? ns : header_.samples;
}

bool Reader::read_trace(Trace& trace) {
  const auto ended = [&](std::uint64_t found, const std::string& expected) {
    return Error("ends within trace " + std::to_string(delivered_ + 1) + ": " + std::to_string(found) +
                 " of " + expected + " bytes");
  };
  std::array<std::uint8_t, TraceLayout::size> bytes{};
  const std::size_t got = source_.read(bytes);
  if (got == 0) return false;
  if (got < bytes.size()) throw ended(got, "the 240 header");
  trace.words = TraceWords(bytes, header_.endian);
  if (header_.su) trace.words.clear(181, 240);  // Seismic Unix keeps floats of its own there
  const std::int64_t samples = samples_of(trace.words);
  if (samples == 0) throw Error("trace " + std::to_string(delivered_ + 1) + " has 0 samples");
  const auto extra = static_cast<std::uint64_t>(TraceLayout::size * header_.extra_headers);
  const auto wanted = static_cast<std::uint64_t>(samples * header_.format->bytes);
  const std::string whole = std::to_string(TraceLayout::size + extra + wanted);
  const std::uint64_t skipped = source_.skip(extra);
  if (skipped < extra) throw ended(TraceLayout::size + skipped, whole);
  std::uint64_t have = 0;
  while (have < wanted) {
    const auto step = static_cast<std::size_t>(
        std::min<std::uint64_t>(wanted - have, std::max<std::uint64_t>(step_bytes, have)));
    if (bytes_.size() < have + step) bytes_.resize(have + step);
    const std::size_t count = source_.read({bytes_.data() + have, step});
    have += count;
    if (count < step) throw ended(TraceLayout::size + extra + have, whole);
  }
  trace.samples.resize(static_cast<std::size_t>(samples));
  decode_samples({bytes_.data(), static_cast<std::size_t>(wanted)}, *header_.format, header_.endian,
                 trace.samples);
  return true;
}

bool Reader::next(Trace& trace) {
  return in_place(name(), [&] {
    // trailers may follow the traces of a file that says how many it has
    if (header_.traces && delivered_ == *header_.traces) return false;
    if (!read_trace(trace)) {
      if (header_.traces)
        throw Error("ends after " + std::to_string(delivered_) + " of " + std::to_string(*header_.traces) +
                    " traces (byte 3513)");
      return false;
    }
    ++delivered_;
    return true;
  });
}

TraceHeader Reader::si_header(const Trace& trace) const { return si_from_words(trace.words, header_); }

SampleAxis Reader::axis_of(const Trace& trace) const {
  return {static_cast<std::int64_t>(trace.samples.size()), axis_.interval_s, start_s(trace.words, header_)};
}

}  // namespace slipwave::segy
