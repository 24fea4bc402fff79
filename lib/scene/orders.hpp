// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// No standard header here: the inner loops include this, compiled once for each instruction set.
namespace slipwave {

/// Orders of the reconstruction in space (theory.md (E4), (E5)): the one list of them. Order 2 m + 1 reads m
/// cells to each side.
inline constexpr int orders[] = {1, 3, 5, 7, 9, 11};
/// Orders of the splitting in time.
inline constexpr int time_orders[] = {2, 4};
/// Cells that the reconstruction of an order reaches to each side.
constexpr int reach_of(int order) { return (order - 1) / 2; }
inline constexpr int order_count = sizeof(orders) / sizeof(orders[0]);
/// Cells the widest reconstruction reaches to each side.
inline constexpr int max_reach = reach_of(orders[order_count - 1]);
/// Cells that count as near a cell at an order, whether it reads them or not: three up to order 7.
constexpr int nearness_of(int order) { return reach_of(order) < 3 ? 3 : reach_of(order); }

/// Whether a list holds a number.
template <int Count>
constexpr bool holds(const int (&list)[Count], int number) {
  for (const int one : list)
    if (one == number) return true;
  return false;
}

}  // namespace slipwave
