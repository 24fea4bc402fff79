// SPDX-License-Identifier: BSD-3-Clause
#include "geology/fit.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <utility>

#include "base/error.hpp"
#include "base/instantiate.hpp"
#include "base/parse.hpp"

namespace slipwave {
namespace {

// Of a height, in cells. A bed of one cell between solids has three rows.
constexpr double least_height = 0.2, least_height_of_weak = 1. / 3, largest_height = 1.6;
// Nearer than that to a face, in cells, a horizon lies on it.
constexpr double on_face = 1e-6;
// A smoothstep over n rows changes their heights by 1.5/n of the shift that it takes up.
constexpr double steepest = 1.5, gentle = 0.15, firm = 0.25;
constexpr std::int64_t least_fade = 4;
// With fewer between two interfaces the reconstruction has a low order (docs/theory/interfaces.md).
constexpr std::int64_t least_rows = 3;
// Layers of fewer rows have them counted by thickness alone, and where they are slow have up to so many.
constexpr std::int64_t thin_rows = 8;

double smoothstep(double t) {
  t = std::clamp(t, 0., 1.);
  return t * t * (3 - 2 * t);
}

struct Extent {
  double least = std::numeric_limits<double>::infinity(), largest = -std::numeric_limits<double>::infinity(),
         mean = 0;
  std::size_t least_at = 0, largest_at = 0;
};

/// Returns the extent of the values of a function of the number of a column.
template <class Value>
Extent extent_of(std::size_t columns, const Value& value) {
  Extent of;
  for (std::size_t n = 0; n < columns; ++n) {
    const double here = value(n);
    if (here < of.least) of.least = here, of.least_at = n;
    if (here > of.largest) of.largest = here, of.largest_at = n;
    of.mean += here;
  }
  of.mean /= double(columns);
  return of;
}

/// A horizon that is followed, or the level top or bottom of the model.
struct Knot {
  std::string name;
  const std::vector<double>* depths_m = nullptr;  // null: level
  double mean_m = 0;
  bool strong = true;
  double rows_a_cell_above = 1;
  std::int64_t row = 0;  // counted from z = 0
  double at(std::size_t column) const { return depths_m ? (*depths_m)[column] : mean_m; }
};

/// The way from one knot to the next: rows over which the shifts of both ends fade, and whether those between
/// them are regular. Otherwise all rows of a column are of one height.
struct Filling {
  bool regular_between = false;
  std::int64_t from_above = 0, to_below = 0;
};

/// Whether a grid can follow some horizons together, and how.
template <int D>
class Rows {
 public:
  Rows(const Grid<D>& regular, const std::vector<FitHorizon>& horizons)
      : grid_(regular), horizons_(horizons), columns_(corner_columns(regular)) {}

  /// Horizons by their numbers from the top down. Returns why they cannot be followed, "" if they can.
  std::string take(const std::vector<std::size_t>& chosen);
  /// The grid that follows those taken last.
  Grid<D> grid(const std::vector<std::size_t>& chosen) const;
  /// Row of corners in it of the nth horizon taken.
  std::int64_t row(std::size_t n) const {
    return knots_[n + (top_is_level() ? 1 : 0)].row - knots_.front().row;
  }

 private:
  double h() const { return grid_.spacing_m; }
  bool top_is_level() const { return knots_.front().depths_m == nullptr; }
  double shift(const Knot& knot, std::size_t column) const {
    return knot.at(column) - double(knot.row) * h();
  }
  double largest_shift(const Knot& knot) const;
  bool is_level(const Knot& knot) const;
  std::string place(std::size_t column) const;
  void set_knots(const std::vector<std::size_t>& chosen);
  std::string check_order() const;
  std::string count_rows(std::size_t k);
  Filling filling(const Knot& above, const Knot& below) const;
  void fill(const Knot& above, const Knot& below, std::vector<double>& corners) const;

  Grid<D> grid_;
  const std::vector<FitHorizon>& horizons_;
  std::vector<Point<D>> columns_;
  std::vector<Knot> knots_;
};

template <int D>
std::string Rows<D>::place(std::size_t column) const {
  std::string text;
  for (std::size_t axis = 0; axis + 1 < D; ++axis) {
    text += (axis ? " " : "") + std::string(1, axis_names<D>()[axis]) + '=' + shown(columns_[column][axis]);
  }
  return text;
}

template <int D>
double Rows<D>::largest_shift(const Knot& knot) const {
  const auto shifts = extent_of(columns_.size(), [&](std::size_t n) { return shift(knot, n); });
  return std::max(std::abs(shifts.least), std::abs(shifts.largest));
}

template <int D>
bool Rows<D>::is_level(const Knot& knot) const {
  const auto depths = extent_of(columns_.size(), [&](std::size_t n) { return knot.at(n); });
  return depths.largest - depths.least <= on_face * h();
}

template <int D>
void Rows<D>::set_knots(const std::vector<std::size_t>& chosen) {
  knots_.clear();
  const bool has_top = !chosen.empty() && horizons_[chosen.front()].is_top;
  if (!has_top) knots_.push_back({"top of the model"});
  std::size_t next = 0;  // after the one taken before
  for (const std::size_t n : chosen) {
    const auto& horizon = horizons_[n];
    const auto depths = extent_of(columns_.size(), [&](std::size_t at) { return horizon.depths_m[at]; });
    double rows_a_cell = horizon.rows_a_cell_above;
    for (; next < n; ++next) rows_a_cell = std::min(rows_a_cell, horizons_[next].rows_a_cell_above);
    ++next;
    knots_.push_back({horizon.shown, &horizon.depths_m, depths.mean, horizon.strong, rows_a_cell, 0});
  }
  const std::int64_t rows = grid_.shape[D - 1];
  knots_.push_back({"bottom of the model", nullptr, double(rows) * h(), true, 1, rows});
  knots_.front().row = std::llround(knots_.front().mean_m / h());
}

/// Each below the one before it, and inside the model.
template <int D>
std::string Rows<D>::check_order() const {
  for (std::size_t k = 0; k < knots_.size(); ++k) {
    const auto thickness = extent_of(columns_.size(), [&](std::size_t n) {
      return knots_[k].at(n) - (k ? knots_[k - 1].at(n) : -on_face * h());
    });
    if (thickness.least > 0) continue;
    const auto at =
        " at " + place(thickness.least_at) + ", z=" + shown_to_thousandths(knots_[k].at(thickness.least_at));
    if (k == 0 || (k == 1 && top_is_level())) return knots_[k].name + " leaves the model at its top," + at;
    if (k + 1 < knots_.size()) return knots_[k].name + " meets or crosses " + knots_[k - 1].name + at;
    return knots_[k - 1].name + " leaves the model at its bottom, at " + place(thickness.least_at) +
           ", z=" + shown_to_thousandths(knots_[k - 1].at(thickness.least_at));
  }
  return {};
}

/// Sets the row of knot k + 1, or only checks it where that is the bottom.
template <int D>
std::string Rows<D>::count_rows(std::size_t k) {
  const Knot& above = knots_[k];
  Knot& below = knots_[k + 1];
  const bool last = k + 2 == knots_.size();
  const auto cells =
      extent_of(columns_.size(), [&](std::size_t n) { return (below.at(n) - above.at(n)) / h(); });
  const double least = above.strong && below.strong ? least_height : least_height_of_weak;
  const auto most = std::int64_t(std::floor(cells.least / least * (1 + 1e-9)));
  const auto fewest = std::int64_t(std::ceil(cells.largest / largest_height * (1 - 1e-9)));
  std::int64_t count = std::llround(cells.mean);
  if (count < thin_rows) {
    const auto free = std::int64_t(std::floor(cells.least * below.rows_a_cell_above * (1 + 1e-9)));
    count =
        std::max({count, std::clamp<std::int64_t>(most, 1, least_rows), std::min({most, free, thin_rows})});
  } else if (const auto aligned = std::llround(below.mean_m / h()) - above.row;
             aligned > 0 && std::abs(cells.mean / double(aligned) - 1) <= 0.1) {
    count = aligned;  // makes good what was rounded above
  }
  // The bottom has its row already; each horizon before it needs one.
  const auto room = knots_.back().row - above.row - std::int64_t(knots_.size() - 2 - k);
  count = last ? below.row - above.row : std::min(std::max(count, fewest), room);
  if (count <= most && count >= fewest && count > 0) {
    below.row = above.row + count;
    return {};
  }
  const auto apart = above.name + " and " + below.name + " are " + shown_to_thousandths(cells.least * h()) +
                     " m apart at " + place(cells.least_at);
  const std::string thin = std::string("thinner than ") + (least == least_height ? "a fifth" : "a third") +
                           " of a cell of " + shown(h()) + " m";
  if (cells.largest <= largest_height * double(std::max<std::int64_t>(most, 1)))
    return apart + ", rows between them would be " + thin;
  return apart + " and " + shown_to_thousandths(cells.largest * h()) + " m at " + place(cells.largest_at) +
         ", rows between them would be " + thin + " or thicker than 1.6 cells";
}

template <int D>
std::string Rows<D>::take(const std::vector<std::size_t>& chosen) {
  set_knots(chosen);
  if (auto why = check_order(); !why.empty()) return why;
  for (std::size_t k = 0; k + 1 < knots_.size(); ++k)
    if (auto why = count_rows(k); !why.empty()) return why;
  return {};
}

template <int D>
Filling Rows<D>::filling(const Knot& above, const Knot& below) const {
  const double at_top = largest_shift(above), at_end = largest_shift(below);
  const std::int64_t rows = below.row - above.row;
  // Level layers have rows of one height, but for the last, which may have regular ones.
  const bool level = is_level(above) && is_level(below) && &below != &knots_.back();
  if (level && std::max(at_top, at_end) > on_face * h()) return {};
  for (const double change : {gentle, firm}) {
    const auto rows_for = [&](double shift) {
      if (shift <= on_face * h()) return std::int64_t{0};
      return std::max(least_fade, std::int64_t(std::ceil(steepest * shift / (change * h()))));
    };
    const Filling of{true, rows_for(at_top), rows_for(at_end)};
    if (of.from_above + of.to_below <= rows) return of;
  }
  return {};
}

/// Depths of corners of the rows from one knot to the next, without that of the latter.
template <int D>
void Rows<D>::fill(const Knot& above, const Knot& below, std::vector<double>& corners) const {
  const auto way = filling(above, below);
  for (std::int64_t row = above.row; row < below.row; ++row) {
    const auto from = double(row - above.row), to = double(below.row - row);
    double of_above = to / double(below.row - above.row), of_below = 1 - of_above;
    if (way.regular_between) {
      of_above = way.from_above > 0 ? 1 - smoothstep(from / double(way.from_above)) : 0;
      of_below = way.to_below > 0 ? 1 - smoothstep(to / double(way.to_below)) : 0;
    }
    for (std::size_t n = 0; n < columns_.size(); ++n) {
      double depth = double(row) * h();
      if (row == above.row) {
        depth = above.at(n);
      } else {
        if (of_above != 0) depth += of_above * shift(above, n);
        if (of_below != 0) depth += of_below * shift(below, n);
      }
      corners.push_back(depth);
    }
  }
}

template <int D>
Grid<D> Rows<D>::grid(const std::vector<std::size_t>& chosen) const {
  Grid<D> fitted = grid_;
  const std::int64_t first = knots_.front().row;
  fitted.shape[D - 1] = knots_.back().row - first;
  fitted.origin_m[D - 1] = double(first) * h();
  std::vector<double> corners;
  corners.reserve(columns_.size() * std::size_t(fitted.shape[D - 1] + 1));
  for (std::size_t k = 0; k + 1 < knots_.size(); ++k) fill(knots_[k], knots_[k + 1], corners);
  for (std::size_t n = 0; n < columns_.size(); ++n) corners.push_back(knots_.back().at(n));
  std::vector<FittedHorizon> followed;
  for (std::size_t n = 0; n < chosen.size(); ++n) {
    const auto& horizon = horizons_[chosen[n]];
    followed.push_back({horizon.name, horizon.role, row(n)});
  }
  fitted.rows = std::make_shared<const RowDepths<D>>(fitted.shape, std::move(corners), std::move(followed));
  return fitted;
}

/// Whether a horizon is level and on a face of a regular grid.
bool lies_on_face(const FitHorizon& horizon, double spacing_m) {
  const double face = std::round(horizon.depths_m.front() / spacing_m);
  return std::all_of(horizon.depths_m.begin(), horizon.depths_m.end(),
                     [&](double depth) { return std::abs(depth / spacing_m - face) <= on_face; });
}

bool is_chosen(const FitHorizon& horizon, const FitChoice& choice) {
  if (horizon.role == "surface") return choice.surfaces;
  return horizon.strong ? choice.floors : choice.layers;
}

/// Numbers of horizons in the order in which they are tried: strong ones first, each kind from the top down.
/// Those on faces want to stay there when others bend the rows.
std::vector<std::size_t> in_order_of_need(const std::vector<FitHorizon>& horizons, const FitChoice& choice,
                                          double spacing_m) {
  std::vector<std::size_t> order;
  for (const bool strong : {true, false})
    for (std::size_t n = 0; n < horizons.size(); ++n) {
      const bool wanted = is_chosen(horizons[n], choice) || lies_on_face(horizons[n], spacing_m);
      if (horizons[n].strong == strong && wanted) order.push_back(n);
    }
  return order;
}

/// "fitted: floor at 400 m, layer at 600 m, rows 0.82 to 1.21 of 5 m"
template <int D>
std::string summary_of(const Grid<D>& grid, const std::vector<FitHorizon>& horizons,
                       const std::vector<std::size_t>& chosen) {
  std::string text = "fitted: ";
  for (const std::size_t n : chosen) text += horizons[n].shown + ", ";
  const auto [thinnest, thickest] = grid.rows->heights();
  const auto share = [&](double height) { return shown(std::round(height / grid.spacing_m * 100) / 100); };
  return text + "rows " + share(thinnest) + " to " + share(thickest) + " of " + shown(grid.spacing_m) + " m";
}

}  // namespace

FitChoice parse_fit(std::string_view text) {
  if (text == "none") return {false, false, false, true, false};
  if (text == "all") return {true, true, true, true, false};
  FitChoice choice{false, false, false, true, false};
  for (const auto& word : split(text, ',')) {
    if (word != "surface" && word != "floor") {
      throw Error("found '" + std::string(text) + "', expected surface, floor, surface,floor, all or none",
                  ErrorKind::usage);
    }
    (word == "surface" ? choice.surfaces : choice.floors) = true;
  }
  return choice;
}

template <int D>
std::vector<Point<D>> corner_columns(const Grid<D>& grid) {
  std::vector<Point<D>> columns;
  const std::int64_t lines = D == 3 ? grid.shape[1] : 0;
  for (std::int64_t j = 0; j <= lines; ++j)
    for (std::int64_t i = 0; i <= grid.shape[0]; ++i) {
      Point<D> at{};
      at[0] = grid.origin_m[0] + double(i) * grid.spacing_m;
      if (D == 3) at[1] = grid.origin_m[1] + double(j) * grid.spacing_m;
      columns.push_back(at);
    }
  return columns;
}

template <int D>
Fit<D> fit_grid(const Grid<D>& regular, const std::vector<FitHorizon>& horizons, const FitChoice& choice) {
  Fit<D> fit{regular, std::vector<std::int64_t>(horizons.size(), -1), {}, {}};
  const auto order = in_order_of_need(horizons, choice, regular.spacing_m);
  const auto on_faces = [&](std::size_t n) { return lies_on_face(horizons[n], regular.spacing_m); };
  const auto stays_regular = [&](const std::vector<std::size_t>& followed) {
    return followed.empty() || (!choice.always && std::all_of(followed.begin(), followed.end(), on_faces));
  };
  if (stays_regular(order)) return fit;
  Rows<D> rows(regular, horizons);
  std::vector<std::size_t> chosen;
  std::vector<std::pair<std::size_t, std::string>> left_out;
  for (const std::size_t n : order) {
    auto with = chosen;
    with.insert(std::upper_bound(with.begin(), with.end(), n), n);
    const auto why = rows.take(with);
    if (why.empty()) {
      chosen = std::move(with);
    } else if (choice.asked && horizons[n].strong && is_chosen(horizons[n], choice)) {
      throw Error(why + "; move it, use other cells or do not fit it", ErrorKind::usage);
    } else {
      left_out.emplace_back(n, "not fitted: " + why);
    }
  }
  const bool regular_stays = stays_regular(chosen);
  for (const auto& [n, sentence] : left_out)
    if (!regular_stays || !on_faces(n)) fit.left_out.push_back(sentence);
  if (regular_stays) return fit;
  rows.take(chosen);
  for (std::size_t n = 0; n < chosen.size(); ++n) fit.rows[chosen[n]] = rows.row(n);
  fit.grid = rows.grid(chosen);
  fit.summary = summary_of(fit.grid, horizons, chosen);
  return fit;
}

SLIPWAVE_INSTANTIATE_D(FUNCTION, corner_columns);
SLIPWAVE_INSTANTIATE_D(FUNCTION, fit_grid);

}  // namespace slipwave
