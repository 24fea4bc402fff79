// SPDX-License-Identifier: BSD-3-Clause
#include "geology/layers.hpp"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "base/error.hpp"
#include "base/instantiate.hpp"
#include "base/parse.hpp"
#include "rock/anisotropy.hpp"
#include "rock/cut_cell.hpp"
#include "rock/property_range.hpp"
#include "rock/stiffness_input.hpp"
#include "rock/tilted_mean.hpp"

namespace slipwave {

template <int D>
void check_reach(const Grid<D>& grid, const Horizon& top) {
  if (D == 2 && top.is_grid()) {
    throw Error(
        "found a grid of depths over x and y in " + top.name() + ", expected points X Z for a model in 2-D",
        ErrorKind::usage);
  }
  for (int axis = 0; axis < D - 1; ++axis) {
    const double first = grid.centre(axis, 0), last = grid.centre(axis, grid.shape[std::size_t(axis)] - 1);
    if (top.from_m(axis) <= first && top.to_m(axis) >= last) continue;
    throw Error(top.name() + " reaches from " + axis_names<D>()[std::size_t(axis)] + " = " +
                shown(top.from_m(axis)) + " to " + shown(top.to_m(axis)) + " m, expected at least " +
                shown(first) + " to " + shown(last) + ", the centres of the outer cells");
  }
}

namespace {

// vp, vs, rho, the fracture code, and what writing them needs.
constexpr double bytes_a_cell = 16;

/// Tops of all layers at the places of a line along x: [place][layer].
using Tops = std::vector<std::vector<double>>;

Tops tops_along(const std::vector<Layer>& layers, const std::vector<double>& x_m, double y_m) {
  Tops tops(x_m.size());
  for (std::size_t n = 0; n < x_m.size(); ++n) {
    tops[n].reserve(layers.size());
    for (const auto& layer : layers) tops[n].push_back(layer.top.at(x_m[n], y_m));
  }
  return tops;
}

/// Lines of columns: one in 2-D, as many as cells along y in 3-D.
template <int D>
std::int64_t lines_of(const Grid<D>& grid) {
  return D == 2 ? 1 : grid.shape[1];
}

/// Returns where cells have their centres along y, in m; 0 in 2-D, where nothing changes along it.
template <int D>
double y_of(const Grid<D>& grid, std::int64_t line) {
  return D == 2 ? 0. : grid.centre(1, line);
}

/// Lines that tops differ on: only grids change along y.
template <int D>
std::int64_t different_lines(const Grid<D>& grid, const std::vector<Layer>& layers) {
  const bool grids =
      std::any_of(layers.begin(), layers.end(), [](const auto& layer) { return layer.top.is_grid(); });
  return grids ? lines_of(grid) : 1;
}

/// Does a top lie above the one before it in every column?
template <int D>
bool is_above(const Grid<D>& grid, const Layer& layer, const Layer& before) {
  const std::int64_t lines = different_lines(grid, {layer, before});
  for (std::int64_t line = 0; line < lines; ++line) {
    const double y = y_of(grid, line);
    for (std::int64_t n = 0; n < grid.shape[0]; ++n) {
      const double x = grid.centre(0, n);
      if (!(layer.top.at(x, y) < before.top.at(x, y))) return false;
    }
  }
  return true;
}

template <int D>
void check_pile(const Grid<D>& grid, const std::vector<Layer>& layers) {
  if (layers.empty()) throw Error("found no layer, expected at least one", ErrorKind::usage);
  for (std::size_t i = 0; i < layers.size(); ++i) {
    const auto& top = layers[i].top;
    check_reach(grid, top);
    if (i == 0) continue;
    const auto& before = layers[i - 1].top;
    if (top.is_plane() && before.is_plane()) {
      if (top.depth_m() >= before.depth_m()) continue;
      throw Error("the layer at " + top.name() + " comes after the one at " + before.name() +
                      "; give layers from the top down",
                  ErrorKind::usage);
    }
    if (is_above(grid, layers[i], layers[i - 1])) {
      throw Error("the layer at " + top.name() + " lies above the one before it, at " + before.name() +
                      ", all along the model; expected them from the top down",
                  ErrorKind::usage);
    }
  }
}

/// Tops of all layers over a line of columns: at their centres, and at their upright edges at the low and the
/// high side in y, where edges[n] is before column n and edges[n + 1] beyond it.
struct LineOfTops {
  Tops centres, low_edges, high_edges;
};

template <int D>
LineOfTops tops_of_line(const Grid<D>& grid, const std::vector<Layer>& layers, std::int64_t line) {
  const double half = grid.spacing_m / 2, y = y_of(grid, line);
  std::vector<double> centres, edges;
  for (std::int64_t n = 0; n < grid.shape[0]; ++n) centres.push_back(grid.centre(0, n));
  for (std::int64_t n = 0; n <= grid.shape[0]; ++n) edges.push_back(grid.centre(0, n) - half);
  return {tops_along(layers, centres, y), tops_along(layers, edges, y - half),
          tops_along(layers, edges, y + half)};
}

/// "A", "A+K" or "A-K": a value at the top, and what it gains with depth.
struct Trend {
  double value = 0, gradient = 0;
};

Trend parse_trend(std::string_view text) {
  for (std::size_t n = text.size(); n-- > 1;) {
    if (text[n] != '+' && text[n] != '-') continue;
    if (text[n - 1] == 'e' || text[n - 1] == 'E') continue;  // an exponent's sign
    const double size = parse_number(text.substr(n + 1));
    return {parse_number(text.substr(0, n)), text[n] == '-' ? -size : size};
  }
  return {parse_number(text), 0};
}

/// Takes away what stands behind the numbers of a layer, after ':' or blanks: "qp=80", "qs=40".
std::vector<std::string> take_named(std::vector<std::string>& parts) {
  std::vector<std::string> named;
  for (std::size_t n = 1; n < parts.size();) {
    const auto words = split(parts[n], ' ');
    const bool all = words.front().find('=') != std::string::npos;
    if (!all && !named.empty())
      throw Error("found '" + parts[n] + "' behind " + named.back() +
                      ", expected NAME=VALUE there; DIP stands before",
                  ErrorKind::usage);
    for (std::size_t w = all ? 0 : 1; w < words.size(); ++w)
      if (!words[w].empty()) named.emplace_back(words[w]);
    if (all) {
      parts.erase(parts.begin() + std::ptrdiff_t(n));
    } else {
      parts[n++] = words.front();
    }
  }
  return named;
}

/// Takes stiffnesses, NAME=VALUE, from `named`; any of them make the material of a layer without speeds.
void set_stiffness(Layer& layer, bool has_speeds, std::vector<std::string>& named, const InputUnits& units) {
  GivenStiffness given;
  std::erase_if(named, [&](const std::string& text) {
    const auto equals = text.find('=');
    const auto& names = modulus_names();
    const auto found = std::find(names.begin(), names.end(), text.substr(0, equals));
    if (equals == std::string::npos || found == names.end()) return false;
    auto& modulus = given.moduli[std::size_t(found - names.begin())];
    if (modulus) throw Error("found " + *found + " twice", ErrorKind::usage);
    modulus = parse_number(text.substr(equals + 1)) * units.of_stiffness();
    return true;
  });
  if (given.any() == has_speeds)
    throw Error(given.any() ? "found both speeds and stiffnesses, expected - for VP and VS"
                            : "found - for VP and VS, expected speeds, or stiffnesses (c11=VALUE and more)",
                ErrorKind::usage);
  if (!given.any()) return;
  given.check_kind();
  for (const auto& text : named)
    if (const auto other = find_property(text.substr(0, text.find('='))))
      if (row_of(*other).mean == Mean::elastic && !(turns_axes(*other) && !given.are_of_any_rock()))
        throw Error("found both stiffnesses and " + row_of(*other).name + ", expected one of them",
                    ErrorKind::usage);
  if (!(layer.material.rho > 0))
    throw Error("found a density of " + shown(layer.material.rho) + ", expected it above 0 with stiffnesses",
                ErrorKind::usage);
  if (const auto fault = fault_of_stiffness(given))
    throw Error(modulus_names()[std::size_t(fault->of)] + " " + fault->text, ErrorKind::usage);
  layer.material = material_of_given(given, layer.material.rho);
  const auto& of = layer.material;
  const auto add = [&](Property property, double value) { layer.others.emplace_back(property, value); };
  if (of.constants) {
    for (std::size_t n = 0; n < (*of.constants).size(); ++n)
      if ((*of.constants)[n] != 0) add(constant_at(n), (*of.constants)[n]);
    return;
  }
  if (of.is_anisotropic()) add(Property::epsilon, of.epsilon), add(Property::delta, of.delta);
  if (of.tilt != 0) add(Property::tilt, of.tilt);
  if (of.gamma != 0) add(Property::gamma, of.gamma);
  if (!of.orthorhombic) return;
  add(Property::epsilon1, of.orthorhombic->epsilon1), add(Property::delta1, of.orthorhombic->delta1);
  add(Property::delta3, of.orthorhombic->delta3), add(Property::gamma2, of.orthorhombic->gamma2);
}

void set_others(Layer& layer, const std::vector<std::string>& named) {
  std::string names;
  for (const Property property : all_properties())
    if (row_of(property).if_absent && !row_of(property).computed)
      names += (names.empty() ? "" : ", ") + row_of(property).name;
  for (const auto& text : named) {
    const auto equals = text.find('=');
    const auto property = find_property(text.substr(0, equals));
    if (equals == std::string::npos || !property || !row_of(*property).if_absent ||
        row_of(*property).computed)
      throw Error("found '" + text + "', expected NAME=VALUE, NAME one of " + names +
                      ", or of stiffnesses, c11 to c66",
                  ErrorKind::usage);
    for (const auto& [given, value] : layer.others)
      if (given == *property) throw Error("found " + row_of(given).name + " twice", ErrorKind::usage);
    const auto number = text.substr(equals + 1);
    const auto& row = row_of(*property);
    const double value = number == "inf" && row.if_absent == PropertyRow::infinite ? PropertyRow::infinite
                                                                                   : parse_number(number);
    if (!is_in_range(row, value))
      throw Error(row.name + " is " + shown(value) + ", expected " + expected_values(row), ErrorKind::usage);
    layer.others.emplace_back(*property, value);
  }
  layer.complete();
}

/// The optional properties that any layer has.
std::vector<Property> others_of(const std::vector<Layer>& layers) {
  std::vector<Property> others;
  for (const Property property : all_properties())
    if (std::any_of(layers.begin(), layers.end(), [&](const Layer& layer) {
          return std::any_of(layer.others.begin(), layer.others.end(),
                             [&](const auto& other) { return other.first == property; });
        }))
      others.push_back(property);
  return others;
}

/// The dip of the tops that part a cell of this column in 2-D, of `shares` as shares_of_cell(); the mean one
/// of several.
double dip_between(const LineOfTops& over, std::size_t column, const std::vector<double>& shares,
                   double spacing_m) {
  double above = shares.back(), across = 0, down = 0;
  for (std::size_t i = 0; i + 1 < shares.size(); ++i) {
    if (shares[i] > 0 && above > 0) {
      const double fall = over.low_edges[column + 1][i] - over.low_edges[column][i];
      const double length = std::hypot(spacing_m, fall);
      across += spacing_m / length, down += fall / length;
    }
    above += shares[i];
  }
  return std::atan2(down, across);
}

template <int D>
Index<D> index_of(std::int64_t column, std::int64_t line, std::int64_t row) {
  Index<D> at;
  at[D - 2] = line, at[0] = column, at[D - 1] = row;
  return at;
}

enum class Kind { nothing, fluid, solid };

Kind kind_of(const Layer& layer) {
  if (layer.material.rho == 0 && layer.gradient.rho == 0) return Kind::nothing;
  return layer.material.vs == 0 && layer.gradient.vs == 0 ? Kind::fluid : Kind::solid;
}

/// This class finds where cells of a grid lie in a pile of layers.
template <int D>
class Pile {
 public:
  /// `rows` as Fit::rows, or none.
  Pile(const Grid<D>& grid, const std::vector<Layer>& layers, std::vector<std::int64_t> rows)
      : grid_(grid), rows_(std::move(rows)), from_(layers.size(), 0), layers_(layers.size()) {
    rows_.resize(layers_, -1);
    for (std::size_t i = 1; i < layers_; ++i) {
      if (kind_of(layers[i]) != kind_of(layers[i - 1])) continue;
      const bool begins = i == 1 || kind_of(layers[i - 1]) != kind_of(layers[i - 2]);
      from_[i] = begins ? std::max<std::int64_t>(rows_[i - 1], 0) : from_[i - 1];
    }
  }

  /// How many tops there are down to that of the layer of a cell: 0 is void.
  std::size_t layers_at(const std::vector<double>& tops, double centre_m, std::int64_t row) const {
    std::size_t count = layers_;
    while (count > 0 && !is_below(count - 1, tops, centre_m, row)) --count;
    return count;
  }
  /// How tops cut a cell; false: none does.
  bool cut(const LineOfTops& over, const Index<D>& at, double centre_m, std::vector<Cut3D>& cuts) const {
    bool any = false;
    const auto n = std::size_t(at[0]);
    for (std::size_t i = 0; i < layers_; ++i) {
      if (rows_[i] >= 0) {
        const double apart = at[D - 1] >= rows_[i] ? -1 : 2;
        cuts[i] = {{apart, apart}, {apart, apart}};
        continue;
      }
      const auto in_cells = [&](const Tops& edges, int y) {
        return Cut{in_cell(edges[n][i], at, 0, y, centre_m), in_cell(edges[n + 1][i], at, 1, y, centre_m)};
      };
      cuts[i] = {in_cells(over.low_edges, 0), in_cells(over.high_edges, 1)};
      any = any || (cuts[i].least() < 1 && cuts[i].largest() > 0);
    }
    return any;
  }

 private:
  bool is_below(std::size_t i, const std::vector<double>& tops, double centre_m, std::int64_t row) const {
    return rows_[i] >= 0 ? row >= rows_[i] : row >= from_[i] && tops[i] <= centre_m;
  }
  /// A depth at an upright edge of a cell, counted from the upper end of that in its lengths.
  double in_cell(double depth_m, const Index<D>& at, int x, int y, double centre_m) const {
    if (!grid_.rows) return (depth_m - centre_m) / grid_.spacing_m + 0.5;
    auto corner = at;
    corner[0] += x;
    if constexpr (D == 3) corner[1] += y;
    const double upper = grid_.rows->corner(corner);
    ++corner[D - 1];
    return (depth_m - upper) / (grid_.rows->corner(corner) - upper);
  }

  const Grid<D>& grid_;
  std::vector<std::int64_t> rows_;
  std::vector<std::int64_t> from_;  // no cell above this row is a layer's: there its kind begins
  std::size_t layers_ = 0;
};

/// Depth of the top of layer i; where its kind begins there, that of the highest of the layers of this kind
/// that come one after the other: what crops out at the sea floor is part of that, and all of the surface.
double depth_of_kind(const std::vector<Layer>& layers, std::size_t i, double x_m, double y_m) {
  double depth = layers[i].top.at(x_m, y_m);
  if (i > 0 && kind_of(layers[i - 1]) == kind_of(layers[i])) return depth;
  const auto belongs = [&](const Layer& layer) {
    return i == 0 ? kind_of(layer) != Kind::nothing : kind_of(layer) == kind_of(layers[i]);
  };
  for (std::size_t k = i + 1; k < layers.size() && belongs(layers[k]); ++k)
    depth = std::min(depth, layers[k].top.at(x_m, y_m));
  return depth;
}

/// Whether a layer is made of the same as the one above it and begins nowhere above that, so that nothing
/// changes at its top.
template <int D>
bool goes_on(const std::vector<Layer>& layers, std::size_t i, const std::vector<Point<D>>& columns) {
  if (i == 0) return false;
  const Layer &layer = layers[i], &above = layers[i - 1];
  const auto plain = [](const Layer& of) { return of.profile.empty() && of.gradient == Material{}; };
  if (!plain(layer) || !plain(above) || layer.others != above.others || !(layer.material == above.material))
    return false;
  return std::all_of(columns.begin(), columns.end(), [&](const Point<D>& at) {
    const double y = D == 3 ? at[1] : 0;
    return layer.top.at(at[0], y) >= above.top.at(at[0], y);
  });
}

/// The fastest P waves of a layer so far below its top, m/s; 0 in void.
double fastest_in(const Layer& layer, double thickness_m) {
  if (kind_of(layer) == Kind::nothing) return 0;
  double fastest = 0;
  for (const double depth : {0., thickness_m})
    fastest = std::max(fastest, fastest_p_speed<3>(layer.at_depth(depth)));
  double from_m = 0;
  for (const auto& block : layer.profile) {
    if (from_m < thickness_m) fastest = std::max(fastest, fastest_p_speed<3>(block.material));
    from_m = block.to_m;
  }
  return fastest;
}

/// Returns for each layer down to `end_m` by how much its waves are slower at least than the fastest of all
/// (FitHorizon). `tops` in m.
std::vector<double> rows_a_cell_of(const std::vector<Layer>& layers,
                                   const std::vector<std::vector<double>>& tops, double end_m) {
  double of_all = 0;
  std::vector<double> of_layers;
  for (std::size_t i = 0; i < layers.size(); ++i) {
    const bool last = i + 1 == layers.size();
    double thinnest = end_m, thickest = 0;
    for (std::size_t n = 0; n < tops[i].size(); ++n) {
      const double thickness = std::min(last ? end_m : tops[i + 1][n], end_m) - tops[i][n];
      thinnest = std::min(thinnest, thickness), thickest = std::max(thickest, thickness);
    }
    of_layers.push_back(fastest_in(layers[i], thickest));
    if (thickest > 0) of_all = std::max(of_all, fastest_in(layers[i], std::max(thinnest, 0.)));
  }
  for (double& of : of_layers) of = of > 0 ? std::max(1., of_all / of) : 1;
  return of_layers;
}

/// The top of a layer as a horizon, without depths. The floor is that of the sea: all above it is fluid.
FitHorizon horizon_of(const std::vector<Layer>& layers, std::size_t i) {
  const Kind above = i ? kind_of(layers[i - 1]) : Kind::nothing, below = kind_of(layers[i]);
  const bool all_fluid = std::all_of(layers.begin(), layers.begin() + std::ptrdiff_t(i),
                                     [](const Layer& layer) { return kind_of(layer) == Kind::fluid; });
  FitHorizon horizon;
  horizon.is_top = i == 0;
  horizon.strong = above != below;
  horizon.role = i == 0                                                      ? "surface"
                 : below == Kind::solid && above == Kind::fluid && all_fluid ? "floor"
                                                                             : "layer";
  horizon.name = horizon.role == "layer" ? "layer_" + std::to_string(i + 1) : horizon.role;
  horizon.shown = horizon.role + " at " + layers[i].top.name_with_dip();
  return horizon;
}

}  // namespace

Average parse_average(std::string_view text) {
  if (text == "none") return Average::none;
  if (text == "isotropic") return Average::isotropic;
  if (text == "tilted") return Average::tilted;
  throw Error("found '" + std::string(text) + "', expected tilted, isotropic or none", ErrorKind::usage);
}

std::string name_of(Average average) {
  return average == Average::none ? "none" : average == Average::isotropic ? "isotropic" : "tilted";
}

void Layer::complete() {
  for (const auto& [property, value] : others) {
    if (property == Property::epsilon) material.epsilon = value;
    if (property == Property::delta) material.delta = value;
    if (property == Property::tilt) material.tilt = value;
    if (property == Property::azimuth) material.azimuth = value;
    if (property == Property::rotation) material.rotation = value;
    if (property == Property::gamma) material.gamma = value;
  }
  // What a layer does not say of orthorhombic rock is as where all horizontal directions are alike.
  const Orthorhombic none = {material.epsilon, material.delta, 0, material.gamma};
  Orthorhombic of = none;
  for (const auto& [property, value] : others) {
    if (property == Property::epsilon1) of.epsilon1 = value;
    if (property == Property::delta1) of.delta1 = value;
    if (property == Property::delta3) of.delta3 = value;
    if (property == Property::gamma2) of.gamma2 = value;
  }
  if (!(of == none)) material.orthorhombic = of;
}

Material Layer::at_depth(double below_top_m) const {
  const double depth = std::max(below_top_m, 0.);
  if (!profile.empty()) {
    const auto block = std::upper_bound(profile.begin(), profile.end(), depth,
                                        [](double at, const LayerBlock& one) { return at < one.to_m; });
    return (block == profile.end() ? profile.back() : *block).material;
  }
  Material at = material;
  at.vp += gradient.vp * depth, at.vs += gradient.vs * depth, at.rho += gradient.rho * depth;
  // Elastic constants stay what they are in rock whose density grows.
  if (at.constants) {
    const double slower = std::sqrt(material.rho / at.rho);
    at.vp *= slower, at.vs *= slower;
  }
  return at;
}

double Layer::value(Property property) const {
  for (const auto& [of, value] : others)
    if (of == property) return value;
  return row_of(property).if_absent.value();
}

Layer parse_layer(std::string_view text, const InputUnits& units) {
  auto parts = split(text, ':');
  auto named = in_place('\'' + std::string(text) + "'", [&] { return take_named(parts); });
  if (parts.size() != 4 && parts.size() != 5) {
    throw Error("found '" + std::string(text) + "', expected DEPTH:VP:VS:RHO[:DIP] [NAME=VALUE...]",
                ErrorKind::usage);
  }
  const bool has_speeds = parts[1] != "-" || parts[2] != "-";
  auto layer = in_place('\'' + std::string(text) + "'", [&] {
    const auto vp = has_speeds ? parse_trend(parts[1]) : Trend{},
               vs = has_speeds ? parse_trend(parts[2]) : Trend{}, rho = parse_trend(parts[3]);
    const double dip_deg = parts.size() == 5 ? parse_number(parts[4]) : 0;
    return Layer(Horizon::parse(parts[0], dip_deg),
                 {vp.value * units.factor(Property::vp), vs.value * units.factor(Property::vs),
                  rho.value * units.factor(Property::rho)},
                 {vp.gradient, vs.gradient, rho.gradient});
  });
  in_place('\'' + std::string(text) + "'", [&] {
    set_stiffness(layer, has_speeds, named, units);
    set_others(layer, named);
  });
  return layer;
}

template <int D>
Grid<D> grid_over(const Point<D>& size_m, double spacing_m) {
  if (!(spacing_m > 0))
    throw Error("found a step of " + shown(spacing_m) + " m, expected it above zero", ErrorKind::usage);
  Grid<D> grid;
  grid.spacing_m = spacing_m;
  double cells = 1;
  for (std::size_t axis = 0; axis < D; ++axis) {
    const double whole = std::max(1., std::ceil(size_m[axis] / spacing_m - 1e-6));
    cells *= whole;
    grid.shape[axis] = whole < 9e15 ? std::int64_t(whole) : 0;
  }
  const double memory = double(sysconf(_SC_PHYS_PAGES)) * double(sysconf(_SC_PAGESIZE));
  if (cells * bytes_a_cell > memory) {
    throw Error(shown(cells) + " cells do not fit into the memory of this machine, at most " +
                    shown(std::floor(memory / bytes_a_cell / 1e6) * 1e6) + " do",
                ErrorKind::usage);
  }
  return grid;
}

template <int D>
Grid<D> grid_of_size(const Point<D>& size_m, double spacing_m) {
  for (std::size_t axis = 0; axis < D && spacing_m > 0; ++axis) {
    const double steps = size_m[axis] / spacing_m, whole = std::round(steps);
    if (whole < 1 || std::abs(steps - whole) > 1e-6) {
      throw Error(shown(size_m[axis]) + " m are " + shown_to_thousandths(steps) + " steps of " +
                      shown(spacing_m) + " m, expected a whole number",
                  ErrorKind::usage);
    }
  }
  return grid_over<D>(size_m, spacing_m);
}

template <int D>
Fit<D> fit_layers(const Grid<D>& regular, const std::vector<Layer>& layers, const FitChoice& choice) {
  check_pile(regular, layers);
  const auto columns = corner_columns(regular);
  std::vector<std::vector<double>> tops;
  for (std::size_t i = 0; i < layers.size(); ++i) {
    tops.emplace_back();
    for (const auto& at : columns) tops.back().push_back(depth_of_kind(layers, i, at[0], D == 3 ? at[1] : 0));
  }
  const auto rows_a_cell = rows_a_cell_of(layers, tops, regular.end(D - 1));
  std::vector<FitHorizon> horizons;
  std::vector<std::size_t> layer_of;
  for (std::size_t i = 0; i < layers.size(); ++i) {
    const auto [least, largest] = std::minmax_element(tops[i].begin(), tops[i].end());
    if (*largest <= 0 || *least >= regular.end(D - 1) || goes_on<D>(layers, i, columns)) continue;
    horizons.push_back(horizon_of(layers, i));
    if (i > 0) horizons.back().rows_a_cell_above = rows_a_cell[i - 1];
    horizons.back().depths_m = std::move(tops[i]);
    layer_of.push_back(i);
  }
  auto fit = fit_grid(regular, horizons, choice);
  std::vector<std::int64_t> rows(layers.size(), -1);
  for (std::size_t n = 0; n < layer_of.size(); ++n) rows[layer_of[n]] = fit.rows[n];
  fit.rows = std::move(rows);
  return fit;
}

namespace {

/// Makes all cells of a line along x as those of another.
template <int D>
void copy_line(Medium<D>& medium, std::int64_t from, std::int64_t to) {
  const auto& grid = medium.grid();
  const std::int64_t nx = grid.shape[0], lines = lines_of(grid);
  for (const Property property : medium.properties()) {
    float* const values = medium[property].data();
    for (std::int64_t row = 0; row < grid.shape[D - 1]; ++row)
      std::copy_n(values + (row * lines + from) * nx, nx, values + (row * lines + to) * nx);
  }
}

}  // namespace

template <int D>
Medium<D> layered_medium(const Grid<D>& grid, const std::vector<Layer>& layers, Average average,
                         const std::vector<std::int64_t>& rows) {
  check_pile(grid, layers);
  Medium<D> medium(grid);
  auto others = others_of(layers);
  for (const Property property : others)
    medium[property] = Field<D>(grid, float(row_of(property).if_absent.value()));
  complete_anisotropy(medium);
  std::erase_if(others, [](Property property) { return row_of(property).mean == Mean::elastic; });
  const bool tilts = D == 2 && average == Average::tilted;
  if (tilts) add_tilted_means(medium);
  const Pile<D> pile(grid, layers, rows);
  const std::int64_t columns = grid.shape[0], lines = lines_of(grid),
                     different = different_lines(grid, layers);
  const bool level = !grid.rows || !grid.rows->first_curvilinear_row();
  LineOfTops over;
  std::vector<Cut3D> cuts(layers.size());
  for (std::int64_t line = 0; line < lines; ++line) {
    if (line >= different && level) {
      copy_line(medium, line - 1, line);
      continue;
    }
    if (line < different) over = tops_of_line(grid, layers, line);
    for (std::int64_t row = 0; row < grid.shape[D - 1]; ++row) {
      for (std::int64_t n = 0; n < columns; ++n) {
        const auto at = index_of<D>(n, line, row);
        const double z = grid.depth(at);
        const auto& tops = over.centres[std::size_t(n)];
        const std::size_t centre = pile.layers_at(tops, z, row);
        if (centre == 0) continue;  // void
        MaterialMean mean(layers[centre - 1].at_depth(z - tops[centre - 1]), medium.has(Property::c33));
        std::vector<ScalarMean> means;
        for (const Property property : others)
          means.emplace_back(row_of(property).mean, float(layers[centre - 1].value(property)));
        std::optional<double> dip;
        if (average != Average::none && pile.cut(over, at, z, cuts)) {
          const auto shares = shares_of_cell(cuts);
          bool all_count = true;
          for (std::size_t i = 0; i < layers.size(); ++i)
            if (mean.add(layers[i].at_depth(z - tops[i]), shares[i])) {
              for (std::size_t k = 0; k < others.size(); ++k)
                means[k].add(float(layers[i].value(others[k])), shares[i]);
            } else if (shares[i] > 0)
              all_count = false;
          if (tilts && all_count && shares.back() == 0 && !mean.has_anisotropic_part())
            dip = dip_between(over, std::size_t(n), shares, grid.spacing_m);
        }
        const auto cell = std::size_t((row * lines + line) * columns + n);
        put(medium, cell, mean.mean());
        if (dip) put_tilted_mean(medium, cell, mean.of_layers(), *dip);
        for (std::size_t k = 0; k < others.size(); ++k) medium[others[k]][cell] = float(means[k].mean());
      }
    }
  }
  if (tilted_means(medium) == 0) drop_tilted_means(medium);
  return medium;
}

template <int D>
std::vector<std::string> cut_off_layers(const Grid<D>& grid, const std::vector<Layer>& layers) {
  std::vector<std::string> sentences;
  const std::int64_t lines = different_lines(grid, layers);
  const auto highest = [&](const Layer& layer) {
    double least = std::numeric_limits<double>::infinity();
    for (std::int64_t line = 0; line < lines; ++line)
      for (std::int64_t n = 0; n < grid.shape[0]; ++n)
        least = std::min(least, layer.top.at(grid.centre(0, n), y_of(grid, line)));
    return least;
  };
  for (const auto& layer : layers)
    if (highest(layer) >= grid.end(D - 1))
      sentences.push_back("the layer at " + layer.top.name() + " begins below the model, which ends at " +
                          shown(grid.end(D - 1)) + " m");
  // Heights, or a number for no value.
  if (!layers.empty() && !layers.front().top.is_plane())
    if (const double least = highest(layers.front()); least < grid.origin_m[D - 1])
      sentences.push_back("the layer at " + layers.front().top.name() + " begins up to " +
                          shown(grid.origin_m[D - 1] - least, 6) +
                          " m above the model, whose top cuts it off: depths count downwards");
  for (std::size_t i = 0; i + 1 < layers.size(); ++i) {
    constexpr double far = std::numeric_limits<double>::infinity();
    Point<2> from{far, far}, to{-far, -far};  // x and y of the columns where it is cut off
    std::size_t by = 0;                       // the layer that first cuts this one off; 0: none
    for (std::int64_t line = 0; line < lines; ++line) {
      for (std::int64_t n = 0; n < grid.shape[0]; ++n) {
        const Point<2> at{grid.centre(0, n), y_of(grid, line)};
        const double top = layers[i].top.at(at[0], at[1]);
        for (std::size_t k = i + 1; k < layers.size(); ++k) {
          if (layers[i].top.is_plane() && layers[k].top.is_plane()) continue;
          if (!(layers[k].top.at(at[0], at[1]) < top)) continue;
          if (by == 0) by = k;
          for (std::size_t axis : {0, 1}) {
            from[axis] = std::min(from[axis], at[axis]);
            to[axis] = std::max(to[axis], at[axis]);
          }
        }
      }
    }
    if (by == 0) continue;
    sentences.push_back("the layer at " + layers[i].top.name() + " is cut off by the one at " +
                        layers[by].top.name() + " between x=" + shown(from[0]) + " and x=" + shown(to[0]));
    if (lines > 1) sentences.back() += ", y=" + shown(from[1]) + " and y=" + shown(to[1]);
  }
  return sentences;
}

SLIPWAVE_INSTANTIATE_D(FUNCTION, grid_of_size);
SLIPWAVE_INSTANTIATE_D(FUNCTION, grid_over);
SLIPWAVE_INSTANTIATE_D(FUNCTION, check_reach);
SLIPWAVE_INSTANTIATE_D(FUNCTION, fit_layers);
SLIPWAVE_INSTANTIATE_D(FUNCTION, layered_medium);

SLIPWAVE_INSTANTIATE_D(FUNCTION, cut_off_layers);

}  // namespace slipwave
