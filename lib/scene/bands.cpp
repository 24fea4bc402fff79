// SPDX-License-Identifier: BSD-3-Clause
#include "scene/bands.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <utility>

#include "base/error.hpp"
#include "base/instantiate.hpp"
#include "base/parse.hpp"
#include "build/model_in_cells.hpp"
#include "model/split_faces.hpp"
#include "rock/coefficients.hpp"
#include "rock/tilted_mean.hpp"
#include "scene/subdomains.hpp"

namespace slipwave {
namespace {

[[noreturn]] void refuse(const std::string& found, const std::string& expected) {
  throw Error("--bands: found " + found + ", expected " + expected, ErrorKind::usage);
}

/// Places that differ by less than this part of a cell are one: what depths lose to rounding.
constexpr double rounding = 1e-6;

/// How many of these cells make up a length, where it is a whole number of them; else 0.
std::int64_t whole_cells(double length_m, double cell_m) {
  const double cells = length_m / cell_m;
  return std::abs(cells - std::round(cells)) < rounding * std::max(1., cells) ? std::llround(cells) : 0;
}

/// A scene in the cells of a band, and the rows of it that the band has.
template <int D>
struct InCells {
  Scene<D> scene;
  std::int64_t first = 0, last = 0;
  const Grid<D>& grid() const { return scene.model.grid(); }
  std::int64_t rows() const { return last - first; }
};

/// Rows beside a face, counted from it: those above are negative.
struct RowsBeside {
  std::int64_t first, last;
};

/// The row of a grid that begins at a depth; `beside` rows above or below it must be level.
template <int D>
std::int64_t row_at(const Grid<D>& grid, double depth_m, const RowsBeside& beside) {
  const std::int64_t rows = grid.shape[D - 1];
  for (std::int64_t row = 1; row < rows; ++row) {
    if (std::abs(grid.depth_of_face(row) - depth_m) > rounding * grid.spacing_m) continue;
    for (auto near = row + beside.first; grid.rows && near <= row + beside.last; ++near)
      if (!grid.rows->row_is_level(std::clamp<std::int64_t>(near, 0, rows)))
        refuse("a band from z=" + shown(depth_m) + " m on, where rows near it follow a horizon that dips",
               "it where " + std::to_string(beside.last - beside.first) + " rows on both sides are level");
    return row;
  }
  refuse("a band from z=" + shown(depth_m) + " m on, where no row of cells of " + shown(grid.spacing_m) +
             " m begins",
         "it at an interface that rows follow, or at a multiple of the cells of both bands");
}

/// Cells of each band along the horizontal axes: whole ones of the widest. Where the model ends before, its
/// last column continues, as it does in absorbing zones.
template <int D>
Index<D> columns_of_widest(const Scene<D>& scene, double widest_m) {
  const auto& grid = scene.model.grid();
  Index<D> columns{};
  for (int axis = 0; axis < D - 1; ++axis) {
    const double length_m = double(grid.shape[axis]) * grid.spacing_m;
    columns[axis] = whole_cells(length_m, widest_m);
    if (columns[axis] > 0) continue;
    columns[axis] = std::int64_t(std::ceil(length_m / widest_m));
    if (scene.edges[axis][1] != EdgeLaw::absorbing)
      refuse("a model of " + shown(length_m) + " m along " +
                 std::string(1, axis_names<D>()[std::size_t(axis)]) + " and cells of " + shown(widest_m) +
                 " m",
             "cells that divide it, or an absorbing edge behind it");
  }
  return columns;
}

/// Solid, fluid or void.
template <int D>
int kind_of(const Medium<D>& medium, std::size_t cell) {
  return medium.is_solid(cell) ? 2 : medium.is_fluid(cell) ? 1 : 0;
}

/// How many columns of a face between bands have a strong interface on it, as a share.
template <int D>
double share_of_interface(const Medium<D>& medium, std::int64_t face) {
  const auto a_row = medium.grid().size() / medium.grid().shape[D - 1];
  std::int64_t strong = 0;
  for (auto cell = face * a_row; cell < (face + 1) * a_row; ++cell)
    strong += strong_interface(medium, std::size_t(cell - a_row), std::size_t(cell));
  return double(strong) / double(a_row);
}

/// What rows `beside` a face between bands must be, counted from it: each is all solid, all fluid or all
/// void, since columns that are taken together must carry the same waves. Where no strong interface lies on
/// all of the face, none lies between them either: rows of another height a few rows below one fed waves with
/// energy (theory/bands.md).
template <int D>
void check_rows_beside(const Medium<D>& medium, std::int64_t face, const RowsBeside& beside) {
  const auto& grid = medium.grid();
  const auto a_row = std::size_t(grid.size() / grid.shape[D - 1]);
  const auto first = std::size_t(std::max<std::int64_t>(0, face + beside.first)),
             last = std::size_t(std::min(grid.shape[D - 1], face + beside.last));
  const bool on_interface = share_of_interface(medium, face) == 1;
  for (auto row = first; row < last; ++row)
    for (auto cell = row * a_row; cell < (row + 1) * a_row; ++cell) {
      if (kind_of(medium, cell) != kind_of(medium, row * a_row))
        refuse("solid, fluid or void side by side at " + place_of(grid, std::int64_t(cell)) +
                   " beside the begin of a band",
               "rows there of one of them each");
      if (!on_interface && row > first && strong_interface(medium, cell - a_row, cell))
        refuse("an interface at " + place_of(grid, std::int64_t(cell)) + " beside the begin of a band",
               "it on that, or " + std::to_string(beside.last - beside.first) + " rows away");
    }
}

/// The row at which a band begins or ends in the cells of a scene. Throws as what it checks.
template <int D>
std::int64_t face_of_band(const Scene<D>& scene, double depth_m, const RowsBeside& beside) {
  const auto face = row_at(scene.model.grid(), depth_m, beside);
  check_rows_beside(scene.model.medium, face, beside);
  return face;
}

/// Fractures on faces lie on those of one band each, as far from others as sweeps read, where the faces of
/// the model are.
void check_fractures(const Grid<2>& whole, const std::vector<InCells<2>>& all, std::int64_t beside) {
  for (const auto& set : all.front().scene.model.fracture_sets) {
    if (!parts_faces(set)) continue;
    for (const auto& trace : set.traces) {
      const auto [top_m, bottom_m] = std::minmax(trace.front()[1], trace.back()[1]);
      const auto band = std::find_if(all.begin(), all.end(), [&, top_m = top_m](const InCells<2>& each) {
        return each.last == each.grid().shape[1] || each.grid().depth_of_face(each.last) > top_m;
      });
      const auto faces = faces_of(band->grid(), trace);
      const bool level = faces.axis == 1;
      const auto first = level ? faces.face : std::int64_t(std::floor(faces.first)),
                 last = level ? faces.face : std::int64_t(std::ceil(faces.last));
      const std::string what =
          "a fracture of '" + set.name + "' on faces " +
          (level ? "at z=" + shown(top_m) : "from z=" + shown(top_m) + " to " + shown(bottom_m)) + " m";
      if ((band != all.begin() && first - band->first < beside) ||
          (band + 1 != all.end() && band->last - last < beside))
        refuse(what, "it in one band, " + std::to_string(beside) + " rows or more from others");
      if (std::abs(faces.moved_m) > std::abs(faces_of(whole, trace).moved_m) + rounding * whole.spacing_m)
        refuse(what + " between faces of cells of " + shown(band->grid().spacing_m) + " m",
               "cells there whose faces it lies on");
    }
  }
}
void check_fractures(const Grid<3>&, const std::vector<InCells<3>>&, std::int64_t) {}

/// The model in the cells of each band.
template <int D>
std::vector<InCells<D>> in_cells_of_bands(const Scene<D>& scene, const ModelInCells<D>& models) {
  const auto& bands = scene.numerics.bands;
  const auto beside = rows_beside_band(scene.numerics.order);
  std::vector<InCells<D>> all;
  for (const auto& band : bands) {
    all.push_back({in_cells_of(scene, models, band.spacing_m)});
    all.back().last = all.back().grid().shape[D - 1];
  }
  for (std::size_t n = 1; n < all.size(); ++n) {
    all[n - 1].last = face_of_band(all[n - 1].scene, bands[n].from_m, {-beside, 0});
    all[n].first = face_of_band(all[n].scene, bands[n].from_m, {0, beside});
  }
  for (std::size_t n = 1; n < all.size(); ++n) {
    const double one = bands[n - 1].spacing_m, other = bands[n].spacing_m;
    if (std::max(one, other) > (widest_step_in_rock + rounding) * std::min(one, other) &&
        share_of_interface(all[n].scene.model.medium, all[n].first) < 1)
      refuse("cells of " + shown(one) + " and " + shown(other) +
                 " m beside each other at z=" + shown(bands[n].from_m) + " m, where no strong interface lies",
             "one of them " + std::to_string(widest_step_in_rock) + " times the other there");
  }
  for (std::size_t n = 0; n < all.size(); ++n)
    if (all[n].rows() < beside)
      refuse(
          "a band of " + std::to_string(all[n].rows()) + " rows from z=" + shown(bands[n].from_m) + " m on",
          "at least " + std::to_string(beside) + " at order " + std::to_string(scene.numerics.order));
  if (scene.with_slip) check_fractures(scene.model.grid(), all, beside);
  return all;
}

/// A place of a grid along an axis, or the last there is.
template <int D>
std::int64_t or_last(const Grid<D>& grid, int axis, std::int64_t at) {
  return std::min(at, grid.shape[axis] - 1);
}

/// A row of a band's model: that of one of the scenes in cells, and from which depth on it lies, m.
template <int D>
struct RowOf {
  const InCells<D>* from;
  std::int64_t row;
  double top_m;
};

/// Height of a row between level faces, m.
template <int D>
double height_of_row(const Grid<D>& grid, std::int64_t row) {
  return grid.depth_of_face(row + 1) - grid.depth_of_face(row);
}

/// Whether a face between bands lies in one rock, and rows of one are whole ones of the other: rows of both
/// bands then continue across it as high as they are.
template <int D>
bool in_one_rock(const InCells<D>& above, const InCells<D>& below) {
  if (share_of_interface(above.scene.model.medium, above.last) > 0) return false;
  const double one = height_of_row(above.grid(), above.last - 1),
               other = height_of_row(below.grid(), below.first), least = std::min(one, other);
  const double cells = above.grid().spacing_m / below.grid().spacing_m;
  return std::abs(one / cells - other) < rounding * least;
}

/// The rows that a band holds: its own and, beyond, those of its neighbours or as many as high as its own.
template <int D>
std::vector<RowOf<D>> rows_of_band(const std::vector<InCells<D>>& all, std::size_t band,
                                   std::int64_t beside) {
  std::vector<RowOf<D>> rows;
  const auto& own = all[band];
  const auto add = [&](const InCells<D>& from, std::int64_t first, std::int64_t last) {
    for (auto row = first; row < last; ++row) rows.push_back({&from, row, from.grid().depth_of_face(row)});
  };
  const auto add_beyond = [&](const InCells<D>& from, bool above) {
    if (above ? !in_one_rock(from, own) : !in_one_rock(own, from))
      return add(from, above ? from.last - beside : from.first, above ? from.last : from.first + beside);
    const double face_m = own.grid().depth_of_face(above ? own.first : own.last),
                 own_m = height_of_row(own.grid(), above ? own.first : own.last - 1),
                 from_m = height_of_row(from.grid(), above ? from.last - 1 : from.first);
    for (auto n = above ? -beside : 0; n < (above ? 0 : beside); ++n) {
      const auto away = std::int64_t(std::floor((double(n) + 0.5) * own_m / from_m));
      const auto row = (above ? from.last : from.first) + away;
      rows.push_back({&from, std::clamp<std::int64_t>(row, 0, from.grid().shape[D - 1] - 1),
                      face_m + double(n) * own_m});
    }
  };
  if (band > 0) add_beyond(all[band - 1], true);
  add(own, own.first, own.last);
  if (band + 1 < all.size()) add_beyond(all[band + 1], false);
  return rows;
}

/// Depths of the corners of these rows in the columns of a grid.
template <int D>
RowDepths<D> depths_of(const Grid<D>& grid, const std::vector<RowOf<D>>& rows) {
  auto cells = grid.shape;
  cells[D - 1] = std::int64_t(rows.size());
  std::size_t a_row = 1;
  for (int axis = 0; axis < D - 1; ++axis) a_row *= std::size_t(cells[axis] + 1);
  std::vector<double> corners_m;
  corners_m.reserve(a_row * (rows.size() + 1));
  const auto add = [&](const Grid<D>& from, std::int64_t row, double depth_m) {
    // Rows that dip are those of the band itself, with columns as wide as these.
    if (!from.rows || from.rows->row_is_level(row))
      return void(corners_m.insert(corners_m.end(), a_row, depth_m));
    Index<D> at{};
    at[D - 1] = row;
    for (std::size_t n = 0; n < a_row; ++n) {
      auto place = std::int64_t(n);
      for (int axis = 0; axis < D - 1; ++axis) {
        at[axis] = std::min(place % (cells[axis] + 1), from.shape[axis]);
        place /= cells[axis] + 1;
      }
      corners_m.push_back(from.rows->corner(at));
    }
  };
  for (const auto& of : rows) add(of.from->grid(), of.row, of.top_m);
  // The last one ends where the model does, or is as high as the one before.
  const auto& [from, row, top_m] = rows.back();
  const bool own = from->last == row + 1 && rows[rows.size() - 2].from == from;
  add(from->grid(), row + 1,
      own ? from->grid().depth_of_face(row + 1) : 2 * top_m - rows[rows.size() - 2].top_m);
  return {cells, std::move(corners_m)};
}

/// The cell of another band that stands for a cell of this one: that round its centre, or the one behind it.
template <int D>
Index<D> cell_beside(const Grid<D>& grid, const Index<D>& at, const RowOf<D>& row) {
  Index<D> cell = at;
  for (int axis = 0; axis < D - 1; ++axis)
    cell[axis] =
        or_last(row.from->grid(), axis,
                std::int64_t((double(at[axis]) + 0.5) * grid.spacing_m / row.from->grid().spacing_m));
  cell[D - 1] = row.row;
  return cell;
}

/// Rows of fields of the scenes in cells, in the columns of the first one.
template <int D>
class RowsOfFields {
 public:
  RowsOfFields(const Grid<D>& grid, const std::vector<RowOf<D>>& rows) : grid_(grid), rows_(rows) {}
  /// `of(scene)` is the field of a scene; empty where that of the band is.
  template <class Value, class Of>
  Field<D, Value> operator()(const Field<D, Value>& own, Of&& of) const {
    if (own.empty()) return {};
    Field<D, Value> field(grid_);
    for (std::int64_t n = 0; n < grid_.size(); ++n) {
      const auto at = grid_.index(n);
      const auto& row = rows_[std::size_t(at[D - 1])];
      const auto& from = of(row.from->scene);
      if (!from.empty()) field[std::size_t(n)] = from(cell_beside(grid_, at, row));
    }
    return field;
  }

 private:
  const Grid<D>& grid_;
  const std::vector<RowOf<D>>& rows_;
};

/// The model of these rows in the columns of one of the scenes. Nothing slips in rows of other bands.
template <int D>
Model<D> model_of_rows(const InCells<D>& own, const std::vector<RowOf<D>>& rows, const Index<D>& columns) {
  const auto& whole = own.scene.model;
  Grid<D> grid = whole.grid();
  for (int axis = 0; axis < D - 1; ++axis) grid.shape[axis] = columns[axis];
  grid.shape[D - 1] = std::int64_t(rows.size());
  grid.origin_m[D - 1] = rows.front().top_m;
  grid.rows = std::make_shared<const RowDepths<D>>(depths_of(grid, rows));
  const RowsOfFields<D> rows_of(grid, rows);
  Model<D> model;
  model.title = whole.title, model.source = whole.source, model.history = whole.history;
  for (const Property property : whole.medium.properties())
    model.medium[property] = rows_of(
        whole.medium[property], [property](const Scene<D>& scene) -> const auto& {
          return scene.model.medium[property];
        });
  model.fracture = rows_of(
      whole.fracture, [](const Scene<D>& scene) -> const auto& { return scene.model.fracture; });
  for (std::int64_t n = 0; n < std::int64_t(model.fracture.size()); ++n)
    if (rows[std::size_t(grid.index(n)[D - 1])].from != &own) model.fracture[std::size_t(n)] = 0;
  model.fracture_sets = whole.fracture_sets;
  model.fracture_share = rows_of(
      whole.fracture_share, [](const Scene<D>& scene) -> const auto& { return scene.model.fracture_share; });
  for (std::size_t n = 0; n < whole.prestress_pa.size(); ++n)
    model.prestress_pa.push_back(rows_of(
        whole.prestress_pa[n], [n](const Scene<D>& scene) -> const auto& {
          return scene.model.prestress_pa[n];
        }));
  return model;
}

/// What a subdomain knows of the whole model.
template <int D>
Subdomain of_whole(const std::vector<InCells<D>>& all) {
  Subdomain whole;
  for (const auto& each : all) {
    const auto& medium = each.scene.model.medium;
    whole.slips |= each.scene.slips();
    whole.shear |= has_shear(medium);
    whole.anisotropic |= anisotropic_cells(medium) > 0;
    whole.tilted |= couples_pairs(medium, each.scene.numerics.order);
    whole.tilted_means |= tilted_means(medium) > 0;
    whole.has_void |= has_void(medium);
    whole.corrects_inside |= corrects_inside(medium);
    whole.fastest = std::max(whole.fastest, fastest_speed(medium));
    whole.fastest_across_cells = std::max(whole.fastest_across_cells, fastest_across_cells(medium));
  }
  return whole;
}

/// The time step at which no wave of a band crosses more than its share of a cell, s.
template <int D>
double time_step_of(const InCells<D>& band) {
  const auto rows = rows_of(band.scene.model.medium, band.first, band.last);
  return band.scene.numerics.cfl * band.grid().spacing_m / fastest_across_cells(rows);
}

/// The smallest of these.
template <int D>
double time_step_of_bands(const std::vector<InCells<D>>& all) {
  double step_s = std::numeric_limits<double>::infinity();
  for (const auto& each : all) step_s = std::min(step_s, time_step_of(each));
  return step_s;
}

/// Cells of an absorbing zone from which on its damping is resolved well enough: that many send back as much
/// at half the usual time step as 20 do at the usual one (theory/sources.md).
constexpr std::int64_t fewest_zone_cells = 12;

/// Absorbing zones are as wide in all bands, in whole cells of the widest: the width that is given, or as
/// many cells as without bands. What a zone sends back falls with the square of its damping times the time
/// step (theory.md (E14b)), so where `step_s`, that of all bands, is less than these cells allow fewer of
/// them do.
template <int D>
std::int64_t zone_of_widest(const Scene<D>& scene, const std::vector<InCells<D>>& all, double step_s) {
  const auto wider = [](const InCells<D>& one, const InCells<D>& other) {
    return one.grid().spacing_m < other.grid().spacing_m;
  };
  const auto& widest = *std::max_element(all.begin(), all.end(), wider);
  const auto& source = scene.survey.sources.front();
  const auto cells = double(zone_cells(widest.scene, source));
  if (scene.numerics.zone_cells > 0)
    return std::int64_t(
        std::ceil(cells * scene.model.grid().spacing_m / widest.grid().spacing_m * (1 - rounding)));
  // That of plane waves is a length.
  if (std::holds_alternative<PlaneWave<D>>(source.mechanism)) return std::int64_t(cells);
  return std::max(fewest_zone_cells, std::int64_t(std::ceil(cells * step_s / time_step_of(widest))));
}

/// By row, the slowest wave of that row and all below, m/s.
template <int D>
std::vector<double> slowest_below(const Medium<D>& medium) {
  if (anisotropic_cells(medium) > 0) return slowest_below(in_slowest_directions(medium));
  const auto& grid = medium.grid();
  const auto rows = std::size_t(grid.shape[D - 1]), a_row = std::size_t(grid.size()) / rows;
  std::vector<double> slowest(rows);
  double least = std::numeric_limits<double>::infinity();
  for (auto row = rows; row-- > 0;) {
    for (auto cell = row * a_row; cell < (row + 1) * a_row; ++cell)
      if (!medium.is_void(cell))
        least = std::min(least, double(medium.is_fluid(cell) ? medium.vp[cell] : medium.vs[cell]));
    slowest[row] = least;
  }
  return slowest;
}

template <int D>
void check_bands(const Scene<D>& scene) {
  const auto& bands = scene.numerics.bands;
  const double largest = largest_cell_m(bands);
  for (std::size_t n = 0; n < bands.size(); ++n) {
    if (!whole_cells(largest, bands[n].spacing_m))
      refuse("cells of " + shown(bands[n].spacing_m) + " and of " + shown(largest) + " m",
             "each to divide the largest");
    if (n == 0) continue;
    const double one = bands[n - 1].spacing_m, other = bands[n].spacing_m;
    const auto ratio = whole_cells(std::max(one, other), std::min(one, other));
    if (ratio < 2 || ratio > widest_step_of_bands)
      refuse("cells of " + shown(one) + " m beside cells of " + shown(other) + " m",
             "one of them 2, 3 or " + std::to_string(widest_step_of_bands) + " times the other");
  }
  if (scene.numerics.time_step_s) refuse("--time-step", "--cfl with bands");
  if (scene.numerics.monotone) refuse("--monotone", "it without bands");
}

}  // namespace

std::vector<Band> parse_bands(const std::string& text) {
  if (text.empty() || text == "none" || text == "auto") return {};
  std::vector<Band> bands;
  for (const auto& part : split(text, ',')) {
    const auto colon = part.find(':');
    if (colon == std::string::npos) refuse("'" + part + "'", "DEPTH:STEP,... such as 0:0.5,30:2");
    const auto number = [](const std::string& digits) {
      return in_place("--bands", [&] { return parse_number(digits); });
    };
    bands.push_back({number(part.substr(0, colon)), number(part.substr(colon + 1))});
    const auto& band = bands.back();
    if (!(band.spacing_m > 0) || !std::isfinite(band.spacing_m))
      refuse("cells of " + shown(band.spacing_m) + " m", "them above 0");
    if (bands.size() == 1 ? band.from_m != 0 : !(band.from_m > bands[bands.size() - 2].from_m))
      refuse("'" + text + "'", "depths that begin with 0 and deepen");
  }
  if (bands.size() < 2) refuse("one band", "two or more, or none");
  return bands;
}

std::string shown(const std::vector<Band>& bands, int digits) {
  std::string text;
  for (const auto& band : bands)
    text += (text.empty() ? "" : ", from z=" + shown(band.from_m) + " m on ") +
            (digits > 0 ? shown(band.spacing_m, digits) : shown(band.spacing_m)) + " m";
  return text;
}

double largest_cell_m(const std::vector<Band>& bands) {
  double largest = 0;
  for (const auto& band : bands) largest = std::max(largest, band.spacing_m);
  return largest;
}

std::vector<Band> resized(std::vector<Band> bands, double ratio) {
  for (auto& band : bands) band.spacing_m *= ratio;
  return bands;
}

template <int D>
std::vector<Scene<D>> scenes_of_bands(const Scene<D>& scene) {
  check_bands(scene);
  const auto all = in_cells_of_bands(scene, ModelInCells<D>(scene.model, scene.attenuation));
  const auto whole = of_whole(all);
  const auto beside = rows_beside_band(scene.numerics.order);
  const double step_s = time_step_of_bands(all), largest = largest_cell_m(scene.numerics.bands);
  const auto zone = zone_of_widest(scene, all, step_s);
  const auto widest = columns_of_widest(scene, largest);
  std::vector<Scene<D>> scenes;
  for (std::size_t n = 0; n < all.size(); ++n) {
    const auto rows = rows_of_band(all, n, beside);
    const auto times = whole_cells(largest, scene.numerics.bands[n].spacing_m);
    auto columns = widest;
    for (auto& count : columns) count *= times;
    auto band = with_model(scene, model_of_rows(all[n], rows, columns));
    band.subdomain = whole;
    band.subdomain.rows = std::int64_t(rows.size());
    band.subdomain.first = n > 0 ? beside : 0;
    band.subdomain.last = band.subdomain.first + all[n].rows();
    band.subdomain.other_cells = {n > 0 ? beside : 0, n + 1 < all.size() ? beside : 0};
    band.subdomain.own_heights = {n > 0 && in_one_rock(all[n - 1], all[n]),
                                  n + 1 < all.size() && in_one_rock(all[n], all[n + 1])};
    band.subdomain.side_speeds = side_speeds(band.model.medium, Subdomain{});
    band.numerics.time_step_s = step_s;
    band.numerics.zone_cells = int(zone * times);
    band.numerics.bands.clear();
    scenes.push_back(std::move(band));
  }
  return scenes;
}

/// Cells times steps of a second, absorbing zones included.
template <int D>
double cost_of_bands(const Scene<D>& scene, const std::vector<InCells<D>>& all) {
  double widest = 0, cells = 0;
  for (const auto& each : all) widest = std::max(widest, each.grid().spacing_m);
  const double step_s = time_step_of_bands(all);
  const double zone_m = double(zone_of_widest(scene, all, step_s)) * widest;
  for (std::size_t n = 0; n < all.size(); ++n) {
    const double spacing = all[n].grid().spacing_m;
    const auto zones = [&](int axis, int side) {
      return scene.edges[axis][side] == EdgeLaw::absorbing ? zone_m / spacing : 0;
    };
    double of_band =
        double(all[n].rows()) + (n == 0 ? zones(D - 1, 0) : 0) + (n + 1 == all.size() ? zones(D - 1, 1) : 0);
    for (int axis = 0; axis < D - 1; ++axis)
      of_band *= double(all[n].grid().shape[axis]) + zones(axis, 0) + zones(axis, 1);
    cells += of_band;
  }
  return cells / step_s;
}

template <int D>
ChosenBands bands_for(const Scene<D>& scene) {
  const auto& grid = scene.model.grid();
  const auto slowest = slowest_below(scene.model.medium);
  // Nothing is made in other cells where no waves call for them.
  if (slowest.back() < 2 * slowest.front()) return {};
  const auto beside = rows_beside_band(scene.numerics.order);
  Scene<D> banded = scene;
  auto& bands = banded.numerics.bands;
  bands = {{0, grid.spacing_m}};
  const ModelInCells<D> models(scene.model, scene.attenuation);
  std::map<double, Scene<D>> in_cells;
  const auto fits = [&](double from_m, double cell_m, const RowsBeside& rows) {
    auto found = in_cells.find(cell_m);
    if (found == in_cells.end()) found = in_cells.emplace(cell_m, in_cells_of(scene, models, cell_m)).first;
    try {
      return face_of_band(found->second, from_m, rows) + rows.last <= found->second.model.grid().shape[D - 1];
    } catch (const Error&) {
      return false;
    }
  };
  std::int64_t last = 0;  // row of the last face, in the model's cells
  for (std::int64_t row = beside; row < grid.shape[D - 1]; ++row) {
    const auto& above = bands.back();
    const double times = grid.spacing_m / above.spacing_m;
    if (double(row - last) * times < double(beside)) continue;
    const double room = slowest[std::size_t(row)] / slowest.front() * times;
    for (int ratio = std::min(widest_step_of_bands, int(room)); ratio >= 2; --ratio) {
      if (grid.rows && !grid.rows->row_is_level(row)) break;
      const Band band{grid.depth_of_face(row), above.spacing_m * ratio};
      if (ratio > widest_step_in_rock && share_of_interface(scene.model.medium, row) < 1) continue;
      if (!fits(band.from_m, above.spacing_m, {-beside, 0}) ||
          !fits(band.from_m, band.spacing_m, {0, beside}))
        continue;
      bands.push_back(band);
      last = row;
      break;
    }
  }
  // Wider cells make absorbing zones wider: the fewest cells and steps may be those of some of the bands.
  ChosenBands best;
  const double whole = cost_of_bands(scene, {{scene, 0, grid.shape[D - 1]}});
  for (; bands.size() > 1; bands.pop_back()) try {
      check_bands(banded);
      columns_of_widest(banded, largest_cell_m(bands));
      const double share = cost_of_bands(scene, in_cells_of_bands(banded, models)) / whole;
      if (share <= 0.5 && share < best.share) best = {bands, share};
    } catch (const Error&) {  // the scene does not go with these
    }
  return best;
}

SLIPWAVE_INSTANTIATE_D(FUNCTION, bands_for);
SLIPWAVE_INSTANTIATE_D(FUNCTION, scenes_of_bands);

}  // namespace slipwave
