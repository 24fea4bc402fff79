#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "solver/kernels/kernels.hpp"

namespace slipwave::solver {

/// Of each line the cells that have neighbours of their own material on both sides along an axis, in runs of
/// whole blocks. What they gain in a sweep needs no values at faces (theory.md (E9a)). Which cells these are
/// depends on the material alone, not on how sweeps are cut.
class UniformInterior {
 public:
  /// The next line has these, one behind the other.
  void add_line(std::span<const IndexRange> runs);
  std::span<const IndexRange> of(std::int64_t line) const {
    const auto number = std::size_t(line);
    if (number + 1 >= first_.size()) return {};
    return {runs_.data() + first_[number], first_[number + 1] - first_[number]};
  }
  bool empty() const { return runs_.empty(); }

 private:
  std::vector<IndexRange> runs_;
  std::vector<std::size_t> first_ = {0};
};

/// Cuts columns into what is in the runs and what is not. The first `less` cells of a run do not count.
template <class In, class Out>
void tell_apart(std::span<const IndexRange> runs, std::int64_t less, const IndexRange& columns, In&& in,
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
