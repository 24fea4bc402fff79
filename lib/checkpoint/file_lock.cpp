// SPDX-License-Identifier: BSD-3-Clause
#include "checkpoint/file_lock.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>

#include "base/error.hpp"
#include "io/temporary.hpp"

namespace slipwave {
FileLock::FileLock(std::string path, const std::string& what) : path_(std::move(path)) {
  for (;;) {
    descriptor_ = open(path_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0600);
    if (descriptor_ < 0) throw Error(what + ": " + cause_of(errno));
    if (flock(descriptor_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
      close(descriptor_);
      throw Error(what + ": is in use by another run, expected one at a time");
    }
    // Its last owner may have removed it after we opened it.
    if (has_name(descriptor_, path_)) return;
    close(descriptor_);
  }
}

FileLock::~FileLock() {
  unlink(path_.c_str());
  close(descriptor_);
}

}  // namespace slipwave
