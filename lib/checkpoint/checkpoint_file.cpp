// SPDX-License-Identifier: BSD-3-Clause
#include "checkpoint/checkpoint_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>

#include "base/error.hpp"

namespace slipwave {
namespace {

constexpr std::size_t block_bytes = std::size_t(1) << 18;
/// What every checkpoint begins with; the format follows, the checksum of all before it ends the file.
constexpr std::array<char, 24> mark = {"slipwave checkpoint\n\x1a\r\n"};
constexpr std::uint64_t header_bytes = mark.size() + sizeof(std::uint64_t);

std::string directory_of(const std::string& path) {
  const std::filesystem::path at(path);
  return at.has_parent_path() ? at.parent_path().string() : ".";
}

/// Reads as many bytes as are asked for; throws where the file ends before.
void read_at(int descriptor, const std::string& path, char* to, std::size_t count, std::uint64_t from) {
  while (count > 0) {
    const ssize_t got = pread(descriptor, to, count, off_t(from));
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) fail_on(path, errno);
    if (got == 0) throw Error(path + ": ended while it was read, expected it to stay as it is");
    to += got;
    count -= std::size_t(got);
    from += std::uint64_t(got);
  }
}

void synchronize(int descriptor, const std::string& path) {
  while (fsync(descriptor) != 0)
    if (errno != EINTR) fail_on(path, errno);
}

}  // namespace

std::string older_checkpoint(const std::string& path) { return path + ".1"; }

CheckpointWriter::CheckpointWriter(std::string path)
    : path_(std::move(path)), file_(in_place(path_, [&] {
        return Temporary(directory_of(path_), '.' + std::filesystem::path(path_).filename().string() + '.');
      })) {
  buffer_.reserve(block_bytes);
  auto begin = mark;
  auto format = checkpoint_format;
  bytes(begin.data(), begin.size());
  value(format);
}

void CheckpointWriter::bytes(void* first, std::size_t count) {
  const char* from = static_cast<const char*>(first);
  while (count > 0) {
    const auto taken = std::min(count, block_bytes - buffer_.size());
    buffer_.insert(buffer_.end(), from, from + taken);
    from += taken;
    count -= taken;
    if (buffer_.size() == block_bytes) flush();
  }
}

std::size_t CheckpointWriter::count(std::size_t now, std::size_t) {
  std::uint64_t number = now;
  value(number);
  return now;
}

void CheckpointWriter::flush() {
  checksum_.add(buffer_.data(), buffer_.size());
  put(buffer_.data(), buffer_.size());
  buffer_.clear();
}

void CheckpointWriter::put(const char* from, std::size_t count) {
  while (count > 0) {
    const ssize_t written = ::write(file_.descriptor(), from, count);
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) fail_on(path_, errno);
    from += written;
    count -= std::size_t(written);
    bytes_ += std::uint64_t(written);
  }
}

void CheckpointWriter::commit() {
  flush();
  checksum_.add(bytes_);
  const std::uint64_t sum = checksum_.sum();
  put(reinterpret_cast<const char*>(&sum), sizeof sum);
  synchronize(file_.descriptor(), path_);
  const std::string older = older_checkpoint(path_);
  if (access(path_.c_str(), F_OK) == 0) {
    unlink(older.c_str());
    // Where there are no hard links, the older one alone is there for a moment.
    if (link(path_.c_str(), older.c_str()) != 0 && std::rename(path_.c_str(), older.c_str()) != 0)
      fail_on(older, errno);
  }
  in_place(path_, [&] { file_.rename_to(path_); });
  // The names reach the disk, too; not every file system knows that of directories.
  const int directory = open(directory_of(path_).c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (directory < 0) return;
  fsync(directory);
  close(directory);
}

CheckpointPart::CheckpointPart(int descriptor, std::string path, std::uint64_t begin, std::uint64_t end)
    : descriptor_(descriptor), path_(std::move(path)), at_(begin), end_(end) {}

void CheckpointPart::bytes(void* first, std::size_t count) {
  char* to = static_cast<char*>(first);
  if (count > left()) throw Error(path_ + ": ends too early, expected more to be kept in it");
  const auto kept = std::min(count, buffer_.size() - used_);
  std::copy_n(buffer_.data() + used_, kept, to);
  used_ += kept;
  to += kept;
  count -= kept;
  if (count == 0) return;
  if (count >= block_bytes) {
    read_at(descriptor_, path_, to, count, at_);
    at_ += count;
    return;
  }
  buffer_.resize(std::size_t(std::min<std::uint64_t>(block_bytes, end_ - at_)));
  read_at(descriptor_, path_, buffer_.data(), buffer_.size(), at_);
  at_ += buffer_.size();
  std::copy_n(buffer_.data(), count, to);
  used_ = count;
}

std::size_t CheckpointPart::count(std::size_t, std::size_t piece_bytes) {
  std::uint64_t number = 0;
  value(number);
  if (number > left() / piece_bytes)
    throw Error(path_ + ": found " + std::to_string(number) + " values announced, expected as many as fit");
  return std::size_t(number);
}

CheckpointPart CheckpointPart::part(std::uint64_t count) {
  if (count > left()) throw Error(path_ + ": ends too early, expected more to be kept in it");
  const std::uint64_t begin = at_ - (buffer_.size() - used_);
  buffer_.clear();
  used_ = 0;
  at_ = begin + count;
  return {descriptor_, path_, begin, begin + count};
}

CheckpointReader::CheckpointReader(const std::string& path)
    : path_(path), descriptor_(open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK)) {
  if (descriptor_ < 0) fail_on(path_, errno);
  try {
    check();
  } catch (...) {
    close(descriptor_);
    throw;
  }
}

CheckpointReader::~CheckpointReader() { close(descriptor_); }

void CheckpointReader::refuse(const std::string& sentence) const { throw Error(path_ + ": " + sentence); }

void CheckpointReader::check() {
  struct stat status {};
  if (fstat(descriptor_, &status) != 0) fail_on(path_, errno);
  if (!S_ISREG(status.st_mode)) refuse("is not a regular file, expected a checkpoint of sw-shoot");
  bytes_ = std::uint64_t(status.st_size);
  std::array<char, mark.size()> begin{};
  std::uint64_t format = 0, sum = 0;
  if (bytes_ < header_bytes + sizeof sum) refuse("is not a checkpoint of sw-shoot, or cut off");
  read_at(descriptor_, path_, begin.data(), begin.size(), 0);
  if (begin != mark) refuse("is not a checkpoint of sw-shoot, or damaged");
  read_at(descriptor_, path_, reinterpret_cast<char*>(&format), sizeof format, mark.size());
  if (format != checkpoint_format)
    refuse("found a checkpoint of format " + std::to_string(format) + ", expected " +
           std::to_string(checkpoint_format));
  Checksum checksum;
  std::vector<char> block(block_bytes);
  const std::uint64_t summed = bytes_ - sizeof sum;
  for (std::uint64_t at = 0; at < summed; at += block.size()) {
    const auto count = std::size_t(std::min<std::uint64_t>(block.size(), summed - at));
    read_at(descriptor_, path_, block.data(), count, at);
    checksum.add(block.data(), count);
  }
  checksum.add(summed);
  read_at(descriptor_, path_, reinterpret_cast<char*>(&sum), sizeof sum, summed);
  if (sum != checksum.sum()) refuse("is damaged or cut off, its checksum is not that of what it holds");
}

CheckpointPart CheckpointReader::content() const {
  return {descriptor_, path_, header_bytes, bytes_ - sizeof(std::uint64_t)};
}

}  // namespace slipwave
