// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <unordered_map>
#include <vector>

#include "gather/trace.hpp"
#include "io/output_file.hpp"
#include "segy/geometry.hpp"
#include "segy/reader.hpp"
#include "segy/rounding.hpp"
#include "segy/text.hpp"

namespace slipwave::segy {

/// How a file is written. Default: what everybody reads.
struct FileFormat {
  int code = 5;      // of sample_formats(); those that came with revision 2 need it
  int revision = 1;  // 0, 1 or 2 (written as 2.1)
  Endian endian = Endian::big;
  TextEncoding encoding = TextEncoding::ebcdic;
  bool su =
      false;  // Seismic Unix: no reel headers, format 5, bytes 181 to 240 zero; SU itself wants native_endian
};

/// `format`, or Seismic Unix where a file of that name is.
FileFormat format_named_by(const std::string& path, const FileFormat& format = {});

/// Everything that must be known before the first trace is written.
struct FileInfo {
  FileFormat format;
  SampleAxis axis;
  SurveyLayout layout;
  std::string text;                    // 3200 characters (lay_out_text, with_entry); empty: stamps only
  std::vector<ExtendedText> extended;  // of 3200 characters each, without that of the history
  std::string history;  // commands, one a line (base/history.hpp), which the text shows as far as it has room
  std::optional<BinaryWords> carried;  // the binary header of the input, for what this does not say
  int carried_revision = 1;            // of the file that carried traces come from: 0 has no time scalar
  bool lengths_vary = false;           // every trace has its own length, axis has the first one's
  std::int64_t extra_headers = 0;      // of 240 bytes a trace, carried along (revision 2)
  const SampleFormat* raw_format = nullptr;  // of raw traces that are written, if not the file's
  Endian raw_endian = Endian::big;           // and their byte order
};

/// Whether only revision 2 holds this sampling: no whole microseconds, or above 16 bits.
bool needs_revision_2(const SampleAxis& axis);

/// Sentences about what some readers will not take (samples or interval above 32767).
std::vector<std::string> warnings_of(const FileInfo& info);

/// Returns the info of a file of the same kind as was read, for a tool that changes samples: revision, byte
/// order and SU-ness kept, samples IEEE floats, or doubles where the input's were doubles or wider integers.
/// The rest is as in info_as() (conversion.hpp). A name that ends in .su makes it Seismic Unix.
FileInfo info_like(const Reader& reader, const std::string& entry, const std::string& output = "");

/// Writes traces as they come, in the memory of one. Every number that goes into the file header is in
/// `info`. Errors: a sampling the revision cannot hold; a trace of another length; a value the sample format
/// cannot hold
/// ("trace 3: sample 17: nan ..."); a header word that overflows.
class Writer {
 public:
  /// Writes the file headers. `out` must outlive the writer; committing it is the caller's business.
  Writer(OutputFile& out, FileInfo info);

  /// A trace described in SI.
  void write(const TraceHeader& header, std::span<const double> samples);
  /// A trace of another file, its headers carried along; counters, ns and dt are made to fit.
  void write(const Trace& trace, bool from_su);
  /// Writes a trace of another file whose samples are in the format and byte order of the file, or in those
  /// that FileInfo says of them.
  void write(const RawTrace& trace, bool from_su);

  std::int64_t written() const noexcept { return written_; }

  /// Once, before the output is committed: sentences about what the file holds less exactly than it was
  /// given. Throws Error where rounding has left nothing but zeros.
  std::vector<std::string> finish() const;

 private:
  TraceWords carried(TraceWords words, bool from_su);
  void put_headers(TraceWords words, std::vector<std::uint8_t> extensions, std::int64_t samples);
  void put_samples(Component component, std::span<const double> samples);

  OutputFile& out_;
  FileInfo info_;
  const SampleFormat& sample_format_;
  std::int64_t interval_word_ = 0;
  std::int64_t written_ = 0;
  std::unordered_map<std::int64_t, std::int64_t> in_bin_;
  std::vector<std::uint8_t> bytes_;
  Rounding rounding_;
  std::int64_t times_rounded_ = 0;  // traces that have such
};

/// Entries of the textual header that any gather in SI needs: components with unit, code and sign convention,
/// sampling, and where the coordinates are.
std::vector<std::string> convention_entries(std::span<const Component> components, const SampleAxis& axis,
                                            const SurveyLayout& layout);

/// What stands in the textual header of a gather beside conventions: lines about program, source and scheme,
/// and the commands that made it, one a line.
struct Heading {
  std::vector<std::string> entries;
  std::string history;
};

/// A whole gather, traces sorted by shot: layout from its headers, text from the heading followed by
/// convention_entries. Returns sentences about what the file holds less
/// exactly than it was given.
std::vector<std::string> write_gather(OutputFile& out, const Gather& gather, const FileFormat& format,
                                      const Heading& heading);

}  // namespace slipwave::segy
