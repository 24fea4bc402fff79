// SPDX-License-Identifier: BSD-3-Clause
#include "segy/writer_headers.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "base/error.hpp"
#include "segy/time_words.hpp"

namespace slipwave::segy {
namespace {

constexpr std::int64_t highest_signed_16 = 32767;
constexpr std::int64_t highest_signed_32 = 2147483647;
/// Share of the smallest distance of a survey that rounding of places may take without a word.
constexpr double tolerated_rounding = 0.01;

std::string file_kind(const FileFormat& format) {
  return format.su ? "Seismic Unix" : "SEG-Y revision " + std::to_string(format.revision);
}

bool has_wide_words(const FileFormat& format) { return !format.su && format.revision >= 2; }

bool fits_interval_word(double interval_s) {
  const double us = interval_s * 1e6;
  return is_whole(us) && us <= static_cast<double>(highest_16);
}

void check_sampling(const FileInfo& info) {
  const SampleAxis& axis = info.axis;
  const std::string kind = file_kind(info.format);
  const bool wide = has_wide_words(info.format);
  const std::int64_t most = wide ? highest_signed_32 : highest_16;
  if (axis.count < 1 || axis.count > most)
    throw Error(std::to_string(axis.count) + " samples a trace, " + kind + " holds 1 to " +
                std::to_string(most) + (wide || axis.count < 1 ? "" : "; SEG-Y revision 2 holds them"));
  if (!(axis.interval_s >= 0) || !std::isfinite(axis.interval_s))
    throw Error("sample interval " + shown(axis.interval_s) + " s, expected a positive number");
  if (!wide && !fits_interval_word(axis.interval_s))
    throw Error("sample interval " + shown(axis.interval_s) + " s, " + kind +
                " holds whole microseconds up to 65535; SEG-Y revision 2 holds any");
  if (info.carried) return;  // carried traces have a delay of their own
  TraceWords words;
  set_first_sample(words, axis.start_s, has_time_scalar(info.format));
}

void set_unless_carried(BinaryWords& words, FieldName<BinaryLayout> name, std::int64_t value) {
  if (words.get(name) == 0) words.set(name, value);
}

void set_revision_2(BinaryWords& words, const FileInfo& info) {
  words.clear(3261, 3300);
  words.clear(3507, 3532);
  if (info.format.revision < 2) return;
  words.set("xntrpr", info.layout.traces_per_shot);
  words.set("xns", info.axis.count);
  words.set_real("xdt", info.axis.interval_s * 1e6);
  words.set_real("xdto", info.axis.interval_s * 1e6);
  words.set("xnso", info.axis.count);
  words.set("byte_order", 0x01020304);
  words.set("ntraces", info.layout.traces);
  words.set("extra_headers", info.extra_headers);
}

}  // namespace

const SampleFormat& checked_format(const FileInfo& info) {
  const SampleFormat* const format = find_format(info.format.code);
  if (format == nullptr)
    throw Error("sample format code " + std::to_string(info.format.code) + " is unknown");
  if (info.format.revision < 0 || info.format.revision > 2)
    throw Error("revision " + std::to_string(info.format.revision) + ", expected 0, 1 or 2");
  if (info.format.su && format->code != 5)
    throw Error(std::string("sample format ") + format->name + ", Seismic Unix holds ieee only",
                ErrorKind::usage);
  if (info.format.revision < 2 && format->since >= 2)
    throw Error(std::string("sample format ") + format->name +
                    " exists since revision 2, the file is of revision " +
                    std::to_string(info.format.revision),
                ErrorKind::usage);
  check_sampling(info);
  return *format;
}

BinaryWords binary_header(const FileInfo& info) {
  BinaryWords words = info.carried.value_or(BinaryWords{});
  const std::int64_t interval = interval_word(info.axis.interval_s);
  const std::int64_t count = info.axis.count <= highest_16 ? info.axis.count : 0;
  set_unless_carried(words, "job", 1);
  set_unless_carried(words, "line", 1);
  set_unless_carried(words, "reel", 1);
  if (info.layout.traces_per_shot <= highest_signed_16)
    set_unless_carried(words, "ntrpr", info.layout.traces_per_shot);
  words.set("dt", interval);
  words.set("ns", count);
  set_unless_carried(words, "dto", interval);
  set_unless_carried(words, "nso", count);
  words.set("format", info.format.code);
  set_unless_carried(words, "fold", 1);
  set_unless_carried(words, "sort", 5);
  set_unless_carried(words, "vsum", 1);
  set_unless_carried(words, "mfeet", 1);
  set_revision_2(words, info);
  words.set("fixed", info.format.revision >= 1 && !info.lengths_vary ? 1 : 0);
  words.set("extended", static_cast<std::int64_t>(info.extended.size()));
  return words;
}

BinaryWords::Bytes with_revision_stamp(BinaryWords::Bytes bytes, const FileFormat& format) {
  std::uint8_t* const at = bytes.data() + (3501 - BinaryLayout::first);
  if (format.revision >= 2) {
    at[0] = 2;
    at[1] = 1;
  } else {
    store_bytes(at, 2, format.endian, format.revision == 1 ? 0x0100 : 0);
  }
  return bytes;
}

std::int64_t interval_word(double interval_s) {
  const double us = std::nearbyint(interval_s * 1e6);
  return us <= static_cast<double>(highest_16) ? static_cast<std::int64_t>(us) : 0;
}

bool has_time_scalar(const FileFormat& format) { return !format.su && format.revision >= 1; }

bool needs_revision_2(const SampleAxis& axis) {
  return axis.count > highest_16 || !fits_interval_word(axis.interval_s);
}

std::vector<std::string> places_rounded(const SurveyLayout& layout) {
  if (layout.rounding_m <= tolerated_rounding * layout.closest_m) return {};
  return {"places are rounded by up to " + shown(layout.rounding_m, 2) +
          " m, the scalar (bytes 69 and 71) being " + std::to_string(layout.coordinate_scalar) + ": " +
          shown(100 * layout.rounding_m / layout.closest_m, 2) + " % of the smallest distance, " +
          shown(layout.closest_m, 3) + " m"};
}

std::vector<std::string> warnings_of(const FileInfo& info) {
  std::vector<std::string> warnings;
  if (info.axis.count > highest_signed_16 && !has_wide_words(info.format))
    warnings.push_back(
        std::to_string(info.axis.count) +
        " samples a trace: readers that take the word as signed see a negative number above 32767; "
        "sw-convert --revision 2 writes it in a wider one");
  if (interval_word(info.axis.interval_s) > highest_signed_16)
    warnings.push_back("sample interval " + shown(info.axis.interval_s) +
                       " s: readers that take the word as signed see a negative number above 0.032767 s; "
                       "sw-filter --resample makes it shorter");
  return warnings;
}

namespace {

/// Bytes of what names a trace, in-line (189) and cross-line (193) among them.
std::string places_of_numbers(Numbering numbering) {
  const std::string midpoint = "  midpoint x 181 y 185, bin 21";
  switch (numbering) {
    case Numbering::bins:
      break;
    case Numbering::shots:
      return midpoint + "; shot 9, 189; channel 13; component 29, 193";
    case Numbering::channels:
      return midpoint + "; shot 9; channel 13, 193; component 29, 189";
  }
  return midpoint + ", y 189, x 193; shot 9; channel 13; component 29";
}

}  // namespace

std::vector<std::string> convention_entries(std::span<const Component> components, const SampleAxis& axis,
                                            const SurveyLayout& layout) {
  std::vector<std::string> entries;
  std::string recorded;
  for (const Component component : components)
    recorded += (recorded.empty() ? "" : ", ") + std::string(name_of(component)) + " " + unit_of(component) +
                " (trid " + std::to_string(code_of(component)) + ")";
  entries.push_back("Recorded: " + recorded);
  entries.push_back("Signs: z and vz positive down, x along the line; stress positive in tension,");
  entries.push_back("  p = -(sum of normal stresses)/dimensions, positive in compression");
  if (std::any_of(components.begin(), components.end(), [](Component component) {
        return component >= Component::exx && component <= Component::das;
      }))
    entries.push_back("  strain rates positive in extension, exz = (dvx/dz + dvz/dx)/2");
  entries.push_back("trid 256 + n: stress n = 1 sxx, 2 syy, 3 szz, 4 syz, 5 sxz, 6 sxy");
  entries.push_back("Sampling: " + std::to_string(axis.count) + " samples every " + shown(axis.interval_s) +
                    " s from " + shown(axis.start_s) + " s");
  entries.push_back("Bytes: source x 73 y 77 depth 49, receiver x 81 y 85 elevation 41,");
  entries.push_back(places_of_numbers(layout.numbering));
  entries.push_back("Lengths in metres, scalar (bytes 69 and 71) " +
                    std::to_string(layout.coordinate_scalar) + ", midpoint bins of " + shown(layout.bin_m) +
                    (layout.bin_y_m == layout.bin_m ? "" : " x " + shown(layout.bin_y_m)) + " m");
  return entries;
}

}  // namespace slipwave::segy
