// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <limits>
#include <vector>

#include "base/archive.hpp"
#include "solver/sweep/sweeps.hpp"

namespace slipwave::solver {

/// Which blocks of cells may hold anything but zero. No wave has reached the others yet: a sweep over zeros
/// gives zeros, to the last bit, and need not be computed. The thread that works on a row may read and mark
/// it.
template <int D, class Real>
class ActiveCells {
 public:
  explicit ActiveCells(const State<D, Real>& state)
      : state_(state),
        blocks_(state.layout.padded_nx() / block),
        active_(std::size_t(state.layout.lines() * blocks_), 0),
        lines_(std::size_t(state.layout.lines())) {}

  /// From the first to the last of the blocks which these columns touch that may not be zero in any of some
  /// lines, in cells; columns beyond a line do not count.
  IndexRange among(const IndexRange& lines, const IndexRange& columns) const {
    const auto first = std::max<std::int64_t>(columns.first, 0) / block,
               last = std::min((columns.last + block - 1) / block, blocks_);
    Blocks all;
    // Once waves are everywhere, the first line tells.
    for (auto line = lines.first; line < lines.last && (all.first > first || all.last < last); ++line)
      all.add(lines_[std::size_t(line)]);
    return {std::max<std::int64_t>(all.first, first) * block, std::min<std::int64_t>(all.last, last) * block};
  }
  /// Marks those blocks of these columns that are no longer zero, or whose faces are not at rest: a traction
  /// may be left where all motion is too small for a number, and a neighbour may give a state.
  void mark(std::int64_t line, const IndexRange& columns, const Sweeps<D, Real>& sweeps);
  std::int64_t memory_bytes() const { return bytes_of(active_) + bytes_of(lines_); }
  void serialize(Archive& archive);

 private:
  static constexpr std::int64_t block = Layout<D>::block;
  const State<D, Real>& state_;
  std::int64_t blocks_;
  std::vector<char> active_;  // [line][block]
  /// From the first to the last block of a line that is.
  struct Blocks {
    std::int32_t first = std::numeric_limits<std::int32_t>::max(), last = 0;
    void add(const Blocks& more) { first = std::min(first, more.first), last = std::max(last, more.last); }
  };
  std::vector<Blocks> lines_;
};

}  // namespace slipwave::solver
