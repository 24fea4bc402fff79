#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "base/memory.hpp"
#include "solver/kernels/kernels.hpp"

namespace slipwave::solver {

/// The cells of each row whose neighbours on both sides along an axis have their own material, in runs of
/// whole blocks. Their update needs no interface states (theory.md (E9a)). Which cells these are depends on
/// the material alone, not on the tiling.
class UniformInterior {
 public:
  /// Adds the runs of the next row, in the order of its cells.
  void add_line(std::span<const IndexRange> runs);
  std::span<const IndexRange> of(std::int64_t line) const {
    const auto number = std::size_t(line);
    if (number + 1 >= first_.size()) return {};
    return {runs_.data() + first_[number], first_[number + 1] - first_[number]};
  }
  bool empty() const { return runs_.empty(); }
  std::int64_t memory_bytes() const { return bytes_of(runs_) + bytes_of(first_); }

 private:
  std::vector<IndexRange> runs_;
  std::vector<std::size_t> first_ = {0};
};

/// Splits columns into those in the runs and the others. The first `less` cells of a run do not count.
template <class In, class Out>
void split_by_runs(std::span<const IndexRange> runs, std::int64_t less, const IndexRange& columns, In&& in,
                   Out&& out) {
  std::int64_t first = columns.first;
  for (const auto& run : runs) {
    const IndexRange here{std::max(run.first + less, first), std::min(run.last, columns.last)};
    if (here.first >= columns.last) break;
    if (here.empty()) continue;
    if (first < here.first) out(IndexRange{first, here.first});
    in(here);
    first = here.last;
  }
  if (first < columns.last) out(IndexRange{first, columns.last});
}

}  // namespace slipwave::solver
