// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <random>

#include "solver/sweep/interface_stencils.hpp"

namespace slipwave::solver {
namespace {

/// Cells that `is` says so of, from a cell outwards along an axis, up to `reach` of them and not beyond the
/// grid.
template <class Is>
bool any_within(const Field<2>& z, Index<2> at, int axis, int step, int reach, const Is& is) {
  const Index<2> from = at;
  for (int n = 1; n <= reach; ++n) {
    at[std::size_t(axis)] = from[std::size_t(axis)] + n * step;
    if (at[std::size_t(axis)] < 0 || at[std::size_t(axis)] >= z.grid().shape[std::size_t(axis)]) return false;
    if (is(z(at), z(from))) return true;
  }
  return false;
}

/// Media in which impedances are equal or differ by a strong interface: stencils end at the first cell that
/// differs, and a cell without waves counts where one with waves is near.
std::size_t counted(const Field<2>& z, int axis, int reach) {
  std::size_t count = 0;
  for (std::int64_t n = 0; n < z.grid().size(); ++n) {
    const auto at = z.grid().index(n);
    const auto differs = [](float other, float own) { return own > 0 ? other != own : other > 0; };
    count += any_within(z, at, axis, -1, reach, differs) || any_within(z, at, axis, 1, reach, differs);
  }
  return count;
}

TEST(InterfaceStencils, AreAllCellsWhoseStencilMeetsAnotherImpedance) {
  std::mt19937 engine(4);
  const std::array<float, 4> impedances = {0, 4e5F, 1.5e6F, 8e6F};
  EdgeLaws<2> mirrors{};
  mirrors[0] = mirrors[1] = {EdgeLaw::mirror, EdgeLaw::mirror};
  for (const Index<2>& shape : {Index<2>{70, 41}, {5, 60}, {64, 3}, {1, 1}}) {
    Field<2> z(Grid<2>{shape, 5, {0, 0}});
    // Blocks of random sizes over one material, so that some rows have long runs without an interface.
    for (auto& value : z) value = 1.5e6F;
    for (int block = 0; block < 4; ++block) {
      const float value = impedances[engine() % 4];
      const Index<2> low{std::int64_t(engine() % std::size_t(shape[0])),
                         std::int64_t(engine() % std::size_t(shape[1]))};
      for (Index<2> at = low; at[1] < std::min<std::int64_t>(low[1] + 6, shape[1]); ++at[1])
        for (at[0] = low[0]; at[0] < std::min<std::int64_t>(low[0] + 9, shape[0]); ++at[0]) z(at) = value;
    }
    for (const int axis : {0, 1})
      for (const int reach : {0, 1, 2, 3}) {
        const InterfaceStencils ends(StencilSearch<2>{.impedances = {&z},
                                                      .waves = {wave_p},
                                                      .edges = mirrors,
                                                      .axis = axis,
                                                      .reach = reach,
                                                      .rises_from = [](auto&&...) { return false; }});
        EXPECT_EQ(ends.size(), counted(z, axis, reach))
            << shape[0] << " x " << shape[1] << " cells, axis " << axis << ", reach " << reach;
      }
  }
}

}  // namespace
}  // namespace slipwave::solver
