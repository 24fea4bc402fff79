// SPDX-License-Identifier: BSD-3-Clause
#include "build/import_fit.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <utility>

#include "base/error.hpp"
#include "base/parse.hpp"
#include "geology/layers.hpp"
#include "rock/averaging.hpp"

namespace slipwave {
namespace {

/// A symmetric matrix of two bands on either side of its diagonal, D'D + rho I with D of second differences,
/// factorised once (L D L').
class Bending {
 public:
  Bending(std::size_t count, double rho) : diagonal_(count, rho), first_(count, 0), second_(count, 0) {
    for (std::size_t n = 0; n + 2 < count; ++n) {
      const std::array<double, 3> d = {1, -2, 1};
      for (std::size_t i = 0; i < 3; ++i) diagonal_[n + i] += d[i] * d[i];
      first_[n + 1] += d[0] * d[1];
      first_[n + 2] += d[1] * d[2];
      second_[n + 2] += d[0] * d[2];
    }
    for (std::size_t n = 0; n < count; ++n) {
      if (n >= 2) second_[n] /= diagonal_[n - 2];
      if (n >= 2) first_[n] -= second_[n] * diagonal_[n - 2] * first_[n - 1];
      if (n >= 1) first_[n] /= diagonal_[n - 1];
      if (n >= 1) diagonal_[n] -= first_[n] * first_[n] * diagonal_[n - 1];
      if (n >= 2) diagonal_[n] -= second_[n] * second_[n] * diagonal_[n - 2];
    }
  }
  void solve(std::vector<double>& x) const {
    const std::size_t count = x.size();
    for (std::size_t n = 1; n < count; ++n)
      x[n] -= first_[n] * x[n - 1] + (n > 1 ? second_[n] * x[n - 2] : 0);
    for (std::size_t n = 0; n < count; ++n) x[n] /= diagonal_[n];
    for (std::size_t n = count; n-- > 0;) {
      if (n + 1 < count) x[n] -= first_[n + 1] * x[n + 1];
      if (n + 2 < count) x[n] -= second_[n + 2] * x[n + 2];
    }
  }

 private:
  std::vector<double> diagonal_, first_, second_;
};

/// Rows of a column of cells: from `top` fluid down to `floor`, from there on rock.
struct Parts {
  std::int64_t top = 0, floor = 0;
};

std::vector<Parts> parts_of(const Medium<2>& medium) {
  const auto& grid = medium.grid();
  std::vector<Parts> parts(std::size_t(grid.shape[0]), Parts{});
  for (std::int64_t i = 0; i < grid.shape[0]; ++i) {
    auto& of = parts[std::size_t(i)];
    const auto cell = [&](std::int64_t k) { return std::size_t(grid.flat({i, k})); };
    while (of.top < grid.shape[1] && medium.is_void(cell(of.top))) ++of.top;
    of.floor = of.top;
    while (of.floor < grid.shape[1] && medium.is_fluid(cell(of.floor))) ++of.floor;
  }
  return parts;
}

/// Returns by how much waves in fluid are slower than the fastest of all at least (FitHorizon).
double rows_a_cell_of_fluid(const Medium<2>& medium) {
  double of_all = 0, of_fluid = 0;
  for (std::size_t cell = 0; cell < medium.vp.size(); ++cell) {
    of_all = std::max(of_all, double(medium.vp[cell]));
    if (medium.is_fluid(cell)) of_fluid = std::max(of_fluid, double(medium.vp[cell]));
  }
  return of_fluid > 0 ? of_all / of_fluid : 1;
}

/// Depths at corners of columns from those at centres.
std::vector<double> at_corners(const std::vector<double>& centres) {
  const std::size_t last = centres.size() - 1;
  std::vector<double> corners;
  corners.push_back(last ? 1.5 * centres[0] - 0.5 * centres[1] : centres[0]);
  for (std::size_t n = 0; n < last; ++n) corners.push_back((centres[n] + centres[n + 1]) / 2);
  corners.push_back(last ? 1.5 * centres[last] - 0.5 * centres[last - 1] : centres[0]);
  return corners;
}

std::vector<double> found_floor(const Grid<2>& grid, const std::vector<Parts>& parts, double sampled_m) {
  std::vector<double> stairs;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (parts[i].floor == grid.shape[1] || parts[i].floor == parts[i].top) {
      throw Error("found no " + std::string(parts[i].floor == parts[i].top ? "fluid above" : "rock below") +
                      " a sea floor at x=" + shown(grid.centre(0, std::int64_t(i))) +
                      ", expected a floor in every column",
                  ErrorKind::usage);
    }
    stairs.push_back(double(parts[i].floor) * grid.spacing_m);
  }
  return at_corners(smoothed(stairs, std::max(sampled_m, grid.spacing_m) / 2));
}

std::vector<double> depths_of(const Grid<2>& grid, const Horizon& horizon) {
  check_reach(grid, horizon);
  std::vector<double> depths;
  for (const auto& at : corner_columns(grid)) depths.push_back(horizon.at(at[0]));
  return depths;
}

/// A sentence where a horizon lies farther from where cells have it than their own size explains.
void compare(const Grid<2>& grid, const FitHorizon& horizon, const std::vector<std::int64_t>& rows,
             double sampled_m, std::vector<std::string>& warnings) {
  double largest = 0;
  std::size_t at = 0;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const double depth = (horizon.depths_m[i] + horizon.depths_m[i + 1]) / 2;
    const double apart = std::abs(depth - double(rows[i]) * grid.spacing_m);
    if (apart > largest) largest = apart, at = i;
  }
  if (largest <= 1.5 * std::max(sampled_m, grid.spacing_m)) return;
  warnings.push_back("the " + horizon.shown + " lies " + shown(largest, 3) +
                     " m from that of the cells at x=" + shown(grid.centre(0, std::int64_t(at))) +
                     "; materials near it are continued to it");
}

/// The mean over rows [first, last) of a column of a regular grid between two depths.
class ColumnMean {
 public:
  ColumnMean(const Medium<2>& from, Medium<2>& to) : from_(from), to_(to), scalars_(from.properties()) {
    std::erase_if(scalars_, [](Property property) { return row_of(property).mean == Mean::elastic; });
  }
  void put_cell(std::size_t cell, std::int64_t column, Point<2> depths, std::int64_t first,
                std::int64_t last) {
    const auto& grid = from_.grid();
    const double h = grid.spacing_m;
    const auto row_at = [&](double depth) {
      return std::clamp(std::int64_t(std::floor(depth / h)), first, last - 1);
    };
    const auto at = [&](std::int64_t row) { return std::size_t(grid.flat({column, row})); };
    const auto source = at(row_at((depths[0] + depths[1]) / 2));
    MaterialMean mean(material_of(from_, source), from_.has(Property::c33));
    std::vector<ScalarMean> means;
    for (const Property property : scalars_)
      means.emplace_back(row_of(property).mean, from_[property][source]);
    for (auto row = row_at(depths[0]); row <= row_at(depths[1]); ++row) {
      const double part = std::min(depths[1], double(row + 1) * h) - std::max(depths[0], double(row) * h);
      if (part <= 1e-9 * h || !mean.add(material_of(from_, at(row)), part)) continue;
      for (std::size_t n = 0; n < means.size(); ++n) means[n].add(from_[scalars_[n]][at(row)], part);
    }
    put(to_, cell, mean.mean());
    for (std::size_t n = 0; n < means.size(); ++n) to_[scalars_[n]][cell] = float(means[n].mean());
  }

 private:
  const Medium<2>& from_;
  Medium<2>& to_;
  std::vector<Property> scalars_;
};

/// `floor_row` in the new grid, -1: none.
Medium<2> filled(const Medium<2>& from, const Grid<2>& grid, const std::vector<Parts>& parts, bool has_top,
                 std::int64_t floor_row) {
  Medium<2> to(grid, from);
  ColumnMean mean(from, to);
  const std::int64_t rows = from.grid().shape[1];
  for (std::int64_t i = 0; i < grid.shape[0]; ++i) {
    const auto& of = parts[std::size_t(i)];
    const std::int64_t top = has_top ? of.top : 0;
    const auto refuse = [&](const std::string& what) {
      throw Error("found no " + what + " at x=" + shown(grid.centre(0, i)) + ", where the horizon wants some",
                  ErrorKind::usage);
    };
    if (floor_row > 0 && of.floor == top) refuse("fluid above the sea floor");
    if (of.top == rows || (floor_row >= 0 && of.floor == rows)) refuse("rock");
    for (std::int64_t k = 0; k < grid.shape[1]; ++k) {
      const auto edge = [&](std::int64_t row) {
        return (grid.rows->corner({i, row}) + grid.rows->corner({i + 1, row})) / 2;
      };
      const bool above = k < floor_row;
      mean.put_cell(std::size_t(grid.flat({i, k})), i, {edge(k), edge(k + 1)},
                    above || floor_row < 0 ? top : of.floor, above ? of.floor : rows);
    }
  }
  return to;
}

}  // namespace

Horizon parse_imported_horizon(const std::string& text) {
  const bool is_curve = text.starts_with('@') || text.starts_with("smooth@") || text.starts_with("sine,");
  if (is_curve) return Horizon::parse(text);
  try {
    return Horizon(parse_number(text));
  } catch (const Error&) {
    return Horizon::parse("smooth@" + text);
  }
}

std::vector<double> smoothed(const std::vector<double>& stairs_m, double half_m) {
  const std::size_t count = stairs_m.size();
  std::size_t steps = 1;
  for (std::size_t n = 1; n < count; ++n) steps += stairs_m[n] != stairs_m[n - 1];
  if (count < 3 || steps == 1) return stairs_m;
  // The method of multipliers: what bends least, and what is allowed, until they agree. Waves twice as long
  // as a step's tread pass halfway.
  const double wave = 3.14159265358979 * double(steps) / double(count);
  const Bending bending(count, std::pow(wave, 4));
  const double rho = std::pow(wave, 4);
  std::vector<double> allowed = stairs_m, dual(count, 0.), depths(count, 0.);
  constexpr int iterations = 400;
  for (int iteration = 0; iteration < iterations; ++iteration) {
    for (std::size_t n = 0; n < count; ++n) depths[n] = rho * (allowed[n] - dual[n]);
    bending.solve(depths);
    for (std::size_t n = 0; n < count; ++n) {
      allowed[n] = std::clamp(depths[n] + dual[n], stairs_m[n] - half_m, stairs_m[n] + half_m);
      dual[n] += depths[n] - allowed[n];
    }
  }
  for (std::size_t n = 0; n < count; ++n)
    depths[n] = std::clamp(depths[n], stairs_m[n] - half_m, stairs_m[n] + half_m);
  return depths;
}

ImportFit fit_imported(const Model<2>& model, const ImportedHorizons& wanted) {
  const auto& grid = model.grid();
  if (!model.fracture.empty()) throw Error("found fractures, expected a model without", ErrorKind::usage);
  const auto parts = parts_of(model.medium);
  std::vector<FitHorizon> horizons;
  ImportFit result{model, {}, {}};
  const auto add = [&](const std::string& role, const std::string& name, std::vector<double> depths) {
    horizons.push_back({role, role + " " + name, role, true, role == "surface", std::move(depths)});
    std::vector<std::int64_t> rows;
    for (const auto& of : parts) rows.push_back(role == "surface" ? of.top : of.floor);
    compare(grid, horizons.back(), rows, wanted.sampled_m, result.warnings);
  };
  if (wanted.surface) add("surface", "at " + wanted.surface->name(), depths_of(grid, *wanted.surface));
  if (wanted.floor) add("floor", "at " + wanted.floor->name(), depths_of(grid, *wanted.floor));
  if (wanted.find_floor) add("floor", "found", found_floor(grid, parts, wanted.sampled_m));
  for (auto& horizon : horizons)
    if (horizon.role == "floor") horizon.rows_a_cell_above = rows_a_cell_of_fluid(model.medium);
  const auto fit = fit_grid(grid, horizons, {true, true, true, true, false});
  if (!fit.grid.rows) return result;
  const std::int64_t floor_row = horizons.back().role == "floor" ? fit.rows.back() : -1;
  result.model.medium =
      filled(model.medium, fit.grid, parts, wanted.surface.has_value() && fit.rows[0] == 0, floor_row);
  result.summary = fit.summary;
  return result;
}

}  // namespace slipwave
