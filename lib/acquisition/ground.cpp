// SPDX-License-Identifier: BSD-3-Clause
#include "acquisition/ground.hpp"

#include <algorithm>
#include <cmath>

#include "base/instantiate.hpp"

namespace slipwave {
namespace {

constexpr std::int32_t unknown = -1, no_floor = -2;

}  // namespace

template <int D>
Ground<D>::Ground(const Grid<D>& whole) : grid_(whole) {
  const auto columns = std::size_t(whole.size() / whole.shape[D - 1]);
  surface_.assign(columns, unknown);
  floor_.assign(columns, unknown);
}

template <int D>
std::size_t Ground<D>::column_of(Index<D> at) const {
  at[D - 1] = 0;
  return std::size_t(grid_.flat(at));
}

template <int D>
bool Ground<D>::see_row(std::int64_t row, const std::function<Matter(const Index<D>&)>& matter) {
  bool all = true;
  for (std::size_t column = 0; column < surface_.size(); ++column) {
    if (floor_[column] != unknown) continue;
    auto at = grid_.index(std::int64_t(column));
    at[D - 1] = row;
    const auto found = matter(at);
    if (surface_[column] == unknown && found != Matter::nothing) {
      surface_[column] = std::int32_t(row);
      if (found == Matter::rock) floor_[column] = no_floor;
    } else if (surface_[column] != unknown && found == Matter::rock) {
      floor_[column] = std::int32_t(row);
    }
    all = all && floor_[column] != unknown;
  }
  return all;
}

template <int D>
std::optional<double> Ground<D>::depth_of(const std::vector<std::int32_t>& rows, const Point<D>& at) const {
  Index<D> cell{};
  for (std::size_t axis = 0; axis + 1 < D; ++axis)
    cell[axis] = std::clamp<std::int64_t>(
        std::int64_t(std::floor((at[axis] - grid_.origin_m[axis]) / grid_.spacing_m)), 0,
        grid_.shape[axis] - 1);
  const auto row = rows[column_of(cell)];
  if (row < 0) return {};
  if (!grid_.rows) return grid_.origin_m[D - 1] + double(row) * grid_.spacing_m;
  auto place = grid_.in_cells(at);
  place[D - 1] = double(row);
  return grid_.rows->depth(place);
}

template <int D>
std::optional<double> Ground<D>::surface_m(const Point<D>& at) const {
  return depth_of(surface_, at);
}

template <int D>
std::optional<double> Ground<D>::floor_m(const Point<D>& at) const {
  return depth_of(floor_, at);
}

SLIPWAVE_INSTANTIATE_D(TYPE, class Ground);

}  // namespace slipwave
