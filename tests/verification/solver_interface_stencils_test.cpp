// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <random>
#include <vector>

#include "solver/sweep/interface_stencils.hpp"

namespace slipwave::solver::solver_interface_stencils_test {
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

/// Water over rock of two kinds over a void, in rows; slots follow each other in rows.
template <class Real>
void expect_rows_as_their_cells(int order) {
  const Grid<2> grid{{29, 24}, 5, {0, 0}};
  Field<2> z(grid);
  for (std::int64_t n = 0; n < grid.size(); ++n) {
    const auto row = grid.index(n)[1];
    z[std::size_t(n)] = row < 8 ? 1.5e6F : row < 12 ? 9e6F : row < 18 ? 1.5e6F : 0.F;
  }
  EdgeLaws<2> mirrors{};
  mirrors[0] = mirrors[1] = {EdgeLaw::mirror, EdgeLaw::mirror};
  const auto slot_beside = [&](const Index<2>& at, int side) {
    const auto n = std::int32_t(grid.flat(at));
    return at[1] == 17 && side == 1 ? of_void(n) : n + (side == 1 ? std::int32_t(grid.shape[0]) : 0);
  };
  const int reach = reach_of(order);
  const InterfaceStencils stencils(StencilSearch<2>{.impedances = {&z},
                                                    .waves = {wave_p},
                                                    .edges = mirrors,
                                                    .axis = 1,
                                                    .reach = reach,
                                                    .rises_from = [](auto&&...) { return false; },
                                                    .slot_beside = slot_beside});
  std::mt19937 engine(6);
  const auto drawn = [&](double size) {
    std::vector<Real> all(std::size_t(grid.size() + 2 * reach * grid.shape[0]));
    for (auto& value : all) value = Real(size * std::uniform_real_distribution<double>(-1, 1)(engine));
    return all;
  };
  const auto v = drawn(1), s = drawn(5e6), of_v = drawn(0.1), of_s = drawn(1e5), bend = drawn(0.1);
  const PairCorrections<Real> corrections{
      of_v.data(),
      of_s.data(),
      nullptr,
      bend.data(),
      of_s.data(),
      of_s.data(),
      {{{of_v.data(), of_s.data(), nullptr}, {of_v.data(), of_s.data(), bend.data()}}}};
  std::int64_t together = 0;
  for (std::int64_t row = 0; row < 18; ++row) {
    const auto begin = std::size_t(row * grid.shape[0]);
    std::vector<Real> impedance(z.begin() + std::ptrdiff_t(begin),
                                z.begin() + std::ptrdiff_t(begin) + grid.shape[0]);
    const std::vector<Real> b(impedance.size(), Real(5e-8));
    const auto correct = [&](std::int64_t first, std::int64_t last, std::vector<Real>& up,
                             std::vector<Real>& down) {
      const auto from = begin + std::size_t(reach * grid.shape[0] + first);
      const PairOfLine<Real> pair{v.data() + from, s.data() + from, grid.shape[0], corrections, Real(-0.9)};
      MaterialRows<Real> material{};
      material.zp = impedance.data() + first, material.b = b.data() + first;
      stencils.correct(order, row, {first, last}, pair, material, up.data() + first, down.data() + first);
    };
    std::vector<Real> up(impedance.size()), down(up), up_alone(up), down_alone(up);
    correct(0, grid.shape[0], up, down);
    for (std::int64_t x = 0; x < grid.shape[0]; ++x) correct(x, x + 1, up_alone, down_alone);
    EXPECT_EQ(up, up_alone) << "order " << order << ", row " << row;
    EXPECT_EQ(down, down_alone) << "order " << order << ", row " << row;
    if (const auto* const first = stencils.find(row, 0)) together += first->alike;
  }
  EXPECT_GE(together, 5 * grid.shape[0]) << "order " << order;
}

TEST(InterfaceStencils, CorrectCellsThatAreAlikeAsEachAlone) {
  for (const int order : orders)
    if (order > 1) expect_rows_as_their_cells<float>(order), expect_rows_as_their_cells<double>(order);
}

}  // namespace
}  // namespace slipwave::solver::solver_interface_stencils_test
