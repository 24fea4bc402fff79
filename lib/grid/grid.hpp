// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>

#include "grid/row_depths.hpp"

namespace slipwave {

template <int D>
using Point = std::array<double, std::size_t(D)>;  // m; 2-D: x, z; 3-D: x, y, z; z points down
template <int D>
using Index = std::array<std::int64_t, std::size_t(D)>;

/// Names of the axes in storage order, fastest first: "x","z" or "x","y","z".
template <int D>
constexpr std::array<char, D> axis_names() {
  if constexpr (D == 2)
    return {'x', 'z'};
  else
    return {'x', 'y', 'z'};
}

/// A plain grid of cubic cells. Cell (i, .., k) has its centre at origin + (i + 1/2) h; the last axis is
/// depth, its origin the free surface z = 0. Cells are numbered x fastest.
template <int D>
struct Grid {
  Index<D> shape{};      // cells along x, [y,] z
  double spacing_m = 0;  // h
  Point<D> origin_m{};   // the low corner of cell (0, .., 0), where `first` is 0
  /// Cells of a larger grid that come before this part of it. Places are counted from the origin of the
  /// larger one, so that they are the same numbers in it and in all its parts, to the last bit.
  Index<D> first{};
  /// Depths of the larger grid where rows follow horizons (a fitted grid); null: a regular grid. centre(),
  /// end() and position() along the last axis are then row coordinates (RowDepths), not depths.
  std::shared_ptr<const RowDepths<D>> rows{};

  std::int64_t size() const {
    std::int64_t cells = 1;
    for (auto n : shape) cells *= n;
    return cells;
  }
  double centre(int axis, std::int64_t i) const {
    return origin_m[axis] + (double(first[axis] + i) + 0.5) * spacing_m;
  }
  double end(int axis) const { return origin_m[axis] + double(first[axis] + shape[axis]) * spacing_m; }
  /// Returns the position of a place along an axis, in cells from the centre of cell 0.
  double position(int axis, double place_m) const {
    return (place_m - origin_m[axis]) / spacing_m - 0.5 - double(first[axis]);
  }
  std::int64_t flat(const Index<D>& at) const {
    std::int64_t n = 0;
    for (int axis = D - 1; axis >= 0; --axis) n = n * shape[axis] + at[axis];
    return n;
  }
  Index<D> index(std::int64_t flat_index) const {
    Index<D> at{};
    for (int axis = 0; axis < D; ++axis) {
      at[axis] = flat_index % shape[axis];
      flat_index /= shape[axis];
    }
    return at;
  }
  /// Row coordinates of a point: itself in a regular grid. Within a millionth of a cell of the first or the
  /// last face it is on that face, so that a place on a surface can be given by its depth.
  Point<D> row_coordinates(Point<D> point_m) const {
    if (!rows) return point_m;
    const double cells = double(rows->cells()[D - 1]), row = rows->row_position(in_cells(point_m));
    const double snapped = std::abs(row) < 1e-6 ? 0 : std::abs(row - cells) < 1e-6 ? cells : row;
    point_m[D - 1] = origin_m[D - 1] + snapped * spacing_m;
    return point_m;
  }
  /// Depths of the first and the last face above or below a point of a fitted grid, m.
  std::array<double, 2> depths_at(const Point<D>& point_m) const {
    Point<D> at = in_cells(point_m);
    at[D - 1] = 0;
    const double top = rows->depth(at);
    at[D - 1] = double(rows->cells()[D - 1]);
    return {top, rows->depth(at)};
  }
  /// Depth of the centre of a cell, m.
  double depth(Index<D> at) const {
    if (!rows) return centre(D - 1, at[D - 1]);
    for (int axis = 0; axis < D; ++axis) at[axis] += first[axis];
    return rows->centre(at);
  }
  /// Height of a cell at its centre, m.
  double height(Index<D> at) const {
    if (!rows) return spacing_m;
    for (int axis = 0; axis < D; ++axis) at[axis] += first[axis];
    return rows->height(at);
  }
  /// Depth of the faces above a row, m, of which all are level.
  double depth_of_face(std::int64_t row) const {
    return rows ? rows->row(row)[0] : origin_m[D - 1] + double(row) * spacing_m;
  }
  /// A point with its horizontal coordinates counted in cells from the first corner.
  Point<D> in_cells(Point<D> point_m) const {
    for (int axis = 0; axis < D - 1; ++axis) point_m[axis] = (point_m[axis] - origin_m[axis]) / spacing_m;
    return point_m;
  }
  bool operator==(const Grid& other) const {
    return shape == other.shape && spacing_m == other.spacing_m && origin_m == other.origin_m &&
           first == other.first && (rows == other.rows || (rows && other.rows && *rows == *other.rows));
  }
};

/// "x=1200 z=45": the centre of a cell as messages show it.
template <int D>
std::string place_of(const Grid<D>& grid, std::int64_t flat_index);

/// "500 x 600 cells of 5 m": a grid as messages show it.
template <int D>
std::string shown(const Grid<D>& grid);

}  // namespace slipwave
