// SPDX-License-Identifier: BSD-3-Clause
#include "checkpoint/snapshot_log.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cassert>
#include <cerrno>
#include <filesystem>

#include "base/error.hpp"
#include "base/instantiate.hpp"
#include "io/temporary.hpp"

namespace slipwave {
namespace {}  // namespace

template <int D>
SnapshotLog<D>::SnapshotLog(const std::string& path, const Grid<D>& grid, std::size_t fields,
                            const SnapshotMark& mark, const Take& take)
    : path_(path), grid_(grid), mark_(mark) {
  const int begin_anew = mark.bytes == 0 ? O_CREAT | O_TRUNC : 0;
  descriptor_ = open(path.c_str(), O_RDWR | O_CLOEXEC | O_NOFOLLOW | begin_anew, 0600);
  if (descriptor_ < 0) fail_on(path_, errno);
  try {
    replay(take, fields);
    if (ftruncate(descriptor_, off_t(mark_.bytes)) != 0) fail_on(path_, errno);
  } catch (...) {
    close(descriptor_);
    throw;
  }
}

template <int D>
SnapshotLog<D>::~SnapshotLog() {
  close(descriptor_);
}

template <int D>
void SnapshotLog<D>::replay(const Take& take, std::size_t fields) {
  struct stat status {};
  if (fstat(descriptor_, &status) != 0) fail_on(path_, errno);
  if (std::uint64_t(status.st_size) < mark_.bytes)
    throw Error(path_ + ": found " + std::to_string(status.st_size) + " bytes, expected the " +
                std::to_string(mark_.bytes) + " of which the checkpoint knows");
  const auto get = [&](void* first, std::size_t count) {
    char* to = static_cast<char*>(first);
    while (count > 0) {
      const ssize_t got = ::read(descriptor_, to, count);
      if (got < 0 && errno == EINTR) continue;
      if (got < 0) fail_on(path_, errno);
      if (got == 0) throw Error(path_ + ": ended while it was read, expected it to stay as it is");
      to += got;
      count -= std::size_t(got);
    }
  };
  const std::uint64_t a_time = sizeof(double) + fields * std::uint64_t(grid_.size()) * sizeof(float);
  const auto damaged = [&] { return Error(path_ + ": does not hold what the checkpoint says of it"); };
  if (mark_.bytes != mark_.times * a_time) throw damaged();
  // Checked once before anything of it is used.
  for (const bool use : {false, true}) {
    if (lseek(descriptor_, 0, SEEK_SET) != 0) fail_on(path_, errno);
    Checksum checksum;
    for (std::uint64_t n = 0; n < mark_.times; ++n) {
      double time_s = 0;
      get(&time_s, sizeof time_s);
      checksum.add(&time_s, sizeof time_s);
      std::vector<Field<D>> all;
      for (std::size_t field = 0; field < fields; ++field) {
        all.emplace_back(grid_);
        get(all.back().data(), all.back().size() * sizeof(float));
        checksum.add(all.back().data(), all.back().size() * sizeof(float));
      }
      if (use) take(time_s, all);
    }
    if (checksum.sum() != mark_.checksum) throw damaged();
  }
}

template <int D>
void SnapshotLog<D>::put(const void* first, std::size_t count) {
  const char* from = static_cast<const char*>(first);
  Checksum checksum(mark_.checksum);
  checksum.add(first, count);
  mark_.checksum = checksum.sum();
  mark_.bytes += count;
  while (count > 0) {
    const ssize_t written = ::write(descriptor_, from, count);
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) fail_on(path_, errno);
    from += written;
    count -= std::size_t(written);
  }
}

template <int D>
void SnapshotLog<D>::append(double time_s, const std::vector<Field<D>>& fields) {
  if (!failure_.empty()) return;
  const auto before = mark_;
  try {
    put(&time_s, sizeof time_s);
    for (const auto& field : fields) {
      assert(field.grid() == grid_);
      put(field.data(), field.size() * sizeof(float));
    }
    ++mark_.times;
  } catch (const Error& error) {
    failure_ = error.what();
    mark_ = before;
  }
}

template <int D>
SnapshotMark SnapshotLog<D>::synchronized() {
  if (!failure_.empty()) throw Error(failure_);
  while (fsync(descriptor_) != 0)
    if (errno != EINTR) fail_on(path_, errno);
  return mark_;
}

void remove_snapshot_logs(const std::string& begin) {
  const std::filesystem::path path(begin);
  const std::string log = path.filename().string();
  std::error_code failed;
  for (const auto& entry :
       std::filesystem::directory_iterator(path.has_parent_path() ? path.parent_path() : ".", failed)) {
    const auto name = entry.path().filename().string();
    if (name.compare(0, log.size(), log) == 0 && name.size() > log.size() &&
        name.find_first_not_of("0123456789", log.size()) == std::string::npos)
      unlink(entry.path().c_str());
  }
}

SLIPWAVE_INSTANTIATE_D(TYPE, class SnapshotLog);

}  // namespace slipwave
