// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "io/temporary.hpp"

namespace slipwave {

/// Sorts any number of byte strings by numbers that come with them, in bounded memory: what does not fit is
/// sorted in parts, each written to a private temporary file, and the parts are merged at the end. Ascending
/// by the first key, then the second, ...; NaN comes last; equal ones stay in the order in which they came.
class RecordSorter {
 public:
  /// `keys` numbers a record. At most about `memory_bytes` are held (at least one record and 1 MiB). The
  /// temporary file, if one is needed, goes into `directory` and takes as much room as all records.
  RecordSorter(std::size_t keys, std::uint64_t memory_bytes, std::string directory);
  ~RecordSorter();

  /// Copies a record. Throws Error naming the directory when the temporary file cannot be written.
  void add(std::span<const double> keys, std::span<const std::uint8_t> record);
  /// All records in order, each valid until `take` returns. Once, at the end.
  void deliver(const std::function<void(std::span<const std::uint8_t>)>& take);

  std::int64_t count() const noexcept { return count_; }
  /// Bytes held for records at most so far.
  std::uint64_t most_held() const noexcept { return most_held_; }
  /// Bytes in the temporary file; 0 when memory sufficed.
  std::uint64_t on_disk() const noexcept { return on_disk_; }
  std::size_t parts() const noexcept { return parts_.size(); }

 private:
  /// A record in memory.
  struct Held {
    std::size_t number;  // in the order in which they came
    const std::uint8_t* bytes;
    std::size_t size;
  };
  /// A part of the temporary file in which sorted records lie, in bytes.
  struct Part {
    std::uint64_t begin, end;
  };
  class PartReader;

  bool before(const Held& a, const Held& b) const;
  std::uint8_t* room_for(std::size_t bytes);
  void sort_held();
  void write_part();
  void put(const void* bytes, std::size_t count);
  void flush();

  std::size_t keys_;
  std::uint64_t memory_bytes_;
  std::string directory_;
  std::int64_t count_ = 0;
  std::vector<Held> held_;
  std::vector<double> held_keys_;  // keys_ numbers a record, by Held::number
  std::vector<std::unique_ptr<std::uint8_t[]>> blocks_;
  std::size_t block_bytes_ = 0, block_used_ = 0;  // of the last block
  std::uint64_t held_bytes_ = 0, most_held_ = 0;
  std::unique_ptr<Temporary> file_;
  std::vector<Part> parts_;
  std::uint64_t on_disk_ = 0;
  std::vector<std::uint8_t> buffer_;
};

}  // namespace slipwave
