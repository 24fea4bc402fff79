// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <string_view>

#include "base/error.hpp"
#include "segy/bytes.hpp"
#include "segy/layout_binary.hpp"
#include "segy/layout_extension.hpp"
#include "segy/layout_trace.hpp"

namespace slipwave::segy {

/// A field of a header by its name, looked up while compiling: a name the layout lacks does not compile.
template <class Layout>
struct FieldName {
  Field field;
  consteval FieldName(const char* name) : field(find(name)) {}  // NOLINT: words.get("sx") is the point
  constexpr explicit FieldName(const Field& of_table) : field(of_table) {}

 private:
  static constexpr Field find(std::string_view name) {
    for (const Field& candidate : Layout::fields)
      if (candidate.name == name) return candidate;
    throw "no field of this name in the layout";
  }
};

/// The bytes of one header, kept big-endian whatever the file's order; bytes no field covers are carried as
/// they are.
template <class Layout>
class Words {
 public:
  using Bytes = std::array<std::uint8_t, Layout::size>;

  Words() = default;
  Words(std::span<const std::uint8_t, Layout::size> file_bytes, Endian endian) {
    std::copy(file_bytes.begin(), file_bytes.end(), bytes_.begin());
    if (endian == Endian::little) swap(bytes_);
  }

  /// The header as it stands in a file of that byte order.
  Bytes in_file_order(Endian endian) const {
    Bytes out = bytes_;
    if (endian == Endian::little) swap(out);
    return out;
  }

  std::int64_t get(FieldName<Layout> name) const {
    const Field& f = name.field;
    const std::uint64_t raw = load_bytes(at(f), size_of(f.type), Endian::big);
    return is_signed(f.type) ? sign_extended(raw, size_of(f.type)) : static_cast<std::int64_t>(raw);
  }
  double get_real(FieldName<Layout> name) const {
    return std::bit_cast<double>(load_bytes(at(name.field), 8, Endian::big));
  }

  /// Throws Error naming the field when the value does not fit it.
  void set(FieldName<Layout> name, std::int64_t value) {
    const Field& f = name.field;
    const auto [lowest, highest] = range_of(f.type);
    if (value < lowest || value > highest)
      throw Error("header word " + std::string(f.name) + " (byte " + std::to_string(f.byte) + ") would be " +
                  std::to_string(value) + ", its range is " + std::to_string(lowest) + " to " +
                  std::to_string(highest));
    store_bytes(at(f), size_of(f.type), Endian::big, static_cast<std::uint64_t>(value));
  }
  void set_real(FieldName<Layout> name, double value) {
    store_bytes(at(name.field), 8, Endian::big, std::bit_cast<std::uint64_t>(value));
  }

  /// Sets the bytes `first` to `last` (numbered as the standard does, both included) to 0.
  void clear(int first, int last) {
    std::fill(bytes_.begin() + (first - Layout::first), bytes_.begin() + (last + 1 - Layout::first), 0);
  }

  bool operator==(const Words&) const = default;

 private:
  const std::uint8_t* at(const Field& f) const { return bytes_.data() + (f.byte - Layout::first); }
  std::uint8_t* at(const Field& f) { return bytes_.data() + (f.byte - Layout::first); }
  static void swap(Bytes& bytes) {
    for (const Field& f : Layout::fields) {
      const auto from = bytes.begin() + (f.byte - Layout::first);
      std::reverse(from, from + size_of(f.type));
    }
  }

  Bytes bytes_{};
};

using TraceWords = Words<TraceLayout>;
using BinaryWords = Words<BinaryLayout>;
using ExtensionWords = Words<ExtensionLayout>;

}  // namespace slipwave::segy
