// SPDX-License-Identifier: BSD-3-Clause
#include "segy_target.hpp"

#include <optional>

#include "base/error.hpp"
#include "io/output_file.hpp"
#include "memory_file.hpp"
#include "segy/conversion.hpp"
#include "segy/describe.hpp"

namespace slipwave::segy {
namespace {

using fuzz::fail;

/// Where the bytes are read from: a file, or a stream that is at its end after them.
struct Input {
  std::string path;
  Bytes first;
};

/// Runs `body`; an Error must name the input.
template <class Body>
bool answers(const Input& input, Body&& body) {
  try {
    body();
    return true;
  } catch (const Error& error) {
    if (!std::string(error.what()).starts_with(input.path + ": "))
      fail("names no input: " + std::string(error.what()));
    return false;
  }
}

/// The format of the output, chosen by the input.
FileFormat chosen_format(std::span<const std::uint8_t> bytes) {
  unsigned sum = 0;
  for (const std::uint8_t byte : bytes) sum = 31 * sum + byte;
  const auto formats = sample_formats();
  FileFormat format;
  format.revision = static_cast<int>(sum % 3);
  format.su = sum / 3 % 5 == 0;
  format.code = format.su ? 5 : formats[sum / 15 % formats.size()].code;
  format.endian = sum / 256 % 2 == 0 ? Endian::big : Endian::little;
  format.encoding = sum / 512 % 2 == 0 ? TextEncoding::ebcdic : TextEncoding::ascii;
  return format;
}

template <class AnyTrace>
std::int64_t convert(const Input& input, const std::optional<FileFormat>& format) {
  Reader reader(input.path, {}, input.first);
  in_place(input.path, [&] {
    const FileFormat to = format.value_or(format_of(reader));
    OutputFile out("/dev/null", OutputFile::Content::binary);
    FileInfo info = info_as(reader, "sw-convert", to);
    Writer writer(out, info);
    AnyTrace trace;
    while (reader.next(trace)) writer.write(trace, reader.header().su);
    out.commit();
  });
  return reader.delivered();
}

}  // namespace

void examine(std::span<const std::uint8_t> bytes, As as) {
  static const fuzz::MemoryFile file;
  Input input{"/dev/null", {}};
  if (as == As::file)
    input.path = file.holding(bytes);
  else
    input.first.assign(bytes.begin(), bytes.end());
  std::optional<Description> facts;
  if (!answers(input, [&] { facts = describe(input.path, {}, input.first); })) return;
  if (facts->damage && !facts->damage->starts_with(input.path + ": ")) fail(*facts->damage);
  std::int64_t raw = -1;
  const bool copied = answers(input, [&] { raw = convert<RawTrace>(input, std::nullopt); });
  if (copied && (facts->damage || raw != facts->traces)) fail("copying read other traces than describing");
  answers(input, [&] { convert<Trace>(input, chosen_format(bytes)); });
}

}  // namespace slipwave::segy
