// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/memory.hpp"
#include "solver/kernels/kernels.hpp"

namespace slipwave::solver {

/// Cells, each with its column `x`, by line, then column.
template <class Cell>
struct ByLine {
  std::vector<Cell> cells;
  std::vector<std::int64_t> first = {0};  // number of the first cell of each line, and the end

  bool empty() const { return cells.empty(); }
  const Cell& operator[](std::int64_t n) const { return cells[std::size_t(n)]; }
  void end_line() { first.push_back(std::int64_t(cells.size())); }
  /// Ends all lines before this one.
  void end_lines_before(std::int64_t line) {
    while (std::int64_t(first.size()) <= line) end_line();
  }
  std::int64_t count(std::int64_t line) const { return end(line) - first[std::size_t(line)]; }
  /// Whether a line holds none.
  bool empty(std::int64_t line) const { return count(line) == 0; }
  /// The number after the last of a line.
  std::int64_t end(std::int64_t line) const { return first[std::size_t(line) + 1]; }
  /// The number of the first of a line at this column or behind it.
  std::int64_t from(std::int64_t line, std::int64_t x) const {
    const auto begin = cells.begin(), of_line = begin + first[std::size_t(line)];
    if (x <= 0) return of_line - begin;
    // Where all columns before this one have a cell, which is common, no search is needed.
    if (x < begin + end(line) - of_line && of_line[x].x == x) return of_line + x - begin;
    return std::lower_bound(of_line, begin + end(line), x,
                            [](const Cell& one, std::int64_t column) { return one.x < column; }) -
           begin;
  }
  /// Numbers of those of a line in these columns; none of a line below 0, which is beyond the grid.
  IndexRange in(std::int64_t line, const IndexRange& columns) const {
    return line < 0 ? IndexRange{} : IndexRange{from(line, columns.first), from(line, columns.last)};
  }
  /// The cell in a column, null where there is none.
  const Cell* find(std::int64_t line, std::int64_t x) const {
    const auto n = from(line, x);
    return n < end(line) && (*this)[n].x == x ? &(*this)[n] : nullptr;
  }
  std::int64_t memory_bytes() const { return bytes_of(cells) + bytes_of(first); }
};

}  // namespace slipwave::solver
