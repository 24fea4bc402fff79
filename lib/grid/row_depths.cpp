// SPDX-License-Identifier: BSD-3-Clause
#include "grid/row_depths.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "base/error.hpp"
#include "base/instantiate.hpp"
#include "base/parse.hpp"

namespace slipwave {
namespace {

constexpr int most_points = 4;

/// Lagrange weights of the corners nearest to a place between them: four, or as many as there are.
struct CornerWeights {
  std::int64_t first = 0;
  int count = 0;
  std::array<double, most_points> weights{};
};

CornerWeights corner_weights(double position, std::int64_t cells) {
  const double inside = std::clamp(position, 0., double(cells));
  CornerWeights of;
  of.count = int(std::min<std::int64_t>(most_points, cells + 1));
  of.first = std::clamp<std::int64_t>(std::int64_t(std::floor(inside)) - (of.count - 1) / 2, 0,
                                      cells + 1 - of.count);
  for (int n = 0; n < of.count; ++n) {
    double weight = 1;
    for (int m = 0; m < of.count; ++m)
      if (m != n) weight *= (inside - double(of.first + m)) / double(n - m);
    of.weights[std::size_t(n)] = weight;
  }
  return of;
}

/// Returns by how much the corners of a cell (RowDepths::corners_of) deepen along an axis, on average.
template <std::size_t N>
double mean_gain(const std::array<double, N>& corners, int axis) {
  double sum = 0;
  for (std::size_t n = 0; n < N; ++n) sum += (n >> axis & 1 ? 1 : -1) * corners[n];
  return sum / (double(N) / 2);
}

/// Returns the same along z, added up column by column.
template <std::size_t N>
double height_of(const std::array<double, N>& corners) {
  double sum = 0;
  for (std::size_t n = 0; n < N / 2; ++n) sum -= corners[n], sum += corners[N / 2 + n];
  return sum / (double(N) / 2);
}

}  // namespace

template <int D>
RowDepths<D>::RowDepths(const Index& cells, std::vector<double> corners_m,
                        std::vector<FittedHorizon> horizons)
    : cells_(cells), corners_m_(std::move(corners_m)), horizons_(std::move(horizons)) {
  std::int64_t a_row = 1;
  for (std::size_t axis = 0; axis + 1 < D; ++axis) a_row *= cells_[axis] + 1;
  const std::int64_t all = a_row * (cells_[D - 1] + 1);
  if (std::int64_t(corners_m_.size()) != all) {
    throw Error("found " + std::to_string(corners_m_.size()) + " depths of corners, expected " +
                std::to_string(all));
  }
  for (std::int64_t n = 0; n < all; ++n) {
    const double depth = corners_m_[std::size_t(n)];
    const bool below = n < a_row || depth > corners_m_[std::size_t(n - a_row)];
    if (std::isfinite(depth) && below) continue;
    throw Error("found a depth of " + shown(depth) + " m at row " + std::to_string(n / a_row) + ", column " +
                std::to_string(n % a_row) + " of the corners, expected " +
                (std::isfinite(depth)
                     ? "it below the one above, at " + shown(corners_m_[std::size_t(n - a_row)]) + " m"
                     : std::string("a number")));
  }
}

template <int D>
double RowDepths<D>::centre(const Index& at) const {
  double sum = 0;
  for (const double corner : corners_of(at)) sum += corner;
  return sum / (1 << D);
}

template <int D>
double RowDepths<D>::height(const Index& at) const {
  return height_of(corners_of(at));
}

template <int D>
double RowDepths<D>::slope(const Index& at, int axis, double spacing_m) const {
  return mean_gain(corners_of(at), axis) / spacing_m;
}

template <int D>
double RowDepths<D>::stretch(const Index& at, double spacing_m) const {
  const auto corners = corners_of(at);
  double square = 1;
  for (int axis = 0; axis < D - 1; ++axis) {
    const double slope = mean_gain(corners, axis) / spacing_m;
    square += slope * slope;
  }
  return std::sqrt(square) * spacing_m / height_of(corners);
}

template <int D>
double RowDepths<D>::of_row(std::int64_t row, const std::array<double, std::size_t(D)>& position) const {
  const auto x = corner_weights(position[0], cells_[0]);
  const auto y = D == 3 ? corner_weights(position[1], cells_[1]) : CornerWeights{0, 1, {1}};
  double depth = 0;
  for (int j = 0; j < y.count; ++j)
    for (int i = 0; i < x.count; ++i) {
      Index at{};
      at[0] = x.first + i;
      if (D == 3) at[1] = y.first + j;
      at[D - 1] = row;
      depth += x.weights[std::size_t(i)] * y.weights[std::size_t(j)] * corner(at);
    }
  return depth;
}

template <int D>
double RowDepths<D>::depth(const std::array<double, std::size_t(D)>& position) const {
  const double row = position[D - 1];
  const auto above = std::clamp<std::int64_t>(std::int64_t(std::floor(row)), 0, cells_[D - 1] - 1);
  const double from = of_row(above, position), to = of_row(above + 1, position);
  return from + (row - double(above)) * (to - from);
}

template <int D>
double RowDepths<D>::row_position(std::array<double, std::size_t(D)> at) const {
  const double depth = at[D - 1];
  // The last row of corners at or above that depth, but one with a row below it.
  std::int64_t low = 0, high = cells_[D - 1];
  while (high - low > 1) {
    const std::int64_t middle = (low + high) / 2;
    (of_row(middle, at) <= depth ? low : high) = middle;
  }
  const double from = of_row(low, at), to = of_row(low + 1, at);
  return double(low) + (depth - from) / (to - from);
}

template <int D>
bool RowDepths<D>::row_is_level(std::int64_t row) const {
  const auto depths = this->row(row);
  return std::all_of(depths.begin(), depths.end(), [&](double depth) { return depth == depths.front(); });
}

template <int D>
std::optional<std::int64_t> RowDepths<D>::first_curvilinear_row() const {
  for (std::int64_t row = 0; row <= cells_[D - 1]; ++row)
    if (!row_is_level(row)) return row;
  return std::nullopt;
}

template <int D>
std::array<double, 2> RowDepths<D>::heights() const {
  std::array<double, 2> range{std::numeric_limits<double>::infinity(), 0};
  const std::size_t a_row = row(0).size();
  for (std::size_t n = a_row; n < corners_m_.size(); ++n) {
    const double height = corners_m_[n] - corners_m_[n - a_row];
    range = {std::min(range[0], height), std::max(range[1], height)};
  }
  return range;
}

SLIPWAVE_INSTANTIATE_D(TYPE, class RowDepths);

}  // namespace slipwave
