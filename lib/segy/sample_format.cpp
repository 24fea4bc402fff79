// SPDX-License-Identifier: BSD-3-Clause
#include "segy/sample_format.hpp"

#include "base/error.hpp"

namespace slipwave::segy {
namespace {

constexpr SampleFormat formats[] = {
    {1, 4, "ibm", "4-byte IBM float", 0},
    {2, 4, "int32", "4-byte integer", 0},
    {3, 2, "int16", "2-byte integer", 0},
    {5, 4, "ieee", "4-byte IEEE float", 1},
    {6, 8, "double", "8-byte IEEE float", 2},
    {7, 3, "int24", "3-byte integer", 2},
    {8, 1, "int8", "1-byte integer", 1},
    {9, 8, "int64", "8-byte integer", 2},
    {10, 4, "uint32", "4-byte unsigned integer", 2},
    {11, 2, "uint16", "2-byte unsigned integer", 2},
    {12, 8, "uint64", "8-byte unsigned integer", 2},
    {15, 3, "uint24", "3-byte unsigned integer", 2},
    {16, 1, "uint8", "1-byte unsigned integer", 2},
};

}  // namespace

const char* name_of(Endian endian) { return endian == Endian::big ? "big" : "little"; }

std::span<const SampleFormat> sample_formats() { return formats; }

const SampleFormat* find_format(std::int64_t code) {
  for (const SampleFormat& format : formats)
    if (format.code == code) return &format;
  return nullptr;
}

const SampleFormat& format_named(const std::string& name) {
  std::string known;
  for (const SampleFormat& format : formats) {
    if (name == format.name || name == std::to_string(format.code)) return format;
    known += (known.empty() ? "" : ", ") + std::string(format.name);
  }
  throw Error("sample format \"" + name + "\", expected one of " + known, ErrorKind::usage);
}

}  // namespace slipwave::segy
