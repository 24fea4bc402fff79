// SPDX-License-Identifier: BSD-3-Clause
#include "memory_file.hpp"

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>

namespace slipwave::fuzz {

void fail(const std::string& what) {
  std::fprintf(stderr, "%s\n", what.c_str());
  std::abort();
}

MemoryFile::MemoryFile() : descriptor_(memfd_create("input", MFD_CLOEXEC)) {
  if (descriptor_ < 0) fail("no memory file");
  path_ = "/proc/self/fd/" + std::to_string(descriptor_);
}

MemoryFile::~MemoryFile() { close(descriptor_); }

const std::string& MemoryFile::holding(std::span<const std::uint8_t> bytes) const {
  const auto size = static_cast<off_t>(bytes.size());
  const bool done =
      ftruncate(descriptor_, size) == 0 && pwrite(descriptor_, bytes.data(), bytes.size(), 0) == size;
  if (!done) fail("the memory file cannot be written");
  return path_;
}

}  // namespace slipwave::fuzz
