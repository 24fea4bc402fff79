// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <utility>
#include <vector>

#include "model/model.hpp"

namespace slipwave {

/// Clusters of slip planes in cells of another size: a solid cell belongs to the cluster that fills most of
/// it, and slips in the share that it fills (theory.md 2.11), under the mean prestress of those parts.
template <int D>
class ClusterShares {
 public:
  /// Both outlive this.
  ClusterShares(const Model<D>& from, Model<D>& to) : from_(from), to_(to) {}
  /// A part of the cell that is being filled: an old cell and how much of it lies in the new one.
  void add(std::size_t part, double volume) {
    if (!from_.fracture.empty()) parts_.emplace_back(part, volume);
  }
  /// Gives a cell the cluster, share and prestress of the parts that were added, its material being there
  /// already; the parts are forgotten.
  void put(std::size_t cell);

 private:
  const Model<D>& from_;
  Model<D>& to_;
  std::vector<std::pair<std::size_t, double>> parts_;
};

}  // namespace slipwave
