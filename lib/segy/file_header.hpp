// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "segy/byte_source.hpp"
#include "segy/bytes.hpp"
#include "segy/sample_format.hpp"
#include "segy/text.hpp"
#include "segy/words.hpp"

namespace slipwave::segy {

/// What the user knows better than the file.
struct ReadOptions {
  std::optional<Endian> endian;
  std::optional<int> format;  // a code of sample_formats()
  bool su = false;            // a Seismic Unix file, also where it does not look like one
  bool to_damage = false;     // an input that ends too early gives its whole traces, then Reader::damage()
};

/// One of the 3200-byte texts that may follow the binary header.
struct ExtendedText {
  std::string text;  // ISO 8859-1
  TextEncoding encoding = TextEncoding::ebcdic;
  bool operator==(const ExtendedText&) const = default;
};

/// What stands before the traces, and what it says about them.
struct FileHeader {
  bool su = false;  // no reel headers: text, binary and extended are empty
  Endian endian = Endian::big;
  TextEncoding encoding = TextEncoding::ebcdic;
  int major = 0;
  int minor = 0;
  const SampleFormat* format = nullptr;
  std::int64_t samples = 0;  // per trace; 0: only the trace headers say
  double interval_us = 0;    // 0: only the trace headers say
  bool feet = false;
  std::string text;  // 3200 characters, ISO 8859-1
  BinaryWords binary;
  std::vector<ExtendedText> extended;
  std::int64_t extra_headers = 0;      // of 240 bytes, in every trace after the first one
  std::uint64_t first_trace = 0;       // offset of the first trace
  std::optional<std::int64_t> traces;  // where revision 2 says how many
};

/// Reads up to the first trace. Throws Error when the input is neither SEG-Y nor Seismic Unix, ends within
/// its headers, or has a sample format that cannot be read.
FileHeader read_file_header(ByteSource& source, const ReadOptions& options);

}  // namespace slipwave::segy
