// SPDX-License-Identifier: BSD-3-Clause
#include "base/memory.hpp"

#include <sys/mman.h>
#include <unistd.h>

#include <cstring>
#if defined(__GLIBC__)
#include <malloc.h>
#endif

namespace slipwave {
namespace {

std::size_t page_bytes() { return std::size_t(sysconf(_SC_PAGESIZE)); }

/// The whole pages in it.
template <class Byte>
std::span<Byte> pages_of(std::span<Byte> memory) {
  const auto page = page_bytes();
  const auto before = (page - reinterpret_cast<std::uintptr_t>(memory.data()) % page) % page;
  if (memory.size() < before + page) return {};
  return memory.subspan(before, (memory.size() - before) / page * page);
}

/// Calls see(first, count) for each run of pages of zeros, counted from the first page.
template <class See>
void each_zero_run(std::span<const std::byte> pages, const See& see) {
  const auto page = page_bytes();
  const auto is_zero = [&](std::size_t at) {
    return pages[at] == std::byte{0} && std::memcmp(&pages[at], &pages[at] + 1, page - 1) == 0;
  };
  for (std::size_t first = 0, last = 0; first < pages.size(); first = last + page) {
    for (last = first; last < pages.size() && is_zero(last);) last += page;
    if (last > first) see(first, last - first);
  }
}

/// Private memory without a file behind it is zeros after this; false where the system cannot.
bool discard(std::span<const std::byte> pages) {
#if defined(__linux__)
  return pages.empty() || madvise(const_cast<std::byte*>(pages.data()), pages.size(), MADV_DONTNEED) == 0;
#else
  return pages.empty();
#endif
}

}  // namespace

void release_zero_pages(std::span<const std::byte> memory) {
  const auto pages = pages_of(memory);
  each_zero_run(pages, [&](std::size_t first, std::size_t count) { discard(pages.subspan(first, count)); });
}

void clear_and_release(std::span<std::byte> memory) {
  const auto pages = pages_of(memory);
  if (pages.empty() || !discard(pages)) {
    std::memset(memory.data(), 0, memory.size());
    return;
  }
  const auto before = std::size_t(pages.data() - memory.data());
  std::memset(memory.data(), 0, before);
  std::memset(pages.data() + pages.size(), 0, memory.size() - before - pages.size());
}

std::int64_t bytes_without_zero_pages(std::span<const std::byte> memory) {
  auto bytes = std::int64_t(memory.size());
#if defined(__linux__)
  each_zero_run(pages_of(memory), [&](std::size_t, std::size_t count) { bytes -= std::int64_t(count); });
#endif
  return bytes;
}

void release_freed_memory() {
#if defined(__GLIBC__)
  (void)malloc_trim(0);
#endif
}

}  // namespace slipwave
