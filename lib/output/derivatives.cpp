#include "output/derivatives.hpp"

#include <cstddef>
#include <cstdint>

namespace slipwave {

namespace {

template <int D>
Field<D> difference(Field<D> a, const Field<D>& b) {
  for (std::size_t cell = 0; cell < a.size(); ++cell) a[cell] -= b[cell];
  return a;
}

}  // namespace

template <int D>
Field<D> derivative(const Field<D>& field, int axis) {
  const auto& grid = field.grid();
  std::int64_t stride = 1;
  for (int a = 0; a < axis; ++a) stride *= grid.shape[std::size_t(a)];
  const std::int64_t length = grid.shape[std::size_t(axis)];
  const double h = grid.spacing_m;
  Field<D> result(grid);
  for (std::int64_t cell = 0; cell < grid.size(); ++cell) {
    const std::int64_t i = cell / stride % length, before = i, after = length - 1 - i;
    const auto at = [&](std::int64_t step) { return double(field[std::size_t(cell + step * stride)]); };
    double slope = 0;
    if (before >= 2 && after >= 2)
      slope = (8 * (at(1) - at(-1)) - (at(2) - at(-2))) / (12 * h);
    else if (before >= 1 && after >= 1)
      slope = (at(1) - at(-1)) / (2 * h);
    else if (after >= 2)
      slope = (4 * at(1) - 3 * at(0) - at(2)) / (2 * h);
    else if (before >= 2)
      slope = (3 * at(0) - 4 * at(-1) + at(-2)) / (2 * h);
    else if (after == 1)
      slope = (at(1) - at(0)) / h;
    else if (before == 1)
      slope = (at(0) - at(-1)) / h;
    result[std::size_t(cell)] = float(slope);
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

template Field<2> derivative<2>(const Field<2>&, int);
template Field<3> derivative<3>(const Field<3>&, int);
template Field<2> divergence<2>(const std::array<Field<2>, 2>&);
template Field<3> divergence<3>(const std::array<Field<3>, 3>&);

}  // namespace slipwave
