#pragma once

#include <algorithm>
#include <cstring>
#include <vector>

#include "base/archive.hpp"
#include "solver/sweep/state.hpp"

namespace slipwave::solver {

/// Which blocks of cells may hold anything but zero. Nothing has come to the others yet: what a sweep makes
/// of zeros is zero, to the last bit, and need not be computed. Lines may be asked and told by the thread
/// that works on them.
template <int D, class Real>
class ActiveCells {
 public:
  explicit ActiveCells(const State<D, Real>& state)
      : state_(state),
        blocks_(state.layout.padded_nx() / block),
        active_(std::size_t(state.layout.lines() * blocks_), 0) {}

  /// Whether all blocks these columns touch are zero; columns beyond the line do not count.
  bool is_quiet(std::int64_t line, const IndexRange& columns) const {
    const std::int64_t first = std::max<std::int64_t>(columns.first / block, 0);
    const std::int64_t last = std::min((columns.last + block - 1) / block, blocks_);
    return last <= first ||
           !std::memchr(active_.data() + line * blocks_ + first, 1, std::size_t(last - first));
  }
  /// Looks at the blocks of these columns that were quiet.
  void look(std::int64_t line, const IndexRange& columns);
  std::int64_t memory_bytes() const { return std::int64_t(active_.size()); }
  void serialize(Archive& archive) { archive.fixed(active_); }

 private:
  static constexpr std::int64_t block = Layout<D>::block;
  const State<D, Real>& state_;
  std::int64_t blocks_;
  std::vector<char> active_;  // [line][block]
};

}  // namespace slipwave::solver
