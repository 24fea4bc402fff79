// SPDX-License-Identifier: BSD-3-Clause
#include "model/single_fracture.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "base/error.hpp"
#include "base/instantiate.hpp"
#include "base/parse.hpp"
#include "geology/points_file.hpp"
#include "grid/extent.hpp"
#include "io/input_bytes.hpp"
#include "model/planar_fracture.hpp"
#include "model/spline_shares.hpp"
#include "model/split_faces.hpp"

namespace slipwave {
namespace {

/// Points in which a piece is taken, per cell.
constexpr double points_a_cell = 32;

/// What a point of a fracture brings to the cells about it.
struct TracePoint {
  double metres;  // of the fracture that it stands for
  const std::array<double, 9>& strain;
};

void add_point(const Grid<2>& grid, const Point<2>& at, const TracePoint& point,
               std::map<std::size_t, CrossedCell<2>>& cells) {
  const auto [x, z] = spline_shares<2>(grid, at);
  for (std::size_t k = 0; k < 3; ++k)
    for (std::size_t i = 0; i < 3; ++i) {
      const Index<2> index = {x.first + std::int64_t(i), z.first + std::int64_t(k)};
      const double share = x.of[i] * z.of[k];
      if (!(share > 0) || index[0] < 0 || index[1] < 0 || index[0] >= grid.shape[0] ||
          index[1] >= grid.shape[1])
        continue;
      const auto number = std::size_t(grid.flat(index));
      auto& cell = cells[number];
      cell.cell = number;
      const double density = share * point.metres / (grid.spacing_m * grid.height(index));
      for (std::size_t n = 0; n < cell.strain.size(); ++n) cell.strain[n] += density * point.strain[n];
    }
}

/// Returns the box within which points count to cells of a grid, in m.
Box<2> bounds_of(const Grid<2>& grid) {
  const double margin = 2 * grid.spacing_m;
  Box<2> box;
  for (std::size_t axis = 0; axis < 2; ++axis) {
    box.low_m[axis] = grid.origin_m[axis] + double(grid.first[axis]) * grid.spacing_m - margin;
    box.high_m[axis] = grid.end(int(axis)) + margin;
  }
  if (!grid.rows) return box;
  const auto corners = grid.rows->corners_m();
  const auto [top, bottom] = std::minmax_element(corners.begin(), corners.end());
  box.low_m[1] = *top, box.high_m[1] = *bottom;
  return box;
}

/// From which to which share of its way a piece may be in a box.
std::array<double, 2> shares_within(const Box<2>& box, const Point<2>& from, const Point<2>& along) {
  double begin = 0, end = 1;
  for (std::size_t axis = 0; axis < 2; ++axis) {
    if (along[axis] == 0) {
      if (from[axis] < box.low_m[axis] || from[axis] > box.high_m[axis]) return {1, 0};
      continue;
    }
    const double a = (box.low_m[axis] - from[axis]) / along[axis],
                 b = (box.high_m[axis] - from[axis]) / along[axis];
    begin = std::max(begin, std::min(a, b)), end = std::min(end, std::max(a, b));
  }
  return begin < end ? std::array{begin, end} : std::array<double, 2>{1, 0};
}

std::string shown_point(const Point<2>& point) { return shown(point[0]) + "," + shown(point[1]); }

/// Marks with the code of a set what its fractures lie in, unless a later cluster took it.
template <int D>
FractureCount mark(Model<D>& model, std::size_t code) {
  FractureCount count;
  for (const auto& crossed : cells_crossed(model.grid(), model.fracture_sets[code - 1])) {
    auto& of_cell = model.fracture[crossed.cell];
    if (!model.medium.is_solid(crossed.cell)) {
      ++count.left;
      continue;
    }
    if (of_cell > code) continue;
    count.taken += of_cell != 0 && of_cell != code && model.fracture_sets[of_cell - 1U].is_cluster();
    of_cell = std::uint8_t(code);
    if (!model.fracture_share.empty()) model.fracture_share[crossed.cell] = 1;
    ++count.marked;
  }
  return count;
}

/// Adds a set whose fractures lie on faces; counts faces, not cells.
FractureCount add_on_faces(Model<2>& model, const FractureSet<2>& set) {
  for (const auto& trace : set.traces) check_on_faces(model.grid(), trace);
  const auto count_faces = [&model] {
    FractureCount count;
    count.marked = std::int64_t(split_faces(model, &count.left).size());
    return count;
  };
  const auto before = count_faces();
  model.fracture_sets.push_back(set);
  auto count = count_faces();
  count.left -= before.left;
  count.marked -= before.marked;
  if (count.marked <= 0)
    throw Error("none of the " + std::to_string(count.left) +
                " faces that the fractures lie on is between solid cells, at least one must be that no other "
                "fracture lies on");
  return count;
}

}  // namespace

FractureTrace<2> parse_segment(const std::string& text) {
  const auto ends = split(text, ':');
  if (ends.size() != 2) throw Error("found '" + text + "', expected X,Z:X,Z", ErrorKind::usage);
  return {parse_point<2>(ends[0]), parse_point<2>(ends[1])};
}

template <int D>
std::vector<FractureTrace<D>> read_fracture_traces(const std::string& path) {
  const auto text = read_text(path);
  return in_place(path, [&] {
    std::vector<FractureTrace<D>> traces;
    std::string part;
    int line = 0, first = 1;
    const auto finish = [&] {
      // Lines of the points are those of the file.
      auto points = points_of_text<D>(std::string(std::size_t(first - 1), '\n') + part);
      FractureTrace<D> trace;
      for (const auto& point : points) trace.push_back(point.at);
      if (!trace.empty() && trace.size() < std::size_t(D))
        throw Error("line " + std::to_string(points[0].line) + ": found a fracture of " +
                    (trace.size() == 1 ? "one point" : "two points") + ", expected at least " +
                    std::to_string(D));
      if (!trace.empty()) traces.push_back(std::move(trace));
      part.clear();
      first = line + 1;
    };
    for (const auto& each : split(text, '\n')) {
      ++line;
      const auto begin = each.find_first_not_of(" \t\r");
      if (begin == std::string::npos || each[begin] == '>')
        finish();
      else
        part += std::string(each) + "\n";
    }
    finish();
    if (traces.empty())
      throw Error(std::string("holds no fracture, expected lines of ") + (D == 2 ? "X Z" : "X Y Z"));
    return traces;
  });
}
SLIPWAVE_INSTANTIATE_D(FUNCTION, read_fracture_traces);

Point<2> normal_between_tips(const FractureTrace<2>& trace) {
  // Of a closed one the first piece.
  const auto& last = trace.back() == trace.front() ? trace.at(1) : trace.back();
  return unit_normal<2>({trace.front()[1] - last[1], last[0] - trace.front()[0]});
}

double length_of(const FractureTrace<2>& trace) {
  double sum = 0;
  for (std::size_t n = 1; n < trace.size(); ++n)
    sum += std::hypot(trace[n][0] - trace[n - 1][0], trace[n][1] - trace[n - 1][1]);
  return sum;
}

namespace {

/// A straight piece of a fracture, its end of the smaller x first.
struct Piece {
  Point<2> from, to;
};

/// Metres that two pieces of the same line have in common.
double common_m(const Piece& one, const Piece& other) {
  const auto length_of_piece = [](const Piece& piece) {
    return std::hypot(piece.to[0] - piece.from[0], piece.to[1] - piece.from[1]);
  };
  const bool first_longer = length_of_piece(one) >= length_of_piece(other);
  const auto &longer = first_longer ? one : other, &shorter = first_longer ? other : one;
  const double length_m = length_of_piece(longer), near_m = 1e-6 * length_m;
  const Point<2> along = {(longer.to[0] - longer.from[0]) / length_m,
                          (longer.to[1] - longer.from[1]) / length_m};
  double low = length_m, high = 0;
  for (const auto& end : {shorter.from, shorter.to}) {
    const double x = end[0] - longer.from[0], z = end[1] - longer.from[1];
    if (std::abs(x * along[1] - z * along[0]) > near_m) return 0;
    low = std::min(low, x * along[0] + z * along[1]), high = std::max(high, x * along[0] + z * along[1]);
  }
  const double common = std::min(high, length_m) - std::max(low, 0.);
  return common > near_m ? common : 0;
}

}  // namespace

double doubled_size(const std::vector<FractureTrace<2>>& traces) {
  std::vector<Piece> pieces;
  for (const auto& trace : traces)
    for (std::size_t n = 1; n < trace.size(); ++n)
      pieces.push_back({std::min(trace[n - 1], trace[n]), std::max(trace[n - 1], trace[n])});
  std::sort(pieces.begin(), pieces.end(),
            [](const Piece& one, const Piece& other) { return one.from[0] < other.from[0]; });
  double sum = 0;
  for (std::size_t n = 0; n < pieces.size(); ++n)
    for (std::size_t k = n + 1; k < pieces.size() && pieces[k].from[0] <= pieces[n].to[0]; ++k)
      sum += common_m(pieces[n], pieces[k]);
  return sum;
}

double doubled_size(const std::vector<FractureTrace<3>>& polygons) {
  auto sorted = polygons;
  std::sort(sorted.begin(), sorted.end());
  double sum = 0;
  for (std::size_t n = 1; n < sorted.size(); ++n)
    if (sorted[n] == sorted[n - 1]) sum += area_of(sorted[n]);
  return sum;
}

namespace {

/// Softer single fractures than this, times the cell, count as free: any rock gives less than a
/// ten-thousandth of what a cell with them does, and strains times moduli stay in the range of numbers.
constexpr double most_give_per_pa = 1e-4;

/// The strain of a cell by a fracture that crosses all of it, times the cell.
template <int D>
auto strain_of_fracture(const Point<D>& normal, const LinearCompliance& of, double spacing_m) {
  const double most = most_give_per_pa * spacing_m;
  return strain_of_plane<D>(normal, std::min(of.normal_m_per_pa, most),
                            std::min(of.tangential_m_per_pa, most));
}

}  // namespace

template <>
std::vector<CrossedCell<2>> cells_crossed(const Grid<2>& grid, const FractureSet<2>& set) {
  if (set.is_cluster()) return {};
  std::map<std::size_t, CrossedCell<2>> cells;
  const auto& of = set.systems.at(0).compliance;
  const auto bounds = bounds_of(grid);
  for (const auto& trace : set.traces)
    for (std::size_t n = 1; n < trace.size(); ++n) {
      const Point<2> along = {trace[n][0] - trace[n - 1][0], trace[n][1] - trace[n - 1][1]};
      const double length_m = std::hypot(along[0], along[1]);
      const Point<2> normal = {-along[1] / length_m, along[0] / length_m};
      const auto strain = strain_of_fracture<2>(normal, of, grid.spacing_m);
      const auto points = std::ceil(points_a_cell * length_m / grid.spacing_m);
      const auto [begin, end] = shares_within(bounds, trace[n - 1], along);
      for (double k = std::floor(begin * points) + 0.5; k < std::min(end * points + 1, points); ++k)
        add_point(grid, {trace[n - 1][0] + along[0] * k / points, trace[n - 1][1] + along[1] * k / points},
                  {length_m / points, strain}, cells);
    }
  std::vector<CrossedCell<2>> all;
  for (const auto& [number, cell] : cells) all.push_back(cell);
  return all;
}

template <>
std::vector<CrossedCell<3>> cells_crossed(const Grid<3>& grid, const FractureSet<3>& set) {
  if (set.is_cluster()) return {};
  std::map<std::size_t, CrossedCell<3>> cells;
  const auto& of = set.systems.at(0).compliance;
  for (const auto& polygon : set.traces) {
    const auto strain = strain_of_fracture<3>(normal_of_polygon(polygon), of, grid.spacing_m);
    for (const auto& [number, density] : densities_of(grid, polygon)) {
      auto& cell = cells[number];
      cell.cell = number;
      for (std::size_t n = 0; n < strain.size(); ++n) cell.strain[n] += density * strain[n];
    }
  }
  std::vector<CrossedCell<3>> all;
  for (const auto& [number, cell] : cells) all.push_back(cell);
  return all;
}

template <int D>
void place_single_fractures(Model<D>& model) {
  const auto& sets = model.fracture_sets;
  if (std::all_of(sets.begin(), sets.end(), [](const auto& set) { return set.is_cluster(); })) return;
  for (auto& code : model.fracture)
    if (code > 0 && !sets[code - 1U].is_cluster()) code = 0;
  for (std::size_t code = 1; code <= sets.size(); ++code)
    if (!sets[code - 1].is_cluster() && !sets[code - 1].on_faces) mark(model, code);
}
SLIPWAVE_INSTANTIATE_D(FUNCTION, place_single_fractures);

void check_trace(const Grid<2>& grid, const FractureTrace<2>& trace) {
  if (trace.size() < 2)
    throw Error("found a fracture of " + std::to_string(trace.size()) + " points, expected at least 2",
                ErrorKind::usage);
  for (std::size_t n = 0; n < trace.size(); ++n) {
    const auto place = grid.row_coordinates(trace[n]);
    for (std::size_t axis = 0; axis < 2; ++axis)
      if (!(place[axis] >= grid.origin_m[axis] && place[axis] <= grid.end(int(axis))))
        throw Error("found the point " + shown_point(trace[n]) + " outside the model, which is at " +
                        shown_box(box_of_grid(grid)),
                    ErrorKind::usage);
    if (n > 0 && trace[n] == trace[n - 1])
      throw Error(
          "found the point " + shown_point(trace[n]) + " twice in a row, expected a piece of some length",
          ErrorKind::usage);
  }
}

void check_trace(const Grid<3>& grid, const FractureTrace<3>& polygon) {
  if (const auto fault = fault_of_polygon(polygon); !fault.empty()) throw Error(fault, ErrorKind::usage);
  const auto box = box_of_grid(grid);
  for (const auto& vertex : polygon)
    for (std::size_t axis = 0; axis < 3; ++axis)
      if (!(vertex[axis] >= box.low_m[axis] && vertex[axis] <= box.high_m[axis]))
        throw Error("found the point " + shown(vertex[0]) + "," + shown(vertex[1]) + "," + shown(vertex[2]) +
                        " outside the model, which is at " + shown_box(box),
                    ErrorKind::usage);
}

template <int D>
FractureCount add_single_fractures(Model<D>& model, const FractureSet<D>& set) {
  for (const auto& trace : set.traces) check_trace(model.grid(), trace);
  check_room_for_set(model);
  if (model.fracture.empty()) model.fracture = Field<D, std::uint8_t>(model.grid());
  if constexpr (D == 2)
    if (set.on_faces) return add_on_faces(model, set);
  model.fracture_sets.push_back(set);
  const auto count = mark(model, model.fracture_sets.size());
  if (count.marked == 0)
    throw Error("none of the " + std::to_string(count.left) +
                " cells that the fractures lie in is solid, at least one must be");
  return count;
}
SLIPWAVE_INSTANTIATE_D(FUNCTION, add_single_fractures);

}  // namespace slipwave
