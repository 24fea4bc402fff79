// SPDX-License-Identifier: BSD-3-Clause
#include "io/netcdf_container.hpp"

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "base/error.hpp"

namespace slipwave {
namespace {

constexpr std::string_view hdf5_signature = "\x89HDF\r\n\x1a\n";

/// Longer than any file: a number beyond it is damage, and below it sums of two do not overflow.
constexpr std::uint64_t no_file_is_longer = std::uint64_t(1) << 62;

[[noreturn]] void throw_damaged() {
  throw Error("the header of this netCDF file is damaged: make or copy the file again");
}

/// Reads the header of a classic file (CDF-1, -2, -5), big-endian, front to back.
class ClassicHeader {
 public:
  ClassicHeader(const ReadAt& read_at, std::uint64_t size, int version)
      : read_at_(read_at), size_(size), version_(version) {}

  /// The bytes the file must have to hold all its data.
  std::uint64_t least_size() {
    const std::uint64_t records = count();
    // A file left open by its writer does not know its number of records.
    const bool records_known = records != (version_ == 5 ? ~std::uint64_t(0) : 0xffffffffu);
    std::vector<std::uint64_t> lengths;
    for (std::uint64_t left = list_length(); left > 0; --left) {
      skip_name();
      lengths.push_back(count());
    }
    skip_attributes();
    std::uint64_t fixed_end = 0, record_bytes = 0, last_record_end = 0;
    std::uint64_t record_variables = 0, only_record_bytes = 0;
    for (std::uint64_t left = list_length(); left > 0; --left) {
      skip_name();
      std::uint64_t elements = 1;
      bool in_records = false;
      for (std::uint64_t rank = count(), axis = 0; axis < rank; ++axis) {
        const std::uint64_t dimension = count();
        if (dimension >= lengths.size()) throw_damaged();
        const std::uint64_t length = lengths[dimension];
        if (length == 0 && axis == 0) {
          in_records = true;
        } else {
          elements = product(elements, length);
        }
      }
      skip_attributes();
      const std::uint64_t bytes = product(elements, width_of(number(4)));
      count();  // vsize: computed instead, it saturates in large files
      const std::uint64_t begin = number(version_ == 1 ? 4 : 8);
      if (begin > no_file_is_longer) throw_damaged();
      if (in_records) {
        ++record_variables;
        only_record_bytes = bytes;
        record_bytes += (bytes + 3) / 4 * 4;
        last_record_end = std::max(last_record_end, begin + bytes);
      } else {
        fixed_end = std::max(fixed_end, begin + bytes);
      }
    }
    if (record_variables == 1) record_bytes = only_record_bytes;  // a single one is not padded
    if (!records_known || records == 0 || record_variables == 0) return std::max(fixed_end, position_);
    return std::max({fixed_end, position_, last_record_end + product(records - 1, record_bytes)});
  }

 private:
  std::uint64_t number(int bytes) {
    std::array<unsigned char, 8> raw{};
    if (!read_at_(position_, raw.data(), std::size_t(bytes)))
      throw_truncated(position_ + std::uint64_t(bytes));
    position_ += std::uint64_t(bytes);
    std::uint64_t value = 0;
    for (int i = 0; i < bytes; ++i) value = value << 8 | raw[std::size_t(i)];
    return value;
  }
  std::uint64_t count() { return number(version_ == 5 ? 8 : 4); }
  std::uint64_t list_length() {
    number(4);  // the list's tag; an absent list has length 0
    return count();
  }
  void skip(std::uint64_t bytes) {
    // Near 2^64 the sum would wrap round: the position would go back and the same bytes be read without end.
    if (bytes > no_file_is_longer) throw_damaged();
    position_ += (bytes + 3) / 4 * 4;
    if (position_ > size_) throw_truncated(position_);
  }
  void skip_name() { skip(count()); }
  void skip_attributes() {
    for (std::uint64_t left = list_length(); left > 0; --left) {
      skip_name();
      const std::uint64_t width = width_of(number(4));
      skip(product(count(), width));
    }
  }
  static std::uint64_t product(std::uint64_t a, std::uint64_t b) {
    std::uint64_t result = 0;
    if (__builtin_mul_overflow(a, b, &result) || result > no_file_is_longer) throw_damaged();
    return result;
  }
  static std::uint64_t width_of(std::uint64_t type) {
    constexpr std::array<int, 12> widths = {0, 1, 1, 2, 4, 4, 8, 1, 2, 4, 8, 8};
    if (type == 0 || type >= widths.size()) throw_damaged();
    return std::uint64_t(widths[type]);
  }
  [[noreturn]] void throw_truncated(std::uint64_t least) const {
    throw Error("truncated: found " + std::to_string(size_) + " bytes, expected at least " +
                std::to_string(least));
  }

  const ReadAt& read_at_;
  std::uint64_t size_, position_ = 4;
  int version_;
};

/// The end of file that the superblock of an HDF5 file claims, or 0 when it cannot tell.
std::uint64_t hdf5_size(const ReadAt& read_at) {
  std::array<unsigned char, 52> head{};
  if (!read_at(0, head.data(), head.size())) return 0;
  const int version = head[8];
  std::size_t at = 0;
  if (version <= 1) {
    if (head[13] != 8) return 0;
    at = version == 0 ? 40 : 44;
  } else {
    if (head[9] != 8) return 0;
    at = 28;
  }
  std::uint64_t size = 0;
  for (int i = 7; i >= 0; --i) size = size << 8 | head[at + std::size_t(i)];
  return size == ~std::uint64_t(0) ? 0 : size;
}

}  // namespace

bool begins_netcdf(std::string_view first) {
  if (first.substr(0, 8) == hdf5_signature) return true;
  return first.size() >= 4 && first.substr(0, 3) == "CDF" &&
         (first[3] == 1 || first[3] == 2 || first[3] == 5);
}

void check_not_truncated(const ReadAt& read_at, std::uint64_t size) {
  std::array<char, 8> first{};
  if (size == 0) throw Error("is empty, expected a netCDF file");
  if (!read_at(0, first.data(), first.size())) {
    throw Error("found " + std::to_string(size) + " bytes, expected a netCDF file");
  }
  if (!begins_netcdf({first.data(), first.size()})) return;
  const std::uint64_t least =
      first[0] == 'C' ? ClassicHeader(read_at, size, first[3]).least_size() : hdf5_size(read_at);
  if (size < least) {
    throw Error("truncated: found " + std::to_string(size) + " bytes, expected " + std::to_string(least));
  }
}

}  // namespace slipwave
