// SPDX-License-Identifier: BSD-3-Clause
#include "output/derivatives.hpp"

#include <cstddef>
#include <cstdint>

#include "base/instantiate.hpp"

namespace slipwave {

namespace {

template <int D>
Field<D> difference(Field<D> a, const Field<D>& b) {
  for (std::size_t cell = 0; cell < a.size(); ++cell) a[cell] -= b[cell];
  return a;
}

/// Derivative per metre along a line of cells, `before` and `after` of which lie on either side of a place
/// where at(step) is the value that many cells further.
template <class At>
double slope(const At& at, std::int64_t before, std::int64_t after, double h) {
  if (before >= 2 && after >= 2) return (8 * (at(1) - at(-1)) - (at(2) - at(-2))) / (12 * h);
  if (before >= 1 && after >= 1) return (at(1) - at(-1)) / (2 * h);
  if (after >= 2) return (4 * at(1) - 3 * at(0) - at(2)) / (2 * h);
  if (before >= 2) return (3 * at(0) - 4 * at(-1) + at(-2)) / (2 * h);
  if (after == 1) return (at(1) - at(0)) / h;
  if (before == 1) return (at(0) - at(-1)) / h;
  return 0;
}

/// Derivative per metre of value(cell) along an axis at a cell of the grid.
template <int D, class Value>
double slope_at(const Grid<D>& grid, const Index<D>& cell, int axis, const Value& value) {
  const auto along = std::size_t(axis);
  const auto at = [&](std::int64_t step) {
    auto other = cell;
    other[along] += step;
    return value(other);
  };
  return slope(at, cell[along], grid.shape[along] - 1 - cell[along], grid.spacing_m);
}

/// By the chain rule, all with the same differences, so that linear fields have exact derivatives: with
/// z = z(xi, zeta), d/dz = (d/dzeta)/(dz/dzeta) and d/dx = d/dxi - dz/dxi d/dz (theory.md (F1)).
template <int D>
Field<D> curvilinear_derivative(const Field<D>& field, int axis) {
  const auto& grid = field.grid();
  const auto value = [&](const Index<D>& at) { return double(field(at)); };
  const auto depth = [&](const Index<D>& at) { return grid.depth(at); };
  Field<D> result(grid);
  for (std::int64_t n = 0; n < grid.size(); ++n) {
    const auto at = grid.index(n);
    const double height = slope_at(grid, at, D - 1, depth);
    const double down = height > 0 ? slope_at(grid, at, D - 1, value) / height : 0;
    result[std::size_t(n)] = float(
        axis == D - 1 ? down : slope_at(grid, at, axis, value) - slope_at(grid, at, axis, depth) * down);
  }
  return result;
}

}  // namespace

template <int D>
Field<D> derivative(const Field<D>& field, int axis) {
  const auto& grid = field.grid();
  if (grid.rows) return curvilinear_derivative(field, axis);
  std::int64_t stride = 1;
  for (int a = 0; a < axis; ++a) stride *= grid.shape[std::size_t(a)];
  const std::int64_t length = grid.shape[std::size_t(axis)];
  Field<D> result(grid);
  for (std::int64_t cell = 0; cell < grid.size(); ++cell) {
    const std::int64_t i = cell / stride % length;
    const auto at = [&](std::int64_t step) { return double(field[std::size_t(cell + step * stride)]); };
    result[std::size_t(cell)] = float(slope(at, i, length - 1 - i, grid.spacing_m));
  }
  return result;
}

template <int D>
Field<D> divergence(const std::array<Field<D>, std::size_t(D)>& velocity) {
  auto sum = derivative<D>(velocity[0], 0);
  for (int axis = 1; axis < D; ++axis) {
    const auto part = derivative<D>(velocity[std::size_t(axis)], axis);
    for (std::size_t cell = 0; cell < sum.size(); ++cell) sum[cell] += part[cell];
  }
  return sum;
}

Field<2> curl(const std::array<Field<2>, 2>& velocity) {
  return difference(derivative<2>(velocity[0], 1), derivative<2>(velocity[1], 0));
}

std::array<Field<3>, 3> curl(const std::array<Field<3>, 3>& velocity) {
  const auto& [x, y, z] = velocity;
  return {difference(derivative<3>(z, 1), derivative<3>(y, 2)),
          difference(derivative<3>(x, 2), derivative<3>(z, 0)),
          difference(derivative<3>(y, 0), derivative<3>(x, 1))};
}

SLIPWAVE_INSTANTIATE_D(FUNCTION, derivative);
SLIPWAVE_INSTANTIATE_D(FUNCTION, divergence);

}  // namespace slipwave
