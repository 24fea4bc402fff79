// SPDX-License-Identifier: BSD-3-Clause
#include "io/output_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <optional>
#include <system_error>
#include <vector>

#include "base/error.hpp"
#include "io/temporary.hpp"

namespace slipwave {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t buffer_bytes = std::size_t(1) << 18;

/// The mode a new file would get from open(): what the umask leaves of rw-rw-rw-.
mode_t mode_of_new_files() {
  const mode_t mask = umask(0);
  umask(mask);
  return 0666 & ~mask;
}

/// Returns where a symbolic link leads, so that the rename replaces the file and not the link.
std::string resolved(const std::string& path) {
  std::error_code failed;
  if (!fs::is_symlink(path, failed)) return path;
  const auto target = fs::weakly_canonical(path, failed);
  return failed ? path : target.string();
}

}  // namespace

struct OutputFile::Impl {
  std::string shown_name;
  std::string target;              // the file that commit() replaces; empty: written in place or streamed
  mode_t mode = 0666;              // of the target
  std::optional<Temporary> whole;  // becomes the target, or is copied to `stream` by commit()
  int stream = -1;                 // stdout or a special file
  bool owns_stream = false;
  bool through_library = false;
  std::vector<char> buffer;

  ~Impl() {
    if (owns_stream && stream >= 0) close(stream);
  }

  int descriptor() const { return whole ? whole->descriptor() : stream; }

  [[noreturn]] void fail(int error_number) const { throw Error(shown_name + ": " + cause_of(error_number)); }

  void put(const char* bytes, std::size_t count, int to) const {
    while (count > 0) {
      const ssize_t written = ::write(to, bytes, count);
      if (written < 0) {
        if (errno == EINTR) continue;
        fail(errno);
      }
      bytes += written;
      count -= std::size_t(written);
    }
  }

  void flush() {
    put(buffer.data(), buffer.size(), descriptor());
    buffer.clear();
  }

  void open_beside(const std::string& path) {
    target = resolved(path);
    const fs::path at(target);
    const std::string directory = at.has_parent_path() ? at.parent_path().string() : ".";
    struct stat status {};
    if (stat(target.c_str(), &status) == 0) {
      if (access(target.c_str(), W_OK) != 0) fail(errno);
      mode = status.st_mode & 0777;
    } else {
      mode = mode_of_new_files();
    }
    in_place(shown_name, [&] { whole.emplace(directory, '.' + at.filename().string() + "."); });
  }

  void copy_to_stream() {
    // By name: the library that wrote it may have replaced the file behind our descriptor.
    const int from = open(whole->path().c_str(), O_RDONLY | O_CLOEXEC);
    if (from < 0) fail(errno);
    std::vector<char> block(buffer_bytes);
    for (;;) {
      const ssize_t count = ::read(from, block.data(), block.size());
      if (count < 0 && errno == EINTR) continue;
      if (count < 0) {
        const int error_number = errno;
        close(from);
        fail(error_number);
      }
      if (count == 0) break;
      put(block.data(), std::size_t(count), stream);
    }
    close(from);
  }
};

OutputFile::OutputFile(const std::string& path, Content content) : impl_(std::make_unique<Impl>()) {
  impl_->shown_name = path == "-" ? "standard output" : path;
  if (path.empty()) throw Error("the output has no name; expected a file or -", ErrorKind::usage);
  if (path == "-") {
    if (content == Content::binary && isatty(STDOUT_FILENO)) {
      throw Error("standard output is a terminal and the output is binary; expected -o FILE or a pipe",
                  ErrorKind::usage);
    }
    impl_->stream = STDOUT_FILENO;
    return;
  }
  struct stat status {};
  const bool exists = stat(path.c_str(), &status) == 0;
  if (!exists && errno != ENOENT) impl_->fail(errno);
  if (exists && S_ISDIR(status.st_mode)) throw Error(path + ": is a directory, expected a file");
  if (exists && !S_ISREG(status.st_mode)) {
    impl_->stream = open(path.c_str(), O_WRONLY | O_CLOEXEC);
    if (impl_->stream < 0) impl_->fail(errno);
    impl_->owns_stream = true;
    return;
  }
  impl_->open_beside(path);
}

OutputFile::~OutputFile() = default;

void OutputFile::write(const void* bytes, std::size_t count) {
  Impl& self = *impl_;
  const char* from = static_cast<const char*>(bytes);
  if (self.buffer.capacity() == 0) self.buffer.reserve(buffer_bytes);
  if (self.buffer.size() + count > buffer_bytes) self.flush();
  if (count >= buffer_bytes) {
    self.put(from, count, self.descriptor());
  } else {
    self.buffer.insert(self.buffer.end(), from, from + count);
  }
}

const std::string& OutputFile::path_for_libraries() {
  Impl& self = *impl_;
  if (!self.whole) {
    in_place(self.shown_name, [&] { self.whole.emplace(temporary_directory(), "slipwave."); });
  }
  self.through_library = true;
  return self.whole->path();
}

void OutputFile::commit() {
  Impl& self = *impl_;
  if (self.stream >= 0) {
    if (self.through_library) {
      self.copy_to_stream();
      self.whole.reset();
    } else {
      self.flush();
    }
    if (self.owns_stream) {
      const int stream = self.stream;
      self.stream = -1;
      if (close(stream) != 0) self.fail(errno);
    }
    return;
  }
  if (!self.through_library) self.flush();
  if (chmod(self.whole->path().c_str(), self.mode) != 0) self.fail(errno);
  in_place(self.shown_name, [&] { self.whole->rename_to(self.target); });
}

void OutputFile::commit_as(const std::string& path) {
  if (impl_->stream < 0) {
    impl_->shown_name = path;
    impl_->target = resolved(path);
  }
  commit();
}

const std::string& OutputFile::shown_name() const { return impl_->shown_name; }

void expect_other_files(const std::string& output, const std::vector<std::string>& inputs) {
  struct stat of_output {};
  if (output.empty() || output == "-" || stat(output.c_str(), &of_output) != 0) return;
  if (!S_ISREG(of_output.st_mode)) return;
  for (const auto& input : inputs) {
    struct stat of_input {};
    if (input.empty() || input == "-" || stat(input.c_str(), &of_input) != 0) continue;
    if (of_input.st_dev == of_output.st_dev && of_input.st_ino == of_output.st_ino)
      throw Error(output + ": is the input, expected another file for the output", ErrorKind::usage);
  }
}

}  // namespace slipwave
