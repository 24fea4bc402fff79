// SPDX-License-Identifier: BSD-3-Clause
#include "grid/true_depth.hpp"

#include <algorithm>
#include <cmath>

#include "base/instantiate.hpp"

namespace slipwave {
namespace {

/// Interpolates values at the centres of a column, between faces, linearly to a depth within them.
double linear_at(const std::vector<double>& faces_m, const std::vector<float>& values, std::int64_t row,
                 double depth_m) {
  const auto centre = [&](std::size_t k) { return (faces_m[k] + faces_m[k + 1]) / 2; };
  const auto here = std::size_t(row), last = values.size() - 1;
  const bool above = depth_m < centre(here);
  const std::size_t from = above ? here - (here > 0) : here, to = std::min(from + 1, last);
  if (from == to || (above && here == 0)) return double(values[here]);
  const double share = (depth_m - centre(from)) / (centre(to) - centre(from));
  return double(values[from]) + share * (double(values[to]) - double(values[from]));
}

}  // namespace

template <int D>
std::vector<double> faces_of_column(const Grid<D>& grid, Index<D> at) {
  std::vector<double> faces(std::size_t(grid.shape[D - 1] + 1), 0.);
  for (std::size_t k = 0; k < faces.size(); ++k) {
    const std::int64_t row = grid.first[D - 1] + std::int64_t(k);
    if (!grid.rows) {
      faces[k] = grid.origin_m[D - 1] + double(row) * grid.spacing_m;
      continue;
    }
    for (int corner = 0; corner < 1 << (D - 1); ++corner) {
      Index<D> of = at;
      of[D - 1] = row;
      for (int axis = 0; axis < D - 1; ++axis)
        of[std::size_t(axis)] += grid.first[std::size_t(axis)] + ((corner >> axis) & 1);
      faces[k] += grid.rows->corner(of) / (1 << (D - 1));
    }
  }
  return faces;
}

std::int64_t row_between(const std::vector<double>& faces_m, double depth_m) {
  if (!(depth_m >= faces_m.front() && depth_m <= faces_m.back())) return -1;
  return std::upper_bound(faces_m.begin() + 1, faces_m.end() - 1, depth_m) - faces_m.begin() - 1;
}

template <int D>
std::array<double, 2> depth_extent(const Grid<D>& grid) {
  if (!grid.rows) return {grid.origin_m[D - 1], grid.end(D - 1)};
  const auto first = grid.rows->row(grid.first[D - 1]);
  const auto last = grid.rows->row(grid.first[D - 1] + grid.shape[D - 1]);
  return {std::min(0., *std::min_element(first.begin(), first.end())),
          *std::max_element(last.begin(), last.end())};
}

template <int D>
Grid<D> in_regular_depth(const Grid<D>& grid) {
  if (!grid.rows) return grid;
  const auto [top, bottom] = depth_extent(grid);
  Grid<D> regular = grid;
  regular.rows = nullptr;
  regular.origin_m[D - 1] = top;
  regular.first[D - 1] = 0;
  // As many as have their centres within.
  const double rows = std::ceil((bottom - top) / grid.spacing_m - 0.5 - 1e-6);
  regular.shape[D - 1] = std::max<std::int64_t>(1, std::int64_t(rows));
  return regular;
}

template <int D>
Field<D> in_regular_depth(const Field<D>& field, DepthTake take) {
  const auto& from = field.grid();
  if (!from.rows) return field;
  Field<D> regular(in_regular_depth(from));
  const auto& to = regular.grid();
  const std::int64_t columns = to.size() / to.shape[D - 1];
  std::vector<float> values(std::size_t(from.shape[D - 1]), 0);
  for (std::int64_t column = 0; column < columns; ++column) {
    const auto faces = faces_of_column(from, to.index(column));
    for (std::size_t k = 0; k < values.size(); ++k)
      values[k] = field[std::size_t(column) + k * std::size_t(columns)];
    for (std::int64_t k = 0; k < to.shape[D - 1]; ++k) {
      const double depth = to.centre(D - 1, k);
      const auto row = row_between(faces, depth);
      if (row < 0) continue;
      regular[std::size_t(column + k * columns)] =
          take == DepthTake::nearest ? values[std::size_t(row)] : float(linear_at(faces, values, row, depth));
    }
  }
  return regular;
}

SLIPWAVE_INSTANTIATE_D(FUNCTION, faces_of_column);
SLIPWAVE_INSTANTIATE_D(FUNCTION, depth_extent);
template Grid<2> in_regular_depth(const Grid<2>&);
template Grid<3> in_regular_depth(const Grid<3>&);
template Field<2> in_regular_depth(const Field<2>&, DepthTake);
template Field<3> in_regular_depth(const Field<3>&, DepthTake);

}  // namespace slipwave
