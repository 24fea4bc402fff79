// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "model/model.hpp"
#include "solver/sweep/domain.hpp"
#include "solver/sweep/state.hpp"

namespace slipwave::solver {

/// Which cells of a fracture set: all, those that are in it whole, those that its edge cuts.
enum class CellKind { all, whole, cut };

/// This list says where the cells of one fracture set are stored: those of a row form segments of whole
/// vectors, in which cells of other sets or none may stand among them. Sets that continue outside the model
/// (continues_outside()) have cells in zones, too.
template <int D>
class FractureCells {
 public:
  /// Lists the cells of set number `set` (0-based) of the model.
  FractureCells(const Layout<D>& layout, const Domain<D>& domain, const Model<D>& model, std::size_t set,
                CellKind kind = CellKind::all);

  /// Neighbouring cells of a row, from column `first` on; the first of them is number `place`.
  struct Segment {
    std::int64_t first, last;
    std::size_t place;
  };
  /// Returns the segments of that row, ascending.
  std::span<const Segment> segments(std::int64_t line) const {
    return {segments_.data() + starts_[std::size_t(line)],
            starts_[std::size_t(line) + 1] - starts_[std::size_t(line)]};
  }
  /// Cells that belong to the set, and all that are stored.
  std::int64_t cells() const { return cells_; }
  std::size_t stored() const { return stored_; }
  std::int64_t memory_bytes() const {
    return std::int64_t(segments_.size() * sizeof(Segment) + starts_.size() * sizeof(std::size_t));
  }

  /// Hands out each cell of the set: its place among the stored ones, the number of the cell of the model
  /// that it is or is like, and whether it is that.
  void each(const Layout<D>& layout, const Domain<D>& domain, const Model<D>& model,
            const std::function<void(std::size_t place, std::size_t cell, bool in_model)>& with) const;

 private:
  bool belongs(const Model<D>& model, std::size_t cell) const;

  std::size_t set_;
  CellKind kind_;
  bool continues_;
  std::vector<Segment> segments_;
  std::vector<std::size_t> starts_;  // of each line, and the end
  std::size_t stored_ = 0;
  std::int64_t cells_ = 0;
};

}  // namespace slipwave::solver
