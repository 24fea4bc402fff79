// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <string>

namespace slipwave::fuzz {

/// Says what is wrong and ends the process, as fuzzers want it.
[[noreturn]] void fail(const std::string& what);

/// A file in memory, written again for every input.
class MemoryFile {
 public:
  MemoryFile();
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;
  ~MemoryFile();

  /// Its name, once it holds these bytes and no others.
  const std::string& holding(std::span<const std::uint8_t> bytes) const;

 private:
  int descriptor_;
  std::string path_;
};

}  // namespace slipwave::fuzz
