// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "model/model.hpp"
#include "solver/sweep/domain.hpp"

namespace slipwave::solver {

/// Columns of a line that take two half sweeps along x, and the whole blocks computed for them.
struct Patch {
  IndexRange cells, blocks;
};

/// Patches say where slip needs two half sweeps along x instead of one merged sweep: the cells of fractures,
/// and those beside them whose second half sweep reads what slip has changed. They are the same with and
/// without slip: the difference must be the work of slip alone.
template <int D>
class Patches {
 public:
  Patches() = default;
  Patches(const Layout<D>& layout, const Domain<D>& domain, const Model<D>& model);

  /// Lines that take half sweeps as a whole, ascending: their patches are most of them or come close to an
  /// end.
  std::span<const std::int64_t> whole_lines() const { return whole_lines_; }
  /// Returns the patches of a line that does not take half sweeps as a whole, ascending; `margin` more cells
  /// on both sides of their blocks belong to no other patch.
  std::span<const Patch> of(std::int64_t line) const {
    if (patches_.empty()) return {};
    return {patches_.data() + starts_[std::size_t(line)],
            starts_[std::size_t(line) + 1] - starts_[std::size_t(line)]};
  }
  bool empty() const { return patches_.empty(); }

  /// What the first half sweep advances beyond a patch, and what it reads beyond that at most.
  static constexpr std::int64_t margin = Layout<D>::block, beyond = 2 * margin;

 private:
  std::vector<std::int64_t> whole_lines_;
  std::vector<Patch> patches_;
  std::vector<std::size_t> starts_;  // of each line, and the end
};

}  // namespace slipwave::solver
