// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <type_traits>
#include <vector>

#include "base/error.hpp"

namespace slipwave {

/// Serializes a state to continue from later, piece by piece: writes it, or reads it back in the same order.
/// The owner names the pieces in one function for both directions, so that they cannot differ.
class Archive {
 public:
  virtual ~Archive() = default;
  /// Writes these bytes, or fills them with what was written.
  virtual void bytes(void* first, std::size_t count) = 0;
  /// Writes how many pieces of this size follow, or returns how many were written, never more than what is
  /// left can hold.
  virtual std::size_t count(std::size_t now, std::size_t piece_bytes) = 0;

  template <class T>
  void value(T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    bytes(&value, sizeof(T));
  }
  /// What is read is a bool, whatever was written.
  void flag(bool& flag) {
    std::uint8_t one = flag ? 1 : 0;
    value(one);
    flag = one != 0;
  }
  /// Serializes as many values as there are; throws an Error when another number was written.
  template <class T>
  void fixed(T* first, std::size_t number) {
    static_assert(std::is_trivially_copyable_v<T>);
    const auto written = count(number, sizeof(T));
    if (written != number)
      throw Error("found " + std::to_string(written) + " values, expected " + std::to_string(number));
    bytes(first, number * sizeof(T));
  }
  template <class T>
  void fixed(std::vector<T>& all) {
    fixed(all.data(), all.size());
  }
  /// Any number; the vector is made to hold what was written.
  template <class T>
  void values(std::vector<T>& all) {
    static_assert(std::is_trivially_copyable_v<T>);
    all.resize(count(all.size(), sizeof(T)));
    bytes(all.data(), all.size() * sizeof(T));
  }
  void text(std::string& text) {
    text.resize(count(text.size(), 1));
    bytes(text.data(), text.size());
  }
};

}  // namespace slipwave
