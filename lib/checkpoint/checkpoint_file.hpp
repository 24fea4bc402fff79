// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "base/archive.hpp"
#include "checkpoint/checksum.hpp"
#include "io/temporary.hpp"

namespace slipwave {

/// The format of what a checkpoint file holds; another one is refused.
inline constexpr std::uint64_t checkpoint_format = 2;

/// Returns where the checkpoint before the newest is kept: "C.1".
std::string older_checkpoint(const std::string& path);

/// Writes a checkpoint that appears whole or not at all: a private temporary beside it, on the disk before it
/// is given its name. Every failure is an Error that names the checkpoint.
class CheckpointWriter : public Archive {
 public:
  explicit CheckpointWriter(std::string path);
  void bytes(void* first, std::size_t count) override;
  std::size_t count(std::size_t now, std::size_t piece_bytes) override;
  /// Puts it in place; the one that was there becomes the older one. At any moment there is one of the two.
  void commit();

 private:
  void flush();
  void put(const char* from, std::size_t count);

  std::string path_;
  Temporary file_;
  std::uint64_t bytes_ = 0;  // in the file
  std::vector<char> buffer_;
  Checksum checksum_;
};

/// Part of a checkpoint file, read on its own. Copies share nothing but the file, which its reader keeps
/// open.
class CheckpointPart : public Archive {
 public:
  CheckpointPart(int descriptor, std::string path, std::uint64_t begin, std::uint64_t end);
  void bytes(void* first, std::size_t count) override;
  std::size_t count(std::size_t now, std::size_t piece_bytes) override;
  /// The next `count` bytes; they are passed over here.
  CheckpointPart part(std::uint64_t count);
  std::uint64_t left() const { return end_ - at_ + (buffer_.size() - used_); }

 private:
  int descriptor_;
  std::string path_;
  std::uint64_t at_, end_;  // in the file, behind the buffer
  std::vector<char> buffer_;
  std::size_t used_ = 0;
};

/// A whole checkpoint file, its length, format and checksum right. The file stays as it was opened, whatever
/// takes its name later.
class CheckpointReader {
 public:
  /// Throws an Error that names the file and what is wrong with it.
  explicit CheckpointReader(const std::string& path);
  CheckpointReader(const CheckpointReader&) = delete;
  CheckpointReader& operator=(const CheckpointReader&) = delete;
  ~CheckpointReader();
  CheckpointPart content() const;

 private:
  [[noreturn]] void refuse(const std::string& sentence) const;
  void check();

  std::string path_;
  int descriptor_;
  std::uint64_t bytes_ = 0;
};

}  // namespace slipwave
