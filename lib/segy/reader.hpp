// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "gather/trace.hpp"
#include "segy/byte_source.hpp"
#include "segy/file_header.hpp"
#include "segy/float_words.hpp"
#include "segy/geometry.hpp"
#include "segy/words.hpp"

namespace slipwave::segy {

/// A trace as it stands in a file: the headers untouched, the samples as numbers.
struct Trace {
  TraceWords words;
  std::vector<double> samples;
  /// The additional headers of revision 2 as they stand in the file, 240 bytes each.
  std::vector<std::uint8_t> extensions;
};

/// A trace whose samples are not looked at.
struct RawTrace {
  TraceWords words;
  std::vector<std::uint8_t> extensions;   // as in Trace
  std::span<const std::uint8_t> samples;  // in the file's format and order, valid until the next trace
};

/// Traces of a SEG-Y or Seismic Unix file, or of standard input ("-"), one after the other in the memory of
/// one, which grows with what has been read and not with what a header promises. Every error starts with the
/// input's name.
///
/// Samples a trace: the file header's number. Where it is 0, each trace header's; and so where the file's
/// size is known, does not fit the file header's number and fits the trace headers' exactly (traces of
/// different length).
class Reader {
 public:
  /// Reads up to the first trace header. `already_read` are bytes taken from standard input before.
  explicit Reader(const std::string& path, const ReadOptions& options = {},
                  std::vector<std::uint8_t> already_read = {});

  const std::string& name() const noexcept { return source_.name(); }
  const FileHeader& header() const noexcept { return header_; }
  /// Bytes of the whole input, where known, and bytes taken so far: for progress.
  std::optional<std::uint64_t> size() const noexcept { return source_.size(); }
  std::uint64_t position() const noexcept { return source_.position(); }

  /// Samples, interval and start of the first trace; interval 0 when the file does not say it.
  const SampleAxis& axis() const noexcept { return axis_; }
  /// axis(), refused when the interval is 0.
  const SampleAxis& axis_with_interval() const;

  /// The next trace into `trace`, whose memory is used again; false after the last one.
  /// Throws Error when the input ends within a trace (after every whole one was delivered) or with fewer
  /// traces than it says; with ReadOptions::to_damage it returns false there, too. Zeros behind the last
  /// trace that are no whole number of traces, of a file whose trace headers are not zero, are such an end.
  bool next(Trace& trace);
  /// Reads the next trace without decoding its samples.
  bool next(RawTrace& trace);
  /// What is wrong with the end of the input, once next() has come to it ("a.sgy: ends within trace 4: ...").
  const std::optional<std::string>& damage() const noexcept { return damage_; }
  /// Throws an Error of damage(), if there is any: after its whole traces have been written.
  void expect_whole() const;
  /// What headers and samples of the traces so far leave in doubt, a sentence each: sampling intervals that
  /// contradict the one that is taken, and floating point of another kind.
  std::vector<std::string> doubts() const;
  /// Traces delivered so far.
  std::int64_t delivered() const noexcept { return delivered_; }

  /// Header and axis of a trace of this input in SI. Ends whose positions are not given are placed by byte 37
  /// and the midpoint.
  TraceHeader si_header(const Trace& trace) const;
  TraceHeader si_header(const RawTrace& trace) const;
  SampleAxis axis_of(const Trace& trace) const;
  SampleAxis axis_of(const RawTrace& trace) const;
  /// Whether the traces of the file say where sources and receivers are: as the first one and up to a hundred
  /// others, all over a file on disk.
  const PositionsGiven& positions() const noexcept { return positions_; }
  /// Do the trace headers say how long each trace is?
  bool lengths_by_trace() const noexcept { return lengths_by_trace_; }

 private:
  void look_at_first_trace();
  bool trace_headers_fill(std::uint64_t size) const;
  void look_for_positions();
  void look_further(std::size_t head, PositionsGiven& seen);
  void see_positions(std::span<const std::uint8_t> head, PositionsGiven& seen) const;
  TraceHeader si_header_of(const TraceWords& words, const std::vector<std::uint8_t>& extensions) const;
  std::int64_t extra_headers_of(const std::optional<ExtensionWords>& extension) const;
  std::int64_t samples_of(const TraceWords& words, const std::optional<ExtensionWords>& extension) const;
  void see_doubts(const RawTrace& trace);
  bool at_trailer();
  bool at_padding();
  bool read_trace(RawTrace& trace);
  std::span<const std::uint8_t> read_samples(std::uint64_t count, std::uint64_t before);
  void read_extensions(std::vector<std::uint8_t>& into);
  [[noreturn]] void refuse_end(std::uint64_t found, const std::string& expected) const;

  ByteSource source_;
  FileHeader header_;
  SampleAxis axis_;
  bool lengths_by_trace_ = false;
  PositionsGiven positions_;
  std::int64_t delivered_ = 0;
  bool to_damage_ = false, blank_headers_ = false;  // those of the first trace
  std::optional<std::string> damage_;
  std::string interval_doubt_;
  FloatWords words_;
  RawTrace raw_;
  std::vector<std::uint8_t> bytes_;
};

}  // namespace slipwave::segy
