// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <cstring>
#include <vector>

#include "base/archive.hpp"

namespace slipwave::solver {

/// Serialized state as bytes, and the state read back from them.
class ToMemory : public Archive {
 public:
  explicit ToMemory(std::vector<char>& kept) : kept_(kept) {}
  void bytes(void* first, std::size_t count) override {
    const char* from = static_cast<const char*>(first);
    kept_.insert(kept_.end(), from, from + count);
  }
  std::size_t count(std::size_t now, std::size_t) override {
    bytes(&now, sizeof now);
    return now;
  }

 private:
  std::vector<char>& kept_;
};

class FromMemory : public Archive {
 public:
  explicit FromMemory(const std::vector<char>& kept) : kept_(kept) {}
  void bytes(void* first, std::size_t count) override {
    ASSERT_LE(used_ + count, kept_.size());
    // Of no bytes there may be no place either.
    if (count > 0) std::memcpy(first, kept_.data() + used_, count);
    used_ += count;
  }
  std::size_t count(std::size_t, std::size_t) override {
    std::size_t number = 0;
    bytes(&number, sizeof number);
    return number;
  }
  bool all_used() const { return used_ == kept_.size(); }

 private:
  const std::vector<char>& kept_;
  std::size_t used_ = 0;
};

}  // namespace slipwave::solver
