// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <cstring>

namespace slipwave {

/// A sum over bytes in which a change of any one word of eight bytes is always seen. Not against malice.
class Checksum {
 public:
  Checksum() = default;
  /// Continues another one's sum.
  explicit Checksum(std::uint64_t sum) : sum_(sum) {}
  /// Bytes are taken eight at a time, the last of a call filled up with zeros: what is added in several calls
  /// must be cut at multiples of eight to give the same sum.
  void add(const void* first, std::size_t count) {
    const char* from = static_cast<const char*>(first);
    for (; count >= sizeof(std::uint64_t); count -= sizeof(std::uint64_t), from += sizeof(std::uint64_t)) {
      std::uint64_t word;
      std::memcpy(&word, from, sizeof word);
      add(word);
    }
    if (count == 0) return;
    std::uint64_t word = 0;
    std::memcpy(&word, from, count);
    add(word);
  }
  void add(std::uint64_t word) {
    // Each of these is one to one, for the sum and for the word.
    sum_ = (sum_ ^ word) * 0x9e3779b97f4a7c15u;
    sum_ ^= sum_ >> 29;
  }
  std::uint64_t sum() const { return sum_; }

 private:
  std::uint64_t sum_ = 0x51ed270b7a1f39c5u;
};

}  // namespace slipwave
