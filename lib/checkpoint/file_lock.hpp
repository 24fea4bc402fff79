// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace slipwave {

/// While it lives nobody else on the machine, or on others that share the file system and its locks, has one
/// of that path. It is a file of its own, which the destructor removes; the lock of a process that was killed
/// ends with it, its file stays and is taken over.
class FileLock {
 public:
  /// Throws an Error that names `what` when somebody else has it, or when the file cannot be made. Where the
  /// file system knows no locks there is none.
  FileLock(std::string path, const std::string& what);
  FileLock(const FileLock&) = delete;
  FileLock& operator=(const FileLock&) = delete;
  ~FileLock();

 private:
  std::string path_;
  int descriptor_ = -1;
};

}  // namespace slipwave
