// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstring>
#include <vector>

#include "base/archive.hpp"
#include "solver/sweep/state.hpp"

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
        lines_(std::size_t(state.layout.lines()), 0) {}

  /// Whether all cells of some lines are zero.
  bool are_zero(const IndexRange& lines) const {
    return lines.empty() || !std::memchr(lines_.data() + lines.first, 1, std::size_t(lines.count()));
  }
  /// Whether all blocks these columns touch are zero; columns beyond the line do not count.
  bool is_zero(std::int64_t line, const IndexRange& columns) const {
    const std::int64_t first = std::max<std::int64_t>(columns.first / block, 0);
    const std::int64_t last = std::min((columns.last + block - 1) / block, blocks_);
    return last <= first || !lines_[std::size_t(line)] ||
           !std::memchr(active_.data() + line * blocks_ + first, 1, std::size_t(last - first));
  }
  /// Marks those blocks of these columns that are no longer zero.
  void mark(std::int64_t line, const IndexRange& columns);
  std::int64_t memory_bytes() const { return std::int64_t(active_.size() + lines_.size()); }
  void serialize(Archive& archive);

 private:
  static constexpr std::int64_t block = Layout<D>::block;
  const State<D, Real>& state_;
  std::int64_t blocks_;
  std::vector<char> active_;  // [line][block]
  std::vector<char> lines_;   // whether any block of a line is
};

}  // namespace slipwave::solver
