#include "base/input_bytes.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>

#include "base/error.hpp"
#include "base/temporary.hpp"

namespace slipwave {
namespace {

struct Descriptor {
  int number;
  bool owned;
  ~Descriptor() {
    if (owned && number >= 0) close(number);
  }
};

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

std::vector<char> read_all(const std::string& path) {
  const bool regular = is_regular_input(path);
  const std::string name = shown_input(path);
  if (path == "-" && isatty(STDIN_FILENO)) {
    throw Error(name + " is a terminal; expected a file name, or a pipe for -", ErrorKind::usage);
  }
  const Descriptor from{path == "-" ? STDIN_FILENO : open(path.c_str(), O_RDONLY | O_CLOEXEC), path != "-"};
  if (from.number < 0) throw Error(name + ": " + cause_of(errno));
  std::vector<char> bytes;
  struct stat status {};
  if (regular && fstat(from.number, &status) == 0) bytes.reserve(std::size_t(status.st_size) + 1);
  constexpr std::size_t block = std::size_t(1) << 18;
  for (;;) {
    const std::size_t before = bytes.size();
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

}  // namespace slipwave
