// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace slipwave::segy {

/// The bytes of a file or of standard input, read once from the start to the end through one buffer.
/// Errors of opening name the input ("gather.sgy: No such file or directory"); those of reading are the bare
/// cause.
class ByteSource {
 public:
  /// `path` is a file, or "-" for standard input, from which `already_read` bytes were taken before.
  explicit ByteSource(const std::string& path, std::vector<std::uint8_t> already_read = {});
  ByteSource(const ByteSource&) = delete;
  ByteSource& operator=(const ByteSource&) = delete;
  ~ByteSource();

  /// "gather.sgy" or "standard input".
  const std::string& name() const noexcept { return name_; }
  /// Bytes from the start to the end, known for regular files only.
  std::optional<std::uint64_t> size() const noexcept { return size_; }
  std::uint64_t position() const noexcept { return position_; }
  /// Whether reading failed, as of a disk that does: what came before may not be all there is.
  bool failed() const noexcept { return failed_; }

  /// The next bytes without taking them, as many as asked for unless the input ends before;
  /// count is at most peek_limit. Valid until the next call.
  static constexpr std::size_t peek_limit = 1 << 17;
  std::span<const std::uint8_t> peek(std::size_t count);
  /// Returns what peek() does, and takes these bytes: they need no copy of their own.
  std::span<const std::uint8_t> take(std::size_t count);
  /// Takes into.size() bytes, fewer only at the end; says how many.
  std::size_t read(std::span<std::uint8_t> into);
  /// Passes over bytes; says how many there were.
  std::uint64_t skip(std::uint64_t count);
  /// Bytes of a regular file anywhere, position() unchanged; false when they are not all there.
  bool read_at(std::uint64_t offset, std::span<std::uint8_t> into) const;

 private:
  std::size_t read_some(std::span<std::uint8_t> into);
  std::size_t fill(std::span<std::uint8_t> into);
  std::size_t buffered() const noexcept { return end_ - begin_; }

  std::string name_;
  int descriptor_ = -1;
  bool owned_ = false;
  std::optional<std::uint64_t> size_;
  std::uint64_t start_ = 0;  // where in the file position() 0 is
  std::uint64_t position_ = 0;
  std::vector<std::uint8_t> buffer_;
  std::size_t begin_ = 0;
  std::size_t end_ = 0;
  bool failed_ = false;
};

}  // namespace slipwave::segy
