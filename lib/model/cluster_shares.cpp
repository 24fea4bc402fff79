// SPDX-License-Identifier: BSD-3-Clause
#include "model/cluster_shares.hpp"

#include <algorithm>

#include "base/instantiate.hpp"
#include "model/cluster_edge.hpp"

namespace slipwave {

template <int D>
void ClusterShares<D>::put(std::size_t cell) {
  const auto parts = std::exchange(parts_, {});
  // Single fractures are placed in the new cells by themselves.
  std::vector<double> filled(from_.fracture_sets.size() + 1, 0.);
  double all = 0;
  for (const auto& [part, volume] : parts) {
    all += volume;
    const auto code = from_.fracture[part];
    if (code != 0 && from_.fracture_sets[code - 1U].is_cluster())
      filled[code] += volume * fracture_share_of(from_, part);
  }
  const auto most = std::max_element(filled.begin(), filled.end());
  const auto code = std::size_t(most - filled.begin());
  if (!(*most > 0) || to_.medium.is_void(cell) || to_.medium.is_fluid(cell)) {
    if (!to_.fracture.empty()) to_.fracture[cell] = 0;
    return;
  }
  to_.fracture[cell] = std::uint8_t(code);
  // Of a cell of like ones rounding leaves no other share.
  const double share = std::abs(*most / all - 1) < 1e-9 ? 1 : *most / all;
  if (share < 1 && to_.fracture_share.empty()) {
    to_.fracture_share = Field<D>(to_.grid());
    std::fill(to_.fracture_share.begin(), to_.fracture_share.end(), 1.F);
  }
  if (!to_.fracture_share.empty()) to_.fracture_share[cell] = float(share);
  for (std::size_t c = 0; c < from_.prestress_pa.size(); ++c) {
    // Sums of differences keep what is alike exactly alike.
    double base = 0, sum = 0, volumes = 0;
    for (const auto& [part, volume] : parts) {
      if (from_.fracture[part] != code) continue;
      const double stress_pa = from_.prestress_pa[c][part];
      if (volumes == 0) base = stress_pa;
      sum += volume * (stress_pa - base), volumes += volume;
    }
    to_.prestress_pa[c][cell] = float(base + sum / volumes);
  }
}

SLIPWAVE_INSTANTIATE_D(TYPE, class ClusterShares);

}  // namespace slipwave
