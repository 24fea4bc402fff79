// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace slipwave {

/// "standard input" for "-", else the path: as messages name an input.
std::string shown_input(const std::string& path);

/// All bytes of a file, fifo or ("-") standard input. Throws Error naming it: missing, a directory,
/// unreadable, standard input that is a terminal. `already_read` bytes were taken from it before and come
/// first. More than `most` bytes are refused (0: half of the memory of this machine), so that an input
/// without end comes to one.
std::vector<char> read_all(const std::string& path, std::vector<char> already_read = {},
                           std::size_t most = 0);

/// Reads what people write as read_all() does: 64 MiB at most.
std::string read_text(const std::string& path, std::vector<char> already_read = {});

/// Is `path` a regular file? Throws Error naming it when it is missing or a directory. "-" is none.
bool is_regular_input(const std::string& path);

/// A regular file, read at any place.
class InputFile {
 public:
  /// Throws Error naming the file when it cannot be opened.
  explicit InputFile(const std::string& path);
  InputFile(const InputFile&) = delete;
  InputFile& operator=(const InputFile&) = delete;
  ~InputFile();

  std::uint64_t size() const { return size_; }
  /// Copies `count` bytes from `offset` to `to`; false past the end. Throws Error with the bare cause when
  /// reading fails.
  bool read_at(std::uint64_t offset, void* to, std::size_t count) const;

 private:
  int descriptor_ = -1;
  std::uint64_t size_ = 0;
};

/// The first bytes of an input, to detect its kind. From a pipe they are taken for good: whoever reads on
/// must be given taken() first. Keeps a fifo open meanwhile, so that its writer does not see it closed.
class InputStart {
 public:
  /// At most `count` bytes; fewer only where the input ends. Errors as read_all().
  InputStart(const std::string& path, std::size_t count);
  InputStart(const InputStart&) = delete;
  InputStart& operator=(const InputStart&) = delete;
  ~InputStart();

  const std::vector<char>& bytes() const { return bytes_; }
  bool is_regular() const { return regular_; }
  /// What reading the path again will not give: nothing for a regular file, else bytes().
  std::vector<char> taken() const { return regular_ ? std::vector<char>() : bytes_; }

 private:
  bool regular_ = false;
  int descriptor_ = -1;
  std::vector<char> bytes_;
};

}  // namespace slipwave
