// SPDX-License-Identifier: BSD-3-Clause
#include "io/input_bytes.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <utility>

#include "base/error.hpp"
#include "io/temporary.hpp"

namespace slipwave {
namespace {

struct Descriptor {
  int number;
  bool owned;
  Descriptor(int number_, bool owned_) : number(number_), owned(owned_) {}
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor() {
    if (owned && number >= 0) close(number);
  }
};

Descriptor opened(const std::string& path) {
  if (path == "-") {
    if (isatty(STDIN_FILENO)) {
      throw Error("standard input is a terminal; expected a file name, or a pipe for -", ErrorKind::usage);
    }
    return {STDIN_FILENO, false};
  }
  const int descriptor = open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) throw Error(path + ": " + cause_of(errno));
  return {descriptor, true};
}

}  // namespace

std::string shown_input(const std::string& path) { return path == "-" ? "standard input" : path; }

bool is_regular_input(const std::string& path) {
  if (path == "-") return false;
  if (path.empty()) throw Error("an input has no name; expected a file or -", ErrorKind::usage);
  struct stat status {};
  if (stat(path.c_str(), &status) != 0) throw Error(path + ": " + cause_of(errno));
  if (S_ISDIR(status.st_mode)) throw Error(path + ": is a directory, expected a file");
  return S_ISREG(status.st_mode);
}

std::vector<char> read_all(const std::string& path, std::vector<char> already_read, std::size_t most) {
  if (most == 0) most = std::size_t(sysconf(_SC_PHYS_PAGES)) / 2 * std::size_t(sysconf(_SC_PAGESIZE));
  const bool regular = is_regular_input(path);
  const std::string name = shown_input(path);
  const Descriptor from = opened(path);
  std::vector<char> bytes = std::move(already_read);
  struct stat status {};
  if (regular && fstat(from.number, &status) == 0)
    bytes.reserve(std::min(std::size_t(status.st_size), most) + 1);
  constexpr std::size_t block = std::size_t(1) << 18;
  for (;;) {
    const std::size_t before = bytes.size();
    if (before > most)
      throw Error(name + ": found more than " + std::to_string(most) + " bytes, expected no more");
    if (bytes.capacity() - before < 1) bytes.reserve(before + std::max(block, before / 2));
    bytes.resize(std::min(bytes.capacity(), before + std::max(block, before / 2)));
    const ssize_t count = ::read(from.number, bytes.data() + before, bytes.size() - before);
    const int error_number = errno;
    bytes.resize(before + std::size_t(count > 0 ? count : 0));
    if (count < 0 && error_number == EINTR) continue;
    if (count < 0) throw Error(name + ": " + cause_of(error_number));
    if (count == 0) return bytes;
  }
}

std::string read_text(const std::string& path, std::vector<char> already_read) {
  constexpr std::size_t most = std::size_t(1) << 26;
  const auto bytes = read_all(path, std::move(already_read), most);
  return {bytes.begin(), bytes.end()};
}

InputFile::InputFile(const std::string& path) {
  Descriptor from = opened(path);
  struct stat status {};
  if (fstat(from.number, &status) != 0) throw Error(path + ": " + cause_of(errno));
  size_ = std::uint64_t(status.st_size);
  descriptor_ = from.number;
  from.owned = false;
}

InputFile::~InputFile() {
  if (descriptor_ >= 0) close(descriptor_);
}

bool InputFile::read_at(std::uint64_t offset, void* to, std::size_t count) const {
  if (count > size_ || offset > size_ - count) return false;
  auto* at = static_cast<char*>(to);
  while (count > 0) {
    const ssize_t got = pread(descriptor_, at, count, off_t(offset));
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) throw Error(cause_of(errno));
    if (got == 0) return false;
    at += got;
    offset += std::uint64_t(got);
    count -= std::size_t(got);
  }
  return true;
}

InputStart::InputStart(const std::string& path, std::size_t count) : regular_(is_regular_input(path)) {
  Descriptor from = opened(path);
  bytes_.resize(count);
  std::size_t done = 0;
  while (done < count) {
    const ssize_t got = ::read(from.number, bytes_.data() + done, count - done);
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) throw Error(shown_input(path) + ": " + cause_of(errno));
    if (got == 0) break;
    done += std::size_t(got);
  }
  bytes_.resize(done);
  if (!regular_ && from.owned) {
    descriptor_ = from.number;
    from.owned = false;
  }
}

InputStart::~InputStart() {
  if (descriptor_ >= 0) close(descriptor_);
}

}  // namespace slipwave
