// SPDX-License-Identifier: BSD-3-Clause
#include "scene/model_ground.hpp"

#include "base/instantiate.hpp"

namespace slipwave {

template <int D>
bool see(Ground<D>& ground, const Medium<D>& medium) {
  const auto& grid = medium.grid();
  const std::int64_t before = grid.first[D - 1];
  const auto matter = [&](Index<D> at) {
    at[D - 1] -= before;
    const auto cell = std::size_t(grid.flat(at));
    return medium.is_void(cell) ? Matter::nothing : medium.is_fluid(cell) ? Matter::fluid : Matter::rock;
  };
  for (std::int64_t row = 0; row < grid.shape[D - 1]; ++row)
    if (ground.see_row(before + row, matter)) return true;
  return false;
}

SLIPWAVE_INSTANTIATE_D(FUNCTION, see);

}  // namespace slipwave
