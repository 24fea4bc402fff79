// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "grid/grid.hpp"

namespace slipwave {

/// One value per cell: a flat array on a grid, x fastest.
template <int D, class Value = float>
class Field {
 public:
  Field() = default;
  explicit Field(const Grid<D>& grid, Value fill = {})
      : grid_(grid), values_(std::size_t(grid.size()), fill) {}

  const Grid<D>& grid() const { return grid_; }
  bool empty() const { return values_.empty(); }
  std::size_t size() const { return values_.size(); }
  Value* data() { return values_.data(); }
  const Value* data() const { return values_.data(); }
  Value& operator[](std::size_t flat_index) { return values_[flat_index]; }
  const Value& operator[](std::size_t flat_index) const { return values_[flat_index]; }
  Value& operator()(const Index<D>& at) { return values_[std::size_t(grid_.flat(at))]; }
  const Value& operator()(const Index<D>& at) const { return values_[std::size_t(grid_.flat(at))]; }
  auto begin() { return values_.begin(); }
  auto end() { return values_.end(); }
  auto begin() const { return values_.begin(); }
  auto end() const { return values_.end(); }
  /// The cells along x whose other indices are those of line number `line` (0 .. size/nx - 1).
  std::span<const Value> line(std::int64_t line) const {
    return {values_.data() + line * grid_.shape[0], std::size_t(grid_.shape[0])};
  }
  std::span<Value> line(std::int64_t line) {
    return {values_.data() + line * grid_.shape[0], std::size_t(grid_.shape[0])};
  }

 private:
  Grid<D> grid_;
  std::vector<Value> values_;
};

}  // namespace slipwave
