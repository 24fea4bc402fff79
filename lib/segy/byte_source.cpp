// SPDX-License-Identifier: BSD-3-Clause
#include "segy/byte_source.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cassert>
#include <cerrno>
#include <cstring>

#include "base/error.hpp"
#include "io/input_bytes.hpp"

namespace slipwave::segy {
namespace {

constexpr std::size_t file_buffer_bytes = 1 << 18;

Error failure(const std::string& name) { return Error(name + ": " + std::strerror(errno)); }

}  // namespace

ByteSource::ByteSource(const std::string& path, std::vector<std::uint8_t> already_read)
    : name_(shown_input(path)), buffer_(std::move(already_read)) {
  end_ = buffer_.size();
  if (path == "-") {
    descriptor_ = STDIN_FILENO;
    if (::isatty(descriptor_)) throw Error(name_ + ": is a terminal, expected a file or a pipe");
  } else {
    descriptor_ = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
    if (descriptor_ < 0) throw failure(name_);
    owned_ = true;
  }
  struct stat about {};
  const bool known = ::fstat(descriptor_, &about) == 0;
  if (known && S_ISDIR(about.st_mode)) {
    if (owned_) ::close(descriptor_);
    throw Error(name_ + ": is a directory, expected a file");
  }
  if (known && S_ISREG(about.st_mode) && about.st_size > 0) {  // files of /proc say 0 and are not empty
    const auto here = ::lseek(descriptor_, 0, SEEK_CUR);
    const auto from = here < 0 ? -1 : here - static_cast<off_t>(end_);
    if (from >= 0) {
      start_ = static_cast<std::uint64_t>(from);
      size_ = static_cast<std::uint64_t>(std::max<off_t>(about.st_size - from, 0));
    }
  }
  // a pipe gives 64 KiB at once
  std::size_t wanted = peek_limit;
  if (size_) wanted = static_cast<std::size_t>(std::min<std::uint64_t>(file_buffer_bytes, *size_));
  buffer_.resize(std::max(wanted, end_));
}

ByteSource::~ByteSource() {
  if (owned_) ::close(descriptor_);
}

/// One read call: what a pipe holds now; 0 at the end.
std::size_t ByteSource::read_some(std::span<std::uint8_t> into) {
  ssize_t count = 0;
  do count = ::read(descriptor_, into.data(), into.size());
  while (count < 0 && errno == EINTR);
  failed_ = count < 0;
  if (failed_) throw Error(std::strerror(errno));
  return static_cast<std::size_t>(count);
}

/// Straight from the descriptor, past the buffer.
std::size_t ByteSource::fill(std::span<std::uint8_t> into) {
  std::size_t done = 0;
  while (done < into.size()) {
    const std::size_t count = read_some(into.subspan(done));
    if (count == 0) break;
    done += count;
  }
  return done;
}

std::span<const std::uint8_t> ByteSource::peek(std::size_t count) {
  assert(count <= peek_limit);
  if (buffered() < count) {
    std::memmove(buffer_.data(), buffer_.data() + begin_, buffered());
    end_ -= begin_;
    begin_ = 0;
    if (buffer_.size() < count) buffer_.resize(count);  // a file that has grown since
    while (end_ < count) {
      const std::size_t got = read_some(std::span(buffer_).subspan(end_));
      if (got == 0) break;
      end_ += got;
    }
  }
  return {buffer_.data() + begin_, std::min(count, buffered())};
}

std::span<const std::uint8_t> ByteSource::take(std::size_t count) {
  const auto taken = peek(count);
  begin_ += taken.size();
  position_ += taken.size();
  return taken;
}

std::size_t ByteSource::read(std::span<std::uint8_t> into) {
  std::size_t done = 0;
  while (done < into.size()) {
    if (buffered() == 0) {
      if (into.size() - done >= buffer_.size()) {
        done += fill(into.subspan(done));
        break;
      }
      begin_ = 0;
      end_ = read_some(buffer_);
      if (end_ == 0) break;
    }
    const std::size_t count = std::min(into.size() - done, buffered());
    std::memcpy(into.data() + done, buffer_.data() + begin_, count);
    begin_ += count;
    done += count;
  }
  position_ += done;
  return done;
}

std::uint64_t ByteSource::skip(std::uint64_t count) {
  std::uint64_t done = std::min<std::uint64_t>(count, buffered());
  begin_ += done;
  position_ += done;
  if (done < count && size_) {
    const std::uint64_t left = std::min(count - done, *size_ > position_ ? *size_ - position_ : 0);
    if (::lseek(descriptor_, static_cast<off_t>(start_ + position_ + left), SEEK_SET) < 0)
      throw Error(std::strerror(errno));
    position_ += left;
    return done + left;
  }
  std::vector<std::uint8_t> waste(static_cast<std::size_t>(std::min<std::uint64_t>(count - done, 1 << 16)));
  while (done < count) {
    const std::size_t step = static_cast<std::size_t>(std::min<std::uint64_t>(count - done, waste.size()));
    const std::size_t got = read({waste.data(), step});
    done += got;
    if (got < step) break;
  }
  return done;
}

bool ByteSource::read_at(std::uint64_t offset, std::span<std::uint8_t> into) const {
  std::size_t done = 0;
  while (done < into.size()) {
    const ssize_t count = ::pread(descriptor_, into.data() + done, into.size() - done,
                                  static_cast<off_t>(start_ + offset + done));
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return false;
    done += static_cast<std::size_t>(count);
  }
  return true;
}

}  // namespace slipwave::segy
