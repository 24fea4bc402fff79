// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "checkpoint/checksum.hpp"
#include "grid/field.hpp"

namespace slipwave {

/// How far a log of snapshots had come.
struct SnapshotMark {
  std::uint64_t times = 0, bytes = 0;
  std::uint64_t checksum = Checksum().sum();
};

/// The snapshots of a shot as they were taken, in a private file beside its checkpoint: what a shot that is
/// taken up again does not see any more. A netCDF file cannot be cut back to an earlier moment; this one
/// can.
template <int D>
class SnapshotLog {
 public:
  using Take = std::function<void(double time_s, const std::vector<Field<D>>& fields)>;

  /// Continues behind the mark, or begins. `fields` a time, on this grid. Hands what lies before the mark to
  /// `take`, time after time. Throws an Error naming the file when that is not whole.
  SnapshotLog(const std::string& path, const Grid<D>& grid, std::size_t fields, const SnapshotMark& mark,
              const Take& take);
  SnapshotLog(const SnapshotLog&) = delete;
  SnapshotLog& operator=(const SnapshotLog&) = delete;
  ~SnapshotLog();

  /// What does not fit the disk any more ends no run: the log stays as it was before, for the checkpoints
  /// that there are, and takes no more.
  void append(double time_s, const std::vector<Field<D>>& fields);
  /// All that was appended is on the disk. Throws an Error naming the file where it is not.
  SnapshotMark synchronized();

 private:
  void replay(const Take& take, std::size_t fields);
  void put(const void* first, std::size_t count);

  std::string path_;
  int descriptor_ = -1;
  Grid<D> grid_;
  SnapshotMark mark_;
  std::string failure_;  // why it takes no more; empty: it does
};

/// Removes all files whose names are `begin` and a number.
void remove_snapshot_logs(const std::string& begin);

extern template class SnapshotLog<2>;
extern template class SnapshotLog<3>;

}  // namespace slipwave
