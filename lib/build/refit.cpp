// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/error.hpp"
#include "base/instantiate.hpp"
#include "build/resample.hpp"
#include "geology/fit.hpp"
#include "geology/layers.hpp"
#include "model/cluster_shares.hpp"
#include "model/single_fracture.hpp"
#include "rock/averaging.hpp"
#include "rock/tilted_mean.hpp"

namespace slipwave {
namespace {

/// What a fitted grid has for making it anew: horizons inside it, from the top down.
template <int D>
std::vector<FitHorizon> horizons_of(const Grid<D>& from, const Grid<D>& to) {
  std::vector<FitHorizon> horizons;
  std::int64_t above = 0;  // the row of the horizon before
  for (const auto& followed : from.rows->horizons()) {
    FitHorizon horizon{
        followed.name, "horizon " + followed.name, followed.role, true, followed.row == 0, {}, 1};
    const bool level = from.rows->row_is_level(followed.row);
    for (auto at : corner_columns(to)) {
      for (std::size_t axis = 0; axis + 1 < D; ++axis)
        at[axis] = (at[axis] - from.origin_m[axis]) / from.spacing_m;
      at[D - 1] = double(followed.row);
      horizon.depths_m.push_back(level ? from.rows->row(followed.row)[0] : from.rows->depth(at));
    }
    // As many rows as it has, by their thickness.
    double thinnest_m = std::numeric_limits<double>::infinity();
    for (std::size_t n = 0; n < horizon.depths_m.size(); ++n)
      thinnest_m =
          std::min(thinnest_m, horizon.depths_m[n] - (horizons.empty() ? 0 : horizons.back().depths_m[n]));
    if (const double rows = double(followed.row - above); rows > 0 && thinnest_m > 0)
      horizon.rows_a_cell_above = std::max(1., rows * from.spacing_m / thinnest_m);
    above = followed.row;
    horizons.push_back(std::move(horizon));
  }
  return horizons;
}

/// Ends of rows that must be level for a grid to be made anew from its horizons.
template <int D>
void check_ends(const Grid<D>& grid) {
  const auto level_at = [&](std::int64_t row, double depth_m) {
    return grid.rows->row_is_level(row) &&
           std::abs(grid.rows->row(row)[0] - depth_m) <= 1e-6 * grid.spacing_m;
  };
  const auto& horizons = grid.rows->horizons();
  const bool has_top = !horizons.empty() && horizons.front().row == 0;
  if (horizons.empty() || !level_at(grid.shape[D - 1], grid.end(D - 1)) || (!has_top && !level_at(0, 0))) {
    throw Error(
        "found rows that follow no named horizon, or end in one: such a grid cannot be made anew in other "
        "cells");
  }
}

/// A column holds where its rows lie between horizons: at horizon n, counted from the top of the grid, n;
/// between two of them the share of the way. It is the same for cells of any size, the last of which may
/// reach below the bottom.
class Column {
 public:
  template <int D>
  Column(const Grid<D>& grid, Index<D> at, const std::vector<std::int64_t>& knots, double bottom_m) {
    std::vector<double> depths(std::size_t(grid.shape[D - 1] + 1), 0.);
    for (std::size_t row = 0; row < depths.size(); ++row) {
      at[D - 1] = std::int64_t(row);
      double sum = 0;
      for (int corner = 0; corner < 1 << (D - 1); ++corner) {
        auto of = at;
        for (std::size_t axis = 0; axis + 1 < D; ++axis) of[axis] += corner >> axis & 1;
        sum += grid.rows->corner(of);
      }
      depths[row] = sum / (1 << (D - 1));
    }
    for (std::size_t n = 0; n + 1 < knots.size(); ++n) {
      const double top = depths[std::size_t(knots[n])];
      const double end = n + 2 < knots.size() ? depths[std::size_t(knots[n + 1])] : bottom_m;
      for (auto row = knots[n]; row < knots[n + 1]; ++row)
        at_.push_back(double(n) + (depths[std::size_t(row)] - top) / (end - top));
    }
    const double last = depths[std::size_t(knots[knots.size() - 2])];
    at_.push_back(double(knots.size() - 2) + (depths.back() - last) / (bottom_m - last));
  }
  double top(std::int64_t row) const { return at_[std::size_t(row)]; }
  double end(std::int64_t row) const { return at_[std::size_t(row) + 1]; }
  std::int64_t rows() const { return std::int64_t(at_.size()) - 1; }
  /// The row a place is in; one on a face (to rounding) is in the lower one.
  std::int64_t row_at(double place) const {
    const auto below = std::upper_bound(at_.begin(), at_.end(), place + 1e-9);
    return std::clamp<std::int64_t>(below - at_.begin() - 1, 0, rows() - 1);
  }

 private:
  std::vector<double> at_;
};

/// First row, rows of horizons inside, and end.
template <int D>
std::vector<std::int64_t> knots_of(const Grid<D>& grid) {
  std::vector<std::int64_t> knots = {0};
  for (const auto& horizon : grid.rows->horizons())
    if (horizon.row > 0) knots.push_back(horizon.row);
  knots.push_back(grid.shape[D - 1]);
  return knots;
}

/// An old column under a new one, and the area of what they share, in old cells.
struct Under {
  std::int64_t column = 0;  // number of its first cell
  double area = 0;
  bool has_centre = false;
};

template <int D>
std::vector<Under> under(const Grid<D>& from, const Grid<D>& to, const Index<D>& at) {
  std::vector<Under> columns = {{0, 1, true}};
  const double ratio = to.spacing_m / from.spacing_m;
  std::int64_t stride = 1;
  for (std::size_t axis = 0; axis + 1 < D; ++axis) {
    const double low = double(at[axis]) * ratio, high = double(at[axis] + 1) * ratio;
    const auto last = from.shape[axis] - 1;
    const auto centre = std::min(std::int64_t(std::floor((low + high) / 2 + 1e-9)), last);
    std::vector<Under> crossed;
    for (const auto& column : columns)
      for (auto n = std::min(std::int64_t(std::floor(low + 1e-6)), last);
           n <= last && double(n) < high - 1e-6; ++n)
        crossed.push_back({column.column + n * stride,
                           column.area * (std::min(high, double(n + 1)) - std::max(low, double(n))),
                           column.has_centre && n == centre});
    columns = std::move(crossed);
    stride *= from.shape[axis];
  }
  return columns;
}

/// Fills cells of a new grid from those of an old one that follows the same horizons.
template <int D>
class Refit {
 public:
  Refit(const Model<D>& from, const Grid<D>& grid)
      : from_(from),
        to_(without_values(from, grid)),
        knots_from_(knots_of(from.grid())),
        knots_to_(knots_of(grid)),
        shares_(from, to_) {
    // Where interfaces lie in old cells is not known.
    drop_tilted_means(to_.medium);
    scalars_ = from.medium.properties();
    std::erase_if(scalars_, [](Property property) { return row_of(property).mean == Mean::elastic; });
  }
  Model<D> filled() {
    const auto& grid = to_.grid();
    const std::int64_t columns = grid.size() / grid.shape[D - 1];
    for (std::int64_t n = 0; n < columns; ++n) fill_column(n);
    place_single_fractures(to_);
    return std::move(to_);
  }

 private:
  void fill_column(std::int64_t number) {
    const auto &old = from_.grid(), &grid = to_.grid();
    const std::int64_t old_stride = old.size() / old.shape[D - 1], stride = grid.size() / grid.shape[D - 1];
    const double bottom_m = old.end(D - 1);
    const Column here(grid, grid.index(number), knots_to_, bottom_m);
    const auto unders = under(old, grid, grid.index(number));
    std::vector<Column> columns;
    for (const auto& column : unders)
      columns.emplace_back(old, old.index(column.column), knots_from_, bottom_m);
    const auto centre =
        std::size_t(std::find_if(unders.begin(), unders.end(), [](const Under& u) { return u.has_centre; }) -
                    unders.begin());
    for (std::int64_t row = 0; row < here.rows(); ++row) {
      const double top = here.top(row), end = here.end(row);
      const auto nearest = columns[centre].row_at((top + end) / 2);
      parts_.clear();
      for (std::size_t n = 0; n < unders.size(); ++n)
        for (auto k = columns[n].row_at(top); k < columns[n].rows() && columns[n].top(k) < end - 1e-9; ++k) {
          const double height = std::min(end, columns[n].end(k)) - std::max(top, columns[n].top(k));
          parts_.push_back({std::size_t(unders[n].column + k * old_stride), unders[n].area * height});
        }
      put_cell(std::size_t(number + row * stride), std::size_t(unders[centre].column + nearest * old_stride));
    }
  }
  /// The mean over parts of the kind of `source`, whose fractures the cell has.
  void put_cell(std::size_t cell, std::size_t source) {
    MaterialMean mean(material_of(from_.medium, source), from_.medium.has(Property::c33));
    std::vector<ScalarMean> means;
    for (const Property property : scalars_)
      means.emplace_back(row_of(property).mean, from_.medium[property][source]);
    for (const auto& [part, volume] : parts_) {
      shares_.add(part, volume);
      if (!mean.add(material_of(from_.medium, part), volume)) continue;
      for (std::size_t n = 0; n < means.size(); ++n) means[n].add(from_.medium[scalars_[n]][part], volume);
    }
    put(to_.medium, cell, mean.mean());
    for (std::size_t n = 0; n < means.size(); ++n) to_.medium[scalars_[n]][cell] = float(means[n].mean());
    for (std::size_t c = 0; c < from_.prestress_pa.size(); ++c)
      to_.prestress_pa[c][cell] = from_.prestress_pa[c][source];
    shares_.put(cell);
  }

  const Model<D>& from_;
  Model<D> to_;
  std::vector<std::int64_t> knots_from_, knots_to_;
  ClusterShares<D> shares_;
  std::vector<Property> scalars_;  // whose means depend on nothing else
  std::vector<std::pair<std::size_t, double>> parts_;
};

}  // namespace

template <int D>
Model<D> refitted(const Model<D>& model, double spacing_m, Extent extent) {
  const auto& from = model.grid();
  check_ends(from);
  Point<D> size{};
  for (std::size_t axis = 0; axis + 1 < D; ++axis) size[axis] = double(from.shape[axis]) * from.spacing_m;
  size[D - 1] = from.end(D - 1);
  auto regular = extent == Extent::kept ? grid_of_size<D>(size, spacing_m) : grid_over<D>(size, spacing_m);
  regular.origin_m = from.origin_m;
  regular.origin_m[D - 1] = 0;
  const auto fit = fit_grid(regular, horizons_of(from, regular), {true, true, true, true, true});
  return Refit<D>(model, fit.grid).filled();
}

SLIPWAVE_INSTANTIATE_D(FUNCTION, refitted);

}  // namespace slipwave
