// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "grid/grid.hpp"

namespace slipwave {

/// What fills a cell, as far as depths are measured from it.
enum class Matter : std::uint8_t { nothing, fluid, rock };

/// This class says where the ground and the sea floor of a model are: rows of faces in each column. On fitted
/// grids depths between the columns follow the horizons; on regular ones a column is level.
template <int D>
class Ground {
 public:
  Ground() = default;
  /// Prepares the ground of a whole model; nothing is known before its rows are seen.
  explicit Ground(const Grid<D>& whole);
  /// Looks at a row of cells, one after the other from the top; returns whether all columns are known.
  bool see_row(std::int64_t row, const std::function<Matter(const Index<D>&)>& matter);

  /// Depth of the first rock or fluid at a place (its last entry is free), m; none where there is only void.
  std::optional<double> surface_m(const Point<D>& at) const;
  /// Depth of the rock below the water there; none on land and where no rock is.
  std::optional<double> floor_m(const Point<D>& at) const;
  const Grid<D>& grid() const { return grid_; }

 private:
  std::optional<double> depth_of(const std::vector<std::int32_t>& rows, const Point<D>& at) const;
  std::size_t column_of(Index<D> at) const;

  Grid<D> grid_;
  std::vector<std::int32_t> surface_, floor_;  // rows of faces; unknown, or no_floor on land
};

extern template class Ground<2>;
extern template class Ground<3>;

}  // namespace slipwave
