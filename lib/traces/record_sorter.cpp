// SPDX-License-Identifier: BSD-3-Clause
#include "traces/record_sorter.hpp"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <limits>
#include <queue>
#include <utility>

#include "base/error.hpp"

namespace slipwave {
namespace {

constexpr std::size_t usual_block = 4 << 20;
constexpr std::size_t least_block = 1 << 16;
constexpr std::size_t buffer_bytes = 1 << 20;

}  // namespace

/// Walks through the records of one part: keys, then the size, then the bytes of each.
class RecordSorter::PartReader {
 public:
  PartReader(const RecordSorter& sorter, const Part& part, std::size_t block)
      : sorter_(sorter), at_(part.begin), end_(part.end), block_(block), keys_(sorter.keys_) {}

  bool next() {
    if (begin_ == have_ && at_ == end_) return false;
    std::uint64_t size = 0;
    const std::size_t head = keys_.size() * sizeof(double);
    const std::uint8_t* from = want(head + sizeof size);
    std::memcpy(keys_.data(), from, head);
    std::memcpy(&size, from + head, sizeof size);
    record_ = {want(static_cast<std::size_t>(size)), static_cast<std::size_t>(size)};
    return true;
  }
  const std::vector<double>& keys() const { return keys_; }
  std::span<const std::uint8_t> record() const { return record_; }

 private:
  /// The next bytes, taken.
  const std::uint8_t* want(std::size_t count) {
    if (have_ - begin_ < count) {
      std::copy(buffer_.begin() + std::ptrdiff_t(begin_), buffer_.begin() + std::ptrdiff_t(have_),
                buffer_.begin());
      have_ -= begin_;
      begin_ = 0;
      buffer_.resize(std::max({buffer_.size(), count, block_}));
      while (have_ < count) fill();
    }
    begin_ += count;
    return buffer_.data() + (begin_ - count);
  }
  void fill() {
    const auto room = std::min<std::uint64_t>(buffer_.size() - have_, end_ - at_);
    const ssize_t got = ::pread(sorter_.file_->descriptor(), buffer_.data() + have_,
                                static_cast<std::size_t>(room), static_cast<off_t>(at_));
    if (got < 0 && errno == EINTR) return;
    if (got <= 0)
      throw Error(sorter_.directory_ +
                  ": reading the temporary file: " + (got < 0 ? cause_of(errno) : "it ends early"));
    have_ += static_cast<std::size_t>(got);
    at_ += static_cast<std::uint64_t>(got);
  }

  const RecordSorter& sorter_;
  std::uint64_t at_, end_;
  std::size_t block_;
  std::vector<double> keys_;
  std::span<const std::uint8_t> record_;
  std::vector<std::uint8_t> buffer_;
  std::size_t begin_ = 0, have_ = 0;
};

RecordSorter::RecordSorter(std::size_t keys, std::uint64_t memory_bytes, std::string directory)
    : keys_(keys),
      memory_bytes_(std::max<std::uint64_t>(memory_bytes, 1 << 20)),
      directory_(std::move(directory)) {}

RecordSorter::~RecordSorter() = default;

std::uint8_t* RecordSorter::room_for(std::size_t bytes) {
  if (blocks_.empty() || block_bytes_ - block_used_ < bytes) {
    const auto share = static_cast<std::size_t>(memory_bytes_ / 16);
    block_bytes_ = std::max(bytes, std::clamp(share, least_block, usual_block));
    blocks_.emplace_back(new std::uint8_t[block_bytes_]);
    held_bytes_ += block_bytes_;
    most_held_ = std::max(most_held_, held_bytes_);
    block_used_ = 0;
  }
  block_used_ += bytes;
  return blocks_.back().get() + (block_used_ - bytes);
}

void RecordSorter::add(std::span<const double> keys, std::span<const std::uint8_t> record) {
  const std::uint64_t overhead = sizeof(Held) + keys_ * sizeof(double);
  // vectors that grow hold up to twice, and while they do three times, of what is in them
  if (!held_.empty() && held_bytes_ + 3 * overhead * held_.size() + record.size() > memory_bytes_)
    write_part();
  std::uint8_t* const room = room_for(record.size());
  std::copy(record.begin(), record.end(), room);
  held_.push_back({held_.size(), room, record.size()});
  for (const double key : keys)
    held_keys_.push_back(std::isnan(key) ? std::numeric_limits<double>::infinity() : key);
  ++count_;
}

bool RecordSorter::before(const Held& a, const Held& b) const {
  for (std::size_t k = 0; k < keys_; ++k) {
    const double of_a = held_keys_[a.number * keys_ + k];
    const double of_b = held_keys_[b.number * keys_ + k];
    if (of_a != of_b) return of_a < of_b;
  }
  return a.number < b.number;
}

void RecordSorter::sort_held() {
  std::sort(held_.begin(), held_.end(), [this](const Held& a, const Held& b) { return before(a, b); });
}

void RecordSorter::flush() {
  const std::uint8_t* from = buffer_.data();
  std::size_t left = buffer_.size();
  while (left > 0) {
    const ssize_t written = ::write(file_->descriptor(), from, left);
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) throw Error(directory_ + ": writing a temporary file: " + cause_of(errno));
    from += written;
    left -= static_cast<std::size_t>(written);
  }
  on_disk_ += buffer_.size();
  buffer_.clear();
}

void RecordSorter::put(const void* bytes, std::size_t count) {
  const auto* from = static_cast<const std::uint8_t*>(bytes);
  buffer_.insert(buffer_.end(), from, from + count);
  if (buffer_.size() >= buffer_bytes) flush();
}

void RecordSorter::write_part() {
  if (!file_)
    file_ = in_place(directory_, [&] { return std::make_unique<Temporary>(directory_, "slipwave."); });
  sort_held();
  const std::uint64_t begin = on_disk_;
  for (const Held& held : held_) {
    put(held_keys_.data() + held.number * keys_, keys_ * sizeof(double));
    const std::uint64_t size = held.size;
    put(&size, sizeof size);
    put(held.bytes, held.size);
  }
  flush();
  parts_.push_back({begin, on_disk_});
  held_.clear();
  held_keys_.clear();
  blocks_.clear();
  held_bytes_ = 0;
}

void RecordSorter::deliver(const std::function<void(std::span<const std::uint8_t>)>& take) {
  if (parts_.empty()) {
    sort_held();
    for (const Held& held : held_) take({held.bytes, held.size});
    return;
  }
  if (!held_.empty()) write_part();
  held_ = {};
  held_keys_ = {};
  buffer_ = {};
  const auto share = static_cast<std::size_t>(memory_bytes_ / parts_.size());
  std::vector<PartReader> readers;
  for (const Part& part : parts_)
    readers.emplace_back(*this, part, std::clamp<std::size_t>(share, 4096, usual_block));
  const auto later = [&](std::size_t a, std::size_t b) {
    if (readers[a].keys() != readers[b].keys()) return readers[b].keys() < readers[a].keys();
    return b < a;  // parts are in the order in which the records came
  };
  std::priority_queue<std::size_t, std::vector<std::size_t>, decltype(later)> next(later);
  for (std::size_t part = 0; part < readers.size(); ++part)
    if (readers[part].next()) next.push(part);
  while (!next.empty()) {
    const std::size_t part = next.top();
    next.pop();
    take(readers[part].record());
    if (readers[part].next()) next.push(part);
  }
}

}  // namespace slipwave
